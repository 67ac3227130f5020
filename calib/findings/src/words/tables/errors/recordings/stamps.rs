//! Words of stamps that tell no time.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::NoTime => error_by(
            "the table has no column with the time of each row[; {likely} may be one][. The lines above it state a rate of {said}]",
            vec![Remedy::examples([
                (OptionName::Rate, "100"),
                (OptionName::Columns, "t=1"),
            ])],
        ),
        Kind::RowsWithoutTime => error_by(
            "the rows of this file have no time stamps. The program that wrote it takes {rate} unless it was changed",
            vec![Remedy::such_as(OptionName::Rate, "100")],
        ),
        Kind::ExpressionOfDates => error(
            "an expression for the time takes numbers, and the column holds dates or times of day",
            "give the column without the expression",
        ),
        Kind::ExpressionBackwards => error(
            "the expression for the time has a factor of {factor}, which lets time stand still or run back; a positive one expected",
            "correct the expression",
        ),
        Kind::ExpressionUnit => error_with(
            "the expression for the time gives {unit}, in which the rate would be {rate} Hz",
            "correct the factor",
            vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
        ),
        Kind::TimeUnitStated => error_by(
            "the file states {unit} for the time stamps. In this unit the sampling rate would be {rate} Hz, as no sensor has",
            vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
        ),
        Kind::TimeUnitOpen => error_by(
            "the program cannot tell the unit of the time stamps[: it does not know the one in `{column}`][. Their usual step of {step} makes a usual rate in no common unit, so look up what they count]",
            vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
        ),
        Kind::TimeUnitTooFast => error_with(
            "the file does not state the unit of the time stamps. By their steps it would be {unit}, but then the device was turned at {speed} from rest to rest, faster than a hand turns it",
            "look up what the stamps count",
            vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
        ),
        Kind::StampsByOne => error_by(
            "the time stamps go up by 1 from row to row, as if they counted the rows",
            vec![Remedy::examples([
                (OptionName::Rate, "100"),
                (OptionName::TimeUnit, "ms"),
            ])],
        ),
        Kind::StampsAllEqual => error_by(
            "every time stamp is the same",
            vec![Remedy::set(OptionName::Rate)],
        ),
        Kind::StampsTooCoarse => error_by(
            "{merged} of {all} rows share their stamp with another: stamps are too coarse to tell the rows apart in time",
            vec![Remedy::set(OptionName::Rate)],
        ),
        Kind::StampsTooLarge => error(
            "the time stamps are too large to tell apart in seconds",
            "subtract the first stamp from all",
        ),
        Kind::TimeGoesBack => error_by(
            "time goes back from {from} to {to}[ at record {record}][ (counted from {origin})]. If the stamps pass {from} again within a few rows, the rows are out of order; if not, the clock began again",
            vec![Remedy::set(OptionName::SortTime), Remedy::Split],
        ),
        Kind::ClocksRestartApart => error(
            "the time stamps of one sensor begin again more often than those of the other ({most:recording} in all). So the program cannot tell what belongs together",
            "split both files where the stamps begin again, and calibrate the pairs that belong together",
        ),
        Kind::PartOpen => error_by(
            "[there is no part {part}: ]the clock begins again, from {from} to {to}: {count} recordings in one file, of {rows} rows",
            vec![Remedy::such_as(OptionName::Part, "1")],
        ),
        Kind::PartMissing => error_by(
            "recording {part} of the file is asked for, and the file holds one only",
            vec![Remedy::Omit {
                option: OptionName::Part,
            }],
        ),
        Kind::NeverOverlap => error(
            "the accelerometer was on from {accel_from} to {accel_to} s, the gyroscope from {gyro_from} to {gyro_to} s: they never overlap; are both stamps of one clock, in one unit?",
            "export both sensors by one clock, in one unit",
        ),
        Kind::SumOfOtherStamps => error(
            "gravity and the acceleration without gravity have different time stamps. So the program cannot add them to what the sensor reads",
            "record the accelerometer with gravity[, as {streams}]",
        ),
        Kind::RateImpossible => error_by(
            "the sampling rate of {rate} is not within 0.001 to 1e7 Hz",
            vec![Remedy::such_as(OptionName::Rate, "100")],
        ),
        _ => return None,
    })
}
