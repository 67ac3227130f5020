//! Words of what an imported calibration lacks.

use crate::remedy::Remedy;

use crate::words::entry::{Entry, care, remark};

kinds! {
    /// The file states no errors of its parameters.
    ERRORS_NOT_STATED = "errors_not_stated" => Entry {
        reason: "the imported calibration gives no uncertainties",
        text: "the calibration is imported from {tool} and gives no uncertainties",
        ..remark(0.001)
    },
    /// The file states no biases.
    BIAS_NOT_STATED = "bias_not_stated" => Entry {
        reason: "the imported calibration has no bias",
        text: "the calibration is imported from {tool}: its {sensors} have no bias (reading at rest). The program \
           takes the bias as 0",
        remedies: vec![Remedy::UpdateBias],
        ..care(1.0)
    },
    /// An exported calibration has no bias of a sensor.
    BIAS_UNKNOWN = "bias_unknown" => Entry {
        reason: "the bias of the {sensors} is not known",
        text: "the bias (the reading at rest) of the {sensors} is not known: the file corrects by none, or leaves its entries out",
        remedies: vec![Remedy::UpdateBias],
        ..remark(0.05)
    },
    /// Only the first of several IMUs in the file was read.
    FIRST_IMU_TAKEN = "first_imu_taken" => Entry {
        reason: "of several units the first was read",
        text: "the file holds several devices: of {units} the program reads the first",
        ..remark(0.001)
    },
    /// An entry of the file is not known.
    ENTRY_UNKNOWN = "entry_unknown" => Entry {
        reason: "an entry of the file is not known",
        text: "{entry} is not read, because {tool} has no such entry",
        ..remark(0.001)
    },
    /// The places of the accelerometer's axes are not read.
    PLACES_NOT_READ = "places_not_read" => Entry {
        reason: "the positions of the accelerometer's axes are not read",
        text: "the program does not read where the axes of the accelerometer lie in the device ({entries}). This \
           matters only while the device turns",
        ..remark(0.001)
    },
}
