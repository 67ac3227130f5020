//! Samples that are in memory already, checked as those of a plain CSV are.

use findings::{Finding, Kind, Remedy};
use nalgebra::Vector3;
use sensor::Sensor;

use super::assemble::assemble;
use super::options::ReadOptions;
use super::samples::{Pushed, Samples};
use super::scalar::ScalarStream;
use super::stream::Stream;
use super::{Recording, Role};
use crate::Error;
use crate::rows::table::Table;
use crate::shown::figure;
use crate::source::place::{at_column, at_line, in_file};
use crate::units::field::FieldUnit;

findings::tuning! {
    /// Largest reading and stamp that are numbers of a sensor.
    LARGEST: f64 = 1e15;
}

/// Arrays of a recording, one row per stamp.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rows<'a> {
    /// Time stamps, s (`n`).
    pub t: &'a [f64],
    /// Specific force, m/s² (`n × 3`); empty without an accelerometer.
    pub accel: &'a [[f64; 3]],
    /// Angular rate, rad/s (`n × 3`); empty without a gyroscope.
    pub gyro: &'a [[f64; 3]],
    /// Temperature, °C (`n`); empty without a thermometer.
    pub temperature: &'a [f64],
    /// Magnetic field, µT (`n × 3`); empty without a magnetometer.
    pub mag: &'a [[f64; 3]],
}

impl Recording {
    /// The recording in arrays, called `name`: what [`Recording::read`] makes of a plain CSV with these numbers, bit for
    /// bit. Rows count as lines, from 1.
    ///
    /// # Errors
    /// [`Error::Input`] for arrays of different lengths, a number that is not finite, time that goes backwards, and
    /// whatever else no working sensor gives; messages begin with `name:row:column`.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::Recording;
    /// use stillpoint_recording::Rows;
    ///
    /// let rows = Rows { t: &[0.0, 0.01], accel: &[[0.0, 0.0, 9.8]], ..Rows::default() };
    /// let refused = Recording::from_rows("mine", rows).unwrap_err().to_string();
    /// assert_eq!(refused, "mine: accel has 1 row, t has 2; give arrays of one length");
    /// ```
    pub fn from_rows(name: &str, rows: Rows<'_>) -> Result<Self, Error> {
        rows.check_lengths(name)?;
        let mut table = Table {
            name: name.to_owned(),
            plain_time: true,
            has_time: true,
            ..Table::default()
        };
        table.clock.origin = Some(origin(rows.t));
        for sensor in Sensor::ALL {
            *table.samples_mut(sensor) = rows.samples(name, sensor)?;
        }
        table.stated.field = Some(FieldUnit::Microtesla);
        let zero = origin(rows.t) as f64;
        for (k, (&t, &celsius)) in rows.t.iter().zip(rows.temperature).enumerate() {
            check(name, k, "temperature", celsius, 8)?;
            let t = t - zero;
            if table.temperature_t.last().is_none_or(|&last| t > last) {
                table.temperature_t.push(t);
                table.temperature.push(celsius);
            }
        }
        let used = Role::ALL.into_iter().filter(|role| match role {
            Role::Time => true,
            Role::Accel(_) => !rows.accel.is_empty(),
            Role::Gyro(_) => !rows.gyro.is_empty(),
            Role::Temperature => !rows.temperature.is_empty(),
            Role::Field(_) => !rows.mag.is_empty(),
            Role::TimeOf(_) | Role::Device => false,
        });
        table.roles = used.map(|role| (role, role.name().to_owned())).collect();
        let mut recording = assemble(name.to_owned(), vec![table], &ReadOptions::default())?;
        recording.description.format = "arrays";
        Ok(recording)
    }

    /// The readings of a sensor of one dimension.
    pub fn scalar(&self, name: &str) -> Option<&ScalarStream> {
        self.scalars.iter().find(|own| own.name == name)
    }

    /// The same with the readings of a sensor of one dimension beside the others: `t` (s, `n`), readings (`n`) and the true signal at
    /// these stamps (`n`), or none.
    ///
    /// # Errors
    /// [`Error::Input`] for arrays of different lengths, a number that is not finite, time that does not go on, readings of which none lies
    /// within the recording, and a name that the recording has already.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::Recording;
    ///
    /// let recording = Recording::default().with_scalar("barometer", &[0.0, 0.1], &[101_300.0, 101_302.0], &[])?;
    /// assert_eq!(recording.scalars[0].values[1], 101_302.0);
    /// assert!(recording.with_scalar("barometer", &[0.0], &[0.0], &[]).is_err());
    /// # Ok::<(), stillpoint_recording::Error>(())
    /// ```
    pub fn with_scalar(
        mut self,
        name: &str,
        t: &[f64],
        readings: &[f64],
        truth: &[f64],
    ) -> Result<Self, Error> {
        if self.scalar(name).is_some() {
            let taken = Finding::of(Kind::NAME_TAKEN).detail("name", name);
            return Err(in_file(&self.name, taken));
        }
        let arrays = [("readings", readings.len()), ("truth", truth.len())];
        let given = |(array, len): &(&str, usize)| *array == "readings" || *len > 0;
        of_one_length(name, t.len(), arrays.into_iter().filter(given))?;
        for (array, values, column) in [("t", t, 1), ("readings", readings, 2), ("truth", truth, 3)]
        {
            for (k, &value) in values.iter().enumerate() {
                check(name, k, array, value, column)?;
            }
        }
        let (start, end) = (self.start(), self.end());
        if start < end && !t.iter().any(|t| (start..=end).contains(t)) {
            let outside = Finding::of(Kind::SCALAR_OUTSIDE)
                .detail("name", name)
                .number("from", start, "s")
                .number("to", end, "s");
            return Err(in_file(&self.name, outside));
        }
        if let Some(k) = t.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(goes_back(name, k as u64 + 2, t[k], t[k + 1]));
        }
        self.scalars.push(ScalarStream {
            name: name.to_owned(),
            t: t.to_vec(),
            values: readings.to_vec(),
            truth: truth.to_vec(),
        });
        Ok(self)
    }
}

impl Rows<'_> {
    fn check_lengths(&self, name: &str) -> Result<(), Error> {
        let arrays = [
            ("accel", self.accel.len()),
            ("gyro", self.gyro.len()),
            ("temperature", self.temperature.len()),
            ("mag", self.mag.len()),
        ];
        of_one_length(
            name,
            self.t.len(),
            arrays.into_iter().filter(|(_, len)| *len != 0),
        )?;
        if self.accel.is_empty() && self.gyro.is_empty() {
            return Err(in_file(name, Finding::of(Kind::ARRAYS_EMPTY)));
        }
        if self.t.len() < 2 {
            return Err(Error::not_enough(
                Finding::of(Kind::ONE_SAMPLE).in_file(name),
            ));
        }
        Ok(())
    }

    /// Both sensors as they come, in part: their numbers are checked, and that every stamp is later than the one before it, `last` at first.
    ///
    /// # Errors
    /// [`Error::Input`] for arrays of different lengths, a number that is not finite, or time that does not go on.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::Rows;
    ///
    /// let rows = Rows { t: &[0.5], accel: &[[0.0, 0.0, 9.8]], gyro: &[[0.0; 3]], ..Rows::default() };
    /// let [accelerometer, _] = rows.in_part("mine", None)?;
    /// assert_eq!(accelerometer.t, [0.5]);
    /// assert!(rows.in_part("mine", Some(0.5)).is_err());
    /// # Ok::<(), stillpoint_recording::Error>(())
    /// ```
    pub fn in_part(&self, name: &str, mut last: Option<f64>) -> Result<[Stream; 2], Error> {
        let arrays = [("accel", self.accel.len()), ("gyro", self.gyro.len())];
        of_one_length(name, self.t.len(), arrays.into_iter())?;
        for (k, &t) in self.t.iter().enumerate() {
            check(name, k, "t", t, 1)?;
            if let Some(last) = last.filter(|last| t <= *last) {
                return Err(goes_back(name, k as u64 + 1, last, t));
            }
            last = Some(t);
        }
        let sensors = [("accel", self.accel, 2), ("gyro", self.gyro, 5)];
        for (array, values, first) in sensors {
            for (k, value) in values.iter().enumerate() {
                for (axis, &v) in value.iter().enumerate() {
                    check(name, k, array, v, first + axis)?;
                }
            }
        }
        Ok(sensors.map(|(_, values, _)| Stream {
            t: self.t.to_vec(),
            values: values.iter().map(|v| Vector3::from(*v)).collect(),
        }))
    }

    fn samples(&self, name: &str, sensor: Sensor) -> Result<Samples, Error> {
        let (values, array, first) = match sensor {
            Sensor::Accelerometer => (self.accel, "accel", 2),
            Sensor::Gyroscope => (self.gyro, "gyro", 5),
            Sensor::Magnetometer => (self.mag, "mag", 9),
        };
        let zero = origin(self.t) as f64;
        let mut samples = Samples::with_room(values.len());
        for (k, (&t, value)) in self.t.iter().zip(values).enumerate() {
            check(name, k, "t", t, 1)?;
            for (axis, &v) in value.iter().enumerate() {
                check(name, k, array, v, first + axis)?;
            }
            let line = k as u64 + 1;
            if let Pushed::Backwards(last) = samples.push(t - zero, Vector3::from(*value), line) {
                return Err(goes_back(name, line, last + zero, t));
            }
        }
        Ok(samples)
    }
}

/// Refuses an array that is not as long as the stamps.
fn of_one_length(
    name: &str,
    stamps: usize,
    mut arrays: impl Iterator<Item = (&'static str, usize)>,
) -> Result<(), Error> {
    let Some((array, len)) = arrays.find(|(_, len)| *len != stamps) else {
        return Ok(());
    };
    let lengths = Finding::of(Kind::ARRAY_LENGTHS)
        .detail("array", array)
        .count("rows", len)
        .count("stamps", stamps);
    Err(in_file(name, lengths))
}

/// Returns the origin that is subtracted from every stamp, as readers of text do: the whole seconds of an epoch.
fn origin(t: &[f64]) -> i64 {
    match t.first() {
        Some(&first) if first.is_finite() && first.abs() >= 1e9 => first as i64,
        _ => 0,
    }
}

/// Time goes from `last` back to `t`.
fn goes_back(name: &str, line: u64, last: f64, t: f64) -> Error {
    let back = Finding::of(Kind::TIME_GOES_BACK)
        .detail("from", figure(last))
        .detail("to", figure(t))
        .only_remedies([Remedy::SortRows, Remedy::Split]);
    at_line(name, line, back)
}

fn check(name: &str, row: usize, array: &str, value: f64, column: usize) -> Result<(), Error> {
    if value.is_finite() && value.abs() < LARGEST.get() {
        return Ok(());
    }
    let found = Finding::of(Kind::ARRAY_NOT_FINITE)
        .detail("array", array)
        .detail("value", figure(value));
    Err(at_column(name, row as u64 + 1, column, found))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_of_a_scalar_that_do_not_fit_are_refused_with_their_row() {
        let said = |t: &[f64], readings: &[f64], truth: &[f64]| {
            let with = Recording::default().with_scalar("barometer", t, readings, truth);
            with.unwrap_err().to_string()
        };
        let short = said(&[0.0, 1.0], &[1.0], &[]);
        assert!(short.contains("readings has 1 row, t has 2"), "{short}");
        let back = said(&[0.0, 0.0], &[1.0, 1.0], &[]);
        assert!(back.starts_with("barometer:2"), "{back}");
        let infinite = said(&[0.0], &[f64::INFINITY], &[]);
        assert!(infinite.starts_with("barometer:1:2"), "{infinite}");
        let truth = said(&[0.0, 1.0], &[1.0, 1.0], &[1.0]);
        assert!(truth.contains("truth has 1 row"), "{truth}");
    }
}
