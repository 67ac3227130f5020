//! Words of what a fit leaves and of what it assumes.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::Misfit,
        level: Level::Care,
        severity: 0.02,
        reason: "the {channel} misfits: {rms} is left where the noise makes {noise}",
        text: "the {channel} misfits: {rms} rms is left after the fit where the noise makes {noise} ({ratio} times the \
               noise, p {p})[. It changes with the orientation, most like {pattern} (p {pattern_p}), as neither noise \
               nor a slow change of the bias does]. The program has enlarged the standard errors to cover it",
        advice: "",
        remedies: || vec![Remedy::Discover],
    },
    Entry {
        kind: Kind::EffectMissing,
        level: Level::Care,
        severity: 0.02,
        reason: "the model of the {sensor} lacks an effect, most like {effect}",
        text: "the model of the {sensor} lacks an effect, most like {effect} (χ² {statistic} of {dof} degrees of \
               freedom, p = {p}). The standard errors do not cover it",
        advice: "",
        remedies: || vec![Remedy::Discover],
    },
    Entry {
        kind: Kind::WeakParameter,
        level: Level::Care,
        severity: 0.3,
        reason: "{parameter} is known to {error} only",
        text: "{parameter} is known to {error} only[ ({evidence})]",
        advice: "",
        remedies: || vec![Remedy::Plan],
    },
    Entry {
        kind: Kind::PlacementsMissing,
        level: Level::Care,
        severity: 0.1,
        reason: "more placements are needed: {found}",
        text: "more placements are needed: {found}[; {parameter} is known to {error} only]",
        advice: "",
        remedies: || vec![Remedy::Plan],
    },
    Entry {
        kind: Kind::InfluentialInterval,
        level: Level::Remark,
        severity: 0.05,
        reason: "{parameter} depends on {at} alone",
        text: "without {at} {parameter} would change by {change} of its standard errors, because too few other \
               intervals determine it",
        advice: "leave the interval out if the device was not still in it",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::GravityAssumed,
        level: Level::Remark,
        severity: 0.01,
        reason: "gravity was assumed",
        text: "gravity is taken to be {gravity}, because nobody gave it. The accelerometer's scale factors may all be \
               wrong by {share}. Their standard errors include that",
        advice: "",
        remedies: || vec![Remedy::any_of([OptionName::Gravity, OptionName::Latitude])],
    },
    Entry {
        kind: Kind::AltitudeAssumed,
        level: Level::Remark,
        severity: 0.001,
        reason: "the height above the sea was assumed",
        text: "gravity is taken to be {gravity}, that of the latitude {latitude} at sea level. The accelerometer's \
               scale factors may all be wrong by {share}. Their standard errors include that",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::Altitude)],
    },
];
