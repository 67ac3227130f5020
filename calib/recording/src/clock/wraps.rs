//! Counters of 16, 24 and 32 bits, and clocks of a minute, an hour, a day or a week, that start again: counted on.

use crate::order_statistic::nth_smallest;
use crate::rows::table::Table;

/// Bits of counters.
const BITS: [i32; 3] = [16, 24, 32];
/// Seconds after which clocks start again: a day, a week.
const PERIODS: [f64; 2] = [86_400.0, 604_800.0];
/// Seconds after which fields of a clock start again: those of a minute, of an hour.
const FIELDS: [f64; 2] = [60.0, 3_600.0];
/// Ratios of units that are tried: the same unit, and ms and µs to seconds.
const UNITS: [f64; 3] = [1.0, 1e-3, 1e-6];

findings::tuning! {
    /// Steps that may be lost where a counter starts again.
    LOST: f64 = 10.0;
    /// A counter goes on by less than this part of its range from row to row.
    PART: f64 = 0.35;
}

/// Returns the ranges after which counters start again, in the file's unit.
pub(crate) fn moduli() -> impl Iterator<Item = f64> {
    let counters = UNITS
        .into_iter()
        .flat_map(|unit| BITS.map(|bits| unit * 2f64.powi(bits)));
    let clocks = UNITS
        .into_iter()
        .flat_map(|unit| PERIODS.map(|period| period / unit));
    counters.chain(clocks)
}

/// Counts on over every place where the stamps of `table` jump back by the range of a counter, and remembers it.
pub(crate) fn count_on(table: &mut Table) {
    if table.ascends() {
        return;
    }
    let rows = table.stamped_lines();
    let origin = table.clock.origin.unwrap_or(0) as f64;
    let wraps = wraps(&rows, origin);
    if wraps.is_empty() {
        return;
    }
    let mut counted = 0.0;
    let mut offsets = vec![0.0];
    offsets.extend(wraps.iter().map(|(_, modulus)| {
        counted += modulus;
        counted
    }));
    table.restamp(|line, t| t + offsets[wraps.partition_point(|(from, _)| *from <= line)]);
    table.clock.wraps = wraps.into_iter().map(|(line, _)| line).collect();
}

/// The median of the steps forward from row to row, each with its line and its stamp.
pub(super) fn usual_step(rows: &[(u64, f64)]) -> Option<f64> {
    let steps = || rows.windows(2).map(|pair| pair[1].1 - pair[0].1);
    let count = steps().filter(|step| *step > 0.0).count();
    let forwards = steps().map(|step| if step > 0.0 { step } else { f64::INFINITY });
    nth_smallest(forwards, count.saturating_sub(1) / 2)
}

/// The lines at which a counter started again, with its range.
fn wraps(rows: &[(u64, f64)], origin: f64) -> Vec<(u64, f64)> {
    let Some(usual) = usual_step(rows) else {
        return Vec::new();
    };
    let largest = rows.iter().map(|(_, t)| t + origin).fold(0.0, f64::max);
    let least = rows.iter().map(|(_, t)| t + origin).fold(0.0, f64::min);
    // A counter with a sign goes from the middle of its range to its beginning.
    let fits = |modulus: f64| match least >= 0.0 {
        true => largest < modulus,
        false => least >= -0.5 * modulus && largest < 0.5 * modulus,
    };
    // Recordings of a minute each begin at zero, and a clock at any second.
    let first = rows.first().map_or(0.0, |(_, t)| t + origin);
    let fields = UNITS
        .into_iter()
        .flat_map(|unit| FIELDS.map(|field| field / unit))
        .filter(|_| first > LOST.get() * usual);
    let ranges: Vec<f64> = moduli()
        .chain(fields)
        .filter(|modulus| usual < PART.get() * modulus && fits(*modulus))
        .collect();
    let jumps = rows.windows(2).filter(|pair| pair[1].1 < pair[0].1);
    let wrap = |pair: &[(u64, f64)]| {
        let is_over = |modulus: &&f64| {
            let forward = pair[1].1 + **modulus - pair[0].1;
            forward > 0.0 && forward <= (LOST.get() * usual).min(0.5 * **modulus)
        };
        ranges
            .iter()
            .find(is_over)
            .map(|modulus| (pair[1].0, *modulus))
    };
    jumps.filter_map(wrap).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(start: u64, step: u64, modulus: u64, count: u64, unit: f64) -> Vec<(u64, f64)> {
        let stamp = |k: u64| ((start + k * step) % modulus) as f64 * unit;
        (0..count).map(|k| (k + 2, stamp(k))).collect()
    }

    #[test]
    fn counters_of_any_width_and_tick_are_counted_on() {
        for (bits, step, start) in [
            (16, 10, 65_400),
            (16, 20_000, 60_000),
            (24, 20_000, 16_000_000),
            (24, 655, 16_777_000),
            (32, 3_360_000, 4_290_000_000),
            (32, 10_000, 4_294_900_000),
        ] {
            let rows = counted(start, step, 1 << bits, 50, 1.0);
            let found = wraps(&rows, 0.0);
            assert!(!found.is_empty(), "{bits} bits, {step}");
            assert!(found.iter().all(|(_, range)| *range == 2f64.powi(bits)));
        }
        // Microseconds of 32 bits, written as seconds.
        let rows = counted(4_294_900_000, 10_000, 1 << 32, 50, 1e-6);
        assert_eq!(wraps(&rows, 0.0).len(), 1);
        // Microseconds with a sign.
        let mut rows = counted(4_294_900_000, 10_000, 1 << 32, 50, 1.0);
        rows.iter_mut().for_each(|(_, t)| *t -= 2f64.powi(31));
        assert_eq!(wraps(&rows, 0.0).len(), 1);
        // Seconds of the minute, whose minutes are in another column.
        let mut rows = counted(5_000, 1, 6_000, 1_900, 1e-2);
        assert_eq!(wraps(&rows, 0.0).len(), 1);
        // Two recordings of a minute each.
        rows = counted(0, 1, 6_000, 12_000, 1e-2);
        assert!(wraps(&rows, 0.0).is_empty());
        // Seconds of the day.
        let rows = counted(8_639_990, 1, 8_640_000, 50, 1e-2);
        assert_eq!(wraps(&rows, 0.0).len(), 1);
    }

    #[test]
    fn a_counter_that_begins_again_elsewhere_does_not_wrap() {
        let mut rows = counted(0, 20, 1 << 40, 1000, 1.0);
        rows.extend(counted(0, 20, 1 << 40, 1000, 1.0));
        assert!(wraps(&rows, 0.0).is_empty());
    }
}
