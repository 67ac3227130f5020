//! LabVIEW measurement files: a list of settings, a header per segment, one column of stamps, one per channel, or a step.

use std::io::Read;

use super::text_format::TextFormat;
use crate::header::look::Look;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;

/// A text that begins with `LabVIEW Measurement` (NI, "Specification for the LabVIEW Measurement File (.lvm)").
pub(crate) static LABVIEW: TextFormat = TextFormat {
    name: "lvm",
    about: "a LabVIEW measurement file (.lvm): `LabVIEW Measurement`, settings, `X_Value` and a column per channel",
    parts,
};

/// The first word of such a file.
const BEGIN: &str = "LabVIEW Measurement";
/// The first name above the rows.
const STAMPS: &str = "X_Value";
/// The last, of a column that most rows lack.
const COMMENT: &str = "Comment";

fn parts(look: &Look) -> Option<Vec<Part>> {
    let begins = look.lines().next()?.starts_with(BEGIN);
    begins.then(|| {
        vec![Part {
            change: Some(change),
            ..Part::default()
        }]
    })
}

/// Columns of stamps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stamps {
    #[default]
    One,
    /// One before each channel.
    Each,
    /// None: stamps are a step apart.
    Step,
}

/// The settings in the lines above the rows.
#[derive(Debug, Default)]
struct Settings {
    comma: bool,
    decimal_comma: bool,
    stamps: Stamps,
    is_time: bool,
    begin: f64,
    /// That of the segment before.
    begun: f64,
    step: f64,
    units: Vec<String>,
    /// Names of the channels.
    names: Vec<String>,
    /// The header of this segment has been met.
    in_rows: bool,
    /// Rows of this segment.
    rows: usize,
}

impl Settings {
    fn cells<'a>(&self, line: &'a str) -> Vec<&'a str> {
        let separator = if self.comma { ',' } else { '\t' };
        line.split(separator).map(str::trim).collect()
    }

    fn number(&self, text: &str) -> Option<f64> {
        text.replace(',', ".").parse().ok()
    }

    /// Takes a setting in.
    fn set(&mut self, line: &str) {
        if let Some(rest) = line.strip_prefix("Separator") {
            self.comma = rest.trim().trim_start_matches(',') == "Comma";
        }
        let cells = self.cells(line);
        let value = cells.get(1).copied().unwrap_or_default();
        match cells[0] {
            "Decimal_Separator" => self.decimal_comma = line.trim_end().ends_with(','),
            "X_Columns" => {
                self.stamps = match value {
                    "Multi" => Stamps::Each,
                    "No" => Stamps::Step,
                    _ => Stamps::One,
                }
            }
            "X_Dimension" => self.is_time = value == "Time",
            "X0" => self.begin = self.number(value).unwrap_or(0.0),
            "Delta_X" => self.step = self.number(value).unwrap_or(0.0),
            "Y_Unit_Label" => self.units = cells[1..].iter().map(|&unit| unit.to_owned()).collect(),
            _ => {}
        }
    }

    /// The names above the rows.
    fn header(&mut self, line: &str) -> String {
        let cells = self.cells(line);
        let names = cells[1..]
            .iter()
            .filter(|name| !matches!(**name, STAMPS | COMMENT | ""));
        let unit = |at: usize| self.units.get(at).filter(|unit| !unit.is_empty());
        let named = |(at, name): (usize, &&str)| match unit(at) {
            Some(unit) if !name.contains(['(', '[']) => format!("{name} [{unit}]"),
            _ => (*name).to_owned(),
        };
        self.names = names.enumerate().map(named).collect();
        let first = if self.is_time { "t [s]" } else { STAMPS };
        self.joined(std::iter::once(first.to_owned()).chain(self.names.iter().cloned()))
    }

    fn joined(&self, cells: impl Iterator<Item = String>) -> String {
        let cells: Vec<String> = cells.collect();
        cells.join(if self.comma { "," } else { "\t" })
    }

    /// A row as its stamp and a cell per channel; `None` for a line that is no row.
    fn row(&self, line: &str) -> Option<String> {
        let cells = self.cells(line);
        let count = self.names.len();
        let (stamp, values): (String, Vec<&str>) = match self.stamps {
            Stamps::One => ((*cells.first()?).to_owned(), cells.get(1..=count)?.to_vec()),
            Stamps::Step => {
                let stamp = format!("{:.9}", self.begin + self.step * self.rows as f64);
                let stamp = match self.decimal_comma {
                    true => stamp.replace('.', ","),
                    false => stamp,
                };
                (stamp, cells.get(1..=count)?.to_vec())
            }
            Stamps::Each => {
                let pairs: Vec<&[&str]> = cells.get(..2 * count)?.chunks(2).collect();
                let alike = pairs.iter().all(|pair| pair[0] == cells[0]);
                // Of other stamps the reader makes no number.
                let stamp = match alike {
                    true => cells[0].to_owned(),
                    false => format!("{} and {}", cells[0], pairs[count - 1][0]),
                };
                (stamp, pairs.iter().map(|pair| pair[1]).collect())
            }
        };
        let begins =
            |text: &str| text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '.'));
        let is_row = begins(&stamp) && values.iter().any(|value| begins(value));
        is_row.then(|| {
            self.joined(std::iter::once(stamp).chain(values.into_iter().map(str::to_owned)))
        })
    }
}

/// The names once, the rows without comments, and everything else as a comment.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut settings = Settings::default();
    rewritten(text, move |line, out| {
        let text = String::from_utf8_lossy(line);
        if text.starts_with(STAMPS) && !settings.in_rows {
            let known = !settings.names.is_empty();
            let (before, rows) = (settings.names.clone(), settings.rows);
            let header = settings.header(&text);
            settings.in_rows = true;
            // Of a segment that states the same begin the rows go on.
            let goes_on = known && settings.begin == settings.begun;
            settings.rows = if goes_on { rows } else { 0 };
            settings.begun = settings.begin;
            return match known && settings.names == before {
                true => out.extend_from_slice(b"# "),
                false => out.extend_from_slice(header.as_bytes()),
            };
        }
        if settings.in_rows
            && let Some(row) = settings.row(&text)
        {
            settings.rows += 1;
            return out.extend_from_slice(row.as_bytes());
        }
        settings.in_rows &= text.trim().is_empty();
        settings.set(&text);
        if !text.trim().is_empty() {
            out.extend_from_slice(b"# ");
            out.extend_from_slice(line);
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn changed(text: &str) -> Vec<String> {
        assert!(parts(&Look::at(text.as_bytes())).is_some());
        let rows = changed_by(change, text);
        assert_eq!(rows.lines().count(), text.lines().count());
        let rows = rows
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty());
        rows.map(str::to_owned).collect()
    }

    const HEAD: &str =
        "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\n***End_of_Header***\t\n\t\n";

    #[test]
    fn rows_of_all_segments_follow_the_names() {
        let segment = "Channels\t2\nX_Dimension\tTime\tTime\nX0\t0\t0\nDelta_X\t0.01\t0.01\n***End_of_Header***\t\t\nX_Value\tax\tgx (deg/s)\tComment\n";
        let text = format!("{HEAD}{segment}0.00\t1\t2\tbegin\n0.01\t3\t4\n\n{segment}0.02\t5\t6\n");
        let rows = [
            "t [s]\tax\tgx (deg/s)",
            "0.00\t1\t2",
            "0.01\t3\t4",
            "0.02\t5\t6",
        ];
        assert_eq!(changed(&text), rows);
    }

    #[test]
    fn a_step_makes_stamps_and_those_of_the_channels_are_one() {
        let head = HEAD.replace("Tab\n", "Tab\nX_Columns\tNo\n");
        let text = format!(
            "{head}Y_Unit_Label\tg\t\nX_Dimension\tTime\tTime\nX0\t1.5\t1.5\nDelta_X\t0.01\t0.01\nX_Value\tax\tay\tComment\n\t1\t2\n\t3\t4\n"
        );
        let rows = [
            "t [s]\tax [g]\tay",
            "1.500000000\t1\t2",
            "1.510000000\t3\t4",
        ];
        assert_eq!(changed(&text), rows);
        let head = HEAD.replace("Tab\n", "Tab\nX_Columns\tMulti\n");
        let text = format!(
            "{head}X_Dimension\tTime\tTime\nX_Value\tax\tX_Value\tay\tComment\n0.1\t1\t0.1\t2\n0.2\t3\t0.3\t4\n"
        );
        assert_eq!(
            changed(&text),
            ["t [s]\tax\tay", "0.1\t1\t2", "0.2 and 0.3\t3\t4"]
        );
    }
}
