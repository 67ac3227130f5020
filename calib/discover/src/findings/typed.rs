//! Results of a search as typed findings of its calibration; the verdict is a function of these findings.

use ::findings::{Finding, Kind};
use estimate::methods::joint::FAULTS;

use super::EffectFinding;
use crate::fault::integrity::Integrity;
use crate::gap::channel::Channel;
use crate::remainder::unexplained::Unexplained;

/// Names in one finding, then what remains, then the faults that the fit itself does not report.
pub fn of_discovery(
    effects: &[EffectFinding],
    faults: &[Integrity],
    rest: Option<&Unexplained>,
) -> Vec<Finding> {
    let rest = rest.map(|rest| {
        let found = rest.finding.clone();
        affecting(found, rest.channel, rest.rms)
    });
    let faults = faults.iter().map(|fault| fault.finding.clone());
    named(effects)
        .into_iter()
        .chain(rest)
        .chain(faults.filter(|found| !is_of_the_fit(found.kind)))
        .collect()
}

/// The effects that the base models lack.
fn named(effects: &[EffectFinding]) -> Option<Finding> {
    let widest = effects
        .iter()
        .max_by(|a, b| a.gap_before.total_cmp(&b.gap_before))?;
    let names: Vec<String> = effects.iter().map(with_ties).collect();
    let names = match names.as_slice() {
        [] | [_] => names.join(""),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    };
    let found = Finding::of(Kind::EFFECT_NAMED)
        .count("count", effects.len())
        .detail("names", names);
    Some(affecting(found, widest.channel, widest.rms_before))
}

/// `a or b`, or `a` with how many others cannot be told from it.
fn with_ties(effect: &EffectFinding) -> String {
    match effect.indistinguishable_from.as_slice() {
        [] => effect.name.clone(),
        [other] => format!("{} or {other}", effect.name),
        many => format!("{} (or {} others)", effect.name, many.len()),
    }
}

/// With the error that a channel shows.
fn affecting(found: Finding, channel: Channel, rms: Option<f64>) -> Finding {
    let (of, unit) = match channel {
        Channel::StaticNorm | Channel::MovingForce => ("corrected_reading", "m/s^2"),
        Channel::StaticRate => ("corrected_reading", "rad/s"),
        Channel::Direction => ("turn", "rad"),
    };
    match rms {
        Some(rms) => found.affects(of, rms, unit),
        None => found,
    }
}

/// Returns true if the fit itself, or a look at the readings, reports a finding of this kind.
fn is_of_the_fit(kind: Kind) -> bool {
    let is_of_a_place = FAULTS.iter().any(|fault| fault.kind == kind);
    is_of_a_place || matches!(kind, Kind::QUANTISED | Kind::DEAD_ZONE | Kind::REZEROED)
}
