//! Words of stamps, clocks and missing samples.

use crate::kind::Kind;
use crate::level::Level;
use crate::remedy::{OptionName, Remedy};

use crate::words::entry::Entry;

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        kind: Kind::RowsRepeated,
        level: Level::Remark,
        severity: 0.001,
        reason: "rows repeat earlier rows",
        text: "{count:row} between lines {first_line} and {last_line} repeated earlier rows, stamp and values; left out",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StampsEqual,
        level: Level::Remark,
        severity: 0.001,
        reason: "rows have the stamp of another",
        text: "{count:row} had the stamp of another row: merged to their mean",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::StampsCoarse,
        level: Level::Remark,
        severity: 0.001,
        reason: "the stamps are coarser than the rate",
        text: "{rows:row} of the {sensor} had the stamp of another row ({size} with one stamp on average): the stamps are \
               coarser than the rate. The even clock behind them is used, {rate}",
        remedies: || vec![Remedy::if_wrong([OptionName::Rate])],
    },
    Entry {
        kind: Kind::StampsOfArrival,
        level: Level::Care,
        severity: 0.05,
        reason: "the stamps tell when samples arrived, not when they were taken",
        text: "stamps of the {sensor} come in bursts (median step {median}, mean {mean}), as of arrival",
        remedies: || vec![Remedy::SensorStamps],
    },
    Entry {
        kind: Kind::SamplesLost,
        level: Level::Remark,
        severity: 0.05,
        reason: "samples of the {sensor} are missing",
        text: "the {sensor} has {count:gap} without samples, the longest of {longest} from t = {t0} on",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::LogDropouts,
        level: Level::Remark,
        severity: 0.05,
        reason: "the log lost samples",
        text: "the log has {count:dropout} of {missing} in all, from t = {t0} on ({listed})",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::Paused,
        level: Level::Remark,
        severity: 0.001,
        reason: "the recording was paused",
        text: "the recording was paused at t = {t0} for {length}: later stamps are moved on by that",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ClockBack,
        level: Level::Care,
        severity: 0.3,
        reason: "the clock of the log jumps back",
        text: "the clock of the log jumps back {count:time}",
        remedies: || vec![Remedy::RecordAgain],
    },
    Entry {
        kind: Kind::CounterWraps,
        level: Level::Remark,
        severity: 0.001,
        reason: "the time counter starts again",
        text: "the time counter starts again, {count:time} in all, first in line {line}: it is counted on",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::SessionLeftOut,
        level: Level::Remark,
        severity: 0.001,
        reason: "a short recording in the file was left out",
        text: "in line {line} the clock begins again after {rows:row}: these are left out",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::SeveralRecordings,
        level: Level::Remark,
        severity: 0.001,
        reason: "the file holds several recordings",
        text: "the clock begins again, so that the file holds {count:recording}: read as {names}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TimeUnitTold,
        level: Level::Remark,
        severity: 0.001,
        reason: "the unit of the time was told from the stamps",
        text: "the time is taken as {unit}[, in which the rate is {rate}][, in which the first stamp is of the year {year}]",
        remedies: || vec![Remedy::if_wrong([OptionName::TimeUnit])],
    },
    Entry {
        kind: Kind::StampsCountRows,
        level: Level::Care,
        severity: 30.0,
        reason: "the stamps may count the rows instead of seconds",
        text: "the stamps go up by 1 from row to row and are read as seconds, though they may count the rows",
        remedies: || vec![Remedy::any_of([OptionName::Rate, OptionName::TimeUnit])],
    },
    Entry {
        kind: Kind::StampsIgnored,
        level: Level::Remark,
        severity: 0.001,
        reason: "the given rate stands for the stamps",
        text: "a rate was given: time stamps are ignored",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::RateContradicted,
        level: Level::Care,
        severity: 1.0,
        reason: "the stamps tell another rate than the given one",
        text: "by its stamps the rate is {rate} and not {given}[, and {missing:sample} are missing that the given rate \
               passes over]: angles between rests come out {share} too {size}",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::ClockJoined,
        level: Level::Remark,
        severity: 0.001,
        reason: "the {sensor} was interpolated to other stamps",
        text: "the {sensor} has a clock of its own and is interpolated to the stamps of the {other}",
        remedies: || vec![Remedy::WriteFolder],
    },
    Entry {
        kind: Kind::TemperaturePartlyKnown,
        level: Level::Remark,
        severity: 0.001,
        reason: "the temperature is not known throughout",
        text: "the temperature is known from {from} to {to}, the sensors from {sensors_from} to {sensors_to}: before and \
               after it is taken as constant",
        remedies: Vec::new,
    },
    Entry {
        kind: Kind::TemperatureOfAnotherClock,
        level: Level::Remark,
        severity: 0.001,
        reason: "the temperature is of another clock and left out",
        text: "the temperature is known from {from} to {to}, the sensors from {sensors_from} to {sensors_to}: left out, as \
               of another clock",
        remedies: || vec![Remedy::OneClock],
    },
];
