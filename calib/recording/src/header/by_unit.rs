//! Sensors told by the unit of three columns that differ by their axis, whatever the language of their names.

use std::str::FromStr;

use findings::{Finding, Kind};
use sensor::Sensor;

use super::names::take_apart;
use crate::recording::options::Role;
use crate::units::{AccelUnit, GyroUnit, TimeUnit};

/// Stems of columns in such units that no sensor reads.
const DERIVED: [&str; 17] = [
    "linear",
    "lineare",
    "gravity",
    "user",
    "free",
    "gravitation",
    "ohne",
    "without",
    "sans",
    "linéaire",
    "gravité",
    "erdbeschleunigung",
    "schwerkraft",
    "pesanteur",
    "线性",
    "线加",
    "重力",
];

/// Adds the columns of a sensor that has none yet, and the time's; returns what was decided.
pub(crate) fn by_unit(
    names: &[String],
    only: Option<Sensor>,
    roles: &mut Vec<(Role, usize)>,
) -> Option<Finding> {
    let apart: Vec<(String, Option<&str>)> = names.iter().map(|name| take_apart(name)).collect();
    let mut told = Vec::new();
    let accel = only != Some(Sensor::Gyroscope);
    let gyro = only != Some(Sensor::Accelerometer);
    if accel && !roles.iter().any(|(role, _)| matches!(role, Role::Accel(_))) {
        let found = triad(&apart, roles, |unit| {
            is(unit, |unit: AccelUnit| unit != AccelUnit::Counts)
        });
        told.extend(found.map(|columns| columns.map(|(axis, at)| (Role::Accel(axis), at))));
    }
    if gyro && !roles.iter().any(|(role, _)| matches!(role, Role::Gyro(_))) {
        let found = triad(&apart, roles, |unit| {
            is(unit, |unit: GyroUnit| unit != GyroUnit::Counts)
        });
        told.extend(found.map(|columns| columns.map(|(axis, at)| (Role::Gyro(axis), at))));
    }
    if told.is_empty() {
        return None;
    }
    roles.extend(told.iter().flatten());
    if !roles.iter().any(|(role, _)| *role == Role::Time) {
        let is_time =
            |(_, unit): &(String, Option<&str>)| is(unit.unwrap_or_default(), |_: TimeUnit| true);
        roles.extend(apart.iter().position(is_time).map(|at| (Role::Time, at)));
    }
    let named = told
        .iter()
        .flatten()
        .map(|(role, at)| format!("{}=`{}`", role.name(), crate::shown::shown(&names[*at])));
    let named: Vec<String> = named.collect();
    Some(Finding::of(Kind::COLUMNS_BY_UNIT).detail("columns", named.join(", ")))
}

fn is<U: FromStr>(unit: &str, holds: impl Fn(U) -> bool) -> bool {
    unit.parse().is_ok_and(holds)
}

/// The one stem with three axes in a unit that `fits`.
fn triad(
    apart: &[(String, Option<&str>)],
    roles: &[(Role, usize)],
    fits: impl Fn(&str) -> bool,
) -> Option<[(usize, usize); 3]> {
    let find = |stem: &str, axis: char| {
        let is_it = |(word, unit): &(String, Option<&str>)| {
            word.strip_suffix(axis) == Some(stem) && unit.is_some_and(&fits)
        };
        let at = apart.iter().position(is_it)?;
        roles.iter().all(|(_, taken)| *taken != at).then_some(at)
    };
    let mut found = apart.iter().filter_map(|(word, _)| {
        let stem = word
            .strip_suffix('x')
            .filter(|stem| !DERIVED.iter().any(|part| stem.contains(part)))?;
        Some([
            (0, find(stem, 'x')?),
            (1, find(stem, 'y')?),
            (2, find(stem, 'z')?),
        ])
    });
    let first = found.next();
    first.filter(|_| found.next().is_none())
}
