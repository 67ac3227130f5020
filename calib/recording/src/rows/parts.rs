//! Parts of texts with their sensors: what a format knows and the text does not say.

use findings::{Finding, Kind, OptionName, Remedy};
use std::io::Read;

use sensor::Sensor;

use crate::Error;
use crate::recording::options::{ColumnMap, ReadOptions, Role};
use crate::rows::table::Table;
use crate::source::Input;
use crate::units::field::FieldUnit;
use crate::units::{AccelUnit, GyroUnit, Stated, TimeUnit};

/// A change of a text that keeps its lines, so that messages name them rightly.
pub(crate) type Change = fn(Box<dyn Read + Send>) -> Box<dyn Read + Send>;

/// One sensor's columns of a text, or both sensors'.
#[derive(Clone, Debug, Default)]
pub(crate) struct Part {
    /// The one sensor that is read from it.
    pub only: Option<Sensor>,
    /// Columns of the roles, where the names do not tell them.
    pub columns: Vec<(Role, String)>,
    /// Unit of the stamps.
    pub time_unit: Option<TimeUnit>,
    /// Unit of the accelerometer.
    pub accel_unit: Option<AccelUnit>,
    /// Unit of the gyroscope.
    pub gyro_unit: Option<GyroUnit>,
    /// Unit of the magnetometer.
    pub field_unit: Option<FieldUnit>,
    /// The accelerometer reads -1 g on the axis that points up.
    pub negated: bool,
    /// Rows without numbers are padding.
    pub padded: bool,
    /// The beginning of the text does not show whether it has any row.
    pub may_be_absent: bool,
    /// Rewriting of the text to rows.
    pub change: Option<Change>,
    /// The rate that its program has unless it was told another, Hz, where the rows have no stamps.
    pub usual_rate: Option<f64>,
    /// Finding for the user about this part.
    pub remark: Option<Finding>,
    /// The system that had corrected the readings before.
    pub corrected_by: Option<&'static str>,
}

impl Part {
    /// The columns of one sensor: `t`, x, y and z as they are called or numbered.
    pub fn of(sensor: Sensor, columns: [&str; 4]) -> Self {
        let axis = |axis| Role::axis(sensor, axis);
        let roles = [Role::Time, axis(0), axis(1), axis(2)];
        let columns = columns.map(str::to_owned).into_iter();
        Self {
            only: Some(sensor),
            columns: roles.into_iter().zip(columns).collect(),
            padded: sensor == Sensor::Magnetometer,
            ..Self::default()
        }
    }

    /// A part of each sensor that has rows of its own: accelerometer, gyroscope, magnetometer, by the changes that leave those rows alone.
    pub fn of_each(
        changes: [Option<Change>; 3],
        columns: [&str; 4],
        stated: Stated,
    ) -> impl Iterator<Item = Self> {
        let parts = Sensor::ALL.into_iter().zip(changes);
        parts.filter_map(move |(sensor, change)| {
            let is_field = sensor == Sensor::Magnetometer;
            Some(Self {
                change: Some(change?),
                time_unit: stated.time,
                accel_unit: stated.accel.filter(|_| !is_field),
                gyro_unit: stated.gyro.filter(|_| !is_field),
                field_unit: stated.field.filter(|_| is_field),
                ..Self::of(sensor, columns)
            })
        })
    }

    /// The part of a sensor whose rows, that `change` leaves, are a stamp, if they have one, and its axes in the unit of that name.
    pub fn of_rows(sensor: Sensor, is_stamped: bool, unit: &str, change: Change) -> Self {
        let stamped = usize::from(is_stamped);
        let time = is_stamped.then(|| (Role::Time, "1".to_owned()));
        let axes = (0..3).map(|axis| (Role::axis(sensor, axis), (stamped + axis + 1).to_string()));
        Self {
            only: Some(sensor),
            columns: time.into_iter().chain(axes).collect(),
            accel_unit: unit.parse().ok(),
            gyro_unit: unit.parse().ok(),
            change: Some(change),
            ..Self::default()
        }
    }

    /// True for a magnetometer's, of which the other sensors are not read.
    pub fn is_field(&self) -> bool {
        self.only == Some(Sensor::Magnetometer)
    }

    /// True if the columns of this sensor are known in it.
    pub fn has(&self, sensor: Sensor) -> bool {
        let first = Role::axis(sensor, 0);
        !self.is_field() && self.columns.iter().any(|(role, _)| *role == first)
    }

    /// True if this sensor may be read from it, be it by names.
    pub fn may_hold(&self, sensor: Sensor) -> bool {
        self.has(sensor) || (self.columns.is_empty() && self.only.is_none())
    }

    /// The same, of which only this sensor is read.
    pub fn narrowed(mut self, sensor: Sensor) -> Self {
        self.only = Some(sensor);
        let columns = std::mem::take(&mut self.columns);
        self.columns = self.of_sensor(&ColumnMap(columns));
        self
    }

    /// Reads it from `input`; `origin` is the first stamp of the recording's other part. What the user said holds
    /// over what the format knows.
    pub fn read(
        &self,
        input: Input,
        origin: Option<i64>,
        options: &ReadOptions,
    ) -> Result<Table, Error> {
        let input = match self.change {
            Some(change) => input.changed(change)?,
            None => input,
        };
        let mut columns = self.of_sensor(&options.columns);
        // Who names no sensor's column says more, not otherwise.
        if columns.is_empty() || !options.columns.names_a_sensor() {
            let given: Vec<Role> = columns.iter().map(|(role, _)| *role).collect();
            let own = self.columns.iter();
            columns.extend(own.filter(|(role, _)| !given.contains(role)).cloned());
        }
        let options = ReadOptions {
            columns: ColumnMap(columns),
            na_drop: options.na_drop || self.padded,
            ..options.clone()
        };
        if let (Some(usual), None) = (self.usual_rate, options.rate) {
            return Err(Error::usage(
                Finding::of(Kind::ROWS_WITHOUT_TIME)
                    .in_file(&input.name)
                    .number("rate", usual, "Hz")
                    .only_remedies([Remedy::such_as(OptionName::Rate, usual.to_string())]),
            ));
        }
        let only = self.only.filter(|_| !self.is_field());
        let mut table = Table::read(input, only, origin, &options)?;
        if let Some(sensor) = self.only {
            table.keep_only(sensor)?;
        }
        if self.is_field() {
            (table.accel, table.gyro) = Default::default();
            (table.temperature_t, table.temperature) = Default::default();
            table
                .roles
                .retain(|(role, _)| matches!(role, Role::Time | Role::Field(_)));
        }
        let stated = &mut table.stated;
        stated.time = self.time_unit.or(stated.time);
        stated.accel = self.accel_unit.or(stated.accel);
        stated.gyro = self.gyro_unit.or(stated.gyro);
        stated.field = self.field_unit.or(stated.field);
        table.negated |= self.negated;
        table.corrected_by = self.corrected_by.or(table.corrected_by);
        if let Some(remark) = &self.remark {
            let remark = remark.clone().in_recording(&table.name);
            table.warnings.push(remark);
        }
        Ok(table)
    }

    /// Returns the user's columns for this part's sensor.
    fn of_sensor(&self, map: &ColumnMap) -> Vec<(Role, String)> {
        let concerns = |role: &Role| match role.sensor() {
            // A magnetometer's part has stamps of its own or none.
            None => !self.is_field(),
            sensor => self.only.is_none() || sensor == self.only,
        };
        let own = self.only.map(Role::TimeOf);
        let has_own = map.0.iter().any(|(role, _)| Some(*role) == own);
        let given = map.0.iter().filter(|(role, _)| concerns(role));
        let given = given.filter(|(role, _)| !(has_own && *role == Role::Time));
        let as_time = |(role, column): &(Role, String)| match Some(*role) == own {
            true => (Role::Time, column.clone()),
            false => (*role, column.clone()),
        };
        given.map(as_time).collect()
    }
}

/// A part for each sensor, where the user says that each has stamps of its own; else none.
pub(crate) fn with_own_stamps(map: &ColumnMap) -> Option<Vec<Part>> {
    if !map.has_stamps_of_sensors() {
        return None;
    }
    let sensors = [Sensor::Accelerometer, Sensor::Gyroscope];
    let named = |sensor: &Sensor| {
        let is_of = |role: &Role| (0..3).any(|axis| *role == Role::axis(*sensor, axis));
        map.0.iter().any(|(role, _)| is_of(role))
    };
    // Who names the axes of one sensor goes on without the other.
    let one = sensors.iter().filter(|sensor| named(sensor)).count() == 1;
    let wanted = sensors.into_iter().filter(|sensor| !one || named(sensor));
    let part = |sensor| Part {
        padded: true,
        ..Part::default().narrowed(sensor)
    };
    let mut parts: Vec<Part> = wanted.map(part).collect();
    let has = |wanted: Role| map.0.iter().find(|(role, _)| *role == wanted);
    let field = [
        Role::TimeOf(Sensor::Magnetometer),
        Role::Field(0),
        Role::Field(1),
        Role::Field(2),
    ];
    if let [Some(t), Some(x), Some(y), Some(z)] = field.map(has) {
        let columns = [&t.1, &x.1, &y.1, &z.1].map(String::as_str);
        parts.push(Part::of(Sensor::Magnetometer, columns));
    }
    Some(parts)
}

/// The tables of `parts` of one text.
pub(crate) fn read(
    input: Input,
    parts: &[Part],
    options: &ReadOptions,
) -> Result<Vec<Table>, Error> {
    let own = with_own_stamps(&options.columns);
    let parts = own.as_deref().unwrap_or(parts);
    let mut tables: Vec<Table> = Vec::new();
    let mut input = Some(input);
    let mut absent = None;
    for (k, part) in parts.iter().enumerate() {
        let Some(this) = input.take() else { break };
        if k + 1 < parts.len() {
            input = Some(this.again(options)?);
        }
        let origin = tables.first().and_then(|table| table.clock.origin);
        match part.read(this, origin, options) {
            Err(error) if part.is_field() => without_field(&mut tables, &error),
            Err(error) if part.may_be_absent && is_of_no_rows(&error) => absent = Some(error),
            table => tables.push(table?),
        }
    }
    match absent {
        Some(error) if tables.is_empty() => Err(error),
        _ => Ok(tables),
    }
}

fn is_of_no_rows(error: &Error) -> bool {
    error.finding().kind == Kind::NO_DATA
}

/// Goes on without a magnetometer, and says why: no calibration uses it.
pub(crate) fn without_field(tables: &mut [Table], why: &dyn std::fmt::Display) {
    if let Some(table) = tables.first_mut() {
        table
            .warnings
            .push(Finding::of(Kind::FIELD_LEFT_OUT).detail("why", why.to_string()));
    }
}
