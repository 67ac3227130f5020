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
        reason: "the fit misses the {channel} by {rms}, more than the noise ({noise})",
        text: "the fitted model differs from the {channel} by {rms} (rms), {ratio} times the noise ({noise})[. The difference changes with the orientation, most like {pattern}]. The program has enlarged the standard errors to cover it",
        advice: "",
        remedies: || vec![Remedy::Discover],
    },
    Entry {
        kind: Kind::EffectMissing,
        level: Level::Care,
        severity: 0.06,
        reason: "the model of the {sensor} lacks a source of error, most like {effect}",
        text: "the model of the {sensor} lacks a source of error, most like {effect}. The standard errors do not cover it",
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
        reason: "more placements are needed[ to know {parameter}]",
        text: "more placements are needed: {found}[; {parameter} is known to {error} only]",
        advice: "",
        remedies: || vec![Remedy::Plan],
    },
    Entry {
        kind: Kind::InfluentialInterval,
        level: Level::Remark,
        severity: 0.05,
        reason: "{parameter} depends on {at} alone",
        text: "without {at} {parameter} would change by {change} of its standard errors, because too few other intervals determine it. The program takes the device as still in that time",
        advice: "",
        remedies: || vec![Remedy::if_wrong([OptionName::LeaveOut])],
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
