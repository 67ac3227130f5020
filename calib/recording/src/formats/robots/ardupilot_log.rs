//! ArduPilot's log as a text, as Mission Planner and mavlogdump write it: `FMT, 131, 43, IMU, QBffffff, TimeUS,I,GyrX,..`, and rows
//! `IMU, 1000, 0, 0.01, ..` among those of other messages.

use std::io::Read;

use super::ardupilot_text::corrected;
use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;

/// ArduPilot's log as a text.
pub(crate) static ARDUPILOT_LOG: TextFormat = TextFormat {
    name: "ardupilot_log",
    about: "ArduPilot's log as a text: `FMT, 131, 43, IMU, ..` and rows `IMU, 1000, ..`",
    parts,
};

/// The message with the readings of both sensors.
const MESSAGE: &str = "IMU";

/// Cells before the names of a message: `FMT`, its number, its length, its name and its types.
const BEFORE_NAMES: usize = 5;

/// The cells of a line after the name of its message.
fn row(line: &str) -> Option<&str> {
    let (message, cells) = line.split_once(',')?;
    (message.trim() == MESSAGE).then(|| cells.trim_start())
}

/// The names of the message, where a line states them.
fn names(line: &str) -> Option<&str> {
    let mut cells = line.splitn(BEFORE_NAMES + 1, ',');
    let is_format = cells.next()?.trim() == "FMT";
    let is_message = cells.nth(2)?.trim() == MESSAGE;
    let names = cells.nth(1)?.trim();
    (is_format && is_message).then_some(names)
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    look.far_lines().find_map(names)?;
    Some(vec![Part {
        change: Some(rows),
        remark: Some(corrected()),
        corrected_by: Some("ardupilot"),
        ..Part::default()
    }])
}

/// The names and the rows of the message; the other lines are blank.
fn rows(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut are_named = false;
    rewritten(text, move |line, out| {
        let text = String::from_utf8_lossy(line);
        let kept = match are_named {
            true => row(&text),
            false => names(&text),
        };
        are_named |= kept.is_some();
        out.extend_from_slice(kept.unwrap_or_default().as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn the_rows_of_the_message_are_a_table_with_its_names() {
        let log = "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\nFMT, 131, 43, IMU, QBff, TimeUS,I,GyrX,AccX\nFMT, 132, 43, IMU2, Qff, TimeUS,GyrX,AccX\nIMU, 1000, 0, 0.5, 9.8\nATT, 1000, 0.1\nIMU, 2000, 0, 0.25, 9.5\n";
        assert!(parts(&Look::at(log.as_bytes())).is_some());
        let text = changed_by(rows, log);
        let rows: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
        assert_eq!(
            rows,
            [
                "TimeUS,I,GyrX,AccX",
                "1000, 0, 0.5, 9.8",
                "2000, 0, 0.25, 9.5"
            ]
        );
        let other = "FMT, 132, 43, ATT, Qff, TimeUS,Roll\nATT, 1000, 0.1\n";
        assert!(parts(&Look::at(other.as_bytes())).is_none());
    }
}
