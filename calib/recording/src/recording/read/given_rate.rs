//! A rate that the user gave, against the stamps that it replaces.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use findings::{Finding, Kind, OptionName, Remedy};

use crate::clock::even::{Stamps, bursts, even_clock};
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::recording::stream::Stream;
use crate::shown::significant;

findings::tuning! {
    /// Rates that differ by less are those of two good oscillators.
    SAME: f64 = 5e-4;

    /// A rate that differs by more than this factor is not compared: the stamps are of another unit, or count samples.
    ANOTHER: f64 = 3.0;

    /// Fewest samples that tell a rate.
    FEWEST: usize = 200;

    /// Samples beyond which a second look takes too long.
    MOST: usize = 20_000_000;
}

/// Builds the finding that the stamps contradict the given rate, if they do; reads the file at `path` a second time.
pub(super) fn contradicted(
    path: &Path,
    options: &ReadOptions,
    by_rate: &Recording,
) -> Option<Finding> {
    let given = options.rate?;
    let longer = by_rate
        .gyroscope
        .as_ref()
        .or(by_rate.accelerometer.as_ref())?;
    // What was read of a pipe is gone.
    let can_be_read_again =
        std::fs::metadata(path).is_ok_and(|data| data.is_file() || data.is_dir());
    if !by_rate.has_ignored_stamps() || !can_be_read_again || longer.len() > MOST.get() {
        return None;
    }
    let stamped = ReadOptions {
        rate: None,
        ..options.clone()
    };
    let stamped = Recording::read(path, &stamped).ok()?;
    let stream = stamped
        .gyroscope
        .as_ref()
        .or(stamped.accelerometer.as_ref())?;
    let (rate, lost, error) = rate_by_stamps(stream)?;
    let off = given / rate - 1.0;
    let differs = off.abs() > SAME.get().max(3.0 * error)
        && (ANOTHER.get().recip()..ANOTHER.get()).contains(&(given / rate));
    if !differs {
        return None;
    }
    let found = Finding::of(Kind::RATE_CONTRADICTED)
        .in_recording(&by_rate.name)
        .number("rate", rate, "Hz")
        .number("given", given, "Hz")
        .number("share", off.abs(), "share")
        .detail("size", if off > 0.0 { "small" } else { "large" })
        .affects("turn", off.abs() * FRAC_PI_2, "rad")
        .remedy(Remedy::set_to(OptionName::Rate, significant(rate, 6)));
    Some(match lost {
        0 => found,
        lost => found.count("missing", lost as usize),
    })
}

/// The rate while samples came, how many are missing, and the relative error of the rate.
fn rate_by_stamps(stream: &Stream) -> Option<(f64, u64, f64)> {
    let t = &stream.t;
    let whole = t.last()? - t.first()?;
    if t.len() < FEWEST.get() {
        return None;
    }
    if let Some(found) = bursts(t) {
        let wait = found.size * found.step;
        return Some((found.step.recip(), found.lost, wait / whole));
    }
    match even_clock(t) {
        Stamps::Exact => {
            let usual = stream.median_step()?;
            let steps = t.windows(2).map(|pair| pair[1] - pair[0]);
            let whole_steps = steps.map(|step| (step / usual).round());
            let ticks: f64 = whole_steps.sum();
            Some((
                ticks / whole,
                (ticks as u64 + 1).saturating_sub(t.len() as u64),
                0.0,
            ))
        }
        Stamps::Scattered(clock) => {
            let lost = clock.lost;
            let usual = (clock.even.last()? - clock.even.first()?) / clock.ticks.max(1) as f64;
            // Where the clock was lost in interruptions, ticks are fewer than the time.
            let is_whole = (usual / clock.step - 1.0).abs() < 0.05;
            is_whole.then(|| (usual.recip(), lost, clock.scatter / whole))
        }
        Stamps::Uncountable { .. } => None,
    }
}
