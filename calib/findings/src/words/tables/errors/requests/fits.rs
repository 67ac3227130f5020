//! Words of fits that come to no end, and of magnetometers that no attitude determines.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(Kind::Cancelled, "cancelled", "", Vec::new),
    Entry::error(Kind::SolverRefused, "{reason}", "", Vec::new),
    Entry::error(
        Kind::FitStopped,
        "the {sensor}'s fit stopped after {steps} steps ({ending})[ and leaves {left} of the norms]",
        "[check that the gravity of {gravity} is right and that the device was still in its static intervals]",
        Vec::new,
    ),
    Entry::error(
        Kind::NothingToCalibrate,
        "nothing to calibrate in the recording",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::AxesSame,
        "six positions: I + M has no inverse",
        "check that no two axes are the same",
        Vec::new,
    ),
    Entry::error(
        Kind::MagnetometerAlone,
        "a magnetometer alone: its offset and axes are found against gravity, which only the accelerometer sees",
        "record the accelerometer, and best the gyroscope, of the same device beside it, at rest in twelve attitudes or more",
        Vec::new,
    ),
    Entry::error(
        Kind::AttitudeNotSeen,
        "without an accelerometer nobody knows how the device was held",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::FieldUnitsDiffer,
        "its magnetometer is in {unit}, that of {other} in {others}",
        "name the columns' unit in both files alike",
        Vec::new,
    ),
    Entry::error(
        Kind::AttitudesLeaveOpen,
        "the attitudes do not determine the magnetometer[ ({open})][: its fit did not end ({ending})]",
        "hold every face up and turn the device to other headings in between",
        Vec::new,
    ),
    Entry::error(
        Kind::AttitudesTooFew,
        "{count:static interval} with readings of the magnetometer: too few[, {least} at least are needed]",
        "record more attitudes",
        Vec::new,
    ),
];
