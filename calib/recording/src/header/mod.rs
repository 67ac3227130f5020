//! Column names to quantities.

pub(crate) mod affine;
mod axes_units;
pub(crate) mod by_unit;
pub(crate) mod dialect;
pub(crate) mod gravity;
pub(crate) mod look;
pub(crate) mod names;
pub(crate) mod preface;
pub(crate) mod questions;
pub(crate) mod quotes;
mod row_shape;
pub(crate) mod sniff;
pub(crate) mod triads;
pub(crate) mod unit_row;
pub(crate) mod unnamed;

use findings::{Finding, Kind, OptionName, Remedy};
pub(crate) use questions::{suggest, unclear};
use sensor::Sensor;

use super::units::{Stated, TimeUnit, looks_like_unit};
use crate::header::affine::Affine;
use crate::header::by_unit::by_unit;
use crate::header::gravity::Split;
use crate::header::names::{
    is_like_time, is_message_stamp, is_of_ticks, is_sampling_stamp, is_temperature_beside,
    may_be_linear, role_of, says_gravity, stated_unit, take_apart,
};
use crate::header::suggest::{nearest, suggestion};
use crate::header::triads::Triad;
use crate::recording::options::{ColumnMap, Role};
use crate::shown::{shown, shown_list};

/// Roles of the columns of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Layout {
    /// Cells per row.
    pub width: usize,
    /// Names, as far as the file has them.
    pub names: Vec<String>,
    /// Time stamps.
    pub time: Option<usize>,
    /// Specific force, x y z.
    pub accel: Option<[usize; 3]>,
    /// Gravity in columns of its own, which those of the accelerometer lack.
    pub gravity: Option<Split>,
    /// Angular rate, x y z.
    pub gyro: Option<[usize; 3]>,
    /// Temperature.
    pub temperature: Option<usize>,
    /// Magnetic field, x y z.
    pub field: Option<[usize; 3]>,
    /// Units in the names.
    pub stated: Stated,
    /// Unknown units in the names of the accelerometer and of the gyroscope.
    pub strange: [Option<String>; 2],
    /// Scales and offsets that the user gave.
    pub affine: Vec<(Role, Affine)>,
    /// Finding that sensors were recognised by the units in the names.
    pub by_unit: Option<Finding>,
    /// Columns that may be the time where none is called so for certain.
    pub times: Vec<usize>,
}

impl Layout {
    /// The layout of a table whose header holds `names`.
    ///
    /// # Errors
    /// What is wrong with the names, with the option that would help.
    pub fn of_names(
        names: Vec<String>,
        map: &ColumnMap,
        only: Option<Sensor>,
    ) -> Result<Self, Box<Finding>> {
        let mut roles = roles_by_map(&names, map)?;
        roles_by_name(&names, only, &mut roles)?;
        let gravity = gravity::summed(&names, map, only, &mut roles);
        let by_unit = by_unit(&names, only, &mut roles);
        of_the_one(&names, only, &mut roles);
        as_sampled(&names, map, &mut roles);
        not_of_ticks(&names, map, &mut roles);
        let times = likely_times(&names, &roles);
        if let [time] = times[..] {
            roles.push((Role::Time, time));
        }
        let mut layout = Self {
            width: names.len(),
            affine: affines(&names, map),
            names,
            by_unit,
            gravity,
            times,
            ..Self::default()
        };
        layout.assign(&roles, map)?;
        if layout.affine.is_empty() {
            axes_units::refuse_several(&layout.names, layout.accel, layout.gyro)?;
        }
        layout.state_units();
        Ok(layout)
    }

    /// Takes over columns by role; `map` is what was said of them. Triads have to be whole, and there has to be one,
    /// unless the table is a thermometer's.
    pub fn assign(&mut self, roles: &[(Role, usize)], map: &ColumnMap) -> Result<(), Box<Finding>> {
        let column = |role: Role| {
            roles
                .iter()
                .find(|(r, _)| *r == role)
                .map(|&(_, column)| column)
        };
        let is_sensor = |role: &Role| matches!(role, Role::Accel(_) | Role::Gyro(_));
        let named = map.0.iter().any(|(role, _)| is_sensor(role));
        let triad = |axes: [Role; 3]| -> Result<Option<[usize; 3]>, Box<Finding>> {
            match axes.map(column) {
                [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
                [None, None, None] => Ok(None),
                // Who names the other sensor's columns goes on without this one.
                _ if named
                    && !axes
                        .iter()
                        .any(|axis| map.0.iter().any(|(role, _)| role == axis)) =>
                {
                    Ok(None)
                }
                some => {
                    let missing: Vec<_> = (0..3).filter(|&i| some[i].is_none()).collect();
                    let missing: Vec<_> = missing.into_iter().map(|i| axes[i].name()).collect();
                    Err(Finding::of(Kind::ColumnMissing)
                        .detail("missing", missing.join(" and "))
                        .remedy(suggestion(&self.names))
                        .into())
                }
            }
        };
        self.time = column(Role::Time);
        self.accel = triad([0, 1, 2].map(Role::Accel))?;
        self.gyro = triad([0, 1, 2].map(Role::Gyro))?;
        self.temperature = column(Role::Temperature);
        // One that is not whole is as good as none, and no reason to stop.
        self.field = match [0, 1, 2].map(|axis| column(Role::Field(axis))) {
            [Some(x), Some(y), Some(z)] => Some([x, y, z]),
            _ => None,
        };
        if map.is_of_a_thermometer() || self.has_sensor() {
            return Ok(());
        }
        let found = triads::triads(&self.names);
        let mut accelerometers = found
            .iter()
            .filter(|triad| triad.sensor() == Some(Sensor::Accelerometer));
        let unknown = match (accelerometers.next(), accelerometers.next()) {
            // The advice is the first one's, and who means another has its names.
            (Some(_), Some(other)) => Finding::of(Kind::SensorTwice)
                .of_sensor(Sensor::Accelerometer)
                .detail(
                    "columns",
                    shown_list(other.columns.iter().map(|at| &self.names[*at])),
                ),
            _ => {
                Finding::of(Kind::NoSensorColumns).detail("columns", shown_list(self.names.iter()))
            }
        };
        Err(unknown.only_remedies([suggestion(&self.names)]).into())
    }

    /// Takes another time where that of the layout stands still, as the stamp of a header that nobody fills does.
    pub fn take_time_that_moves(&mut self, stands_still: impl Fn(usize) -> bool) {
        let is_time = |at: &usize| role_of(&self.names[*at], None) == Some(Role::Time);
        let moves = |at: &usize| !self.is_read(*at) && is_time(at) && !stands_still(*at);
        if self.time.is_some_and(&stands_still)
            && let Some(other) = (0..self.names.len()).find(moves)
        {
            self.time = Some(other);
            self.state_units();
        }
    }

    /// Takes the one other time that is finer than that of the layout, as milliseconds are beside a date of whole seconds.
    pub fn take_finer_time(&mut self, is_finer: impl Fn(usize, usize) -> bool) {
        let is_time = |at: &usize| {
            let name = &self.names[*at];
            role_of(name, None) == Some(Role::Time) || is_like_time(name)
        };
        let Some(time) = self.time else { return };
        let mut finer = (0..self.names.len())
            .filter(|at| !self.is_read(*at))
            .filter(is_time)
            .filter(|at| is_finer(*at, time));
        if let (Some(other), None) = (finer.next(), finer.next()) {
            self.time = Some(other);
            self.state_units();
        }
    }

    /// True if three columns are a sensor's.
    pub fn has_sensor(&self) -> bool {
        [self.accel, self.gyro, self.field]
            .iter()
            .any(Option::is_some)
    }

    fn state_units(&mut self) {
        let unit = |column: Option<usize>| {
            let name = self.names.get(column?)?;
            take_apart(name).1
        };
        let first = |triad: Option<[usize; 3]>| triad.map(|[x, ..]| x);
        let stated = Stated {
            time: self.time.and_then(|at| stated_unit(self.names.get(at)?)),
            accel: unit(first(self.accel)).and_then(|u| u.parse().ok()),
            gyro: unit(first(self.gyro)).and_then(|u| u.parse().ok()),
            temperature: unit(self.temperature).and_then(|u| u.parse().ok()),
            field: unit(first(self.field)).and_then(|u| u.parse().ok()),
        };
        // Who gives a factor knows the unit.
        let scaled = |role: Role| self.affine.iter().any(|(given, _)| *given == role);
        let strange = |triad: Option<[usize; 3]>, is_known: bool| {
            let unit = unit(first(triad)).filter(|unit| !is_known && looks_like_unit(unit))?;
            Some(unit.to_owned())
        };
        self.strange = [
            strange(self.accel, stated.accel.is_some() || scaled(Role::Accel(0))),
            strange(self.gyro, stated.gyro.is_some() || scaled(Role::Gyro(0))),
        ];
        self.stated = stated;
    }

    /// Returns the user's scale and offset for the cells of a role.
    pub fn affine_of(&self, role: Role) -> Option<Affine> {
        let given = self.affine.iter().find(|(given, _)| *given == role);
        given.map(|(_, affine)| *affine)
    }

    /// True for a column that has a role.
    pub fn is_read(&self, column: usize) -> bool {
        let triads = self.accel.iter().chain(&self.gyro).chain(&self.field);
        let gravity = self.gravity.iter().flat_map(|split| split.gravity);
        let triads = triads.flatten().copied().chain(gravity);
        let mut read = triads.chain(self.time).chain(self.temperature);
        read.any(|read| read == column)
    }

    /// Returns the number of columns without a role.
    pub fn unread(&self) -> usize {
        (0..self.width).filter(|at| !self.is_read(*at)).count()
    }

    /// Names of the columns that have no role.
    pub fn unused(&self) -> Vec<String> {
        let unused = (0..self.names.len()).filter(|&i| !self.is_read(i));
        unused
            .map(|i| self.names[i].clone())
            .filter(|name| !name.is_empty())
            .collect()
    }

    /// The column of every role, by its name or number.
    pub fn roles(&self) -> Vec<(Role, String)> {
        let called = |column: usize| match self.names.get(column) {
            Some(name) if !name.is_empty() => name.clone(),
            _ => (column + 1).to_string(),
        };
        let axes = |triad: Option<[usize; 3]>| triad.into_iter().flatten().enumerate();
        let time = self.time.map(|column| (Role::Time, called(column)));
        let accel = axes(self.accel).map(|(axis, column)| {
            let gravity = self.gravity.map(|split| split.gravity[axis]);
            let gravity =
                gravity.map_or_else(String::new, |column| format!(" + {}", called(column)));
            (Role::Accel(axis), called(column) + &gravity)
        });
        let gyro = axes(self.gyro).map(|(axis, column)| (Role::Gyro(axis), called(column)));
        let field = axes(self.field).map(|(axis, column)| (Role::Field(axis), called(column)));
        let temperature = self
            .temperature
            .map(|column| (Role::Temperature, called(column)));
        time.into_iter()
            .chain(accel)
            .chain(gyro)
            .chain(temperature)
            .chain(field)
            .collect()
    }

    /// Returns the number and name of a column, for messages.
    pub fn column(&self, index: usize) -> String {
        match self.names.get(index) {
            Some(name) if !name.is_empty() => format!("column {} (`{}`)", index + 1, shown(name)),
            _ => format!("column {}", index + 1),
        }
    }
}

/// Adds the columns whose names have a role that is not taken yet. Of several times the first is used.
fn roles_by_name(
    names: &[String],
    only: Option<Sensor>,
    roles: &mut Vec<(Role, usize)>,
) -> Result<(), Box<Finding>> {
    let given = roles.len();
    // Of a part that one sensor is read from, missing numbers of the other leave no row out.
    let whole = only.filter(|sensor| {
        let mut axes = (0..3).map(|axis| Role::axis(*sensor, axis));
        axes.all(|axis| roles.iter().any(|(role, _)| *role == axis))
    });
    let is_of_other = |role: &Role| match whole {
        Some(Sensor::Accelerometer) => matches!(role, Role::Gyro(_)),
        Some(Sensor::Gyroscope) => matches!(role, Role::Accel(_)),
        _ => false,
    };
    let is_reading =
        |name: &&String| role_of(name, only).is_some_and(|role| role.reading().is_some());
    let reading = names.iter().find(is_reading);
    let is_stamp = |name: &str| reading.is_some_and(|reading| is_message_stamp(name, reading));
    let mut temperatures = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let said = roles[..given].iter().any(|(_, column)| *column == index);
        let Some(role) = role_of(name, only).filter(|role| !said && !is_of_other(role)) else {
            continue;
        };
        match roles.iter().position(|(r, _)| *r == role) {
            None => roles.push((role, index)),
            Some(at) if at < given => {}
            Some(at) if role == Role::Time && is_temperature_beside(name, &names[roles[at].1]) => {
                temperatures.push(index);
            }
            Some(at) if role == Role::Time && is_temperature_beside(&names[roles[at].1], name) => {
                temperatures.push(roles[at].1);
                roles[at].1 = index;
            }
            // Stamps in a unit that is known, rather than those in a zone of the earth.
            Some(at) if role == Role::Time => {
                let used = &names[roles[at].1];
                let better = is_stamp(name) && !is_stamp(used);
                if better || (strange_unit(used) && !strange_unit(name)) {
                    roles[at].1 = index;
                }
            }
            Some(_) if matches!(role, Role::Field(_)) => {}
            Some(at) if says_gravity(&names[roles[at].1]) != says_gravity(name) => {
                if says_gravity(name) {
                    roles[at].1 = index;
                }
            }
            // Linear acceleration beside the accelerometer.
            Some(at) if may_be_linear(&names[roles[at].1]) != may_be_linear(name) => {
                if !may_be_linear(name) {
                    roles[at].1 = index;
                }
            }
            Some(at) => {
                let other = roles[at].1;
                let by_number = firsts_of_several(names, only);
                return Err(Finding::of(Kind::ColumnsAlike)
                    .count("first", other + 1)
                    .detail("first_name", shown(&names[other]))
                    .count("second", index + 1)
                    .detail("second_name", shown(name))
                    .detail("role", role.name())
                    .only_remedies([Remedy::such_as(OptionName::Columns, by_number)])
                    .into());
            }
        }
    }
    let has_one = roles.iter().any(|(role, _)| *role == Role::Temperature);
    if let [temperature] = temperatures[..]
        && !has_one
    {
        roles.push((Role::Temperature, temperature));
    }
    Ok(())
}

/// The first column of every role of a sensor that several columns may have, as `--columns` takes them.
fn firsts_of_several(names: &[String], only: Option<Sensor>) -> String {
    let role = |name: &String| role_of(name, only).filter(|role| role.reading().is_some());
    let roles: Vec<Option<Role>> = names.iter().map(role).collect();
    let is_first = |at: &usize| !roles[..*at].contains(&roles[*at]);
    let comes_again = |at: &usize| roles[at + 1..].contains(&roles[*at]);
    let firsts = (0..roles.len()).filter(is_first).filter(comes_again);
    let each = firsts.filter_map(|at| Some(format!("{}={}", roles[at]?.name(), at + 1)));
    each.collect::<Vec<_>>().join(",")
}

/// Takes the stamps of sampling instead of a time beside them that may be the arrival's, where they are called so.
fn as_sampled(names: &[String], map: &ColumnMap, roles: &mut [(Role, usize)]) {
    let may_go = |used: &str| !is_sampling_stamp(used, "");
    take_better_time(names, map, roles, may_go, is_sampling_stamp);
}

/// Takes the one column called after a time instead of a counter of ticks beside it: `offsetTime` beside `Tick#`.
fn not_of_ticks(names: &[String], map: &ColumnMap, roles: &mut [(Role, usize)]) {
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

/// True for a time whose name ends with something in brackets that is no unit.
fn strange_unit(name: &str) -> bool {
    let unit = take_apart(name).1;
    unit.is_some_and(|unit| unit.parse::<TimeUnit>().is_err())
}

/// The columns of a table of one sensor whose names say nothing but the axis: `X_value`, `x-axis (g)`.
fn of_the_one(names: &[String], only: Option<Sensor>, roles: &mut Vec<(Role, usize)>) {
    let Some(sensor) = only else { return };
    let axes = [0, 1, 2].map(|axis| Role::axis(sensor, axis));
    if roles.iter().any(|(role, _)| axes.contains(role)) {
        return;
    }
    let found = triads::triads(names);
    let free = |triad: &&Triad| {
        let taken = |at: &usize| roles.iter().any(|(_, column)| column == at);
        !triad.is_of_another() && !triad.columns.iter().any(taken)
    };
    let found: Vec<&Triad> = found.iter().filter(free).collect();
    if let [triad] = found[..] {
        roles.extend(axes.into_iter().zip(triad.columns));
    }
}

/// Columns without a role that may be the time, where none is called so.
fn likely_times(names: &[String], roles: &[(Role, usize)]) -> Vec<usize> {
    if roles.iter().any(|(role, _)| *role == Role::Time) {
        return Vec::new();
    }
    let free = |at: &usize| roles.iter().all(|(_, column)| column != at);
    let like = |at: &usize| is_like_time(&names[*at]);
    let mut times: Vec<usize> = (0..names.len()).filter(free).filter(like).collect();
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

/// Refuses one column for two roles.
///
/// # Errors
/// Both.
pub(crate) fn refuse_twins(names: &[String], map: &ColumnMap) -> Result<(), Box<Finding>> {
    // A column that is not there is for another to refuse.
    let roles = roles_by_map(names, map).unwrap_or_default();
    for (i, (role, column)) in roles.iter().enumerate() {
        if let Some(other) = roles[..i].iter().position(|(_, other)| other == column) {
            let given = |i: usize| format!("{}={}", map.0[i].0.name(), shown(&map.0[i].1));
            return Err(Finding::of(Kind::ColumnForTwo)
                .detail("given", format!("{},{}", given(other), given(i)))
                .count("column", column + 1)
                .detail("first", roles[other].0.name())
                .detail("second", role.name())
                .into());
        }
    }
    Ok(())
}

/// The column called `wanted`, or numbered so from 1.
fn column(names: &[String], wanted: &str) -> Option<usize> {
    let by_name = names.iter().position(|name| name.trim() == wanted);
    let number = || wanted.parse::<usize>().ok();
    by_name.or_else(|| {
        number()
            .filter(|n| (1..=names.len()).contains(n))
            .map(|n| n - 1)
    })
}

/// Returns the user's scales and offsets. An expression that is also the name of a column is read as the name.
pub(crate) fn affines(names: &[String], map: &ColumnMap) -> Vec<(Role, Affine)> {
    let of = |(role, wanted): &(Role, String)| {
        let (_, affine) = affine::take_apart(wanted)?;
        column(names, wanted).is_none().then_some((*role, affine))
    };
    map.0.iter().filter_map(of).collect()
}

/// Columns by name first, then by number from 1.
pub(crate) fn roles_by_map(
    names: &[String],
    map: &ColumnMap,
) -> Result<Vec<(Role, usize)>, Box<Finding>> {
    let find = |wanted: &str| {
        column(names, wanted).or_else(|| column(names, affine::take_apart(wanted)?.0))
    };
    let mut roles = Vec::new();
    for (role, wanted) in &map.0 {
        let column = find(wanted).ok_or_else(|| {
            let missing = Finding::of(Kind::NoSuchColumn)
                .detail("role", role.name())
                .detail("wanted", shown(wanted))
                .count("count", names.len());
            match nearest(wanted, names) {
                Some(nearest) => missing.detail("nearest", shown(nearest)),
                None => missing,
            }
        })?;
        roles.push((*role, column));
    }
    Ok(roles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_acceleration_with_gravity_is_taken_before_one_without() {
        let of = |stem: &str| ["x", "y", "z"].map(|axis| format!("{stem}.{axis}"));
        let [without, with] = ["acceleration", "accelerationIncludingGravity"].map(of);
        for (first, second, accel) in [(&without, &with, [3, 4, 5]), (&with, &without, [0, 1, 2])] {
            let names = [first.as_slice(), second.as_slice()].concat();
            let layout = Layout::of_names(names, &ColumnMap::default(), None).unwrap();
            assert_eq!(layout.accel, Some(accel));
        }
    }

    #[test]
    fn the_small_letter_is_the_time_and_the_capital_the_temperature() {
        let layout = |first: &str, second: &str| {
            let names = [first, second, "ax", "ay", "az"].map(str::to_owned);
            let layout = Layout::of_names(names.to_vec(), &ColumnMap::default(), None).unwrap();
            (layout.time, layout.temperature)
        };
        assert_eq!(layout("T", "t"), (Some(1), Some(0)));
        assert_eq!(layout("t", "T"), (Some(0), Some(1)));
        assert_eq!(layout("T (°C)", "t (s)"), (Some(1), Some(0)));
        assert_eq!(layout("T", "temp"), (Some(0), Some(1)));
        assert_eq!(layout("T [ms]", "t"), (Some(0), None));
    }
}
