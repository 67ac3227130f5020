//! Words of remarks on calibrations for other tools.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, remark};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::FrameTurned => note(
            "Kalibr lays the axes of the sensors otherwise, turned by {angle} against those of the calibration. The program has turned the parameters to Kalibr's axes",
            "",
            vec![],
        ),
        Kind::TopicToAdd => note(
            "Kalibr needs the topic of the IMU (the name of its stream of messages), and the file that was written has none",
            "add a line `rostopic: /imu0` with your topic to the file",
            vec![],
        ),
        Kind::DensitiesUnknown => note(
            "neither the calibration nor the noise that was given tells {listed}, of which Kalibr wants a number each",
            "write in numbers of the data sheet",
            vec![Remedy::AnalyseNoise],
        ),
        Kind::OffsetsMeasuredAgain => note(
            "{system} measures the gyroscope's offsets (readings at rest) again at every start, and then those of the file are lost",
            "set {parameter} to 0 if the offsets of the file shall stay",
            vec![],
        ),
        Kind::BiasFromStart => note(
            "imu_calib takes the gyroscope's bias (its reading at rest) from its first samples (calibrate_gyros)",
            "keep the device still while imu_calib starts",
            vec![],
        ),
        Kind::MaybeCorrected => note(
            "the parameters are for the sensor's own readings. A recording of {stream} holds readings that {system} had corrected before, by its parameters of that time",
            "do nothing if the recording holds the sensor's own readings",
            vec![Remedy::set(OptionName::LoggedWith)],
        ),
        Kind::SensorsByIds => note(
            "PX4 uses these parameters only where {ids} are the ids of the vehicle's own sensors",
            "let PX4 calibrate once, then load these parameters",
            vec![],
        ),
        Kind::OnTopOf => note(
            "{system} had corrected the readings of the {sensors} before: these parameters are on top of that correction",
            "use them on readings that are corrected in the same way, not on those of the sensor, and calibrate again when that correction changes",
            vec![],
        ),
        Kind::NotApplied => note(
            "the functions that were written do not correct {what}[: an error of up to {size} at {signal} remains]. Its numbers are in the file beside them",
            "nothing has to be done if that is small enough for you; else correct it in your own code by these numbers",
            vec![],
        ),
        Kind::LostInExport => note(
            "the export leaves out {what}[: an error of up to {size} at {signal} remains]",
            "nothing has to be done if that is small enough for you; else correct recordings by the calibration itself (the command apply)",
            vec![],
        ),
        _ => return None,
    })
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
