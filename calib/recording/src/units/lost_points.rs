//! Numbers that lost their decimal point on the way: 9806 beside 9.81.

use std::collections::BTreeSet;

/// A point that is lost before three decimals makes a number larger by this factor.
const FACTOR: f64 = 1000.0;

findings::tuning! {
    /// Whole numbers from here on may have lost one.
    LEAST: f64 = 100.0;
    /// Neighbours differ by this share ...
    SHARE: f64 = 0.2;
    /// ... and by this much.
    APART: f64 = 0.02;
    /// Neighbours that show it.
    FEWEST: usize = 6;
    /// The same as a share of the neighbours of both kinds.
    MOST: f64 = 0.5;
    /// Different numbers among them: an error code comes again.
    DIFFERENT: usize = 4;
}

/// A number without its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lost {
    /// Index of the first.
    pub at: usize,
    /// Its value.
    pub value: f64,
    /// The value beside it, with its point.
    pub beside: f64,
}

/// Returns the first number without its point, where whole numbers are a thousand times their neighbours with decimals.
pub(crate) fn lost(values: impl Iterator<Item = f64>) -> Option<Lost> {
    let is_whole = |value: f64| value == value.trunc();
    let (mut before, mut first): (Option<f64>, Option<Lost>) = (None, None);
    let (mut pairs, mut fit, mut different) = (0, 0, BTreeSet::new());
    for (index, now) in values.enumerate() {
        if let Some(last) = before.replace(now) {
            let (at, value, beside) = match is_whole(now) {
                true => (index, now, last),
                false => (index - 1, last, now),
            };
            if !is_whole(value)
                || is_whole(beside)
                || value.abs() < LEAST.get()
                || beside.abs() >= LEAST.get()
            {
                continue;
            }
            pairs += 1;
            if (value / FACTOR - beside).abs() <= SHARE.get() * beside.abs() + APART.get() {
                fit += 1;
                different.insert(value as i64);
                first = first.or(Some(Lost { at, value, beside }));
            }
        }
    }
    let shown = fit >= FEWEST.get() && fit as f64 >= MOST.get() * f64::from(pairs);
    first.filter(|_| shown && different.len() >= DIFFERENT.get())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swing(at: i32) -> f64 {
        ((9.8 * (0.01 * f64::from(at)).sin()) * 1e3).round() / 1e3
    }

    #[test]
    fn numbers_a_thousand_times_their_neighbours_have_lost_their_point() {
        let lose = |value: f64, at: i32| match at % 40 == 30 {
            true => (1e3 * value).round(),
            false => value,
        };
        let lost = lost((0..2000).map(|at| lose(swing(at) + 0.0005, at))).unwrap();
        assert_eq!(lost.at, 30);
        assert!((lost.value / lost.beside / 1e3 - 1.0).abs() < 0.1);
    }

    #[test]
    fn error_codes_and_whole_numbers_among_others_have_lost_none() {
        let code = |at: i32| if at % 40 == 0 { 9999.0 } else { 9.8125 };
        assert_eq!(lost((0..2000).map(code)), None);
        let large = |at: i32| (2e3 * swing(at)).round() / 4.0;
        assert_eq!(lost((0..2000).map(large)), None);
        assert_eq!(lost((0..2000).map(swing)), None);
    }
}
