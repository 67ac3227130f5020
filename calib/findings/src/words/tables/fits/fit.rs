//! Words of what a fit leaves and of what it assumes.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, care, remark};

kinds! {
    /// The fit leaves more than the noise explains.
    MISFIT = "misfit" => Entry {
        reason: "the fit misses the {channel} by {rms}, more than the noise ({noise})",
        text: "the fitted model differs from the {channel} by {rms} (rms), {ratio} times the noise ({noise})[. The difference changes with the orientation, most like {pattern}]. The program has enlarged the standard errors to cover it",
        remedies: vec![Remedy::Discover],
        ..care(0.02)
    },
    /// An effect that the model lacks shows in the residuals though no channel misfits as a whole.
    EFFECT_MISSING = "effect_missing" => Entry {
        reason: "the model[ of the {sensor}] lacks a source of error[, most like {effect}]",
        text: "the model[ of the {sensor}] lacks a source of error[, most like {effect}]. The standard errors may not cover all of it",
        remedies: vec![Remedy::Discover],
        ..care(0.06)
    },
    /// The placements cannot show whether a sensor is linear.
    LINEARITY_UNTESTED = "linearity_untested" => Entry {
        reason: "the placements cannot show whether the {sensor} is linear",
        text: "the placements cannot show whether the {sensor} is linear. An error like {effect} of the usual size would put {parameter} off by {times} times its standard error (readings by {size}) and hardly show. The standard errors hold for a linear sensor",
        advice: "add placements on edges and corners",
        ..care(0.1)
    },
    /// The readings are cut off towards zero.
    CUT_TOWARDS_ZERO = "cut_towards_zero" => Entry {
        reason: "the {sensor} reads half a step of {step} too near zero",
        text: "the {sensor} cuts its readings off towards zero, in steps of {step}, instead of rounding them: they are half a step too small. The standard errors do not cover that",
        advice: "round the readings where they are made, and record again",
        ..care(0.1)
    },
    /// The readings of a sensor still change after each turn.
    SETTLES_AFTER_TURNS = "settles_after_turns" => Entry {
        reason: "the {sensor} still settles after each turn, by {size}",
        text: "the readings of the {sensor} still change when the device rests after a turn: they begin {size} (rms) off and settle with a time constant of about {within}. Scale factors and biases are those of means over the rests. The standard errors include what the readings show of it",
        advice: "record again and let the device rest longer in every placement",
        ..care(0.1)
    },
    /// A parameter is known too badly to be used with ease.
    WEAK_PARAMETER = "weak_parameter" => Entry {
        reason: "{parameter} is known to {error} only",
        text: "{parameter} is known to {error} only[ ({evidence})]",
        remedies: vec![Remedy::Plan],
        ..care(0.3)
    },
    /// Directions are missing among the placements.
    PLACEMENTS_MISSING = "placements_missing" => Entry {
        reason: "more placements are needed[ to know {parameter}]",
        text: "more placements are needed[ to know {parameter} better than to {error}]: there are {found}",
        remedies: vec![Remedy::Plan],
        ..care(0.1)
    },
    /// One static interval alone carries a parameter.
    INFLUENTIAL_INTERVAL = "influential_interval" => Entry {
        reason: "{parameter} depends on {at} alone",
        text: "without {at} {parameter} would change by {change} of its standard errors, because too few other intervals determine it. The program takes the device as still in that time",
        remedies: vec![Remedy::if_wrong([OptionName::LeaveOut])],
        ..remark(0.05)
    },
    /// Gravity was assumed.
    GRAVITY_ASSUMED = "gravity_assumed" => Entry {
        reason: "gravity was assumed",
        text: "gravity is taken to be {gravity}, because nobody gave it. The accelerometer's scale factors may all be \
           wrong by {share}. Their standard errors include that",
        remedies: vec![Remedy::any_of([OptionName::Gravity, OptionName::Latitude])],
        ..remark(0.01)
    },
    /// The height was assumed.
    ALTITUDE_ASSUMED = "altitude_assumed" => Entry {
        reason: "the height above the sea was assumed",
        text: "gravity is taken to be {gravity}, that of the latitude {latitude} at sea level. The accelerometer's \
           scale factors may all be wrong by {share}. Their standard errors include that",
        remedies: vec![Remedy::set(OptionName::Altitude)],
        ..remark(0.001)
    },
}
