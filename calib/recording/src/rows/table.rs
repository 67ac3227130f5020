//! Content of one text, in its own units.

use findings::{Finding, Findings, Kind};
use sensor::Sensor;

use crate::Error;
use crate::clock::Clock;
use crate::devices::labels::Labels;
use crate::header::affine::Affine;
use crate::recording::line_numbers::LineNumbers;
use crate::recording::options::Role;
use crate::recording::samples::Samples;
use crate::source::place::in_file;
use crate::units::Stated;

/// Content of one text, in its own units.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// The file, for messages.
    pub name: String,
    /// Accelerometer.
    pub accel: Samples,
    /// Gravity, until it is added to what the accelerometer's columns hold.
    pub gravity: Samples,
    /// Gyroscope.
    pub gyro: Samples,
    /// Magnetometer.
    pub magnetometer: Samples,
    /// Stamps of temperature readings.
    pub temperature_t: Vec<f64>,
    /// Temperature readings.
    pub temperature: Vec<f64>,
    /// Their lines.
    pub temperature_lines: LineNumbers,
    /// Columns that may name the device of a row.
    pub labels: Labels,
    /// Lines on which its header comes again.
    pub headers: Vec<u64>,
    /// The line of its header.
    pub header_line: u64,
    /// Units in the header.
    pub stated: Stated,
    /// Unknown units that the header states for the accelerometer and for the gyroscope.
    pub strange: [Option<String>; 2],
    /// The name of the time column is `t`: seconds, by contract.
    pub plain_time: bool,
    /// Names of columns that no sensor is read from.
    pub unused: Vec<String>,
    /// Names of those of them whose numbers change.
    pub unclear: Vec<String>,
    /// Names of all columns.
    pub names: Vec<String>,
    /// Roles of the columns come from their names, not from a format or the user.
    pub by_names: bool,
    /// Column of each role, by name or number.
    pub roles: Vec<(Role, String)>,
    /// It has a time column.
    pub has_time: bool,
    /// The user's scale and offset for the stamps.
    pub time_affine: Option<Affine>,
    /// Its clock.
    pub clock: Clock,
    /// The accelerometer reads -1 g on the axis that points up.
    pub negated: bool,
    /// The system that had corrected the readings before.
    pub corrected_by: Option<&'static str>,
    /// Warnings from reading.
    pub warnings: Findings,
}

impl Table {
    /// True for readings of an accelerometer or a gyroscope.
    pub fn has_sensor(&self) -> bool {
        !self.accel.t.is_empty() || !self.gyro.t.is_empty()
    }

    /// The samples of a sensor.
    pub fn samples_mut(&mut self, sensor: Sensor) -> &mut Samples {
        match sensor {
            Sensor::Accelerometer => &mut self.accel,
            Sensor::Gyroscope => &mut self.gyro,
            Sensor::Magnetometer => &mut self.magnetometer,
        }
    }

    /// The samples of the accelerometer or of the gyroscope, whichever has more.
    pub fn longer(&self) -> &Samples {
        match self.accel.t.len() >= self.gyro.t.len() {
            true => &self.accel,
            false => &self.gyro,
        }
    }

    /// The stamps of everything in it.
    pub fn stamps_mut(&mut self) -> [&mut Vec<f64>; 4] {
        [
            &mut self.accel.t,
            &mut self.gyro.t,
            &mut self.magnetometer.t,
            &mut self.temperature_t,
        ]
    }

    /// Leaves out the rows on other lines than those that `keeps` is true of.
    pub fn keep_lines(&mut self, keeps: impl Fn(u64) -> bool) {
        for samples in [&mut self.accel, &mut self.gyro, &mut self.magnetometer] {
            *samples = samples.on_lines(&keeps);
        }
        let (t, celsius) = (&self.temperature_t, &self.temperature);
        let mut kept = (Vec::new(), Vec::new(), LineNumbers::default());
        for (i, (t, celsius)) in t.iter().zip(celsius).enumerate() {
            let line = self.temperature_lines.of(i);
            if keeps(line) {
                kept.2.push(kept.0.len(), line);
                kept.0.push(*t);
                kept.1.push(*celsius);
            }
        }
        (self.temperature_t, self.temperature, self.temperature_lines) = kept;
    }

    /// True where no stamp is earlier than one before it.
    pub fn ascends(&self) -> bool {
        let samples = [&self.accel.t, &self.gyro.t, &self.magnetometer.t];
        let mut all = samples.into_iter().chain([&self.temperature_t]);
        all.all(|t| t.windows(2).all(|pair| pair[0] <= pair[1]))
    }

    /// True where rows that are earlier than others only say again what is there.
    pub fn repeats(&self) -> bool {
        let samples = [&self.accel, &self.gyro, &self.magnetometer];
        samples
            .into_iter()
            .all(|samples| samples.clone().in_order().is_ok())
    }

    /// The lines of the rows that hold a reading, with their stamps, in the order of the text.
    pub fn stamped_lines(&self) -> Vec<(u64, f64)> {
        let sensors = [&self.accel, &self.gyro, &self.magnetometer];
        let of = |samples: &Samples| {
            let lines = (0..samples.t.len()).map(|i| (samples.line(i), samples.t[i]));
            lines.collect::<Vec<_>>()
        };
        let temperature = self.temperature_t.iter().enumerate();
        let mut all: Vec<(u64, f64)> = sensors.into_iter().flat_map(of).collect();
        all.extend(temperature.map(|(i, t)| (self.temperature_lines.of(i), *t)));
        all.sort_by_key(|(line, _)| *line);
        all.dedup_by_key(|(line, _)| *line);
        all
    }

    /// Stamps that count the rows there are.
    pub fn count_rows(&mut self, rate: f64) {
        let lines: Vec<u64> = self
            .stamped_lines()
            .into_iter()
            .map(|(line, _)| line)
            .collect();
        self.restamp(|line, _| lines.partition_point(|other| *other < line) as f64 / rate);
    }

    /// Other stamps in place of those there are, by line and stamp.
    pub fn restamp(&mut self, stamp: impl Fn(u64, f64) -> f64) {
        for samples in [&mut self.accel, &mut self.gyro, &mut self.magnetometer] {
            for i in 0..samples.t.len() {
                samples.t[i] = stamp(samples.line(i), samples.t[i]);
            }
        }
        for (i, t) in self.temperature_t.iter_mut().enumerate() {
            *t = stamp(self.temperature_lines.of(i), *t);
        }
    }

    /// Leaves out what a file of one sensor holds of the other.
    pub fn keep_only(&mut self, sensor: Sensor) -> Result<(), Error> {
        let (kept, other, role) = match sensor {
            Sensor::Accelerometer => (&self.accel, &mut self.gyro, "ax, ay, az"),
            Sensor::Gyroscope => (&self.gyro, &mut self.accel, "gx, gy, gz"),
            // A magnetometer's file is read with all that it holds.
            Sensor::Magnetometer => return Ok(()),
        };
        if kept.t.is_empty() {
            return Err(in_file(
                &self.name,
                Finding::of(Kind::OTHER_SENSOR).detail("columns", role),
            ));
        }
        *other = Samples::default();
        Ok(())
    }
}
