//! Words of what the readings themselves show of a sensor.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, care, remark};

/// What decides whether a result that stands on less than was recorded can be used.
pub(super) const IF_EXACT: &str =
    "use the calibration from this recording if its standard errors are small enough for you";

/// What missing or repeated samples ask for.
pub(super) const LEFT_OUT: &str = "nothing has to be done if enough turns are left, for the program leaves out those that this spoils";

kinds! {
    /// Readings end at the limit of the sensor's range.
    SATURATED = "saturated" => Entry {
        reason: "the {sensor} is saturated on {axis}",
        text: "{sensor} {axis} is saturated at {limit} in {rows:row}[ between rows {from_row} and {to_row}]: its range ends there, and the true value is larger. The program leaves out the turns and static intervals that this spoils",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::LargerRange, Remedy::TurnSlower],
        ..care(0.5)
    },
    /// The steps of the readings are wider than the noise.
    QUANTISED = "quantised" => Entry {
        reason: "the {sensor} reads in steps wider than its noise",
        text: "the {sensor} reads in steps of {step} on {axes}, wider than its noise ({noise}). No mean at rest is \
           known better than to {error}[. The steps hide the noise, whose white part is only known to be below {white}]",
        remedies: vec![Remedy::RawReadings],
        ..care(0.05)
    },
    /// Small signals read as exactly zero.
    DEAD_ZONE = "dead_zone" => Entry {
        reason: "the {sensor} reads small rates as zero",
        text: "the {sensor} reads exactly zero on {axes} and nothing between zero and {least}: it has a dead zone, or \
           the readings come from a fusion filter (software that combines sensors). The errors of slow turns \
           cannot be known[, and neither can the bias, for {share} of the readings at rest are zero]",
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.5)
    },
    /// Rows repeat one reading for longer than chance makes it.
    FROZEN = "frozen" => Entry {
        reason: "readings of the {sensors} repeat for a while",
        text: "{rows:row} repeated the reading of the {sensors} from the row before, in {places:place} ({listed}). The program leaves these rows out",
        advice: LEFT_OUT,
        ..remark(0.05)
    },
    /// All readings from a row on repeat one pattern: memory that was never written.
    ERASED_TAIL = "erased_tail" => Entry {
        reason: "the end of the recording is erased memory",
        text: "from row {first_row} (t = {t0}) on, the last {rows:row} repeated one reading on all axes, as erased \
           memory of a logger does. The program leaves them out",
        ..remark(0.001)
    },
    /// The magnetometer reads zero throughout.
    MAGNETOMETER_DEAD = "magnetometer_dead" => Entry {
        reason: "the magnetometer reads zero throughout",
        text: "the magnetometer reads zero on all axes throughout. The program does not use it",
        ..remark(0.01)
    },
    /// Single samples are zero on every axis: the sensor was not read.
    FAILED_READS = "failed_reads" => Entry {
        reason: "reads of the {sensor} failed and were logged as zero",
        text: "{count:sample} of the {sensor} ({share}) are exactly zero on {axes}, among others that are not: the \
           logger failed to read the sensor and wrote zeros. The program does not use them",
        ..remark(0.001)
    },
    /// The device sets its zero anew while it rests.
    REZEROED = "rezeroed" => Entry {
        reason: "the device sets the zero of the {sensor} anew while it rests",
        text: "the bias (the reading at rest) of the {sensor} jumps {after} into the static intervals, by {size} (rms \
           over {intervals} of them): the device sets its zero anew while it rests. Turns and rests are then read \
           about different zeros",
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.5)
    },
    /// Single readings stand far from their neighbours on both sides.
    SPIKES = "spikes" => Entry {
        reason: "single readings of the {sensor} were replaced",
        text: "the {sensor} has {count:single reading} on {axes} far from both neighbours, by up to {largest}, as \
           from transfer errors or knocks[ (rows {listed}). The program puts the mean of the neighbours in place of \
           each][ (t = {times}). The program leaves them out and uses the others]",
        ..remark(0.001)
    },
    /// Some static intervals are far noisier than the others.
    VIBRATION = "vibration" => Entry {
        reason: "the device did not lie still in {intervals}",
        text: "the {sensor} is up to {ratio} times noisier in {intervals} than in the others: its readings scatter more, as from vibration or a hand",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::LayDown],
        ..care(0.1)
    },
    /// From one static interval on the readings are far noisier, or up to one.
    NOISE_CHANGED = "noise_changed" => Entry {
        reason: "the noise of the {sensor} changes part of the way",
        text: "the {sensor} is up to {ratio} times noisier in {intervals} than before: its readings scatter more. Perhaps a fan or a motor ran then, or a setting of the sensor was changed",
        advice: "use the calibration from this recording if only a fan or a motor ran; if a setting was changed, split the recording where the noise changes and calibrate one part",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::RecordAgain],
        ..care(0.1)
    },
    /// The rate wavers in the quietest stretches as in a hand.
    HAND_HELD = "hand_held" => Entry {
        reason: "the device was held in the hand and never lies still",
        text: "the device never lies still: its rate of rotation wavers by {rate} in the quietest stretches, as in a hand. Where a calibration is possible, its standard errors tell whether it can be used",
        remedies: vec![Remedy::LayDown],
        ..care(0.1)
    },
    /// A sensor is slower than the rows, and its readings are held between.
    SLOWER_SENSOR = "slower_sensor" => Entry {
        reason: "the {sensor} is slower than the rows",
        text: "the {sensor} is {ratio} times slower than the rows, so the file repeats its readings in between. The \
           program leaves these out: {repetitions:repetition}",
        ..remark(0.001)
    },
    /// The sensor was read before it had a new reading.
    READINGS_STALE = "readings_stale" => Entry {
        reason: "rows repeat readings of the {sensor}",
        text: "{count:row} ({share} of all) repeated the reading of the {sensor} from the row before, as when a sensor is read \
           before it has a new one. The program puts values on a smooth curve through the neighbours in their place",
        ..remark(0.001)
    },
    /// The recording lacks a sensor.
    ONE_SENSOR_ONLY = "one_sensor_only" => Entry {
        reason: "the recording has no {missing}[ and no {neither}]",
        text: "the recording has no {missing}[ and no {neither}], only the {only}[ (columns not used: {unused})]",
        ..remark(0.001)
    },
    /// The recording has no sensor at all.
    NO_SENSOR = "no_sensor" => Entry {
        reason: "the recording has no sensor",
        text: "the program found no columns of an accelerometer or a gyroscope in the recording[ (columns not used: {unused})]",
        remedies: vec![
            Remedy::LookInto,
            Remedy::such_as(OptionName::Columns, "ax=NAME,ay=NAME,az=NAME"),
        ],
        ..care(1.0)
    },
    /// The accelerometer's sign was turned to the usual one.
    SIGN_TURNED = "sign_turned" => Entry {
        reason: "the program has changed the accelerometer's sign",
        text: "files of {system} have -1 g on the accelerometer's axis that points up. The program has changed the \
           accelerometer's sign",
        ..remark(0.001)
    },
    /// Another system had corrected the readings before.
    CORRECTED_BY_SYSTEM = "corrected_by_system" => Entry {
        reason: "{system} had corrected the readings before",
        text: "{system} has corrected {columns} by its own calibration. A calibration from these readings comes on top \
           of that[. {raw} has the readings without it]",
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.1)
    },
    /// The correction by another system was undone.
    CORRECTION_UNDONE = "correction_undone" => Entry {
        reason: "the correction by {system} was taken off again",
        text: "{columns} holds readings that {system} has corrected. {parameters} taken off again, so that the program \
           uses the sensor's own readings",
        ..remark(0.001)
    },
    /// Another system had filtered the readings and taken a mean off.
    FILTERED_BEFORE = "filtered_before" => Entry {
        reason: "{system} had filtered the readings before",
        text: "{system} has subtracted from {gyro} the mean that it read when it started. It has also filtered {accel}",
        advice: "use the calibration only for logs of {system} with the same filters, and estimate the gyroscope's bias again after each start",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.1)
    },
    /// The accelerometer is the sum of gravity and the acceleration without it.
    GRAVITY_ADDED = "gravity_added" => Entry {
        reason: "the accelerometer is the sum of two columns that the phone's software computed",
        text: "the accelerometer is the sum of columns like `{linear}` and `{gravity}`, both computed by the phone's software. That software has corrected them by a calibration of its own",
        advice: "use the calibration only for readings that the same phone's software has corrected in the same way",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.3)
    },
    /// A column that seemed to lack gravity has it.
    GRAVITY_NOT_ADDED = "gravity_not_added" => Entry {
        reason: "`{linear}` holds gravity already",
        text: "`{linear}` holds gravity already. The program does not add `{gravity}` to it",
        ..remark(0.001)
    },
    /// A fast sensor was read as means over blocks of samples.
    AVERAGED = "averaged" => Entry {
        reason: "the {sensor} was read as means over blocks",
        text: "the {sensor} was sampled at {rate}, more often than a motion by hand needs. The program takes means of {block} samples each, which leaves {then}",
        ..remark(0.001)
    },
}
