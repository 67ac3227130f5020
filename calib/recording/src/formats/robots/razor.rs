//! The Razor AHRS firmware: `#A-C=..`, `#M-C=..`, `#G-C=..` on lines of their own, or `#YPRAG=..` on one.

use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::Look;
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;

/// Readings of the Razor AHRS, raw or as its own calibration corrects them; without stamps.
pub(crate) static RAZOR: TextFormat = TextFormat {
    name: "razor",
    about: "the Razor AHRS firmware's `#A-R=..`, `#M-R=..`, `#G-R=..` (or -C), or `#YPRAG=..`; no stamps: --rate",
    parts,
};

/// The numbers of a line behind its tag.
fn numbers<'a>(line: &'a str, tags: &[&str]) -> Option<Vec<&'a str>> {
    let rest = tags.iter().find_map(|tag| line.trim().strip_prefix(tag))?;
    let cells: Vec<&str> = rest.split(',').map(str::trim).collect();
    let are_numbers = cells.iter().all(|cell| cell.parse::<f64>().is_ok());
    are_numbers.then_some(cells)
}

const FORCE: [&str; 2] = ["#A-R=", "#A-C="];
const RATE: [&str; 2] = ["#G-R=", "#G-C="];
const FIELD: [&str; 2] = ["#M-R=", "#M-C="];
const ALL: [&str; 1] = ["#YPRAG="];

fn parts(look: &Look) -> Option<Vec<Part>> {
    let has = |tags: &[&str]| look.lines().any(|line| numbers(line, tags).is_some());
    let blocks = has(&FORCE) && has(&RATE);
    if !blocks && !has(&ALL) {
        return None;
    }
    let axes = |axis: usize| {
        let force = (Role::Accel(axis), (axis + 1).to_string());
        let rate = (Role::Gyro(axis), (axis + 4).to_string());
        let field = (Role::Field(axis), (axis + 7).to_string());
        let with_field = blocks && has(&FIELD);
        [Some(force), Some(rate), with_field.then_some(field)]
    };
    Some(vec![Part {
        columns: (0..3).flat_map(axes).flatten().collect(),
        change: Some(rows),
        remark: Some(
            "Razor AHRS: `-C` and `#YPRAG` are corrected by the firmware already; `#osrt` sends raw readings".to_owned(),
        ),
        ..Part::default()
    }])
}

/// A row for every reading of the gyroscope, which comes last.
fn rows(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let (mut force, mut field) = (None, None);
    rewritten(text, move |line, out| {
        let line = std::str::from_utf8(line).unwrap_or_default();
        let three = |tags: &[&str]| {
            let cells = numbers(line, tags).filter(|cells| cells.len() == 3)?;
            Some(cells.join(","))
        };
        if let Some(numbers) = numbers(line, &ALL).filter(|cells| cells.len() >= 9) {
            out.extend_from_slice(numbers[3..9].join(",").as_bytes());
        } else if let Some(found) = three(&FORCE) {
            force = Some(found);
        } else if let Some(found) = three(&FIELD) {
            field = Some(found);
        } else if let (Some(rate), Some(force)) = (three(&RATE), force.take()) {
            let cells: Vec<String> = [Some(force), Some(rate), field.take()]
                .into_iter()
                .flatten()
                .collect();
            out.extend_from_slice(cells.join(",").as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_on_lines_of_their_own_are_one_row() {
        for (text, expected) in [
            (
                "#A-R=1.00,2.00,250.00\n#M-R=7,8,9\n#G-R=4.00,5.00,6.00\n",
                "1.00,2.00,250.00,4.00,5.00,6.00,7,8,9",
            ),
            ("#YPRAG=10.0,20.0,30.0,1,2,3,4,5,6\n", "1,2,3,4,5,6"),
        ] {
            assert!(parts(&Look::at(text.as_bytes())).is_some());
            let mut read = String::new();
            rows(Box::new(std::io::Cursor::new(text)))
                .read_to_string(&mut read)
                .unwrap();
            assert_eq!(read.trim(), expected);
        }
        assert!(parts(&Look::at(b"#YPR=1,2,3\n#YPR=1,2,3\n")).is_none());
    }
}
