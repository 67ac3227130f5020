//! Words of clocks that no choice makes right, and of sampling.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, care, remark};

kinds! {
    /// Stamps scatter so much that lost samples cannot be counted.
    CLOCK_UNCOUNTABLE = "clock_uncountable" => Entry {
        reason: "the stamps scatter so much that lost samples cannot be counted",
        text: "the stamps of the gyroscope scatter by {scatter} about steps of {step}. The program cannot tell lost samples from late ones. It uses the stamps as they are",
        remedies: vec![Remedy::SensorStamps, Remedy::set(OptionName::Rate)],
        ..care(0.1)
    },
    /// No clock says when the gyroscope was sampled.
    CLOCK_UNKNOWN = "clock_unknown" => Entry {
        reason: "no clock says when the gyroscope was sampled",
        text: "the times of the gyroscope's samples are not known. After turns it leads to another direction of gravity than the accelerometer's, by {ratio} times the noise. Equal time steps do no better than the stamps",
        advice: "use the accelerometer's parameters and the gyroscope's bias of this calibration, but not the gyroscope's other parameters",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::SensorStamps],
        ..care(0.3)
    },
    /// Samples come in bursts with the stamps of their reading.
    STAMPS_IN_BURSTS = "stamps_in_bursts" => Entry {
        reason: "the stamps of the {sensor} come in bursts",
        text: "the time stamps of the {sensor} come in bursts of {size} samples: they tell when the samples were read and not when they were taken. The program uses equal time steps ({rate}) instead[, on which {lost} samples are missing]",
        remedies: vec![Remedy::SensorStamps],
        ..care(0.05)
    },
    /// The clocks of two sensors are apart.
    CLOCK_OFFSET = "clock_offset" => Entry {
        reason: "the clock of the {sensor} is {late} late",
        text: "the clock of the {sensor} is {late} late against that of the {other}, by their motion[. An offset of {also} fits about as well]. The program does not correct this",
        advice: "do not use this calibration; record both sensors with one app or logger",
        remedies: vec![Remedy::OneClock],
        use_of_result: UseOfResult::Forbidden,
        ..care(1.0)
    },
    /// The clocks of two sensors run at different rates.
    CLOCK_DRIFT = "clock_drift" => Entry {
        reason: "the clock of the gyroscope runs {drift} ppm {which}",
        text: "the clock of the gyroscope runs {drift} ± {error} ppm {which} than that of the accelerometer, by {turns} turns. One of the two clocks is wrong by that. The gyroscope's scale factors may be wrong by as much",
        remedies: vec![Remedy::OneClock, Remedy::set(OptionName::Rate)],
        ..care(0.1)
    },
    /// The rate is higher than any turn needs.
    SAMPLED_FAST = "sampled_fast" => Entry {
        reason: "the rate is higher than needed",
        text: "the sensors were sampled at {rate}, and no hand turns so fast. Means over {block} samples would do and take less time",
        ..remark(0.0001)
    },
    /// Turns are too fast for the sampling rate.
    TURNS_TOO_FAST = "turns_too_fast" => Entry {
        reason: "the turns are too fast for the sampling rate",
        text: "{count} of {all} turns are too fast for {rate}: the device turns by up to {step} from sample to sample. The lost order of the rotations in between (coning) makes an error of about {coning}, most in {at}. A rate of {needed} would do",
        remedies: vec![Remedy::TurnSlower, Remedy::SampleFaster],
        ..care(0.2)
    },
}
