//! Checks of a calibration: refusals, failed gates and warnings.

mod coning;
mod coverage;
mod cut_towards_zero;
mod dead_axes;
mod determined;
mod linearity;
mod norm;
mod of_the_device;
mod on_top;
mod plausible;
mod rests;
mod same_rows;
mod twice;
mod unknowable;

pub use coning::too_fast;
pub(crate) use coverage::few_directions;
pub use coverage::not_in_one_plane;
pub use cut_towards_zero::cut_towards_zero;
pub(super) use dead_axes::{dead_axes, say_dead_axes};
pub(super) use determined::{
    ForceEvidence, RateEvidence, accelerometer_is_determined, gyroscope_is_determined,
};
pub use linearity::untested_linearity;
pub(super) use norm::the_norm_tells_them;
pub use of_the_device::readings_of_the_device;
pub use on_top::corrected_before;
pub(super) use on_top::reads_zero_at_rest;
pub(super) use plausible::none_is_turned;
pub(super) use plausible::{ForceFit, RateFit, signed_axes, turned_field};
pub use plausible::{Said, implausible, implausible_base};
pub(super) use rests::{disagreeing_rests, long_turns, restless};
pub(super) use same_rows::no_rows_come_again;
pub(super) use twice::none_is_there_twice;
pub use twice::without_copies;
pub(super) use unknowable::{refuse_attitude, refuse_unknowable};

use ::findings::{Finding, Kind};
use recording::readings::{Quiet, quietest, symptoms};
use recording::{Error, Recording, Stream};
use sensor::{EffectRef, Quantity, Sensor};

use crate::methods::Choice;
use crate::residuals::StaticMean;

findings::tuning! {
    /// A recording whose one static interval is this share of it lies still.
    STILL: f64 = 0.7;

    /// Rates above this are said to be more than needed, Hz.
    FASTEST: f64 = 5000.0;
    /// A rate that would do, Hz.
    ENOUGH_RATE: f64 = 1000.0;

    /// Quiet stretches that are shown where none is quiet enough.
    QUIETEST: usize = 3;
}

/// Lists the findings about the readings of a recording and how it was cut.
pub fn of_the_detector(recording: &Recording, choice: &Choice) -> Vec<Finding> {
    let found = symptoms(recording, &choice.segmentation);
    let found = found.iter().map(|found| found.in_recording(recording));
    let all = choice.remarks().into_iter().chain(found);
    let all = all.chain(fast_sampling(recording));
    all.map(|found: Finding| found.in_recording(&recording.name))
        .collect()
}

/// Rates that only take time.
fn fast_sampling(recording: &Recording) -> Option<Finding> {
    let streams = [&recording.accelerometer, &recording.gyroscope];
    let steps = streams
        .into_iter()
        .flatten()
        .filter_map(Stream::median_step);
    let rate = steps.min_by(f64::total_cmp)?.recip();
    (rate > FASTEST.get()).then(|| {
        Finding::of(Kind::SAMPLED_FAST)
            .number("rate", rate, "Hz")
            .number("block", (rate / ENOUGH_RATE.get()).round(), "count")
    })
}

/// Refuses effects that look at more than the specific force: of means from a file nothing else is known.
pub(super) fn force_is_all_they_need(effects: &[EffectRef]) -> Result<(), Error> {
    for effect in effects {
        let all = effect.needs().into_iter();
        if let Some(need) = all.clone().find(|need| *need != Quantity::SpecificForce) {
            return Err(Error::not_enough(
                Finding::of(Kind::EFFECT_NEEDS_MEANS)
                    .detail("effect", effect.name())
                    .detail("quantity", need.to_string()),
            ));
        }
    }
    Ok(())
}

/// Refuses recordings without rests or without turns.
pub(super) fn enough_rests(
    recordings: &[&Recording],
    choices: &[Choice],
    means: &[Vec<StaticMean>],
) -> Result<(), Error> {
    let names: Vec<&str> = recordings.iter().map(|r| r.name.as_str()).collect();
    let of = |kind| Finding::of(kind).in_recording(names.join(", "));
    let rejected = choices.iter().flat_map(|c| &c.segmentation.rejected);
    let found = means.iter().map(Vec::len).sum::<usize>();
    if let Some(first) = rejected.clone().next().filter(|_| found < 2) {
        return Err(Error::not_enough(
            of(Kind::QUIET_NOT_STATIC)
                .count("found", found)
                .count("count", rejected.count())
                .detail("first", first.to_string()),
        ));
    }
    match found {
        0 => {
            let never = of(Kind::NEVER_STILL)
                .number("rest", plan::REQUIREMENT.rest, "s")
                .because(plan::REQUIREMENT.finding());
            Err(Error::not_enough(match quietest_of(recordings) {
                Some(quietest) => never.detail("quietest", quietest),
                None => never,
            }))
        }
        1 => {
            let length: f64 = choices
                .iter()
                .flat_map(|c| &c.segmentation.statics)
                .map(|rest| rest.span.length())
                .sum();
            let spans = recordings
                .iter()
                .filter_map(|r| r.accelerometer.as_ref()?.span());
            let whole: f64 = spans.map(|(from, to)| to - from).sum();
            let kind = match length < STILL.get() * whole {
                true => Kind::ONE_STATIC_INTERVAL,
                false => Kind::ALL_STATIC,
            };
            Err(Error::not_enough(
                of(kind)
                    .number("length", length, "s")
                    .number("whole", whole, "s")
                    .because(plan::REQUIREMENT.finding()),
            ))
        }
        _ => Ok(()),
    }
}

/// `t = 12.0 s (1.2e-2 rad/s, 3.1e-1 m/s²), t = …`: the quietest seconds; none without samples.
fn quietest_of(recordings: &[&Recording]) -> Option<String> {
    let recording = recordings.first()?;
    let unit = |sensor, si| match recording.is_in_counts(sensor) {
        true => "counts",
        false => si,
    };
    let units = [
        unit(Sensor::Gyroscope, "rad/s"),
        unit(Sensor::Accelerometer, "m/s²"),
    ];
    let of = |quiet: &Quiet| {
        let rate = quiet.rate.map(|r| format!("{r:.1e} {}", units[0]));
        let force = quiet.force.map(|f| format!("{f:.1e} {}", units[1]));
        let spread: Vec<String> = rate.into_iter().chain(force).collect();
        format!("t = {:.1} s ({})", quiet.span.from, spread.join(", "))
    };
    let found: Vec<String> = quietest(recording, QUIETEST.get()).iter().map(of).collect();
    (!found.is_empty()).then(|| found.join(", "))
}
