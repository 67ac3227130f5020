//! Words of stamps that tell no time.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::NoTime,
        "no time column[; {likely} may be one]",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::RowsWithoutTime,
        "its rows have no time: its program has {rate} unless it was changed",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionOfDates,
        "an expression for the time takes numbers, and the column holds dates or times of day",
        "leave the expression out",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionBackwards,
        "the expression for the time has a factor of {factor}, which lets time stand still or run back; a positive one expected",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionUnit,
        "the expression for the time gives {unit}, in which the rate would be {rate} Hz",
        "correct the factor",
        || vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
    ),
    Entry::error(
        Kind::TimeUnitStated,
        "the file states {unit} for the time, in which the rate would be {rate} Hz",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TimeUnitOpen,
        "the usual step between stamps is {step}, which is of no known unit",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::StampsByOne,
        "stamps go up by 1 from row to row: do they count the rows?",
        "",
        || {
            vec![Remedy::examples([
                (OptionName::Rate, "100"),
                (OptionName::TimeUnit, "ms"),
            ])]
        },
    ),
    Entry::error(
        Kind::StampsAllEqual,
        "every time stamp is the same",
        "",
        || vec![Remedy::set(OptionName::Rate)],
    ),
    Entry::error(
        Kind::StampsTooCoarse,
        "{merged} of {all} rows share their stamp with another: stamps are too coarse",
        "",
        || vec![Remedy::set(OptionName::Rate)],
    ),
    Entry::error(
        Kind::StampsTooLarge,
        "time stamps too large to tell apart in seconds",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TimeGoesBack,
        "[record {record}: ]time goes back from {from} to {to}[ (counted from {origin})]",
        "",
        || vec![Remedy::set(OptionName::SortTime), Remedy::Split],
    ),
    Entry::error(
        Kind::ClocksRestartApart,
        "the clock of one sensor begins again and that of the other does not as often ({most} recordings in all): are both of one recording?",
        "split both files there",
        Vec::new,
    ),
    Entry::error(
        Kind::PartOpen,
        "[there is no part {part}: ]the clock begins again, from {from} to {to}: {count} recordings in one file, of {rows} rows",
        "",
        || vec![Remedy::such_as(OptionName::Part, "1")],
    ),
    Entry::error(
        Kind::PartMissing,
        "part {part} is asked for, and there is one recording in it",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Part,
            }]
        },
    ),
    Entry::error(
        Kind::NeverOverlap,
        "the accelerometer was on from {accel_from} to {accel_to} s, the gyroscope from {gyro_from} to {gyro_to} s: they never overlap; are both stamps of one clock, in one unit?",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SumOfOtherStamps,
        "the acceleration without gravity and gravity have other stamps, so that their sum is not what the sensor reads",
        "[record again with {streams} switched on]",
        Vec::new,
    ),
    Entry::error(
        Kind::RateImpossible,
        "a sampling rate of {rate} is not within 0.001 to 1e7 Hz",
        "",
        || vec![Remedy::such_as(OptionName::Rate, "100")],
    ),
];
