//! Readings of a magnetometer: kept as the file has them, on their own clock.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;

use super::Stream;
use super::options::Role;
use super::samples::Samples;
use crate::clock::held::held_runs;
use crate::header::look::{Look, numbered};
use crate::rows::parts::Part;
use crate::rows::table::Table;
use crate::units::field::FieldUnit;

/// Readings of a magnetometer in the unit of the file, uncorrected.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Magnetometer {
    /// Stamps on the clock of the recording, s, and readings in `unit`.
    pub stream: Stream,
    /// The unit, if the file or its format states one.
    pub unit: Option<FieldUnit>,
    /// The file, entry, topic or variable.
    pub source: String,
    /// Role and name of every column.
    pub columns: Vec<(&'static str, String)>,
}

impl Magnetometer {
    /// Readings in millionths of a tesla.
    pub fn in_microtesla(stream: Stream) -> Self {
        Self {
            stream,
            unit: Some(FieldUnit::Microtesla),
            ..Self::default()
        }
    }

    /// Brings the readings to millionths of a tesla, where their unit is known.
    pub fn convert_to_microtesla(&mut self) {
        let Some(unit) = self.unit else { return };
        let factor = unit.in_microtesla();
        let values = self.stream.values.iter_mut();
        values.for_each(|value| *value *= factor);
        self.unit = Some(FieldUnit::Microtesla);
    }

    /// Readings that are finite, each stamp once and each value once where a slower sensor's was held; those of a sensor
    /// that has not begun or drops out, all three exactly 0, are left out. `None` where nothing is left.
    pub(crate) fn of(t: &[f64], values: &[Vector3<f64>]) -> Option<Self> {
        let mut stream = Stream::default();
        for (t, value) in t.iter().zip(values) {
            let later = stream.t.last().is_none_or(|last| t > last);
            if value.amax() > 0.0 && later && t.is_finite() && value.iter().all(|v| v.is_finite()) {
                stream.t.push(*t);
                stream.values.push(*value);
            }
        }
        if let Some(starts) = held_runs(&stream) {
            stream = Stream {
                t: starts.iter().map(|&i| stream.t[i]).collect(),
                values: starts.iter().map(|&i| stream.values[i]).collect(),
            };
        }
        (!stream.is_empty()).then(|| Self {
            stream,
            ..Self::default()
        })
    }

    /// The first one of `tables`, which then have none; `given` is the unit that an option says.
    pub(crate) fn taken(tables: &mut Vec<Table>, given: Option<FieldUnit>) -> Option<Self> {
        let found = tables.iter_mut().find_map(|table| {
            let Samples { t, values, .. } = std::mem::take(&mut table.magnetometer);
            let columns = table.roles.iter();
            let columns = columns.filter(|(role, _)| matches!(role, Role::Time | Role::Field(_)));
            Some(Self {
                unit: given.or(table.stated.field).and_then(FieldUnit::known),
                source: table.name.clone(),
                columns: columns
                    .map(|(role, name)| (role.name(), name.clone()))
                    .collect(),
                ..Self::of(&t, &values)?
            })
        });
        tables.retain(|table| table.has_sensor() || !table.temperature.is_empty());
        found
    }
}

/// A magnetometer that reads zero throughout, which nothing uses.
pub(crate) fn dead(table: &Table) -> Option<Finding> {
    let values = &table.magnetometer.values;
    let is_dead = !values.is_empty() && values.iter().all(|value| value.amax() == 0.0);
    let found = Finding::of(Kind::MAGNETOMETER_DEAD).in_recording(&table.name);
    is_dead.then(|| found.of_sensor(Sensor::Magnetometer))
}

/// A file of a magnetometer by itself: its time and its axes, by their names or called x, y, z; without names in this order.
pub(crate) fn part(look: &Look, unit: Option<FieldUnit>) -> Option<Part> {
    let first = look.first();
    if first.len() == 4 && first.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        return Some(Part {
            field_unit: unit,
            ..Part::of(Sensor::Magnetometer, ["1", "2", "3", "4"])
        });
    }
    let at = |wanted: Role, letter: &str| {
        let named = look.column(wanted);
        named.or_else(|| numbered(&look.first(), letter))
    };
    let columns = [
        at(Role::Time, "t")?,
        at(Role::Field(0), "x")?,
        at(Role::Field(1), "y")?,
        at(Role::Field(2), "z")?,
    ];
    let columns = columns.each_ref().map(String::as_str);
    Some(Part {
        field_unit: unit,
        ..Part::of(Sensor::Magnetometer, columns)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_not_begun_and_what_was_held_is_left_out() {
        let t: Vec<f64> = (0..100).map(|k| f64::from(k) * 0.01).collect();
        let value = |k: i32| match k {
            0..10 => Vector3::zeros(),
            // Every value twice.
            k => Vector3::new(f64::from(k / 2), 1.0, 2.0),
        };
        let values: Vec<Vector3<f64>> = (0..100).map(value).collect();
        let found = Magnetometer::of(&t, &values).unwrap().stream;
        assert_eq!(found.len(), 45);
        assert_eq!((found.t[0], found.values[44].x), (0.1, 49.0));
        assert_eq!(Magnetometer::of(&t[..10], &values[..10]), None);
    }

    #[test]
    fn units_are_known_by_their_usual_spellings() {
        for unit in [
            FieldUnit::Tesla,
            FieldUnit::Microtesla,
            FieldUnit::Nanotesla,
            FieldUnit::Gauss,
            FieldUnit::Milligauss,
        ] {
            assert_eq!(unit.name().parse(), Ok(unit));
        }
        assert_eq!("μT".parse(), Ok(FieldUnit::Microtesla));
        assert!("deg".parse::<FieldUnit>().is_err());
    }
}
