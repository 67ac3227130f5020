//! Calibration to export, with its sensor models and checks of the requirements of a target.

use calib::Calibration;
use calib::calibration::{Readings, TriadUnits, system_name};
use calib::effects::force_sensitivity;
use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use sensor::{Base, Sensor};

use crate::error::Error;

/// A calibration ready to be written.
#[derive(Clone, Debug)]
pub struct Source<'a> {
    /// Calibration as read from its file.
    pub calibration: &'a Calibration,
    /// The accelerometer.
    pub accelerometer: Option<Base<f64>>,
    /// The gyroscope.
    pub gyroscope: Option<Base<f64>>,
    /// The magnetometer.
    pub magnetometer: Option<Base<f64>>,
    /// `G`, (rad/s)/(m/s²), where the calibration has it.
    pub g_sensitivity: Option<Matrix3<f64>>,
}

impl<'a> Source<'a> {
    /// Builds the source from a calibration.
    pub fn new(calibration: &'a Calibration) -> Self {
        let base = |sensor| calibration.triad(sensor).map(|triad| triad.base());
        let own = calibration.effects.iter();
        let sensitivity = force_sensitivity();
        let own = own.filter(|e| e.name == sensitivity.name() && e.parameters.len() == 9);
        let matrix = |e: &calib::calibration::EffectValues| {
            Matrix3::from_fn(|i, j| e.parameters[3 * i + j].value)
        };
        Self {
            calibration,
            accelerometer: base(Sensor::Accelerometer),
            gyroscope: base(Sensor::Gyroscope),
            magnetometer: base(Sensor::Magnetometer),
            g_sensitivity: own.map(matrix).next(),
        }
    }

    /// Returns false if the bias of a sensor is not known, and zero stands for it: the tool that the calibration was imported from states
    /// none.
    pub fn knows_bias(&self, sensor: Sensor) -> bool {
        let triad = self.calibration.triad(sensor);
        triad.is_none_or(|triad| {
            triad.bias != [0.0; 3] || triad.bias_std.iter().any(Option::is_some)
        })
    }

    /// A remark about biases that are not known.
    pub(crate) fn without_biases(&self) -> Option<Finding> {
        let unknown = Sensor::ALL
            .into_iter()
            .filter(|sensor| !self.knows_bias(*sensor));
        let unknown: Vec<&str> = unknown.map(Sensor::name).collect();
        let found = Finding::of(Kind::BIAS_UNKNOWN).detail("sensors", unknown.join(" and the "));
        (!unknown.is_empty()).then_some(found)
    }

    /// Unit of a corrected magnetic field.
    pub fn field_unit(&self) -> &str {
        let field = self.calibration.magnetic_field.as_ref();
        field.map_or("uT", |field| field.unit.as_str())
    }

    /// The sensors that are calibrated.
    pub fn bases(&self) -> impl Iterator<Item = (Sensor, &Base<f64>)> {
        let all = Sensor::ALL.into_iter();
        all.filter_map(|sensor| Some((sensor, self.base(sensor)?)))
    }

    fn base(&self, sensor: Sensor) -> Option<&Base<f64>> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_ref(),
            Sensor::Gyroscope => self.gyroscope.as_ref(),
            Sensor::Magnetometer => self.magnetometer.as_ref(),
        }
    }

    /// The base model of a sensor that a target cannot do without.
    ///
    /// # Errors
    /// [`Error::Lacks`].
    pub fn needs(&self, sensor: Sensor, target: &'static str) -> Result<&Base<f64>, Error> {
        let what = sensor.name();
        self.base(sensor).ok_or(Error::Lacks { target, what })
    }

    /// Refuses readings in another unit than m/s² and rad/s: the target corrects those.
    ///
    /// # Errors
    /// [`Error::Format`].
    pub fn needs_si(&self, target: &'static str) -> Result<(), Error> {
        for (sensor, si) in [
            (Sensor::Accelerometer, "m/s^2"),
            (Sensor::Gyroscope, "rad/s"),
        ] {
            let unit = self.unit(sensor);
            if let Some(unit) = unit.filter(|unit| unit != si) {
                let found = Finding::of(Kind::EXPORT_UNIT)
                    .detail("target", target)
                    .detail("of", sensor.name())
                    .detail("unit", unit);
                return Err(Error::format(found.detail("si", si)));
            }
        }
        Ok(())
    }

    /// Refuses axes with a negative scale factor: the target multiplies by a positive one, or by none.
    ///
    /// # Errors
    /// [`Error::Flipped`].
    pub fn needs_signs(&self, target: &'static str) -> Result<(), Error> {
        let sensors = [
            ("accelerometer", ["ax", "ay", "az"], &self.accelerometer),
            ("gyroscope", ["gx", "gy", "gz"], &self.gyroscope),
        ];
        for (sensor, names, base) in sensors {
            let Some(base) = base else { continue };
            let scale = base.t.diagonal();
            let flipped: Vec<usize> = (0..3).filter(|&axis| scale[axis] < 0.0).collect();
            if let [first, ..] = flipped[..] {
                let flip: Vec<&str> = flipped.iter().map(|&axis| names[axis]).collect();
                return Err(Error::Flipped {
                    target,
                    sensor,
                    axis: AXES[first],
                    value: scale[first],
                    flip: flip.join(","),
                });
            }
        }
        Ok(())
    }

    /// The unit of a sensor's readings.
    pub fn unit(&self, sensor: Sensor) -> Option<String> {
        let triad = self.calibration.triad(sensor)?;
        Some(TriadUnits::of(sensor, triad.base().scale()).reading)
    }

    /// The sensors whose readings a system had corrected before the calibration, with the system.
    fn corrected_before(&self) -> Vec<(Sensor, &str)> {
        let corrected = |sensor: Sensor| {
            self.calibration.triad(sensor)?;
            match self.calibration.readings(sensor) {
                Readings::CorrectedBy(by) | Readings::Mixed(by) => Some((sensor, by)),
                Readings::NotStated | Readings::Restored { .. } => None,
            }
        };
        Sensor::ALL.into_iter().filter_map(corrected).collect()
    }

    /// A remark where a system other than the target had corrected the readings before: `target` itself replaces what it
    /// had applied.
    pub(crate) fn on_top_of(&self, target: &str) -> Option<Finding> {
        let before: Vec<(Sensor, &str)> = self.corrected_before();
        let others: Vec<_> = before.into_iter().filter(|(_, by)| *by != target).collect();
        let (_, by) = *others.first()?;
        let sensors: Vec<&str> = others
            .iter()
            .filter(|(_, other)| *other == by)
            .map(|(s, _)| s.name())
            .collect();
        let found = Finding::of(Kind::ON_TOP_OF).detail("system", system_name(by));
        Some(found.detail("sensors", sensors.join(" and the ")))
    }

    /// Returns the provenance as comment lines that begin with `mark`: printable ASCII without characters that could
    /// end a comment in any language.
    pub fn provenance(&self, mark: &str) -> String {
        let calibration = self.calibration;
        let mut lines = vec![
            format!("IMU calibration, written by {}", calibration.created_by),
            format!(
                "method {}, gravity {} m/s^2",
                calibration.method, calibration.gravity
            ),
        ];
        for (sensor, by) in self.corrected_before() {
            lines.push(format!(
                "on top of what {} had applied to the readings of the {} before",
                system_name(by),
                sensor.name()
            ));
        }
        if calibration.edited().is_some() {
            lines.push("EDITED since the calibration was written".into());
        }
        if let Some(hash) = &calibration.provenance.numbers_sha256 {
            lines.push(format!("numbers_sha256 {hash}"));
        }
        for input in &calibration.provenance.inputs {
            lines.push(format!(
                "from {}, samples_sha256 {}",
                input.recording, input.samples_sha256
            ));
        }
        let commented = |line: &String| format!("{mark} {}\n", plain(line));
        lines.iter().map(commented).collect()
    }
}

/// Printable ASCII but for `*`, `/`, backslashes and quotes, at most 160 characters.
fn plain(line: &str) -> String {
    let kept = |c: char| match c {
        ' '..='~' if !"*\\\"'`".contains(c) => c,
        _ => '_',
    };
    line.chars().take(160).map(kept).collect()
}

/// The elements of a matrix, row by row.
pub(crate) fn rows(m: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|k| m[(k / 3, k % 3)])
}

/// A matrix of the diagonal alone.
pub(crate) fn diagonal(m: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal(&m.diagonal())
}

/// The axes by name.
pub(crate) const AXES: [&str; 3] = ["X", "Y", "Z"];

/// A vector's numbers with their axes.
pub(crate) fn by_axis(v: Vector3<f64>) -> impl Iterator<Item = (&'static str, f64)> {
    AXES.into_iter().zip([v.x, v.y, v.z])
}
