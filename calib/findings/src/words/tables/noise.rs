//! Words of what an Allan deviation was made from.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, care, remark};

kinds! {
    /// Nothing can be said of the noise of an axis.
    NOISE_UNKNOWN = "noise_unknown" => Entry {
        reason: "the noise of {sensor} {axis} is not known",
        text: "the program cannot tell the noise of {sensor} {axis}: the recording is too short, or the signal never \
           changes",
        advice: "record at least 128 samples at rest; if there are that many, check the column, for its readings never change",
        ..care(0.01)
    },
    /// The five noise terms do not describe the Allan variance.
    NOISE_MODEL_MISSES = "noise_model_misses" => Entry {
        reason: "the five usual kinds of noise do not describe {sensor} {axis}",
        text: "the noise of {sensor} {axis} differs[ by {share}] from the usual model of noise, perhaps by a filter, a vibration or a motion[. The stated terms are those of means over {shortest} and longer. They do not hold for single readings][. The stated uncertainties include a difference of {share}][. It differs over all times up to {longest}, so that no term is known: record ten times as long]",
        ..remark(0.001)
    },
    /// Single samples of a rest are missing.
    NOISE_SAMPLES_MISSING = "noise_samples_missing" => Entry {
        reason: "single samples of the {sensor} are missing",
        text: "the {sensor} lacks {bridged} of {samples} samples ({share}), singly or a few at a time. The program \
           bridges them by straight lines[. The white noise (from sample to sample) may be stated up to {excess} \
           too large]",
        ..remark(0.001)
    },
    /// A rest is interrupted.
    NOISE_GAPS = "noise_gaps" => Entry {
        reason: "the rest of the {sensor} is interrupted",
        text: "the {sensor} has {count:gap} without samples. The program compares no readings across a gap",
        ..remark(0.001)
    },
    /// The mean of a sensor steps during a rest.
    MEAN_STEPS = "mean_steps" => Entry {
        reason: "the mean of {sensor} {axis} jumps during the rest",
        text: "the mean of {sensor} {axis} jumps by {listed}[ and {more} more times]. The jumps act as a random walk (slow drift at random) of {walk}. The bias instability (slow wander at rest) includes them",
        advice: "use these values if the sensor jumps in use too; if not, analyse only the longest stretch between two jumps",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::such_as(OptionName::Rest, "60,3600")],
        ..care(0.05)
    },
    /// The mean of a sensor drifts during a rest.
    MEAN_DRIFTS = "mean_drifts" => Entry {
        reason: "{sensor} {axis} drifts more smoothly than noise does",
        text: "{sensor} {axis} drifts by {change} in {time}, more smoothly than noise does. The stated ramp (steady drift) and random walk include this drift[, which is most of the Allan deviation (scatter of means over a time) beyond {tau}]",
        remedies: vec![Remedy::WarmUp, Remedy::such_as(OptionName::Rest, "60,3600")],
        ..care(0.05)
    },
    /// The bias moves within the rest that it is estimated from.
    BIAS_DRIFTS = "bias_drifts" => Entry {
        reason: "the {sensor}'s bias moves within a rest",
        text: "the {sensor}'s bias (its reading at rest) moves by {change} in a rest of {time}. The estimate is the mean over the rest, and its error covers what the bias does over a fifth of it",
        remedies: vec![Remedy::WarmUp],
        ..remark(0.05)
    },
    /// The readings stand still for a while during a rest.
    READINGS_HELD = "readings_held" => Entry {
        reason: "readings of the {sensor} repeat for a while",
        text: "the readings of the {sensor} repeat one value at t = {listed}: nothing was measured in that time. The noise is therefore stated too small",
        advice: "do not use these values; analyse only the longest stretch between two of these times",
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::such_as(OptionName::Rest, "60,3600")],
        ..care(0.05)
    },
    /// Rows repeat the readings before, for the sensor is slower.
    ROWS_FASTER_THAN_SENSOR = "rows_faster_than_sensor" => Entry {
        reason: "the {sensor} is slower than the rows",
        text: "the {sensor} is slower than the file: {share} of the rows repeat the reading before. The Allan deviation (scatter of means over a time) over a few samples and the noise from rounding are wrong",
        advice: "nothing has to be done unless you need these two values, for those over longer times hold",
        ..remark(0.001)
    },
    /// The gyroscope's deviation does not turn flat.
    SETTLING_UNKNOWN = "settling_unknown" => Entry {
        reason: "how long the first rest must be is not known",
        text: "the recording is too short to tell how long the first rest of a calibration must be. The mean of the gyroscope does not settle in it",
        advice: "nothing has to be done unless you need this time; if you do, record twice as long at rest, and again until the program finds it",
        ..remark(0.001)
    },
}
