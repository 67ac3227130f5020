//! What a joint fit leaves in doubt, in words.

use crate::methods::joint::{Disturbance, Flagged, JointFit, Missing, Reason};
use findings::Findings;

/// A placement off by so much, m/s², though nothing shook it, was not touched: the sensor lies otherwise in its case, or
/// something lifts it.
const APART: f64 = 0.1;

/// A rest whose absence moves a parameter by so many of its standard errors is named.
const INFLUENTIAL: f64 = 4.0;

/// An effect is said to be missing where chance makes the rows speak so for one in fewer recordings than this.
const SPEAKS: f64 = 5e-4;

/// The placements whose force no touch explains: nothing shook, and they are off by more than [`APART`].
pub fn placements_apart(fit: &JointFit) -> Option<String> {
    let apart = |a: &&Flagged| {
        let is_pushed = a.kind == Disturbance::DisturbedInterval && a.reason == Reason::Disturbed;
        is_pushed && !a.shook && a.size > APART
    };
    let all: Vec<String> = fit
        .flagged
        .iter()
        .filter(apart)
        .map(|a| {
            let name = &fit.data.sources[a.recording].name;
            format!(
                "{name}: static interval {} by {:.2} m/s²",
                a.interval + 1,
                a.size
            )
        })
        .collect();
    (!all.is_empty()).then(|| {
        format!(
            "placements disagree with the others though nothing shook there ({}): did the sensor slip in its case? The \
             calibration is without them; fix the sensor and record again",
            all.join(", ")
        )
    })
}

/// An effect that the rows speak for though no channel as a whole misfits: its part in the errors is not in them.
pub fn of_missing(missing: &Missing) -> Option<String> {
    (missing.p_value < SPEAKS).then(|| {
        format!(
            "misfit of the accelerometer by an effect that its model lacks, most like {} (chi² {:.1} of {} degrees of freedom, \
             p = {:.0e} of all that were tried): no standard error contains it. `stillpoint discover` tells what it is and \
             estimates it",
            missing.effect.name(),
            missing.statistic,
            missing.dof,
            missing.p_value,
        )
    })
}

/// Names what was disturbed, with interval and times.
pub fn disturbances(fit: &JointFit, warnings: &mut Findings) {
    let name = |recording: usize| &fit.data.sources[recording].name;
    for lost in &fit.data.lost {
        warnings.push(format!(
            "{}: turn {} (t = {:.2} to {:.2} s) is not used: {}",
            name(lost.recording),
            lost.turn + 1,
            lost.span.from,
            lost.span.to,
            lost.fault
        ));
    }
    for (place, gap) in &fit.data.gaps {
        let rest = &fit.data.rests[*place];
        warnings.push(format!(
            "{}: static interval {} (t = {:.2} to {:.2} s) has a gap of {:.2} s at t = {:.2} s",
            name(rest.recording),
            rest.interval + 1,
            rest.span.from,
            rest.span.to,
            gap.length(),
            gap.from
        ));
    }
    if let Some(shaken) = fit.data.shakes_throughout() {
        warnings.push(format!(
            "{shaken} of {} static intervals shake more than the quiet parts of the recording: was the device \
             held in the hand? They are weighted by their own noise; a touch would look the same",
            fit.data.rests.len()
        ));
    }
    for (place, source) in fit.data.sources.iter().enumerate() {
        if source.sways() {
            warnings.push(format!(
                "{}: the device sways in its static intervals and comes back, as one that is held in the hand does: turns begin \
                 and end a little away from where it rested on the average, and a slow creep would look the same. Lay it down for smaller \
                 errors",
                name(place)
            ));
        }
    }
    for flagged in &fit.flagged {
        let (what, done) = match flagged.kind {
            _ if flagged.reason == Reason::BiasStepped => (
                "static interval",
                "the bias stepped within it, so that its mean is not used",
            ),
            Disturbance::MountSlip => (
                "static interval",
                "the readings drift while the device should have rested (mount_slip), as from a creep of the device or a \
                 warm-up of the sensor; the drift is fitted",
            ),
            Disturbance::SuddenSlip => (
                "static interval",
                "the device moved while it should have rested (mount_slip); its move is fitted",
            ),
            Disturbance::DisturbedInterval => (
                "static interval",
                "something touched or pushed the device (disturbed_interval); its force is not used",
            ),
            Disturbance::RateExcursion => (
                "static interval",
                "the mean of the gyroscope is off in this interval alone; it is not used",
            ),
            Disturbance::BadTurn => (
                "turn",
                "gravity is missed by far more than the noise; the turn is not used",
            ),
        };
        let detail = if flagged.detail.is_empty() { "" } else { ": " };
        warnings.push(format!(
            "{}: {what} {} (t = {:.2} to {:.2} s): {done}{detail}{}",
            name(flagged.recording),
            flagged.interval + 1,
            flagged.span.from,
            flagged.span.to,
            flagged.detail
        ));
    }
}

/// Names the rests without which a parameter would be another.
pub fn influences(fit: &JointFit, warnings: &mut Findings) {
    for influence in fit.influences() {
        if influence.change > INFLUENTIAL && influence.change.is_finite() {
            let rest = &fit.data.rests[influence.rest];
            warnings.push(format!(
                "{}: without static interval {} (t = {:.2} to {:.2} s) {} would move by {:.1} of its \
                 standard errors: record it again if the device was not at rest there, or else one more like it",
                fit.data.sources[rest.recording].name,
                rest.interval + 1,
                rest.span.from,
                rest.span.to,
                influence.parameter,
                influence.change
            ));
        }
    }
}
