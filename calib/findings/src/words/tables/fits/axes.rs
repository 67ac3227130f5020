//! Words of units, ranges and axes that the fit shows.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, bad, care, remark};

kinds! {
    /// One axis reads in another unit or range.
    AXIS_UNIT = "axis_unit" => Entry {
        reason: "{axis} of the {sensor} has another unit or range",
        text: "{axis} of the {sensor} reads {times} what {others} read of the same {what}. This axis has another unit, or is set to another range",
        remedies: vec![Remedy::such_as(OptionName::Columns, "az=az*0.5")],
        ..bad(30.0)
    },
    /// An axis reads more or less than the others of its sensor, by a factor that no unit or range explains.
    AXIS_APART = "axis_apart" => Entry {
        reason: "{axis} of the {sensor} reads {times} what {others} read",
        text: "{axis} of the {sensor} reads {times} what {others} read of the same {what}. Sensors seldom differ so much from axis to axis, and no unit or range explains it. The calibration corrects it",
        advice: "use this calibration if the sensor itself is that unusual; if the file was changed, correct the column",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::such_as(OptionName::Columns, "az=az*0.91")],
        ..care(1.0)
    },
    /// Raw counts per unit differ from axis to axis.
    COUNTS_DIFFER = "counts_differ" => Entry {
        reason: "the axes of the {sensor} differ in their range",
        text: "the axes of the {sensor} read {x}, {y} and {z} raw whole numbers (counts) per m/s². These differ by {share}: the axes may have different ranges. The calibration converts each axis by its own number",
        advice: "use this calibration for readings with the same ranges; if all axes should have one range, set it and record again",
        use_of_result: UseOfResult::Conditional,
        ..care(1.0)
    },
    /// All axes read too much or too little.
    SCALE_OFF = "scale_off" => Entry {
        reason: "the {sensor} reads gravity {share} {more} than it is, on all axes",
        text: "the {sensor} reads gravity as {reads}, {share} {more} than {gravity}, on all axes alike[: {beyond} has another unit or range, or the local gravity is another][. The calibration corrects {carried}]",
        advice: "correct what is wrong of unit, range and local gravity[; if nothing is wrong, use this calibration, for it corrects {carried}]",
        remedies: vec![Remedy::any_of([OptionName::AccelUnit, OptionName::Gravity])],
        ..care(3.0)
    },
    /// The zero of an axis lies where no sensor has it.
    ZERO_OFF = "zero_off" => Entry {
        reason: "{axis} reads {bias} where it should read zero",
        text: "{axis} of the {sensor} reads {bias} where it should read zero, as no sensor does[: gravity was subtracted from {without}][: gravity was added to {with}][: a constant was added to {moved}]",
        remedies: vec![Remedy::such_as(OptionName::Columns, "az=az+9.80665")],
        ..bad(30.0)
    },
    /// Readings look like units of g.
    READINGS_IN_G = "readings_in_g" => Entry {
        reason: "the readings look like units of g",
        text: "the readings of the accelerometer look like units of g (9.8 m/s²). The calibration converts them to m/s²",
        advice: "use this calibration for readings in the same unit",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::set_to(OptionName::AccelUnit, "g")],
        ..care(0.001)
    },
    /// Readings are raw counts.
    RAW_COUNTS = "raw_counts" => Entry {
        reason: "the readings are raw counts",
        text: "the readings of the {sensor} are raw counts, or in a unit that the program does not know: one is about {scale}[, and zero lies near {zero}]. The calibration converts them",
        ..remark(0.0001)
    },
    /// The gyroscope misses gravity after the fit.
    GRAVITY_MISSED = "gravity_missed" => Entry {
        reason: "the gyroscope misses gravity by {missed} after the fit",
        text: "the gyroscope misses gravity by {missed} rms after the fit: its turns do not lead to the directions that the accelerometer reads. Perhaps axes are exchanged, a sign or the time stamps are wrong",
        advice: "do not use this calibration; compare columns, signs and time stamps with the description of the app or the data sheet, correct what differs, and record again if nothing does",
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::LookInto],
        ..bad(10.0)
    },
    /// The turns do not show the axes of the gyroscope.
    AXES_NOT_SHOWN = "axes_not_shown" => Entry {
        reason: "the turns do not show the gyroscope's axes",
        text: "no sensor can have the matrix that the fit found for the gyroscope (its determinant is negative and no axis is flipped). The turns do not show the gyroscope's axes",
        advice: "record again, and between the placements turn the device about each of its three axes by a quarter turn or more",
        ..bad(10.0)
    },
    /// The axes of the gyroscope are left-handed.
    LEFT_HANDED = "left_handed" => Entry {
        reason: "the gyroscope's axes are left-handed (mirrored)",
        text: "the gyroscope's axes are mirrored (left-handed) against the accelerometer's: {axes}. Probably an axis has the wrong sign, or two columns are exchanged",
        remedies: vec![Remedy::such_as(OptionName::Flip, "gz")],
        ..bad(30.0)
    },
    /// The axes of the gyroscope are turned against the accelerometer.
    AXES_TURNED = "axes_turned" => Entry {
        reason: "the axes of the gyroscope and the accelerometer do not agree",
        text: "the gyroscope's axes are turned against the accelerometer's[: {axes}][, by an angle that is no {angle}]. The calibration turns them back[. If both sensors are mounted alike, as in nearly every device, the {other} is mirrored (left-handed) instead: a sign of it is wrong or two of its columns are exchanged]",
        advice: "[use this calibration if the data sheet draws the axes of the gyroscope and the {other} turned so; if it draws them alike, correct the {other}]",
        ..care(1.0)
    },
    /// The scale of the gyroscope is off on all axes.
    GYROSCOPE_SCALE_OFF = "gyroscope_scale_off" => Entry {
        reason: "the gyroscope's scale factor is {ratio} on all axes",
        text: "the gyroscope's scale factor is {ratio} on all axes, too far from 1 for a sensor: its unit or its sampling rate is wrong",
        advice: "compare the length of the recording with its true duration: if they differ, the rate is wrong, and if not, the unit or the range",
        remedies: vec![Remedy::any_of([OptionName::Rate, OptionName::GyroUnit])],
        ..bad(30.0)
    },
    /// The gyroscope's scale is that of stamps which count 1/1024 s.
    CLOCK_OF_TICKS = "clock_of_ticks" => Entry {
        reason: "the time stamps may count 1/1024 s",
        text: "[the gyroscope's scale factor is {ratio} on all axes, as if the time stamps counted 1/1024 s instead of ms. ]The file does not state the unit of the time stamps[. The rate is {rate} if they count 1/1024 s, and it is no usual one if they count ms]",
        advice: "compare the length of the recording with its true duration: if it is too long by 2.4 %, the stamps count 1/1024 s",
        ..care(2.3)
    },
    /// The unit of the gyroscope looks like another one.
    READINGS_IN_DEGREES = "readings_in_degrees" => Entry {
        reason: "the gyroscope's unit looks like {unit}",
        text: "the readings of the gyroscope look like {unit}[ that were read as {read}]. The calibration converts them to rad/s",
        advice: "use this calibration for readings in the same unit",
        use_of_result: UseOfResult::Conditional,
        remedies: vec![Remedy::set_to(OptionName::GyroUnit, "deg/s")],
        ..care(0.001)
    },
}
