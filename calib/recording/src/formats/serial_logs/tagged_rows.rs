//! Rows that begin with `IMU` among those of a robot's other parts: `IMU,1234,0.1,0.2,9.8,..`, `ODOM,0.5,0.1`, `GPS,..`.

use std::io::Read;

use crate::formats::texts::TextFormat;
use crate::header::look::{Look, cells};
use crate::header::names::compact;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;

/// Rows of several parts by turns.
pub(crate) static TAGGED_ROWS: TextFormat = TextFormat {
    name: "tagged_rows",
    about: "rows that begin with `IMU` among others that begin otherwise: `IMU,1234,0.1,0.2,9.8,..` and `ODOM,0.5,..`",
    parts,
};

/// The word in the first cell of such a row.
const TAG: &str = "imu";

findings::tuning! {
    /// Cells behind the tag.
    NARROWEST: usize = 3;
    /// Rows that show the format.
    FEWEST: usize = 5;
}

/// True for a row that begins with the tag and goes on with numbers.
fn is_own(line: &str) -> bool {
    let cells = cells(line);
    let [tag, numbers @ ..] = &cells[..] else {
        return false;
    };
    let is_number = |cell: &String| cell.parse::<f64>().is_ok();
    compact(tag) == TAG && numbers.len() >= NARROWEST.get() && numbers.iter().all(is_number)
}

/// True for a row of another part: it begins with a word and holds a number.
fn is_of_another(line: &str) -> bool {
    let cells = cells(line);
    let is_word = |cell: &String| cell.starts_with(|c: char| c.is_alphabetic() || c == '$');
    let has_number = || line.contains(|c: char| c.is_ascii_digit());
    cells.len() >= 2 && cells.first().is_some_and(is_word) && has_number()
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let is_before = |line: &&str| !is_own(line);
    let lines: Vec<&str> = look.lines().skip_while(is_before).collect();
    let (own, others): (Vec<&str>, Vec<&str>) = lines.iter().partition(|line| is_own(line));
    let width = cells(own.first()?).len();
    let are_alike = own.iter().all(|line| cells(line).len() == width);
    // The last line may be cut.
    let whole = &others[..others.len().saturating_sub(1)];
    let are_rows = !whole.is_empty() && whole.iter().all(|line| is_of_another(line));
    (own.len() >= FEWEST.get() && are_alike && are_rows).then(|| {
        vec![Part {
            change: Some(own_rows),
            ..Part::default()
        }]
    })
}

/// The rows with the tag, without it; a broken one is for the reader to refuse.
fn own_rows(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    rewritten(text, |line, out| {
        let text = String::from_utf8_lossy(line);
        let first = text.find(|c: char| ",;\t ".contains(c));
        let (tag, rest) = first.map_or((&*text, ""), |at| text.split_at(at));
        if compact(tag) == TAG {
            out.extend_from_slice(rest.get(1..).unwrap_or_default().as_bytes());
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn rows_of_the_tag_are_taken_from_those_of_other_parts() {
        let rows = "ODOM,0.5,0.1\nIMU,1,2,3,4\nCTRL,lock=0,yaw=0.1\nIMU,5,6,7,8\n".repeat(6);
        let log = format!("hello\n{rows}");
        let parts = parts(&Look::at(log.as_bytes())).unwrap();
        let rows = changed_by(parts[0].change.unwrap(), &log);
        let rows: Vec<&str> = rows.lines().filter(|line| !line.is_empty()).collect();
        assert_eq!(rows[..3], ["1,2,3,4", "5,6,7,8", "1,2,3,4"]);
        // Alone they are rows with a label, and words below are a header's.
        let is_read = |log: &str| super::parts(&Look::at(log.repeat(9).as_bytes())).is_some();
        assert!(!is_read("IMU,1,2,3,4\n"));
        assert!(!is_read("IMU,1,2,3,4\nt,ax,ay,az\n"));
        assert!(!is_read("IMU,1,2,3,4\n5,6,7,8\n"));
    }
}
