//! Words of what an Allan deviation was made from.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::NoiseUnknown,
        level: Level::Care,
        severity: 0.01,
        reason: "the noise of {sensor} {axis} is not known",
        text: "{sensor} {axis} is too short, or its signal never changes: no noise terms",
        advice: "",
        remedies: || vec![Remedy::RestLonger],
    },
    Entry {
        kind: Kind::NoiseModelMisses,
        level: Level::Remark,
        severity: 0.001,
        reason: "five noise terms do not describe {sensor} {axis}",
        text: "five noise terms miss the Allan variance of {sensor} {axis} by {share} (a filter, a resonance or a motion): \
               the intervals include that",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NoiseSamplesMissing,
        level: Level::Remark,
        severity: 0.001,
        reason: "single samples of the {sensor} are missing",
        text: "the {sensor} lacks {bridged} of {samples} samples ({share}), singly or a few at a time: straight lines \
               bridge them[. The white noise may be stated up to {excess} too large]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NoiseGaps,
        level: Level::Remark,
        severity: 0.001,
        reason: "the rest of the {sensor} is interrupted",
        text: "the {sensor} has {count:gap} without samples: no difference reaches across",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::MeanSteps,
        level: Level::Care,
        severity: 0.05,
        reason: "the mean of {sensor} {axis} steps during the rest",
        text: "{sensor} {axis} steps by {listed}[ and {more} more times]. That looks like a random walk of {walk}, and the \
               bias instability includes it",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::Rest)],
    },
    Entry {
        kind: Kind::MeanDrifts,
        level: Level::Care,
        severity: 0.05,
        reason: "{sensor} {axis} drifts as no noise does",
        text: "{sensor} {axis} drifts by {change} in {time}, as smoothly as no noise does: the ramp and the random walk \
               include it[, and beyond τ = {tau} the Allan deviation is mostly that]",
        advice: "",
        remedies: || vec![Remedy::WarmUp, Remedy::set(OptionName::Rest)],
    },
    Entry {
        kind: Kind::ReadingsHeld,
        level: Level::Care,
        severity: 0.05,
        reason: "the readings of the {sensor} stand still for a while",
        text: "the readings of the {sensor} stand still at t = {listed}: nothing was measured there, and the noise is \
               stated too small",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::Rest)],
    },
    Entry {
        kind: Kind::RowsFasterThanSensor,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} is slower than the rows",
        text: "the {sensor} is slower than the rows: {share} of them repeat the readings before. The deviation below a few \
               samples and the quantisation noise are not the sensor's",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::SettlingUnknown,
        level: Level::Remark,
        severity: 0.001,
        reason: "the length of the first rest stays unknown",
        text: "the gyroscope's deviation does not turn flat: a longer rest tells how long the initial one must be",
        advice: "",
        remedies: || vec![Remedy::RestLonger],
    },
];
