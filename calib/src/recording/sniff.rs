//! The beginning of a text, looked at before it is read: separators, header, first row.

use sensor::Sensor;

use super::batches::Batch;
use super::dialect::{Cell, Dialect, Separator};
use super::header::{self, Layout};
use super::lines::lines;
use super::number::{self, Dialects, Fault};
use super::options::{ReadOptions, Role};
use super::place::{at_line, in_file};
use super::suggest::suggestion;
use crate::Error;

/// Lines looked at, comments not counted.
const SAMPLE: usize = 200;

/// How to read the rows of a text.
#[derive(Clone, Debug)]
pub(super) struct Start {
    /// Separator and decimal mark.
    pub dialect: Dialect,
    /// Which column is what.
    pub layout: Layout,
    /// The header as it is written, to know it again.
    pub header: Option<Vec<u8>>,
    /// Rows come after this line.
    pub after: u64,
    /// What was decided that a person should know.
    pub warnings: Vec<String>,
}

/// A line kept for looking at it again.
struct Kept {
    number: u64,
    comment: bool,
    bytes: Vec<u8>,
}

/// True for lines that are no rows: comments of the usual kinds.
pub(super) fn is_comment(line: &[u8]) -> bool {
    line.starts_with(b"#") || line.starts_with(b"%") || line.starts_with(b"//")
}

/// True if `head`, the beginning of a text, has a row of numbers before anything that could be a header.
pub(super) fn starts_with_numbers(head: &[u8]) -> bool {
    let Ok(kept) = sample("", head) else {
        return false;
    };
    let dialect = dialect_of(&kept);
    let first_row = kept
        .iter()
        .position(|k| !k.comment && is_row(&k.bytes, dialect));
    first_row.is_some_and(|row| header_before(&kept, row, dialect).is_none())
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
        let Some(first) = kept.iter().find(|k| !k.comment) else {
            return Err(in_file(
                name,
                "no data: nothing but blank and comment lines",
            ));
        };
        let row = kept
            .iter()
            .position(|k| !k.comment && is_row(&k.bytes, dialect));
        let header = match row {
            Some(row) => header_before(&kept, row, dialect),
            None => Some(first),
        };
        let mut start = Self {
            dialect,
            layout: Layout::default(),
            header: header.map(|kept| kept.bytes.clone()),
            after: header.map_or(0, |kept| kept.number),
            warnings: Vec::new(),
        };
        if dialect.decimal_comma {
            start
                .warnings
                .push("decimal commas, read as decimal points".to_owned());
        }
        let rows: Vec<&Kept> = kept
            .iter()
            .filter(|k| !k.comment && k.number > start.after)
            .collect();
        match header {
            Some(header) => start.read_header(name, header, &rows, only, options)?,
            None => start.without_header(name, &rows, only, options)?,
        }
        Ok(start)
    }

    fn read_header(
        &mut self,
        name: &str,
        header: &Kept,
        rows: &[&Kept],
        only: Option<Sensor>,
        options: &ReadOptions,
    ) -> Result<(), Error> {
        let refuse = |words: String| at_line(name, header.number, words);
        let mut cells = Vec::new();
        let bytes = without_comment_mark(&header.bytes);
        self.dialect.split(bytes, &mut cells).map_err(|at| {
            refuse(format!(
                "a quote is opened at column {} and never closed",
                at + 1
            ))
        })?;
        let mut names: Vec<String> = cells
            .iter()
            .map(|c| self.decode(&bytes[c.clone()]))
            .collect();
        let width = usual_width(rows, self.dialect).unwrap_or(names.len());
        if rows.is_empty() {
            // A wrong header is the better news.
            Layout::of_names(names, &options.columns, only).map_err(refuse)?;
            return Err(refuse("header found, no data rows".to_owned()));
        }
        if names.len() == width + 1 && names.last().is_some_and(String::is_empty) {
            names.pop();
        }
        if width != names.len() && !(width == names.len() + 1 && ends_empty(rows, self.dialect)) {
            let doubled = width > names.len() && width <= 2 * names.len();
            if self.dialect.separator == Separator::Byte(b',') && doubled && only_integers(rows) {
                return Err(refuse(format!(
                    "{} names but {width} cells in the rows: a comma is both separator and decimal mark, which cannot be undone; export with points or with semicolons",
                    names.len()
                )));
            }
            if options.columns.0.is_empty() {
                names.resize(width.max(names.len()), String::new());
                let line = suggestion(&(1..=width).map(|i| i.to_string()).collect::<Vec<_>>());
                return Err(refuse(format!(
                    "the header has {} names, the rows have {width} cells: are two names glued together? {line} (columns by number)",
                    cells.len(),
                )));
            }
            names.resize(width, String::new());
        }
        self.layout = Layout::of_names(names, &options.columns, only).map_err(refuse)?;
        Ok(())
    }

    /// Bytes of a header cell as text, by Latin-1 where they are no UTF-8.
    fn decode(&mut self, bytes: &[u8]) -> String {
        if let Ok(text) = std::str::from_utf8(bytes) {
            return text.to_owned();
        }
        let warning = "header is not UTF-8, read as Latin-1";
        if !self.warnings.iter().any(|w| w == warning) {
            self.warnings.push(warning.to_owned());
        }
        bytes.iter().map(|&b| char::from(b)).collect()
    }

    fn without_header(
        &mut self,
        name: &str,
        rows: &[&Kept],
        only: Option<Sensor>,
        options: &ReadOptions,
    ) -> Result<(), Error> {
        let first = rows.first().map_or(1, |row| row.number);
        let refuse = |words: String| at_line(name, first, words);
        let width = usual_width(rows, self.dialect).unwrap_or(0);
        let names: Vec<String> = (1..=width).map(|i| i.to_string()).collect();
        self.layout.width = width;
        let roles = if options.columns.0.is_empty() {
            let roles = unnamed_roles(width, only, &medians(rows, self.dialect)).ok_or_else(|| {
                refuse(format!(
                    "{width} columns without a header, and gravity does not tell which are which; {}",
                    suggestion(&names)
                ))
            })?;
            // Four columns of a file that is known to hold one sensor need no comment.
            if only.is_none() {
                let used: Vec<_> = roles
                    .iter()
                    .map(|(role, i)| format!("{}={}", role.name(), i + 1))
                    .collect();
                self.warnings
                    .push(format!("no header; columns taken as {}", used.join(",")));
            }
            roles
        } else {
            header::roles_by_map(&names, &options.columns).map_err(refuse)?
        };
        self.layout.assign(&roles).map_err(refuse)
    }
}

/// The first lines of the text that are not blank.
fn sample(name: &str, head: &[u8]) -> Result<Vec<Kept>, Error> {
    let head = Batch::of(head);
    let (mut kept, mut rows) = (Vec::new(), 0);
    for (number, range) in (1..).zip(lines(&head.bytes, 0)) {
        if let Some(words) = head.fault(&range) {
            return Err(at_line(name, number, words));
        }
        let line = &head.bytes[range];
        if !line.trim_ascii().is_empty() {
            let comment = is_comment(line);
            rows += usize::from(!comment);
            kept.push(Kept {
                number,
                comment,
                bytes: line.to_vec(),
            });
        }
        if rows == SAMPLE {
            break;
        }
    }
    Ok(kept)
}

fn dialect_of(kept: &[Kept]) -> Dialect {
    let lines: Vec<&[u8]> = kept
        .iter()
        .filter(|k| !k.comment)
        .map(|k| k.bytes.as_slice())
        .collect();
    Dialect::of(&lines)
}

fn without_comment_mark(line: &[u8]) -> &[u8] {
    let marks = line
        .iter()
        .take_while(|b| matches!(b, b'#' | b'%' | b'/' | b' '))
        .count();
    if is_comment(line) {
        &line[marks..]
    } else {
        line
    }
}

fn cells(line: &[u8], dialect: Dialect) -> Vec<Cell> {
    let mut cells = Vec::new();
    let _ = dialect.split(line, &mut cells);
    cells
}

/// True if at least half of the cells are numbers.
fn is_row(line: &[u8], dialect: Dialect) -> bool {
    let cells = cells(line, dialect);
    let number = |cell: &Cell| {
        let value = number::parse(
            &line[cell.clone()],
            dialect.decimal_comma,
            &mut Dialects::default(),
        );
        matches!(
            value,
            Ok(_) | Err(Fault::NotFinite | Fault::Thousands | Fault::DecimalComma)
        )
    };
    let numbers = cells.iter().filter(|cell| number(cell)).count();
    numbers >= 1 && 2 * numbers >= cells.len()
}

/// The line that names the columns of `row`: the text line before it, or a comment with as many cells.
fn header_before(kept: &[Kept], row: usize, dialect: Dialect) -> Option<&Kept> {
    let before = &kept[..row];
    if let Some(text) = before.iter().rfind(|k| !k.comment) {
        return Some(text);
    }
    let comment = before.last()?;
    let bytes = without_comment_mark(&comment.bytes);
    let same = cells(bytes, dialect).len() == cells(&kept[row].bytes, dialect).len();
    (same && bytes.iter().any(u8::is_ascii_alphabetic) && !is_row(bytes, dialect))
        .then_some(comment)
}

/// The number of cells that most rows have.
fn usual_width(rows: &[&Kept], dialect: Dialect) -> Option<usize> {
    let mut widths: Vec<usize> = rows
        .iter()
        .map(|row| cells(&row.bytes, dialect).len())
        .collect();
    widths.sort_unstable();
    widths
        .chunk_by(|a, b| a == b)
        .max_by_key(|run| run.len())
        .and_then(|run| run.first().copied())
}

/// True if the rows end with a separator, which makes an empty last cell.
fn ends_empty(rows: &[&Kept], dialect: Dialect) -> bool {
    rows.iter().all(|row| {
        cells(&row.bytes, dialect)
            .last()
            .is_some_and(|cell| cell.is_empty())
    })
}

fn only_integers(rows: &[&Kept]) -> bool {
    rows.iter().all(|row| !row.bytes.contains(&b'.'))
}

/// The median of every triple of columns' norm: `norms[i]` is that of columns i, i+1, i+2.
fn medians(rows: &[&Kept], dialect: Dialect) -> Vec<f64> {
    let width = usual_width(rows, dialect).unwrap_or(0);
    let table: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| {
            let value = |cell: Cell| {
                number::parse(
                    &row.bytes[cell],
                    dialect.decimal_comma,
                    &mut Dialects::default(),
                )
            };
            cells(&row.bytes, dialect)
                .into_iter()
                .filter_map(|cell| value(cell).ok())
                .collect()
        })
        .filter(|row: &Vec<f64>| row.len() == width)
        .collect();
    (0..width.saturating_sub(2))
        .filter_map(|i| {
            let norm = |row: &Vec<f64>| row[i].hypot(row[i + 1]).hypot(row[i + 2]);
            let mut norms: Vec<f64> = table.iter().map(norm).collect();
            let middle = norms.len() / 2;
            (!norms.is_empty()).then(|| *norms.select_nth_unstable_by(middle, f64::total_cmp).1)
        })
        .collect()
}

/// Roles of unnamed columns: by the known sensor, or by which triad has the length of gravity.
fn unnamed_roles(width: usize, only: Option<Sensor>, norms: &[f64]) -> Option<Vec<(Role, usize)>> {
    let gravity = |i: usize| {
        norms
            .get(i)
            .is_some_and(|n| (7.0..13.0).contains(n) || (0.8..1.25).contains(n))
    };
    let accel = |at: usize| (0..3).map(move |i| (Role::Accel(i), at + i));
    let gyro = |at: usize| (0..3).map(move |i| (Role::Gyro(i), at + i));
    let time = usize::from(matches!(width, 4 | 7));
    let mut roles: Vec<(Role, usize)> = (0..time).map(|i| (Role::Time, i)).collect();
    match (width, only) {
        (3 | 4, Some(Sensor::Accelerometer)) => roles.extend(accel(time)),
        (3 | 4, Some(Sensor::Gyroscope)) => roles.extend(gyro(time)),
        (3 | 4, None) if gravity(time) => roles.extend(accel(time)),
        (6 | 7, None) => match (gravity(time), gravity(time + 3)) {
            (true, false) => roles.extend(accel(time).chain(gyro(time + 3))),
            (false, true) => roles.extend(gyro(time).chain(accel(time + 3))),
            _ => return None,
        },
        _ => return None,
    }
    Some(roles)
}
