//! Words of stamps, clocks and missing samples.

use crate::remedy::{OptionName, Remedy};

use crate::words::entry::{Entry, care, remark};
use crate::words::tables::reading::LEFT_OUT;

kinds! {
    /// Rows repeat earlier ones.
    ROWS_REPEATED = "rows_repeated" => Entry {
        reason: "rows repeat earlier rows",
        text: "{count:row} between lines {first_line} and {last_line} repeated earlier rows, stamp and values. The \
           program leaves them out",
        ..remark(0.001)
    },
    /// Rows have the stamp of another, and other values.
    STAMPS_EQUAL = "stamps_equal" => Entry {
        reason: "rows have the stamp of another",
        text: "{count:row} had the stamp of another row. The program merges such rows to their mean",
        ..remark(0.001)
    },
    /// The stamps are coarser than the rate.
    STAMPS_COARSE = "stamps_coarse" => Entry {
        reason: "the stamps are coarser than the rate",
        text: "{rows:row} of the {sensor} had the stamp of another row ({size} with one stamp on average): the stamps \
           are coarser than the rate. The program uses the even clock (equal steps) behind them, {rate}",
        remedies: vec![Remedy::if_wrong([OptionName::Rate])],
        ..remark(0.001)
    },
    /// The stamps are those of arrival: they come in bursts.
    STAMPS_OF_ARRIVAL = "stamps_of_arrival" => Entry {
        reason: "the stamps tell when samples arrived, not when they were taken",
        text: "the time stamps of the {sensor} come in bursts (median step {median}, mean {mean}). They tell when samples arrived at the recorder and not when they were taken",
        remedies: vec![Remedy::SensorStamps],
        ..care(0.05)
    },
    /// Samples are missing.
    SAMPLES_LOST = "samples_lost" => Entry {
        reason: "samples of the {sensor} are missing",
        text: "the {sensor} has {count:gap} without samples, the longest of {longest} from t = {t0} on",
        advice: LEFT_OUT,
        ..remark(0.05)
    },
    /// The logger could not keep up and dropped samples.
    LOG_DROPOUTS = "log_dropouts" => Entry {
        reason: "the log lost samples",
        text: "the log lost samples {count:time}, for {missing} in all, first at t = {t0} ({listed})",
        advice: LEFT_OUT,
        ..remark(0.05)
    },
    /// The recording was paused.
    PAUSED = "paused" => Entry {
        reason: "the recording was paused",
        text: "the recording was paused at t = {t0} for {length}. The program moves the later stamps on by that time",
        ..remark(0.001)
    },
    /// The clock of a log jumps back.
    CLOCK_BACK = "clock_back" => Entry {
        reason: "the clock of the log jumps back",
        text: "the clock of the log jumps back {count:time}, and the program does not correct that. A calibration from this log is not to be used",
        remedies: vec![Remedy::RecordAgain],
        ..care(0.3)
    },
    /// The time counter overflows and starts again.
    COUNTER_WRAPS = "counter_wraps" => Entry {
        reason: "the time counter starts again",
        text: "the time counter starts again, {count:time} in all, first in line {line}. The program counts on from \
           the time before",
        ..remark(0.001)
    },
    /// A short recording before or after the one that is read was left out.
    SESSION_LEFT_OUT = "session_left_out" => Entry {
        reason: "a short recording in the file was left out",
        text: "in line {line} the clock begins again after {rows:row}: these are left out, because they are too few",
        ..remark(0.001)
    },
    /// A file holds several recordings.
    SEVERAL_RECORDINGS = "several_recordings" => Entry {
        reason: "the file holds several recordings",
        text: "the clock begins again, so that the file holds {count:recording}. They are read as {names}",
        ..remark(0.001)
    },
    /// The unit of the stamps follows from the stamps.
    TIME_UNIT_TOLD = "time_unit_told" => Entry {
        reason: "the program found the unit of the time from the stamps",
        text: "the time is taken as {unit}[, for the rate is {rate} then][, for the first stamp is of the year {year} \
           then]",
        remedies: vec![Remedy::if_wrong([OptionName::TimeUnit])],
        ..remark(0.001)
    },
    /// The stamps go up by one and may count the rows.
    STAMPS_COUNT_ROWS = "stamps_count_rows" => Entry {
        reason: "the stamps may count the rows instead of seconds",
        text: "the stamps go up by 1 from row to row. The program reads them as seconds. If they count the rows, the rate has to be given; if they are milliseconds, the unit",
        advice: "nothing has to be done if one row was recorded each second",
        remedies: vec![Remedy::any_of([OptionName::Rate, OptionName::TimeUnit])],
        ..care(30.0)
    },
    /// A rate was given, and the stamps are not used.
    STAMPS_IGNORED = "stamps_ignored" => Entry {
        reason: "the program uses the given rate and not the stamps",
        text: "a rate was given, so that the time stamps are ignored",
        ..remark(0.001)
    },
    /// The stamps tell another rate than the one that was given.
    RATE_CONTRADICTED = "rate_contradicted" => Entry {
        reason: "the stamps tell another rate than the given one",
        text: "the time stamps tell a rate of {rate}, but {given} was given[. In between {missing:sample} are missing, which the given rate does not count]. Angles of turns come out {share} too {size}",
        remedies: vec![Remedy::Omit {
            option: OptionName::Rate,
        }],
        ..care(1.0)
    },
    /// A sensor with a clock of its own was interpolated.
    CLOCK_JOINED = "clock_joined" => Entry {
        reason: "the {sensor} was interpolated to other stamps",
        text: "the {sensor} has time stamps of its own. The program interpolates it to the stamps of the {other}",
        remedies: vec![Remedy::WriteFolder],
        ..remark(0.001)
    },
    /// The thermometer begins late or ends early.
    TEMPERATURE_PARTLY_KNOWN = "temperature_partly_known" => Entry {
        reason: "the temperature is not known throughout",
        text: "the temperature is known from {from} to {to}, the sensors from {sensors_from} to {sensors_to}. Before \
           and after, the temperature is taken as constant",
        ..remark(0.001)
    },
    /// The thermometer's stamps are of another clock.
    TEMPERATURE_OF_ANOTHER_CLOCK = "temperature_of_another_clock" => Entry {
        reason: "the temperature is of another clock and left out",
        text: "the temperature is known from {from} to {to}, the sensors from {sensors_from} to {sensors_to}. The \
           temperature must be of another clock, and the program leaves it out",
        remedies: vec![Remedy::OneClock],
        ..remark(0.001)
    },
}
