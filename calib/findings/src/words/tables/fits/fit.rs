//! Words of what a fit leaves and of what it assumes.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, care, remark};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::Misfit => Entry {
            reason: "the fit misses the {channel} by {rms}, more than the noise ({noise})",
            text: "the fitted model differs from the {channel} by {rms} (rms), {ratio} times the noise ({noise})[. The difference changes with the orientation, most like {pattern}]. The program has enlarged the standard errors to cover it",
            remedies: vec![Remedy::Discover],
            ..care(0.02)
        },
        Kind::EffectMissing => Entry {
            reason: "the model[ of the {sensor}] lacks a source of error[, most like {effect}]",
            text: "the model[ of the {sensor}] lacks a source of error[, most like {effect}]. The standard errors may not cover all of it",
            remedies: vec![Remedy::Discover],
            ..care(0.06)
        },
        Kind::LinearityUntested => Entry {
            reason: "the placements cannot show whether the {sensor} is linear",
            text: "the placements cannot show whether the {sensor} is linear. An error like {effect} of the usual size would put {parameter} off by {times} times its standard error (readings by {size}) and hardly show. The standard errors hold for a linear sensor",
            advice: "add placements on edges and corners",
            ..care(0.1)
        },
        Kind::CutTowardsZero => Entry {
            reason: "the {sensor} reads half a step of {step} too near zero",
            text: "the {sensor} cuts its readings off towards zero, in steps of {step}, instead of rounding them: they are half a step too small. The standard errors do not cover that",
            advice: "round the readings where they are made, and record again",
            ..care(0.1)
        },
        Kind::SettlesAfterTurns => Entry {
            reason: "the {sensor} still settles after each turn, by {size}",
            text: "the readings of the {sensor} still change when the device rests after a turn: they begin {size} (rms) off and settle with a time constant of about {within}. Scale factors and biases are those of means over the rests. The standard errors include what the readings show of it",
            advice: "record again and let the device rest longer in every placement",
            ..care(0.1)
        },
        Kind::WeakParameter => Entry {
            reason: "{parameter} is known to {error} only",
            text: "{parameter} is known to {error} only[ ({evidence})]",
            remedies: vec![Remedy::Plan],
            ..care(0.3)
        },
        Kind::PlacementsMissing => Entry {
            reason: "more placements are needed[ to know {parameter}]",
            text: "more placements are needed[ to know {parameter} better than to {error}]: there are {found}",
            remedies: vec![Remedy::Plan],
            ..care(0.1)
        },
        Kind::InfluentialInterval => Entry {
            reason: "{parameter} depends on {at} alone",
            text: "without {at} {parameter} would change by {change} of its standard errors, because too few other intervals determine it. The program takes the device as still in that time",
            remedies: vec![Remedy::if_wrong([OptionName::LeaveOut])],
            ..remark(0.05)
        },
        Kind::GravityAssumed => Entry {
            reason: "gravity was assumed",
            text: "gravity is taken to be {gravity}, because nobody gave it. The accelerometer's scale factors may all be \
               wrong by {share}. Their standard errors include that",
            remedies: vec![Remedy::any_of([OptionName::Gravity, OptionName::Latitude])],
            ..remark(0.01)
        },
        Kind::AltitudeAssumed => Entry {
            reason: "the height above the sea was assumed",
            text: "gravity is taken to be {gravity}, that of the latitude {latitude} at sea level. The accelerometer's \
               scale factors may all be wrong by {share}. Their standard errors include that",
            remedies: vec![Remedy::set(OptionName::Altitude)],
            ..remark(0.001)
        },
        _ => return None,
    })
}
