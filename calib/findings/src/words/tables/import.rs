//! Words of what an imported calibration lacks.

use crate::kind::Kind;
use crate::remedy::Remedy;

use crate::words::entry::{Entry, care, remark};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ErrorsNotStated => Entry {
            reason: "the imported calibration gives no uncertainties",
            text: "the calibration is imported from {tool} and gives no uncertainties",
            ..remark(0.001)
        },
        Kind::BiasNotStated => Entry {
            reason: "the imported calibration has no bias",
            text: "the calibration is imported from {tool}: its {sensors} have no bias (reading at rest). The program \
               takes the bias as 0",
            remedies: vec![Remedy::UpdateBias],
            ..care(1.0)
        },
        Kind::BiasUnknown => Entry {
            reason: "the bias of the {sensors} is not known",
            text: "the bias (the reading at rest) of the {sensors} is not known: the file corrects by none, or leaves its entries out",
            remedies: vec![Remedy::UpdateBias],
            ..remark(0.05)
        },
        Kind::FirstImuTaken => Entry {
            reason: "of several units the first was read",
            text: "the file holds several devices: of {units} the program reads the first",
            ..remark(0.001)
        },
        Kind::EntryUnknown => Entry {
            reason: "an entry of the file is not known",
            text: "{entry} is not read, because {tool} has no such entry",
            ..remark(0.001)
        },
        Kind::PlacesNotRead => Entry {
            reason: "the positions of the accelerometer's axes are not read",
            text: "the program does not read where the axes of the accelerometer lie in the device ({entries}). This \
               matters only while the device turns",
            ..remark(0.001)
        },
        _ => return None,
    })
}
