//! The choice of the column that is the time, where several may be.

use super::names::{
    compact, is_like_time, is_message_stamp, is_of_ticks, is_sampling_stamp, is_temperature_beside,
    role_of, take_apart,
};
use crate::recording::options::{ColumnMap, Role};
use crate::units::TimeUnit;

/// The roles of two columns called after the time.
pub(super) struct Choice {
    /// The time.
    pub time: usize,
    /// The one of them that is a temperature: `T` beside `t`.
    pub temperature: Option<usize>,
}

/// Chooses between the time that is used and another, in a table with the column `reading`.
pub(super) fn of_two(
    names: &[String],
    used: usize,
    other: usize,
    reading: Option<&String>,
) -> Choice {
    let of = |time: usize, temperature: Option<usize>| Choice { time, temperature };
    let (name, other_name) = (&names[used], &names[other]);
    if is_temperature_beside(other_name, name) {
        return of(used, Some(other));
    }
    if is_temperature_beside(name, other_name) {
        return of(other, Some(used));
    }
    // Stamps in a unit that is known, rather than those in a zone of the earth.
    let is_stamp = |name: &str| reading.is_some_and(|reading| is_message_stamp(name, reading));
    let better = is_stamp(other_name) && !is_stamp(name);
    let better = better || (strange_unit(name) && !strange_unit(other_name));
    of(if better { other } else { used }, None)
}

/// Returns another time than one that stands still.
pub(super) fn that_moves(
    names: &[String],
    time: usize,
    is_free: impl Fn(usize) -> bool,
    stands_still: impl Fn(usize) -> bool,
) -> Option<usize> {
    let is_time = |at: usize| role_of(&names[at], None) == Some(Role::Time);
    let moves = |at: &usize| is_free(*at) && is_time(*at) && !stands_still(*at);
    let mut others = (0..names.len()).filter(moves);
    stands_still(time).then(|| others.next()).flatten()
}

/// Returns the one other time that is finer.
pub(super) fn finer(
    names: &[String],
    time: usize,
    is_free: impl Fn(usize) -> bool,
    is_finer: impl Fn(usize, usize) -> bool,
) -> Option<usize> {
    let is_time = |at: usize| {
        let name = &names[at];
        role_of(name, None) == Some(Role::Time) || is_like_time(name)
    };
    let finer = |at: &usize| is_free(*at) && is_time(*at) && is_finer(*at, time);
    let mut finer = (0..names.len()).filter(finer);
    finer.next().filter(|_| finer.next().is_none())
}

/// Takes the stamps of sampling instead of a time beside them that may be the arrival's, where they are called so.
pub(super) fn as_sampled(names: &[String], map: &ColumnMap, roles: &mut [(Role, usize)]) {
    let may_go = |used: &str| !is_sampling_stamp(used, "");
    take_better_time(names, map, roles, may_go, is_sampling_stamp);
}

/// Takes the one column called after a time instead of a counter of ticks beside it: `offsetTime` beside `Tick#`.
pub(super) fn not_of_ticks(names: &[String], map: &ColumnMap, roles: &mut [(Role, usize)]) {
    let is_time = |name: &str, _: &str| is_like_time(name) && name.to_lowercase().ends_with("time");
    take_better_time(names, map, roles, is_of_ticks, is_time);
}

/// Takes the one free column that is better than the time, where that may go and nobody gave it.
fn take_better_time(
    names: &[String],
    map: &ColumnMap,
    roles: &mut [(Role, usize)],
    may_go: impl Fn(&str) -> bool,
    is_better: impl Fn(&str, &str) -> bool,
) {
    let free = |at: &usize| roles.iter().all(|(_, column)| column != at);
    let time = roles.iter().position(|(role, _)| *role == Role::Time);
    let Some(time) = time.filter(|_| !map.names(Role::Time)) else {
        return;
    };
    let used = &names[roles[time].1];
    let is_better = |at: &usize| is_better(&names[*at], used);
    let mut better = (0..names.len()).filter(free).filter(is_better);
    if let (Some(other), None, true) = (better.next(), better.next(), may_go(used)) {
        roles[time].1 = other;
    }
}

/// True for a column of dates, which have the time of day with them where no other column has it: `date`, `ts.$date`.
pub(super) fn is_date(name: &str) -> bool {
    let last = name.split(['.', '/', ' ']).next_back();
    last.is_some_and(|word| compact(word) == "date")
}

/// True for a time whose name ends with something in brackets that is no unit.
fn strange_unit(name: &str) -> bool {
    let unit = take_apart(name).1;
    unit.is_some_and(|unit| unit.parse::<TimeUnit>().is_err())
}

/// Columns without a role that may be the time, where none is called so.
pub(super) fn likely(names: &[String], roles: &[(Role, usize)]) -> Vec<usize> {
    if roles.iter().any(|(role, _)| *role == Role::Time) {
        return Vec::new();
    }
    let free = |at: &usize| roles.iter().all(|(_, column)| column != at);
    let called = |like: fn(&str) -> bool| -> Vec<usize> {
        let all = (0..names.len()).filter(free);
        all.filter(|at| like(&names[*at])).collect()
    };
    let mut times = called(is_like_time);
    if times.is_empty() {
        times = called(is_date);
    }
    // Ticks and counters have units that nobody states.
    times.sort_by_key(|&at| !names[at].to_lowercase().contains("time"));
    // `Phone timestamp` beside `sensor timestamp [ns]` is the arrival's.
    let sampled = |at: &usize| is_sampling_stamp(&names[*at], "");
    let mut stamps = times.iter().copied().filter(sampled);
    match (stamps.next(), stamps.next()) {
        (Some(stamp), None) => vec![stamp],
        _ => times,
    }
}
