//! Words of what the readings themselves show of a sensor.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

/// What decides whether a result that stands on less than was recorded can be used.
pub(super) const IF_EXACT: &str =
    "use the calibration from this recording if its standard errors are small enough for you";

/// What missing or repeated samples ask for.
pub(super) const LEFT_OUT: &str = "nothing has to be done if enough turns are left, for the program leaves out those that this spoils";

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::Saturated,
        level: Level::Care,
        severity: 0.5,
        reason: "the {sensor} is saturated on {axis}",
        text: "{sensor} {axis} is saturated at {limit} in {rows:row}[ between rows {from_row} and {to_row}]: its range ends there, and the true value is larger. The program leaves out the turns and static intervals that this spoils",
        advice: IF_EXACT,
        remedies: || vec![Remedy::LargerRange, Remedy::TurnSlower],
    },
    Entry {
        kind: Kind::Quantised,
        level: Level::Care,
        severity: 0.05,
        reason: "the {sensor} reads in steps wider than its noise",
        text: "the {sensor} reads in steps of {step} on {axes}, wider than its noise ({noise}). No mean at rest is \
               known better than to {error}[. The steps hide the noise, whose white part is only known to be below {white}]",
        advice: "",
        remedies: || vec![Remedy::RawReadings],
    },
    Entry {
        kind: Kind::DeadZone,
        level: Level::Care,
        severity: 0.5,
        reason: "the {sensor} reads small rates as zero",
        text: "the {sensor} reads exactly zero on {axes} and nothing between zero and {least}: it has a dead zone, or \
               the readings come from a fusion filter (software that combines sensors). The errors of slow turns \
               cannot be known[, and neither can the bias, for {share} of the readings at rest are zero]",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::Frozen,
        level: Level::Remark,
        severity: 0.05,
        reason: "readings of the {sensors} repeat for a while",
        text: "{rows:row} repeated the reading of the {sensors} from the row before, in {places:place} ({listed}). The program leaves these rows out",
        advice: LEFT_OUT,
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ErasedTail,
        level: Level::Remark,
        severity: 0.001,
        reason: "the end of the recording is erased memory",
        text: "from row {first_row} (t = {t0}) on, the last {rows:row} repeated one reading on all axes, as erased \
               memory of a logger does. The program leaves them out",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Rezeroed,
        level: Level::Care,
        severity: 0.5,
        reason: "the device sets the zero of the {sensor} anew while it rests",
        text: "the bias (the reading at rest) of the {sensor} jumps {after} into the static intervals, by {size} (rms \
               over {intervals} of them): the device sets its zero anew while it rests. Turns and rests are then read \
               about different zeros",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::Spikes,
        level: Level::Remark,
        severity: 0.001,
        reason: "single readings of the {sensor} were replaced",
        text: "the {sensor} has {count:single reading} on {axes} far from both neighbours, by up to {largest}, as \
               from transfer errors or knocks[ (rows {listed}). The program puts the mean of the neighbours in place of \
               each][ (t = {times}). The program leaves them out and uses the others]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Vibration,
        level: Level::Care,
        severity: 0.1,
        reason: "the device did not lie still in {intervals}",
        text: "the {sensor} is up to {ratio} times noisier in {intervals} than in the others: its readings scatter more, as from vibration or a hand",
        advice: IF_EXACT,
        remedies: || vec![Remedy::LayDown],
    },
    Entry {
        kind: Kind::NoiseChanged,
        level: Level::Care,
        severity: 0.1,
        reason: "the noise of the {sensor} changes part of the way",
        text: "the {sensor} is up to {ratio} times noisier in {intervals} than before: its readings scatter more. Perhaps a fan or a motor ran then, or a setting of the sensor was changed",
        advice: "use the calibration from this recording if only a fan or a motor ran; if a setting was changed, split the recording where the noise changes and calibrate one part",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::HandHeld,
        level: Level::Care,
        severity: 0.1,
        reason: "the device was held in the hand and never lies still",
        text: "the device never lies still: its rate of rotation wavers by {rate} in the quietest stretches, as in a hand. Where a calibration is possible, its standard errors tell whether it can be used",
        advice: "",
        remedies: || vec![Remedy::LayDown],
    },
    Entry {
        kind: Kind::SlowerSensor,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} is slower than the rows",
        text: "the {sensor} is {ratio} times slower than the rows, so the file repeats its readings in between. The \
               program leaves these out: {repetitions:repetition}",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ReadingsStale,
        level: Level::Remark,
        severity: 0.001,
        reason: "rows repeat readings of the {sensor}",
        text: "{count:row} ({share} of all) repeated the reading of the {sensor} from the row before, as when a sensor is read \
               before it has a new one. The program puts values on a smooth curve through the neighbours in their place",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::OneSensorOnly,
        level: Level::Remark,
        severity: 0.001,
        reason: "the recording has no {missing}[ and no {neither}]",
        text: "the recording has no {missing}[ and no {neither}], only the {only}[ (columns not used: {unused})]",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::NoSensor,
        level: Level::Care,
        severity: 1.0,
        reason: "the recording has no sensor",
        text: "the program found no columns of an accelerometer or a gyroscope in the recording[ (columns not used: {unused})]",
        advice: "",
        remedies: || {
            vec![
                Remedy::LookInto,
                Remedy::such_as(OptionName::Columns, "ax=NAME,ay=NAME,az=NAME"),
            ]
        },
    },
    Entry {
        kind: Kind::SignTurned,
        level: Level::Remark,
        severity: 0.001,
        reason: "the program has changed the accelerometer's sign",
        text: "files of {system} have -1 g on the accelerometer's axis that points up. The program has changed the \
               accelerometer's sign",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::CorrectedBySystem,
        level: Level::Care,
        severity: 0.1,
        reason: "{system} had corrected the readings before",
        text: "{system} has corrected {columns} by its own calibration. A calibration from these readings comes on top \
               of that[. {raw} has the readings without it]",
        advice: "",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::CorrectionUndone,
        level: Level::Remark,
        severity: 0.001,
        reason: "the correction by {system} was taken off again",
        text: "{columns} holds readings that {system} has corrected. {parameters} taken off again, so that the program \
               uses the sensor's own readings",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::FilteredBefore,
        level: Level::Care,
        severity: 0.1,
        reason: "{system} had filtered the readings before",
        text: "{system} has subtracted from {gyro} the mean that it read when it started. It has also filtered {accel}",
        advice: "use the calibration only for logs of {system} with the same filters, and estimate the gyroscope's bias again after each start",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::GravityAdded,
        level: Level::Care,
        severity: 0.3,
        reason: "the accelerometer is the sum of two columns that the phone's software computed",
        text: "the accelerometer is the sum of `{linear}`, .. and gravity `{gravity}`, .., both computed by the phone's software. That software has corrected them by a calibration of its own",
        advice: "use the calibration only for readings that the same phone's software has corrected in the same way",
        remedies: || vec![Remedy::Uncalibrated],
    },
    Entry {
        kind: Kind::GravityNotAdded,
        level: Level::Remark,
        severity: 0.001,
        reason: "`{linear}` holds gravity already",
        text: "`{linear}` holds gravity already. The program does not add `{gravity}` to it",
        advice: "",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::Averaged,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} was read as means over blocks",
        text: "the {sensor} was sampled at {rate}, more often than a motion by hand needs. The program takes means of {block} samples each, which leaves {then}",
        advice: "",
        remedies: Vec::new,
    },
];
