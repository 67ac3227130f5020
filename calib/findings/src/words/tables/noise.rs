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
        text: "the program cannot tell the noise of {sensor} {axis}: the recording is too short, or the signal never \
               changes",
        advice: "",
        remedies: || vec![Remedy::RestLonger],
    },
    Entry {
        kind: Kind::NoiseModelMisses,
        level: Level::Remark,
        severity: 0.001,
        reason: "the five usual kinds of noise do not describe {sensor} {axis}",
        text: "the noise of {sensor} {axis} is unusual: it differs by {share} from the usual model. A filter, a vibration or a motion may be the reason. The stated intervals include that",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NoiseSamplesMissing,
        level: Level::Remark,
        severity: 0.001,
        reason: "single samples of the {sensor} are missing",
        text: "the {sensor} lacks {bridged} of {samples} samples ({share}), singly or a few at a time. The program \
               bridges them by straight lines[. The white noise (from sample to sample) may be stated up to {excess} \
               too large]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NoiseGaps,
        level: Level::Remark,
        severity: 0.001,
        reason: "the rest of the {sensor} is interrupted",
        text: "the {sensor} has {count:gap} without samples. The program compares no readings across a gap",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::MeanSteps,
        level: Level::Care,
        severity: 0.05,
        reason: "the mean of {sensor} {axis} jumps during the rest",
        text: "the mean of {sensor} {axis} jumps by {listed}[ and {more} more times]. The jumps look like a random \
               walk (slow drift at random) of {walk}. The bias instability includes them",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::Rest)],
    },
    Entry {
        kind: Kind::MeanDrifts,
        level: Level::Care,
        severity: 0.05,
        reason: "{sensor} {axis} drifts more smoothly than noise does",
        text: "{sensor} {axis} drifts by {change} in {time}, more smoothly than noise does. The noise found as ramp \
               (steady drift) and random walk (drift at random) includes this[. Beyond averaging times of τ = {tau} \
               the Allan deviation is mostly this drift]",
        advice: "",
        remedies: || vec![Remedy::WarmUp, Remedy::set(OptionName::Rest)],
    },
    Entry {
        kind: Kind::ReadingsHeld,
        level: Level::Care,
        severity: 0.05,
        reason: "the readings of the {sensor} stand still for a while",
        text: "the readings of the {sensor} stand still at t = {listed}: nothing was measured in that time. The noise \
               is therefore stated too small",
        advice: "",
        remedies: || vec![Remedy::set(OptionName::Rest)],
    },
    Entry {
        kind: Kind::RowsFasterThanSensor,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} is slower than the rows",
        text: "the {sensor} is slower than the rows: {share} of the rows repeat the readings before. The Allan \
               deviation below a few samples and the quantisation noise (from rounding) are not the sensor's",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::SettlingUnknown,
        level: Level::Remark,
        severity: 0.001,
        reason: "how long the first rest must be is not known",
        text: "the recording is too short to tell how long the first rest of a calibration must be: the mean of the \
               gyroscope does not settle in it (its Allan deviation reaches no flat part)",
        advice: "",
        remedies: || vec![Remedy::RestLonger],
    },
];
