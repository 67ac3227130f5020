//! Words of calibrations that seem to be of another device, and of what was corrected before.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::doubt(
        Kind::RateAtRestOff,
        "corrected by this calibration the rate at rest is {rate}, where it should be zero. The calibration may be of another device, or for another unit of the gyroscope",
        "",
        || vec![Remedy::UpdateBias],
    ),
    Entry::doubt(
        Kind::DirectionOff,
        "after {count:turn} the corrected gyroscope misses the direction of gravity by {rms} (rms)[, and in the calibration's own recordings by {usual}]. The calibration may be of another device, or for another unit, sign or order of the axes",
        "check the units and columns of the recording",
        || vec![Remedy::OwnCalibration],
    ),
    Entry::doubt(
        Kind::NormOff,
        "at rest the corrected reading of the accelerometer differs from gravity by {rms} (rms)[, and in the calibration's own recordings by {usual}]. The calibration may be of another device",
        "",
        || vec![Remedy::OwnCalibration],
    ),
    Entry::doubt(
        Kind::CorrectedOtherwise,
        "{by} had corrected the readings of the {sensor} in this recording before, and {own} those behind the calibration. So the calibration does not hold for this recording",
        "use it on readings that were corrected in the same way, or calibrate from such as these",
        Vec::new,
    ),
    Entry::doubt(
        Kind::CorrectedInPart,
        "{by} had corrected the readings of the {sensor} before, and not those of {others}: one calibration does not hold for both",
        "calibrate these recordings apart",
        Vec::new,
    ),
    Entry::doubt(
        Kind::NumbersEdited,
        "the calibration was edited since it was written: gravity, a sensor or an effect is not what was found (its numbers_sha256 differs)",
        "calibrate again if you did not edit it",
        Vec::new,
    ),
    Entry::doubt(
        Kind::BasisEdited,
        "the calibration was edited since it was written: method, covariance, limits, inputs or another entry beside the parameters is not what was written (its basis_sha256 differs)",
        "calibrate again if you did not edit it",
        Vec::new,
    ),
    Entry::doubt(
        Kind::EffectOfRecordings,
        "the calibration corrects {effect} ({parameter} = {value}), an error that only the recordings had from which it was made, and the file does not say which they were",
        "correct no other recording with it, or calibrate again without {effect}",
        Vec::new,
    ),
    Entry::doubt(
        Kind::OnlyRestAnalysed,
        "the device moved during the recording. The program analyses only the longest rest, {at}",
        "leave the device alone for the whole recording next time",
        || vec![Remedy::such_as(OptionName::Rest, "60,3600")],
    ),
];
