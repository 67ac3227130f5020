//! The beginning of a text, looked at before it is read: separators, header, first row.

use findings::{Finding, Findings, Kind, OptionName, Remedy};
use sensor::Sensor;

use super::by_map::{affines, refuse_twins, roles_by_map};
use super::dialect::{Cell, Dialect, Separator};
use super::preface::{
    Finder, Kept, Preface, cells, decode, is_comment, without_comment_mark, words,
};
use super::questions::likely::{example, likely, rising};
use super::quotes::open_quote;
use super::row_shape::{
    ends_empty, first_row, is_empty, is_finer, only_integers, rows_are_numbered, stands_still,
    usual_width,
};
use super::suggest::is_by_number;
use super::time_column::is_date;
use super::unit_row;
use super::unnamed::Unnamed;
use crate::Error;
use crate::devices::labels::{self, Class};
use crate::header::Layout;
use crate::recording::options::{ReadOptions, Role};
use crate::rows::number::{self, Dialects};
use crate::source::batches::Batch;
use crate::source::cut::usual_tail;
use crate::source::lines::lines;
use crate::source::place::{at_column, at_line, in_file};

findings::tuning! {
    /// Rows looked at.
    SAMPLE: usize = 200;

    /// Comments that are looked at for a header.
    COMMENTS: usize = 1000;
}

/// Format of a text's rows, found from its beginning.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    /// Separator and decimal mark.
    pub dialect: Dialect,
    /// Roles of the columns.
    pub layout: Layout,
    /// The header as it is written, to know it again.
    pub header: Option<Vec<u8>>,
    /// The row of units below it, for the same reason.
    pub units: Option<Vec<u8>>,
    /// Its line.
    pub header_line: u64,
    /// Bytes from the decimal mark on that the last number of every row has, if they are as many.
    pub tail: Option<usize>,
    /// Rows come after this line.
    pub after: u64,
    /// Warnings about what was decided.
    pub warnings: Findings,
    /// Accelerometer and gyroscope can only be told apart after all rows are read.
    pub undecided: bool,
    /// Gravity told which is which in the rows looked at.
    pub told_by_norm: bool,
    /// Names of columns without a role whose numbers change.
    pub unclear: Vec<String>,
    /// Columns that may say which device a row is of.
    pub labels: Vec<(usize, Class)>,
    /// Where no column is the time, one without a role that may be it by its numbers.
    pub rising: Option<usize>,
}

/// True if `head`, the beginning of a text, has a row of numbers before anything that could be a header.
pub(crate) fn starts_with_numbers(head: &[u8]) -> bool {
    let Ok(kept) = sample("", head) else {
        return false;
    };
    let dialect = dialect_of(&kept);
    let first_row = first_row(&kept, dialect);
    let finder = Finder {
        dialect,
        only: None,
        options: &ReadOptions::default(),
    };
    first_row.is_some_and(|row| finder.preface(&kept, Some(row)).header.is_none())
}

/// True if `head` begins a text with rows of three cells or more: a sensor of which one is missing has as many.
pub(crate) fn is_table(head: &[u8]) -> bool {
    let Ok(kept) = sample("", head) else {
        return false;
    };
    let dialect = dialect_of(&kept);
    let row = first_row(&kept, dialect).and_then(|row| kept.get(row));
    row.is_some_and(|row| cells(&row.bytes, dialect).len() >= 3)
}

/// Returns which of accelerometer and gyroscope `head`, the beginning of the text called `name`, has by its names; both if that is
/// undecided.
pub(crate) fn sensors_in(name: &str, head: &[u8], options: &ReadOptions) -> [bool; 2] {
    match Start::look(name, head, None, options) {
        Ok(start) if start.undecided => [true, true],
        Ok(start) => [start.layout.accel.is_some(), start.layout.gyro.is_some()],
        Err(_) => [false, false],
    }
}

impl Start {
    /// Looks at `head`, the beginning of the text called `name`; `only` is the one sensor in it, if
    /// that is known.
    pub fn look(
        name: &str,
        head: &[u8],
        only: Option<Sensor>,
        options: &ReadOptions,
    ) -> Result<Self, Error> {
        let kept = sample(name, head)?;
        let dialect = dialect_of(&kept);
        if kept.iter().all(|k| k.comment) {
            return Err(in_file(name, Finding::of(Kind::NO_DATA)));
        }
        let row = first_row(&kept, dialect);
        let finder = Finder {
            dialect,
            only,
            options,
        };
        let preface = finder.preface(&kept, row);
        let last = preface.said.or(preface.units).or(preface.header);
        let mut start = Self {
            dialect,
            layout: Layout::default(),
            header: preface.header.map(|kept| kept.bytes.clone()),
            units: preface.units.map(|kept| kept.bytes.clone()),
            header_line: preface.header.map_or(0, |kept| kept.number),
            tail: None,
            after: last.map_or(0, |kept| kept.number),
            warnings: Findings::new(),
            undecided: false,
            told_by_norm: false,
            unclear: Vec::new(),
            labels: Vec::new(),
            rising: None,
        };
        if dialect.decimal_comma {
            start.warnings.push(
                Finding::of(Kind::NUMBER_SPELLING)
                    .detail("spelling", "decimal commas")
                    .detail("read_as", "decimal points"),
            );
        }
        let rows: Vec<&Kept> = kept
            .iter()
            .filter(|k| !k.comment && k.number > start.after)
            .collect();
        if let Some(open) = preface
            .header
            .and_then(|h| start.open_quote(name, h, &kept))
        {
            return Err(open);
        }
        match preface.header {
            Some(header) => start.read_header(name, header, &rows, only, options)?,
            None => start.without_header(name, &rows, only, options)?,
        }
        start.read_units(name, preface, options)?;
        start.unclear = start.unclear(&rows);
        // Asked for only where no column is the time.
        let is_free = |at| !start.layout.is_read(at);
        let untimed = start.layout.time.is_none();
        start.rising = untimed.then(|| rising(&rows, dialect, is_free)).flatten();
        start.labels = labels::columns(&start.layout, &rows, dialect, options);
        if let Some(row) = row.filter(|_| preface.header.is_none()) {
            start.pass_torn(&kept, row);
        }
        start.tail = start.usual_tail(&rows);
        Ok(start)
    }

    /// Returns the error about an open quote in the header, if there is one.
    fn open_quote(&self, name: &str, header: &Kept, kept: &[Kept]) -> Option<Error> {
        let bytes = without_comment_mark(&header.bytes);
        let at = self.dialect.split(bytes, &mut Vec::new()).err()?;
        let below = kept.iter().filter(|k| k.number > header.number);
        let found = open_quote(below.map(|k| (k.number, &k.bytes[..])));
        let column = header.bytes.len() - bytes.len() + at + 1;
        Some(at_column(name, header.number, column, found))
    }

    /// Takes over the units that stand below the names.
    fn read_units(
        &mut self,
        name: &str,
        preface: Preface<'_>,
        options: &ReadOptions,
    ) -> Result<(), Error> {
        let Some(line) = preface.units else {
            return Ok(());
        };
        let cells = words(&line.bytes, self.dialect);
        let stated = unit_row::stated(&self.layout, &cells, options);
        self.layout.stated = stated.map_err(|found| at_line(name, line.number, *found))?;
        Ok(())
    }

    /// Returns the usual number of bytes from the decimal mark on in the last cell of `rows`; the very last row is ignored.
    fn usual_tail(&self, rows: &[&Kept]) -> Option<usize> {
        let column = self.layout.width.checked_sub(1)?;
        let (_, rows) = rows.split_last().filter(|_| self.layout.is_read(column))?;
        let last = rows.iter().filter_map(|row| {
            let cell = cells(&row.bytes, self.dialect).get(column)?.clone();
            Some(&row.bytes[cell])
        });
        usual_tail(last, self.dialect.mark())
    }

    /// Names of the columns without a role whose numbers change within `rows`.
    fn unclear(&self, rows: &[&Kept]) -> Vec<String> {
        let number = |row: &Kept, column: usize| {
            let cell = cells(&row.bytes, self.dialect).get(column)?.clone();
            let decimal_comma = self.dialect.decimal_comma;
            number::parse(&row.bytes[cell], decimal_comma, &mut Dialects::default()).ok()
        };
        let changes = |column: &usize| {
            let mut numbers = rows.iter().filter_map(|row| number(row, *column));
            let first = numbers.next();
            first.is_some_and(|first| numbers.any(|other| other != first))
        };
        let unused = (0..self.layout.names.len()).filter(|&column| !self.layout.is_read(column));
        let unclear = unused.filter(changes);
        unclear
            .map(|column| self.layout.names[column].clone())
            .collect()
    }

    /// True if every cell of a line is a number.
    fn is_numbers(&self, line: &Kept) -> bool {
        let parse = |cell: Cell| {
            let decimal_comma = self.dialect.decimal_comma;
            number::parse(&line.bytes[cell], decimal_comma, &mut Dialects::default())
        };
        let mut cells = cells(&line.bytes, self.dialect).into_iter();
        cells.all(|cell| parse(cell).is_ok())
    }

    /// Passes a first row that is cut at its beginning, as a log begins that is opened while the device sends.
    fn pass_torn(&mut self, kept: &[Kept], row: usize) {
        let torn: Vec<&Kept> = kept[..row].iter().filter(|k| !k.comment).collect();
        if let [torn] = torn[..]
            && cells(&torn.bytes, self.dialect).len() < self.layout.width
            && self.is_numbers(torn)
        {
            self.after = self.after.max(torn.number);
            let cut = Finding::of(Kind::ROW_CUT).detail("which", "first");
            self.warnings.push(cut.count("line", torn.number as usize));
        }
    }

    fn read_header(
        &mut self,
        name: &str,
        header: &Kept,
        rows: &[&Kept],
        only: Option<Sensor>,
        options: &ReadOptions,
    ) -> Result<(), Error> {
        let refuse = |found: Box<Finding>| at_line(name, header.number, *found);
        let bytes = without_comment_mark(&header.bytes);
        let cells = cells(bytes, self.dialect);
        if std::str::from_utf8(bytes).is_err() {
            self.warnings.push(
                Finding::of(Kind::TEXT_ENCODING)
                    .detail("part", "the header")
                    .detail("encoding", "Latin-1"),
            );
        }
        let cell = |cell: &Cell| decode(&bytes[cell.clone()]);
        let mut names: Vec<String> = cells.iter().map(cell).collect();
        refuse_twins(&names, &options.columns).map_err(Error::usage)?;
        let width = usual_width(rows, self.dialect).unwrap_or(names.len());
        if rows.is_empty() {
            // A wrong header is the better news.
            Layout::of_names(names, &options.columns, only).map_err(refuse)?;
            let none = Finding::of(Kind::NO_ROWS).detail("found", "header");
            return Err(refuse(none.into()));
        }
        if names.len() == width + 1 && names.last().is_some_and(String::is_empty) {
            names.pop();
        }
        if width == names.len() + 1 && rows_are_numbered(rows, self.dialect) {
            // R and pandas number their rows, and give the numbers no name.
            names.insert(0, String::new());
        }
        if width != names.len() && !(width == names.len() + 1 && ends_empty(rows, self.dialect)) {
            let doubled = width > names.len() && width <= 2 * names.len();
            if self.dialect.separator == Separator::Byte(b',') && doubled && only_integers(rows) {
                let twice = Finding::of(Kind::COMMA_TWICE)
                    .count("names", names.len())
                    .count("width", width);
                return Err(refuse(twice.into()));
            }
            if options.columns.0.is_empty() {
                names.resize(width.max(names.len()), String::new());
                let other = Finding::of(Kind::HEADER_WIDTH)
                    .count("names", cells.len())
                    .count("width", width)
                    .only_remedies(by_readings(rows, self.dialect, width, only));
                return Err(refuse(other.into()));
            }
            names.resize(width, String::new());
        }
        let layout = Layout::of_names(names.clone(), &options.columns, only);
        self.layout = layout.map_err(|found| {
            let by_rows = || example(rows, self.dialect, &names);
            refuse(match is_by_number(&found) {
                true => found.only_remedies(by_rows()).into(),
                false => found,
            })
        })?;
        if !options.columns.names(Role::Time) {
            let stands_still = |column| stands_still(rows, self.dialect, column);
            self.layout.take_time_that_moves(stands_still);
            let is_finer = |other, time| is_finer(rows, self.dialect, other, time);
            self.layout.take_finer_time(is_finer);
        }
        // Stamps that a logger did not have, and days without a time.
        let has_none = |time: &usize| {
            let is_day = self
                .layout
                .names
                .get(*time)
                .is_some_and(|name| is_date(name))
                && !options.columns.names(Role::Time)
                && stands_still(rows, self.dialect, *time);
            is_day || is_empty(rows, self.dialect, *time)
        };
        if self.layout.time.is_some_and(|time| has_none(&time)) {
            self.layout.time = None;
            self.layout.stated.time = None;
        }
        self.warnings.extend(self.layout.by_unit.clone());
        Ok(())
    }

    fn without_header(
        &mut self,
        name: &str,
        rows: &[&Kept],
        only: Option<Sensor>,
        options: &ReadOptions,
    ) -> Result<(), Error> {
        let first = rows.first().map_or(1, |row| row.number);
        let refuse = |found: Box<Finding>| at_line(name, first, *found);
        let width = usual_width(rows, self.dialect).unwrap_or(0);
        let names: Vec<String> = (1..=width).map(|i| i.to_string()).collect();
        self.layout.width = width;
        let mut columns = options.columns.0.iter();
        let roles = if columns.all(|(role, _)| *role == Role::Device) {
            let unnamed = Unnamed::of(rows, self.dialect);
            let told = unnamed.roles(only);
            self.told_by_norm = told.is_some();
            self.undecided = matches!(unnamed.width(), 6..=8) && only.is_none();
            let roles = told.or_else(|| self.undecided.then(|| unnamed.two_triads()));
            let roles = roles.ok_or_else(|| {
                let unknown = Finding::of(Kind::NO_HEADER).count("width", width);
                let example = by_readings(rows, self.dialect, width, only);
                refuse(unknown.only_remedies(example).into())
            })?;
            // Four columns of a file that is known to hold one sensor need no comment.
            if only.is_none() && !self.undecided {
                let used: Vec<_> = roles
                    .iter()
                    .map(|(role, i)| format!("{}={}", role.name(), i + 1))
                    .collect();
                let told = Finding::of(Kind::COLUMNS_BY_READINGS);
                self.warnings.push(told.detail("columns", used.join(",")));
            }
            roles
        } else {
            refuse_twins(&names, &options.columns).map_err(Error::usage)?;
            self.layout.affine = affines(&names, &options.columns);
            roles_by_map(&names, &options.columns).map_err(refuse)?
        };
        let assigned = self.layout.assign(&roles, &options.columns);
        assigned.map_err(refuse)
    }
}

/// The columns of the axes as the readings of rows of another width than the header's show them, else any of numbers as an example.
fn by_readings(
    rows: &[&Kept],
    dialect: Dialect,
    width: usize,
    only: Option<Sensor>,
) -> Option<Remedy> {
    let numbers: Vec<String> = (1..=width).map(|i| i.to_string()).collect();
    let roles = Unnamed::of(rows, dialect).roles(only);
    let Some(roles) = roles.or_else(|| likely(rows, dialect)) else {
        return example(rows, dialect, &numbers);
    };
    let columns = roles
        .iter()
        .map(|(role, at)| format!("{}={}", role.name(), at + 1));
    let columns: Vec<String> = columns.collect();
    Some(Remedy::such_as(OptionName::Columns, columns.join(",")))
}

/// The first lines of the text that are not blank.
fn sample(name: &str, head: &[u8]) -> Result<Vec<Kept>, Error> {
    let head = Batch::of(head);
    let (mut kept, mut rows) = (Vec::new(), 0);
    for (number, range) in (1..).zip(lines(&head.bytes, 0)) {
        if let Some(found) = head.fault(&range) {
            return Err(at_line(name, number, found));
        }
        let line = &head.bytes[range];
        if !line.trim_ascii().is_empty() {
            let comment = is_comment(line);
            if rows == 0 && kept.len() == 2 * COMMENTS.get() {
                kept.drain(..COMMENTS.get());
            }
            rows += usize::from(!comment && begins_like_a_row(line));
            kept.push(Kept {
                number,
                comment,
                bytes: line.to_vec(),
            });
        }
        if rows == SAMPLE.get() {
            break;
        }
    }
    Ok(kept)
}

/// True for a line that begins with a number: a preface of text does not.
fn begins_like_a_row(line: &[u8]) -> bool {
    let mark = |byte: &u8| !matches!(byte, b' ' | b'\t' | b'"' | b'+' | b'-' | b'.' | b',' | b';');
    let first = line.iter().find(|byte| mark(byte));
    first.is_none_or(u8::is_ascii_digit)
}

fn dialect_of(kept: &[Kept]) -> Dialect {
    let lines: Vec<&[u8]> = kept
        .iter()
        .filter(|k| !k.comment)
        .map(|k| k.bytes.as_slice())
        .collect();
    Dialect::of(&lines)
}
