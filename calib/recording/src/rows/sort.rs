//! Rows in the order of their stamps, whatever order they were written in.

use super::table::Table;
use crate::clock::wraps::moduli;

/// Sorts the samples of every table by stamp, so that a shuffled text is what the sorted one is.
pub(crate) fn by_time(tables: &mut [Table]) {
    for table in &mut *tables {
        for samples in [&mut table.accel, &mut table.gyro, &mut table.magnetometer] {
            *samples = std::mem::take(samples).sort();
        }
        sort_temperature(table);
    }
    count_from_the_earliest(tables);
}

/// Undoes the wraps of a counter before the sorting mixes what lies between them.
pub(crate) fn count_on(table: &mut Table) {
    let longer = table.longer();
    let (Some(modulus), Some(&first)) = (modulus(&longer.t), longer.t.first()) else {
        return;
    };
    let wraps = longer.t.windows(2).zip(1..);
    let wraps = wraps.filter(|(pair, _)| pair[1] - pair[0] < -modulus / 2.0);
    table.clock.wraps = wraps.map(|(_, i)| longer.line(i)).collect();
    for stamps in table.stamps_mut() {
        let mut last = first;
        for t in stamps {
            *t += modulus * ((last - *t) / modulus).round();
            last = *t;
        }
    }
}

/// Returns the range of the counter that wrote `stamps`, if it started again: every jump over more than half of the range is one over
/// the whole of it, within ten of its steps. Jumps of shuffled rows have all sizes.
fn modulus(stamps: &[f64]) -> Option<f64> {
    let jumps = || stamps.windows(2).map(|pair| pair[1] - pair[0]);
    let is_modulus = |modulus: &f64| {
        if !stamps.iter().all(|t| (0.0..*modulus).contains(t)) {
            return false;
        }
        let steps = jumps().map(|jump| jump - modulus * (jump / modulus).round());
        let step = steps.sum::<f64>() / stamps.len() as f64;
        let mut wraps = jumps().map(f64::abs).filter(|jump| *jump > modulus / 2.0);
        let one = |jump: f64| modulus - jump <= 10.0 * step;
        step < modulus / 100.0 && wraps.next().is_some_and(one) && wraps.all(one)
    };
    moduli().find(is_modulus)
}

fn sort_temperature(table: &mut Table) {
    let mut readings: Vec<(f64, f64)> = std::mem::take(&mut table.temperature_t)
        .into_iter()
        .zip(std::mem::take(&mut table.temperature))
        .collect();
    readings.sort_by(|a, b| a.0.total_cmp(&b.0));
    readings.dedup_by(|later, first| later.0 == first.0);
    (table.temperature_t, table.temperature) = readings.into_iter().unzip();
}

/// Stamps that are counted from the first row's are counted from the earliest instead.
fn count_from_the_earliest(tables: &mut [Table]) {
    let Some(first) = tables.first() else { return };
    let starts = [&first.accel, &first.gyro].map(|samples| samples.t.first());
    let earliest = starts
        .into_iter()
        .flatten()
        .copied()
        .fold(f64::NAN, f64::min);
    let shift = earliest.floor();
    let counted = first.clock.origin.is_some_and(|origin| origin != 0);
    if !counted || !shift.is_finite() {
        return;
    }
    for table in tables {
        table.clock.origin = table.clock.origin.map(|o| o.saturating_add(shift as i64));
        let streams = table.stamps_mut().into_iter();
        streams.flatten().for_each(|t| *t -= shift);
    }
}
