//! Words of calibrations that seem to be of another device, and of what was corrected before.

use crate::kind::Kind;
use crate::remedy::Remedy;
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
        "corrected by this calibration the gyroscope misses gravity by {rms} through {count:turn}[; it left {usual} of its own recordings]. The calibration may be of another device, or for another unit, sign or order of the axes",
        "",
        || vec![Remedy::OwnCalibration],
    ),
    Entry::doubt(
        Kind::NormOff,
        "corrected by this calibration the specific force at rest differs from gravity by {rms} rms[; it left {usual} of its own recordings]. The calibration may be of another device",
        "",
        || vec![Remedy::OwnCalibration],
    ),
    Entry::doubt(
        Kind::CorrectedOtherwise,
        "{by} had corrected the readings of the {sensor} before, and {own} those that the calibration is of: the calibration does not hold for them",
        "use the calibration on readings of one kind",
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
        "the calibration does not say which recordings it is from, and its effect {effect} holds in those only ({parameter} = {value})",
        "use it on those recordings only, or calibrate without the effect",
        Vec::new,
    ),
    Entry::doubt(
        Kind::OnlyRestAnalysed,
        "the device moved, and the program analyses only the longest static interval, {at}",
        "",
        Vec::new,
    ),
];
