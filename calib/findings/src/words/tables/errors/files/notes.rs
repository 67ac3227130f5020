//! Words of remarks on calibrations for other tools.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, remark};

kinds! {
    /// The frame of Kalibr is turned against that of the calibration.
    FRAME_TURNED = "frame_turned" => note(
        "Kalibr lays the axes of the sensors otherwise, turned by {angle} against those of the calibration. The program has turned the parameters to Kalibr's axes",
        "",
        vec![],
    ),
    /// A file of Kalibr names no topic.
    TOPIC_TO_ADD = "topic_to_add" => note(
        "Kalibr needs the topic of the IMU (the name of its stream of messages), and the file that was written has none",
        "add a line `rostopic: /imu0` with your topic to the file",
        vec![],
    ),
    /// Noise densities that Kalibr wants are not known.
    DENSITIES_UNKNOWN = "densities_unknown" => note(
        "neither the calibration nor the noise that was given tells {listed}, of which Kalibr wants a number each",
        "write in numbers of the data sheet",
        vec![Remedy::AnalyseNoise],
    ),
    /// A flight controller measures the gyroscope's offsets at every start.
    OFFSETS_MEASURED_AGAIN = "offsets_measured_again" => note(
        "{system} measures the gyroscope's offsets (readings at rest) again at every start, and then those of the file are lost",
        "set {parameter} to 0 if the offsets of the file shall stay",
        vec![],
    ),
    /// A node takes the gyroscope's bias from its first samples.
    BIAS_FROM_START = "bias_from_start" => note(
        "imu_calib takes the gyroscope's bias (its reading at rest) from its first samples (calibrate_gyros)",
        "keep the device still while imu_calib starts",
        vec![],
    ),
    /// A recording may be of readings that a flight controller has corrected.
    MAYBE_CORRECTED = "maybe_corrected" => note(
        "the parameters are for the sensor's own readings. A recording of {stream} holds readings that {system} had corrected before, by its parameters of that time",
        "do nothing if the recording holds the sensor's own readings",
        vec![Remedy::set(OptionName::LoggedWith)],
    ),
    /// PX4 uses parameters of a sensor by its id.
    SENSORS_BY_IDS = "sensors_by_ids" => note(
        "PX4 uses these parameters only where {ids} are the ids of the vehicle's own sensors",
        "let PX4 calibrate once, then load these parameters",
        vec![],
    ),
    /// Parameters are on top of an earlier correction.
    ON_TOP_OF = "on_top_of" => note(
        "{system} had corrected the readings of the {sensors} before: these parameters are on top of that correction",
        "use them on readings that are corrected in the same way, not on those of the sensor, and calibrate again when that correction changes",
        vec![],
    ),
    /// The functions of a module leave a part out.
    NOT_APPLIED = "not_applied" => note(
        "the functions that were written do not correct {what}[: an error of up to {size} at {signal} remains]. Its numbers are in the file beside them",
        "nothing has to be done if that is small enough for you; else correct it in your own code by these numbers",
        vec![],
    ),
    /// A target does not hold a part of a calibration.
    LOST_IN_EXPORT = "lost_in_export" => note(
        "the export leaves out {what}[: an error of up to {size} at {signal} remains]",
        "nothing has to be done if that is small enough for you; else correct recordings by the calibration itself (the command apply)",
        vec![],
    ),
}

/// A remark that no verdict counts.
fn note(text: &'static str, advice: &'static str, remedies: Vec<Remedy>) -> Entry {
    Entry {
        text,
        advice,
        remedies,
        ..remark(0.0)
    }
}
