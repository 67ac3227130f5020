//! Words of the magnetometer and its field.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, care, remark};
use crate::words::tables::reading::IF_EXACT;

kinds! {
    /// The magnetic field is off in a static interval.
    FIELD_DISTURBED = "field_disturbed" => Entry {
        reason: "the magnetic field is disturbed in a static interval",
        text: "in {at} the magnetic field is off by {size} from that of the other intervals, as near iron, a magnet or a current. The program does not use the magnetometer's reading of this interval",
        remedies: vec![Remedy::AwayFromIron],
        ..remark(0.5)
    },
    /// The magnetic field differs from place to place.
    FIELD_UNEVEN = "field_uneven" => Entry {
        reason: "the magnetic field differs from place to place",
        text: "the magnetic field differs by {size} per axis between static intervals ({share} of it; the magnetometer's noise makes {noise}), as near iron or currents. The program has enlarged the magnetometer's standard errors to cover that",
        advice: IF_EXACT,
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::AwayFromIron],
        ..care(0.5)
    },
    /// The magnetic field differs a little from place to place.
    FIELD_LITTLE_UNEVEN = "field_little_uneven" => Entry {
        reason: "the magnetic field differs a little from place to place",
        text: "the magnetic field differs by {size} per axis between static intervals ({share} of it; the magnetometer's noise makes {noise}). The magnetometer's standard errors cover that",
        ..remark(0.2)
    },
    /// The magnetometer's bias steps part of the way.
    MAGNETIC_BIAS_STEPPED = "magnetic_bias_stepped" => Entry {
        reason: "the magnetometer's bias steps",
        text: "from static interval {interval} on ({t0}) the magnetometer's bias is another by {size}[, the last of {count} steps], as where the device corrects it by itself or a magnet in it moved. The calibration holds from there on",
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.5)
    },
    /// The magnetic field around the device steps part of the way.
    FIELD_STEPPED = "field_stepped" => Entry {
        reason: "the magnetic field around the device steps",
        text: "from static interval {interval} on ({t0}) the magnetic field around the device is another by {size} at least[, the last of {count} steps], as where a current was switched on or iron was moved. The field of the calibration is that from there on",
        remedies: vec![Remedy::AwayFromIron],
        ..care(0.5)
    },
    /// The magnetometer has an effect that its model lacks.
    MAGNETIC_EFFECT = "magnetic_effect" => Entry {
        reason: "the model of the magnetometer lacks {effect}",
        text: "the readings of the magnetometer depend on {effect}, a source of error that its model lacks. Its standard errors do not cover that",
        advice: "use this calibration if you do not need the magnetometer",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::set(OptionName::Effects)],
        ..care(0.3)
    },
    /// Magnetometer and gyroscope disagree about the heading.
    HEADING_DISAGREES = "heading_disagrees" => Entry {
        reason: "magnetometer and gyroscope disagree about the heading",
        text: "magnetometer and gyroscope disagree about the heading (the horizontal direction) after turns, by more than noise. The program calibrates the gyroscope by its turns alone",
        advice: "use this calibration without its magnetometer",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::AwayFromIron],
        ..care(0.3)
    },
    /// The magnetometer is not calibrated.
    MAGNETOMETER_NOT_CALIBRATED = "magnetometer_not_calibrated" => Entry {
        reason: "the magnetometer is not calibrated",
        text: "the magnetometer is not calibrated: {why}",
        advice: "record again away from iron, with rests on all sides of the device",
        ..care(0.1)
    },
    /// The axes of the magnetometer are turned or mirrored.
    FIELD_TURNED = "field_turned" => Entry {
        reason: "the axes of the magnetometer are turned or mirrored",
        text: "the magnetometer's axes are turned against the accelerometer's ({axes}), and the calibration turns them back. The corrected field then points {angle} {side} the horizontal plane[, which is right only {half} of the magnetic equator]",
        advice: "[use this calibration if you are {half} of the magnetic equator]",
        remedies: vec![Remedy::set(OptionName::Latitude)],
        ..care(30.0)
    },
    /// Signs of the magnetometer's axes are wrong by the latitude.
    FIELD_SIGNS_WRONG = "field_signs_wrong" => Entry {
        reason: "signs of the magnetometer's axes are wrong",
        text: "the magnetic field points {angle} {side} the horizontal plane, which cannot be at a latitude of {latitude}. One or three axes of the magnetometer, or all of the accelerometer, have the wrong sign",
        advice: "correct the latitude if it is wrong; if it is right, compare the signs of both sensors with the data sheet",
        remedies: vec![Remedy::such_as(OptionName::Flip, "mx")],
        ..care(30.0)
    },
    /// The unit of the magnetometer is known on one side only.
    MAGNETOMETER_UNIT_UNCLEAR = "magnetometer_unit_unclear" => Entry {
        reason: "the unit of the magnetometer is not known",
        text: "the unit of the magnetometer is known for this recording or for the calibration, and not for both. The program corrects it as if the units were the same",
        remedies: vec![Remedy::set(OptionName::MagUnit)],
        ..care(0.1)
    },
}
