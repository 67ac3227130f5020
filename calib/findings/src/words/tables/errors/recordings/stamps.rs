//! Words of stamps that tell no time.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A table has no time.
    NO_TIME = "no_time" => error_by(
        "the table has no column with the time of each row[; {likely} may be one][. The lines above it state a rate of {said}]",
        vec![Remedy::examples([
            (OptionName::Rate, "100"),
            (OptionName::Columns, "t=1"),
        ])],
    ),
    /// Rows of a program have no time.
    ROWS_WITHOUT_TIME = "rows_without_time" => error_by(
        "the rows of this file have no time stamps. The program that wrote it takes {rate} unless it was changed",
        vec![Remedy::such_as(OptionName::Rate, "100")],
    ),
    /// An expression is made of dates.
    EXPRESSION_OF_DATES = "expression_of_dates" => error(
        "an expression for the time takes numbers, and the column holds dates or times of day",
        "give the column without the expression",
    ),
    /// An expression lets time stand still.
    EXPRESSION_BACKWARDS = "expression_backwards" => error(
        "the expression for the time has a factor of {factor}, which lets time stand still or run back; a positive one expected",
        "correct the expression",
    ),
    /// An expression gives a time in an impossible unit.
    EXPRESSION_UNIT = "expression_unit" => error_with(
        "the expression for the time gives {unit}, in which the rate would be {rate} Hz",
        "correct the factor",
        vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
    ),
    /// The file states an impossible unit of the time.
    TIME_UNIT_STATED = "time_unit_stated" => error_by(
        "the file states {unit} for the time stamps. In this unit the sampling rate would be {rate} Hz, as no sensor has",
        vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
    ),
    /// The unit of the stamps is not known.
    TIME_UNIT_OPEN = "time_unit_open" => error_by(
        "the program cannot tell the unit of the time stamps[: it does not know the one in `{column}`][. Their usual step of {step} makes a usual rate in no common unit, so look up what they count]",
        vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
    ),
    /// In the unit that the rate tells no hand would have turned the device.
    TIME_UNIT_TOO_FAST = "time_unit_too_fast" => error_with(
        "the file does not state the unit of the time stamps. By their steps it would be {unit}, but then the device was turned at {speed} from rest to rest, faster than a hand turns it",
        "look up what the stamps count",
        vec![Remedy::such_as(OptionName::TimeUnit, "ms")],
    ),
    /// Stamps go up by one and tell no unit.
    STAMPS_BY_ONE = "stamps_by_one" => error_by(
        "the time stamps go up by 1 from row to row, as if they counted the rows",
        vec![Remedy::examples([
            (OptionName::Rate, "100"),
            (OptionName::TimeUnit, "ms"),
        ])],
    ),
    /// All stamps are the same.
    STAMPS_ALL_EQUAL = "stamps_all_equal" => error_by(
        "every time stamp is the same",
        vec![Remedy::set(OptionName::Rate)],
    ),
    /// Most rows share their stamp with another.
    STAMPS_TOO_COARSE = "stamps_too_coarse" => error_by(
        "{merged} of {all} rows share their stamp with another: stamps are too coarse to tell the rows apart in time",
        vec![Remedy::set(OptionName::Rate)],
    ),
    /// Stamps are too large for a double in seconds.
    STAMPS_TOO_LARGE = "stamps_too_large" => error(
        "the time stamps are too large to tell apart in seconds",
        "subtract the first stamp from all",
    ),
    /// Time goes back.
    TIME_GOES_BACK = "time_goes_back" => error_by(
        "time goes back from {from} to {to}[ at record {record}][ (counted from {origin})]. If the stamps pass {from} again within a few rows, the rows are out of order; if not, the clock began again",
        vec![Remedy::set(OptionName::SortTime), Remedy::Split],
    ),
    /// The clock of one sensor begins again and that of the other does not.
    CLOCKS_RESTART_APART = "clocks_restart_apart" => error(
        "the time stamps of one sensor begin again more often than those of the other ({most:recording} in all). So the program cannot tell what belongs together",
        "split both files where the stamps begin again, and calibrate the pairs that belong together",
    ),
    /// A file holds several recordings, and one has to be chosen.
    PART_OPEN = "part_open" => error_by(
        "[there is no part {part}: ]the clock begins again, from {from} to {to}: {count} recordings in one file, of {rows} rows",
        vec![Remedy::such_as(OptionName::Part, "1")],
    ),
    /// A part is asked for of a file with one recording.
    PART_MISSING = "part_missing" => error_by(
        "recording {part} of the file is asked for, and the file holds one only",
        vec![Remedy::Omit {
            option: OptionName::Part,
        }],
    ),
    /// Two sensors were never on together.
    NEVER_OVERLAP = "never_overlap" => error(
        "the accelerometer was on from {accel_from} to {accel_to} s, the gyroscope from {gyro_from} to {gyro_to} s: they never overlap; are both stamps of one clock, in one unit?",
        "export both sensors by one clock, in one unit",
    ),
    /// Gravity and the acceleration without it have other stamps.
    SUM_OF_OTHER_STAMPS = "sum_of_other_stamps" => error(
        "gravity and the acceleration without gravity have different time stamps. So the program cannot add them to what the sensor reads",
        "record the accelerometer with gravity[, as {streams}]",
    ),
    /// A sampling rate is impossible.
    RATE_IMPOSSIBLE = "rate_impossible" => error_by(
        "the sampling rate of {rate} is not within 0.001 to 1e7 Hz",
        vec![Remedy::such_as(OptionName::Rate, "100")],
    ),
}
