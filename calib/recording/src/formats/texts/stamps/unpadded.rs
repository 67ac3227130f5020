//! Stamps whose part of a second lacks its leading zeros: `12:00:03.7` for 7 ms, before `12:00:03.17`.

use std::io::Read;
use std::ops::Range;

use crate::formats::texts::places::{may_be_row, places, replaced, whole_rows};
use crate::formats::texts::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::role_of;
use crate::order_statistic::nth_smallest;
use crate::recording::options::Role;
use crate::rows::parts::{Change, Part};
use crate::source::rewrite::rewritten;

/// A table whose stamps count milliseconds or microseconds behind the point.
pub(crate) static UNPADDED: TextFormat = TextFormat {
    name: "unpadded",
    about: "stamps whose part of a second has no leading zeros: `12:00:03.7`, `12:00:03.17` for 7 and 17 ms",
    parts,
};

/// Digits of a part with its zeros, and the text with them.
const PARTS: [(usize, Change); 2] = [(3, |text| padded(text, 3)), (6, |text| padded(text, 6))];

findings::tuning! {
    /// The step into a second is one of those within it, but for this factor.
    STEADY: f64 = 3.0;
}

/// A stamp as its whole seconds and the digits behind them.
struct Stamp<'a> {
    whole: &'a str,
    digits: &'a str,
    at: Range<usize>,
}

/// The stamp in cell `at` of a line.
fn stamp(line: &str, at: usize) -> Option<Stamp<'_>> {
    let at = places(line).get(at)?.clone();
    let (whole, digits) = line[at.clone()].rsplit_once(['.', ',', ':'])?;
    let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let is_clock = whole.matches(':').count() == 2 && whole.ends_with(|c: char| c.is_ascii_digit());
    let is_stamp = (is_digits(whole) || is_clock) && is_digits(digits);
    is_stamp.then_some(Stamp { whole, digits, at })
}

/// The column of the stamps: the first that is called so in a header, else the first.
fn column(line: &str) -> usize {
    let places = places(line);
    let mut names = places.into_iter().map(|at| &line[at]);
    let named = names.position(|name| role_of(name, None) == Some(Role::Time));
    named.unwrap_or(0)
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let lines = whole_rows(look);
    let column = column(lines.first()?);
    let stamps = lines.iter().filter_map(|line| stamp(line, column));
    let stamps: Vec<Stamp<'_>> = stamps.collect();
    let mut changes = PARTS.into_iter();
    let (_, change) = changes.find(|(digits, _)| lack_zeros(&stamps, *digits))?;
    Some(vec![Part {
        change: Some(change),
        ..Part::default()
    }])
}

/// True for stamps that go back as decimals, and as counts of so many digits go on steadily from second to second.
fn lack_zeros(stamps: &[Stamp<'_>], digits: usize) -> bool {
    let counts = |stamp: &Stamp<'_>| {
        let begins = stamp.digits.len() == 1 || !stamp.digits.starts_with('0');
        begins && stamp.digits.len() <= digits
    };
    if !stamps.iter().all(counts) {
        return false;
    }
    let count = |stamp: &Stamp<'_>| stamp.digits.parse::<f64>().unwrap_or(f64::NAN);
    let decimal = |stamp: &Stamp<'_>| count(stamp) / 10f64.powi(stamp.digits.len() as i32);
    let (mut within, mut into, mut back) = (Vec::new(), Vec::new(), false);
    for pair in stamps.windows(2) {
        let step = count(&pair[1]) - count(&pair[0]);
        match pair[0].whole == pair[1].whole {
            true => {
                within.push(step);
                back |= decimal(&pair[1]) < decimal(&pair[0]);
            }
            false => into.push(step + 10f64.powi(digits as i32)),
        }
    }
    let middle = |steps: &[f64]| nth_smallest(steps.iter().copied(), steps.len() / 2);
    let usual = middle(&within).zip(middle(&into));
    back && within.iter().all(|step| *step >= 0.0)
        && usual.is_some_and(|(within, into)| {
            within > 0.0 && (within / STEADY.get()..=within * STEADY.get()).contains(&into)
        })
}

/// The text with stamps of so many digits. A part that has zeros or is longer makes no stamp, for the reader to refuse.
fn padded(text: Box<dyn Read + Send>, digits: usize) -> Box<dyn Read + Send> {
    let mut at: Option<usize> = None;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        if !may_be_row(text) {
            return out.extend_from_slice(line);
        }
        let at = *at.get_or_insert_with(|| column(text));
        let Some(stamp) = stamp(text, at) else {
            return out.extend_from_slice(line);
        };
        let (whole, part) = (stamp.whole, stamp.digits);
        let is_count = part.len() == 1 || !part.starts_with('0');
        let stamp_with_zeros = match is_count && part.len() <= digits {
            true => format!("{whole}.{part:0>digits$}"),
            false => format!("{whole} and {part}"),
        };
        out.extend_from_slice(replaced(text, &stamp.at, &stamp_with_zeros).as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn changed(text: &str) -> Option<String> {
        let part = parts(&Look::at(text.as_bytes()))?.remove(0);
        Some(changed_by(part.change.unwrap(), text))
    }

    /// A stamp per row, each `step` counts after the one before, `per` counts in a second.
    fn text(begin: &str, mark: char, step: u64, per: u64) -> String {
        let row = |k: u64| {
            let count = 7 + k * step;
            format!("{begin}{}{mark}{},1,2\n", 10 + count / per, count % per)
        };
        format!("time,ax,ay\n{}", (0..300).map(row).collect::<String>())
    }

    #[test]
    fn counts_behind_the_point_get_their_zeros() {
        for (text, second, last) in [
            (
                text("12:00:", '.', 10, 1000),
                "12:00:10.017,",
                "12:00:12.997,",
            ),
            (
                text("12:00:", ':', 10, 1000),
                "12:00:10.017,",
                "12:00:12.997,",
            ),
            (
                text("17", '.', 10_000, 1_000_000),
                "1710.010007,",
                "1712.990007,",
            ),
        ] {
            let rows = changed(&text).unwrap();
            assert!(rows.lines().nth(2).unwrap().starts_with(second), "{rows}");
            assert!(rows.lines().last().unwrap().starts_with(last), "{rows}");
        }
    }

    #[test]
    fn decimals_and_counts_of_another_kind_are_left_alone() {
        // Zeros at the end are left out, zeros at the beginning are there, and hundredths are none of both.
        assert_eq!(changed("t,ax\n3.7,1\n3.71,1\n3.72,1\n4,1\n4.01,1\n"), None);
        assert_eq!(changed("t,ax\n3.97,1\n3.98,1\n4.007,1\n4.017,1\n"), None);
        assert_eq!(changed(&text("12:00:", '.', 1, 100)), None);
        // Nothing tells how many make a second.
        assert_eq!(changed("t,ax\n3.7,1\n3.17,1\n3.27,1\n3.37,1\n"), None);
        assert_eq!(changed("time,ax\n12:00:03,1\n12:00:04,1\n"), None);
    }
}
