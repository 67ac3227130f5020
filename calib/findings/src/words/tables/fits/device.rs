//! Words of devices, their recordings and what is known of them.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, UseOfResult, bad, care, remark};

kinds! {
    /// The rotation of the earth speaks against the given latitude.
    LATITUDE_DOUBTFUL = "latitude_doubtful" => Entry {
        reason: "the recording speaks against the latitude",
        text: "the earth's rotation has a vertical part of {expected} at a latitude of {given}. The recording shows {shown} ± {error}, as at a latitude of {seen}, and speaks against the given latitude. {what} may be wrong[. The model was fitted at the latitude that the recording shows, because it explains as much as {instead}]",
        advice: "check the sign and the value of the latitude, and that the accelerometer reads +g on an axis that points up",
        remedies: vec![Remedy::Omit {
            option: OptionName::Latitude,
        }],
        ..care(0.04)
    },
    /// The recording system has taken the bias off.
    BIAS_REMOVED_BEFORE = "bias_removed_before" => Entry {
        reason: "the gyroscope reads no bias, as where software subtracts it",
        text: "the gyroscope reads zero at rest on all axes to within its noise. Few devices do: most likely the phone's or logger's software subtracts the bias (the reading at rest). This calibration holds only while that software subtracts the same",
        remedies: vec![Remedy::Uncalibrated],
        ..care(0.02)
    },
    /// A recording repeats another.
    SAME_DATA = "same_data" => Entry {
        reason: "a recording is given twice",
        text: "this recording has the same data as {other}. The two are counted once",
        ..remark(0.0001)
    },
    /// A sensor differs from recording to recording.
    RECORDINGS_DIFFER = "recordings_differ" => Entry {
        reason: "the {sensor} differs between {first} and {second}",
        text: "{parameter} differs by {change} ± {error} between {first} and {second}[, at {celsius}]. Perhaps the temperature or the clock changed, or the data are of two devices[. The standard errors include {included} of the difference]",
        advice: "calibrate each recording alone if its temperature, its clock or its device was another",
        ..care(0.05)
    },
    /// A sensor differs from one part of a recording to another.
    PARTS_DIFFER = "parts_differ" => Entry {
        reason: "the {sensor} changes within the recording",
        text: "{parameter} differs by {change} ± {error} between the parts of the recording. Perhaps the temperature or the clock changed, or the rows are of two devices. The standard errors include half of the difference",
        advice: "calibrate each part alone if its temperature, its clock or its device was another",
        ..care(0.05)
    },
    /// There is no gyroscope.
    NO_GYROSCOPE = "no_gyroscope" => Entry {
        reason: "there is no gyroscope",
        text: "the recording has no gyroscope: only the accelerometer is calibrated",
        ..remark(0.0001)
    },
    /// There is no accelerometer.
    NO_ACCELEROMETER = "no_accelerometer" => Entry {
        reason: "without an accelerometer only the gyroscope's bias is found",
        text: "the recording has no accelerometer: only the gyroscope's bias (its reading at rest) is found",
        ..care(0.1)
    },
    /// A recording lacks a sensor.
    SENSOR_MISSING = "sensor_missing" => Entry {
        reason: "a recording lacks a sensor",
        text: "the recording lacks the accelerometer or the gyroscope. The program does not calibrate the gyroscope by this recording",
        ..remark(0.001)
    },
    /// The device is not of the type of the prior.
    NOT_OF_TYPE = "not_of_type" => Entry {
        reason: "the device does not look like one of the prior's type",
        text: "the device does not look like its type (the typical values given as a prior): {parameter} lies {distance} standard deviations from the type's mean (by chance with probability {p}). The prior is not used",
        advice: "use this calibration, which was made without the prior; if the device is of another type, give the prior of that type",
        use_of_result: UseOfResult::Conditional,
        ..care(0.1)
    },
    /// The biases of the recordings of a calibration differ.
    BIASES_DIFFER = "biases_differ" => Entry {
        reason: "the biases of the calibration's recordings differ",
        text: "the biases (readings at rest) of the calibration's recordings differ ({how}), and this recording is none of them. The program subtracts the biases of the last one, {last}",
        remedies: vec![Remedy::UpdateBias],
        ..care(0.05)
    },
    /// An effect of the user gives no number.
    EFFECT_FAULT = "effect_fault" => Entry {
        reason: "the effect {effect} gives no number",
        text: "the effect {effect} (a source of error that you defined) could not be computed. The search left it out from then on",
        advice: "correct its formula",
        ..care(0.05)
    },
    /// A sensor that the limits require is not calibrated.
    REQUIRED_MISSING = "required_missing" => Entry {
        reason: "the limits require the {sensor}, which is not calibrated",
        text: "the limits require the {sensor}, and it is not calibrated",
        advice: "do not use this calibration where this limit has to hold",
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..bad(5.0)
    },
    /// A limit is not kept.
    LIMIT_NOT_KEPT = "limit_not_kept" => Entry {
        reason: "{name} is {value}, and {allowed} is allowed",
        text: "{name} is {value}. Its limit allows {allowed}",
        advice: "do not use this calibration where this limit has to hold",
        use_of_result: UseOfResult::Forbidden,
        remedies: vec![Remedy::RecordAgain],
        ..bad(5.0)
    },
    /// A sensor is not calibrated.
    NOT_CALIBRATED = "not_calibrated" => Entry {
        reason: "the {sensor} is not calibrated",
        text: "the {sensor} is not calibrated: {why}[. The program keeps its bias {kept}]",
        remedies: vec![
            Remedy::RecordAgain,
            Remedy::set_to(OptionName::Sensor, "accelerometer"),
        ],
        ..bad(20.0)
    },
    /// A time constant was supposed and not fitted.
    TIME_CONSTANT_SUPPOSED = "time_constant_supposed" => Entry {
        reason: "a time constant was supposed",
        text: "the {parameter} of the error {effect} is supposed to be {value}, because these recordings do not show it. The other parameters of that error depend on it, so the program gives no standard errors",
        ..remark(0.01)
    },
    /// The temperature changes, and the model has no effect of it.
    TEMPERATURE_CHANGED = "temperature_changed" => Entry {
        reason: "the temperature changed from {low} to {high}, which the model leaves out",
        text: "the temperature changed from {low} to {high} while the device was at rest, and the model has no effect of the temperature. Scale factors and biases are means over that range, and the standard errors do not cover how they change within it",
        remedies: vec![Remedy::Discover],
        ..care(0.5)
    },
    /// Some recordings have no temperature.
    TEMPERATURE_UNKNOWN = "temperature_unknown" => Entry {
        reason: "some recordings have no temperature",
        text: "the recordings without a temperature ({without}) keep the program from looking for effects of the temperature",
        remedies: vec![Remedy::Thermometer],
        ..remark(0.01)
    },
    /// A sensor that is not calibrated is left as it was read.
    LEFT_AS_READ = "left_as_read" => Entry {
        reason: "the {sensor} is not calibrated",
        text: "the {sensor} is not calibrated[ ({why})]. The program leaves its readings as they are",
        ..remark(0.1)
    },
    /// An axis reads nothing but noise while the others turn.
    AXIS_ONLY_NOISE = "axis_only_noise" => Entry {
        reason: "the {axis} axis of the {sensor} reads nothing but noise",
        text: "the {axis} axis of the {sensor} reads nothing but noise while other axes turn: it is dead, or its column is another, or the device was not turned about it",
        advice: "check that column in the file and the sensor",
        remedies: vec![Remedy::RecordAgain],
        ..bad(90.0)
    },
    /// The bias of a sensor moved during the recording.
    BIAS_MOVED = "bias_moved" => Entry {
        reason: "the bias of the {sensor} moved by {change} during the recording[, {like}]",
        text: "the bias (the reading at rest) of the {sensor} moved by {change} from the first static interval to the last, more than it walks by. The calibration states its mean over that time, and its errors count the motion",
        advice: "let the device warm up before you record",
        remedies: vec![Remedy::Discover],
        ..care(0.1)
    },
    /// The bias of a sensor wandered during the recording.
    BIAS_WANDERED = "bias_wandered" => Entry {
        reason: "the readings of the {sensor} at rest wandered by {size}",
        text: "the readings of the {sensor} at rest lay {size} (rms) off their mean, as where its bias walks or steps or the device was not quite still. The calibration states the mean bias, and its errors count that motion",
        advice: "let the device warm up, and lay it down in every placement",
        remedies: vec![Remedy::Discover],
        ..care(0.1)
    },
    /// The bias wanders by less than a corrected reading shows.
    BIAS_UNSTEADY = "bias_unsteady" => Entry {
        reason: "the bias of the {sensor} wanders a little",
        text: "the bias (the reading at rest) of the {sensor} lies {size} (rms) off its mean in the course of the recording. The errors of the bias count that",
        ..remark(0.05)
    },
    /// Static intervals in a part of the recording fit another accelerometer.
    OF_ANOTHER_ACCELEROMETER = "of_another_accelerometer" => Entry {
        reason: "a part of the recording is of another accelerometer",
        text: "{intervals:static interval} at {at} fit another accelerometer than the {used} that the program uses: with that one their gravity is off by {missed} (rms), with one of their own by {own}. Perhaps the file holds two devices, or a range or filter of the sensor was switched",
        remedies: vec![Remedy::Split],
        ..care(1.0)
    },
    /// A recording that the fit did not see disagrees with the calibration, whatever its biases are.
    VALIDATION_DISAGREES = "validation_disagrees" => Entry {
        reason: "the calibration does not hold for the validation recording",
        text: "the calibration misses this recording by {missed} times what the noise and the errors of the calibration explain, whatever its biases are ({channel}; {own} times in the recordings of the fit). Perhaps it is of another device, or the device has changed: temperature, a shock, another range",
        advice: "do not use the calibration for this recording",
        use_of_result: UseOfResult::Forbidden,
        ..care(1.0)
    },
    /// A sensor of one dimension that is not calibrated is left as it was read.
    SCALAR_LEFT_AS_READ = "scalar_left_as_read" => Entry {
        reason: "the {name} is not calibrated",
        text: "the calibration or this program does not know the {name}. Its readings stay as they are",
        ..remark(0.1)
    },
    /// Only the bias of a sensor is known.
    BIAS_ALONE = "bias_alone" => Entry {
        reason: "only the bias of the {sensor} is known",
        text: "only the bias (the reading at rest) of the {sensor} is known. Its scale factors and misalignments are taken as those of a perfect sensor",
        ..remark(0.1)
    },
    /// The calibration is for readings of which axes were flipped.
    FOR_FLIPPED_AXES = "for_flipped_axes" => Entry {
        reason: "the calibration is for readings with flipped axes",
        text: "the recording was read with {axes} flipped, and the calibration is for readings with that sign. What reads the sensor has to flip {axes} too",
        advice: "look up how the target reads this sensor",
        ..care(0.5)
    },
}
