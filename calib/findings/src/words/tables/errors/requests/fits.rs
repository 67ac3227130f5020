//! Words of fits that come to no end, and of magnetometers that no attitude determines.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::Cancelled,
        "the work was cancelled before it had a result",
        "run it again",
        Vec::new,
    ),
    Entry::error(
        Kind::SolverRefused,
        "no calibration fits this recording: its numbers are too large, too small or not those of a sensor",
        "check the units and the columns of the recording",
        Vec::new,
    ),
    Entry::error(
        Kind::FitStopped,
        "the fit of the {sensor} came to no end in {steps:step}[: its readings at rest still differ from gravity by {left}]",
        "[give the right gravity if {gravity} is not that of your place; else ]record again and keep the device still in every placement",
        Vec::new,
    ),
    Entry::error(
        Kind::FitStoppedByTurns,
        "the fit came to no end: the turns of the gyroscope do not lead to the directions that the accelerometer reads, which by itself can be calibrated. Perhaps the rates are filtered or not raw, or their axes are exchanged",
        "compare the rates with the description of the app or the data sheet, and record raw ones",
        || vec![Remedy::set_to(OptionName::Sensor, "accelerometer")],
    ),
    Entry::error(
        Kind::NothingToCalibrate,
        "the recording has nothing to calibrate: no placements of an accelerometer and no rests of a gyroscope",
        "record an accelerometer and a gyroscope, with the device at rest in at least ten placements",
        Vec::new,
    ),
    Entry::error(
        Kind::AxesSame,
        "the six placements do not determine three different axes of the sensor: two of its axes look the same",
        "check that no column is given twice and that each axis was once up and once down",
        Vec::new,
    ),
    Entry::error(
        Kind::MagnetometerAlone,
        "the recording has a magnetometer alone: its offset and axes are found against gravity, which only the accelerometer sees",
        "record the accelerometer, and best the gyroscope, of the same device beside it, at rest in twelve orientations or more",
        Vec::new,
    ),
    Entry::error(
        Kind::AttitudeNotSeen,
        "without an accelerometer the program cannot know how the device was held",
        "record the accelerometer too",
        Vec::new,
    ),
    Entry::error(
        Kind::FieldUnitsDiffer,
        "the magnetometer of this recording is in {unit}, that of {other} in {others}",
        "convert one of them, so that both files have one unit and say so",
        Vec::new,
    ),
    Entry::error(
        Kind::AttitudesLeaveOpen,
        "the orientations of the device do not determine the magnetometer's axes and offset[ ({open})][: its fit did not end ({ending})]",
        "record again with each of the six faces up once, and point the device to another heading (compass direction) each time",
        Vec::new,
    ),
    Entry::error(
        Kind::AttitudesTooFew,
        "{count:static interval} with readings of the magnetometer are too few[: {least} at least are needed]",
        "record at rest in more orientations",
        Vec::new,
    ),
];
