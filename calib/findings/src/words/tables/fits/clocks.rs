//! Words of clocks that no choice makes right, and of sampling.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::ClockUncountable,
        level: Level::Care,
        severity: 0.1,
        reason: "the stamps scatter so much that lost samples cannot be counted",
        text: "the stamps of the gyroscope scatter by {scatter} about steps of {step}. The program cannot tell lost samples from late ones. It uses the stamps as they are",
        advice: "",
        remedies: || vec![Remedy::SensorStamps, Remedy::set(OptionName::Rate)],
    },
    Entry {
        kind: Kind::ClockUnknown,
        level: Level::Care,
        severity: 0.3,
        reason: "no clock says when the gyroscope was sampled",
        text: "the times of the gyroscope's samples are not known. After turns it leads to another direction of gravity than the accelerometer's, by {ratio} times the noise. Equal time steps do no better than the stamps",
        advice: "use the accelerometer's parameters and the gyroscope's bias of this calibration, but not the gyroscope's other parameters",
        remedies: || vec![Remedy::SensorStamps],
    },
    Entry {
        kind: Kind::StampsInBursts,
        level: Level::Care,
        severity: 0.05,
        reason: "the stamps of the {sensor} come in bursts",
        text: "the time stamps of the {sensor} come in bursts of {size} samples: they tell when the samples were read and not when they were taken. The program uses equal time steps ({rate}) instead[, on which {lost} samples are missing]",
        advice: "",
        remedies: || vec![Remedy::SensorStamps],
    },
    Entry {
        kind: Kind::ClockOffset,
        level: Level::Care,
        severity: 1.0,
        reason: "the clock of the {sensor} is {late} late",
        text: "the clock of the {sensor} is {late} late against that of the {other}, by their motion[. An offset of {also} fits about as well]. The program does not correct this: do not use the calibration",
        advice: "record both sensors with one app or logger",
        remedies: || vec![Remedy::OneClock],
    },
    Entry {
        kind: Kind::ClockDrift,
        level: Level::Care,
        severity: 0.1,
        reason: "the clock of the gyroscope runs {drift} ppm {which}",
        text: "the clock of the gyroscope runs {drift} ± {error} ppm {which} than that of the accelerometer, by {turns} turns. One of the two clocks is wrong by that. The gyroscope's scale factors may be wrong by as much",
        advice: "",
        remedies: || vec![Remedy::OneClock, Remedy::set(OptionName::Rate)],
    },
    Entry {
        kind: Kind::SampledFast,
        level: Level::Remark,
        severity: 0.0001,
        reason: "the rate is higher than needed",
        text: "the sensors were sampled at {rate}, and no hand turns so fast. Means over {block} samples would do and take less time",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TurnsTooFast,
        level: Level::Care,
        severity: 0.2,
        reason: "the turns are too fast for the sampling rate",
        text: "{count} of {all} turns are too fast for {rate}: the device turns by up to {step} from sample to sample. The lost order of the rotations in between (coning) makes an error of about {coning}, most in {at}. A rate of {needed} would do",
        advice: "",
        remedies: || vec![Remedy::TurnSlower, Remedy::SampleFaster],
    },
];
