//! Rows below the stamp of the first and the rate of all, as Empatica writes them: `1690000000.0,..`, `32.0,..`, `-3,2,63`.

use std::io::Read;

use crate::clock::time::SINCE_1970;
use crate::formats::texts::text_format::TextFormat;
use crate::header::look::{Look, cells};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::{AccelUnit, TimeUnit};

/// A text of three axes without stamps, whose first two lines say when it began and how fast it goes.
pub(crate) static START_AND_RATE: TextFormat = TextFormat {
    name: "start_and_rate",
    about: "an accelerometer's rows below one with the stamp of the first and one with the rate, as Empatica writes them",
    parts,
};

/// Rates, Hz.
const RATES: std::ops::RangeInclusive<f64> = 1.0..=4000.0;

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut lines = look.lines();
    let start = same(lines.next()?).filter(|start| SINCE_1970.contains(start));
    let rate = same(lines.next()?).filter(|rate| RATES.contains(rate));
    let is_row = |line: &str| {
        let cells = cells(line);
        let is_number = |cell: &String| cell.parse::<f64>().is_ok_and(|n| !SINCE_1970.contains(&n));
        cells.len() == 3 && cells.iter().all(is_number)
    };
    // The last line looked at may be cut.
    let rows: Vec<&str> = lines.collect();
    let (_, whole) = rows.split_last()?;
    let are_rows = !whole.is_empty() && whole.iter().all(|line| is_row(line));
    (start.is_some() && rate.is_some() && are_rows).then(|| {
        // Its other sensors have one column.
        let axes = (0..3).map(|axis| (Role::Accel(axis), (axis + 2).to_string()));
        vec![Part {
            columns: std::iter::once((Role::Time, "1".to_owned()))
                .chain(axes)
                .collect(),
            time_unit: Some(TimeUnit::Seconds),
            accel_unit: Some(AccelUnit::Counts),
            change: Some(change),
            ..Part::default()
        }]
    })
}

/// The number that all three cells of a line are.
fn same(line: &str) -> Option<f64> {
    let cells = cells(line);
    let [x, y, z] = [0, 1, 2].map(|at| cells.get(at)?.parse::<f64>().ok());
    (cells.len() == 3 && x == y && y == z).then_some(x?)
}

/// The rows with their stamps, since the first, in front.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let (mut start, mut rate) = (None, None);
    let mut rows = 0.0;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        match (start, rate) {
            _ if text.trim().is_empty() => {}
            (None, _) => start = same(text),
            (Some(_), None) => rate = same(text),
            (Some(_), Some(rate)) => {
                out.extend_from_slice(format!("{:.6},", rows / rate).as_bytes());
                out.extend_from_slice(line);
                rows += 1.0;
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    #[test]
    fn stamps_follow_from_the_start_and_the_rate() {
        let text = "1690000000.0, 1690000000.0, 1690000000.0\n32.0, 32.0, 32.0\n1,-1,68\n1,-2,67\n2,-1,68\n";
        assert!(parts(&Look::at(text.as_bytes())).is_some());
        let rows = changed_by(change, text);
        assert_eq!(
            rows.trim(),
            "0.000000,1,-1,68\n0.031250,1,-2,67\n0.062500,2,-1,68"
        );
        for other in [
            "1690000000.0\n64.0\n0.1\n0.2\n0.3\n",
            "0.1,0.1,0.1\n32,32,32\n1,2,3\n1,2,3\n",
            "1690000000.0,1690000000.0,1690000000.0\n1,-1,68\n1,-1,68\n1,-1,68\n",
        ] {
            assert!(parts(&Look::at(other.as_bytes())).is_none(), "{other}");
        }
    }
}
