//! Stamps and temperatures that are refused, or worth a warning.

use sensor::Sensor;

use super::samples::Samples;
use super::stream::extreme_steps;
use super::{Gap, Stream};
use crate::Error;
use crate::source::place::in_file;

/// Repeated rows and equal stamps.
pub(crate) fn order(
    name: &str,
    samples: &Samples,
    warnings: &mut Vec<String>,
) -> Result<(), Error> {
    let repeats = samples.repeats;
    if repeats.count > 0 {
        warnings.push(format!(
            "{name}:{}: {} rows between lines {} and {} repeat earlier rows, stamp and values; left out",
            repeats.first, repeats.count, repeats.first, repeats.last
        ));
    }
    let merged = samples.twins.len();
    if samples.t.len() < 2 && merged + repeats.count > 0 {
        return Err(in_file(
            name,
            "every time stamp is the same; --rate HZ reads the rows as evenly spaced",
        ));
    }
    if merged > samples.t.len() {
        return Err(in_file(
            name,
            format!(
                "{} of {} rows share their stamp with another: stamps are too coarse; --rate HZ reads the rows as evenly spaced",
                merged,
                merged + samples.t.len()
            ),
        ));
    }
    if merged > 0 {
        warnings.push(format!(
            "{name}: {merged} rows with the stamp of another, merged to their mean"
        ));
    }
    Ok(())
}

/// Stamps of arrival instead of sampling: most steps far shorter than the mean.
pub(crate) fn bursts(
    name: &str,
    sensor: Sensor,
    stream: &Stream,
    gaps: &[Gap],
    warnings: &mut Vec<String>,
) {
    let (Some((least, _)), [first, .., last]) = (extreme_steps(&stream.t), &stream.t[..]) else {
        return;
    };
    let missing: f64 = gaps.iter().map(|gap| gap.t1 - gap.t0).sum();
    let mean = (last - first - missing) / (stream.len() - 1 - gaps.len()).max(1) as f64;
    let in_bursts = |step: &f64| *step < mean / 2.0;
    // No median is below the least.
    let median = Some(least).filter(in_bursts).and(stream.median_step());
    if let Some(median) = median.filter(in_bursts) {
        warnings.push(format!(
            "{name}: stamps of the {} come in bursts (median step {median:.4} s, mean {mean:.4} s), as of arrival; --rate {:.1} reads the rows as evenly spaced",
            sensor.name(),
            1.0 / mean
        ));
    }
}

/// Interruptions.
pub(crate) fn gaps(name: &str, sensor: Sensor, gaps: &[Gap], warnings: &mut Vec<String>) {
    let longest = gaps
        .iter()
        .max_by(|a, b| (a.t1 - a.t0).total_cmp(&(b.t1 - b.t0)));
    if let Some(longest) = longest {
        warnings.push(format!(
            "{name}: {} gap{} in the {}, the longest {:.3} s from {:.3} s on",
            gaps.len(),
            if gaps.len() == 1 { "" } else { "s" },
            sensor.name(),
            longest.t1 - longest.t0,
            longest.t0
        ));
    }
}

/// Sensors are hardly ever hotter than this, °C: those that are heated against drift stay below it.
const HOT: f64 = 62.0;

/// True if the readings can be temperatures in °C.
pub(crate) fn temperature(name: &str, celsius: &[f64], warnings: &mut Vec<String>) -> bool {
    let possible = celsius.iter().all(|c| (-60.0..=150.0).contains(c));
    let least = celsius.iter().copied().fold(f64::INFINITY, f64::min);
    let most = celsius.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if possible && least > HOT {
        let of = |fahrenheit: f64| (fahrenheit - 32.0) / 1.8;
        warnings.push(format!(
            "{name}: temperatures of {least:.1} to {most:.1} are taken as °C: if they are °F ({:.1} to {:.1} °C), call the column \
             `temp [F]`; if they are right, leave it",
            of(least),
            of(most)
        ));
    }
    if !possible {
        warnings.push(format!(
            "{name}: temperatures beyond -60 to 150 °C, left out; a unit in the column's name, as in `temp [K]`, helps"
        ));
    }
    possible
}
