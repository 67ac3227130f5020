//! Column names to quantities.

pub(crate) mod affine;
pub(crate) mod by_map;
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
mod time_column;
pub(crate) mod triads;
pub(crate) mod unit_row;
pub(crate) mod unnamed;

use findings::{Finding, Kind, OptionName, Remedy};
pub(crate) use questions::{suggest, unclear};
use sensor::Sensor;

use super::units::{Stated, looks_like_unit};
use crate::header::affine::Affine;
use crate::header::by_map::{affines, roles_by_map};
use crate::header::by_unit::by_unit;
use crate::header::gravity::Split;
use crate::header::names::{may_be_linear, role_of, says_gravity, stated_unit, take_apart};
use crate::header::suggest::suggestion;
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
        time_column::as_sampled(&names, map, &mut roles);
        time_column::not_of_ticks(&names, map, &mut roles);
        let times = time_column::likely(&names, &roles);
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
            names::axes_units::refuse_several(&layout.names, layout.accel, layout.gyro)?;
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
                    Err(Finding::of(Kind::COLUMN_MISSING)
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
            (Some(_), Some(other)) => Finding::of(Kind::SENSOR_TWICE)
                .of_sensor(Sensor::Accelerometer)
                .detail(
                    "columns",
                    shown_list(other.columns.iter().map(|at| &self.names[*at])),
                ),
            _ => Finding::of(Kind::NO_SENSOR_COLUMNS)
                .detail("columns", shown_list(self.names.iter())),
        };
        Err(unknown.only_remedies([suggestion(&self.names)]).into())
    }

    /// Takes another time where that of the layout stands still, as the stamp of a header that nobody fills does.
    pub fn take_time_that_moves(&mut self, stands_still: impl Fn(usize) -> bool) {
        let is_free = |at: usize| !self.is_read(at);
        let other = self
            .time
            .and_then(|time| time_column::that_moves(&self.names, time, is_free, stands_still));
        self.take_time(other);
    }

    /// Takes the one other time that is finer than that of the layout, as milliseconds are beside a date of whole seconds.
    pub fn take_finer_time(&mut self, is_finer: impl Fn(usize, usize) -> bool) {
        let is_free = |at: usize| !self.is_read(at);
        let other = self
            .time
            .and_then(|time| time_column::finer(&self.names, time, is_free, is_finer));
        self.take_time(other);
    }

    fn take_time(&mut self, other: Option<usize>) {
        if other.is_some() {
            self.time = other;
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
    let mut temperatures = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let said = roles[..given].iter().any(|(_, column)| *column == index);
        let Some(role) = role_of(name, only).filter(|role| !said && !is_of_other(role)) else {
            continue;
        };
        match roles.iter().position(|(r, _)| *r == role) {
            None => roles.push((role, index)),
            Some(at) if at < given => {}
            Some(at) if role == Role::Time => {
                let choice = time_column::of_two(names, roles[at].1, index, reading);
                roles[at].1 = choice.time;
                temperatures.extend(choice.temperature);
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
                return Err(Finding::of(Kind::COLUMNS_ALIKE)
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
