//! The parameters that a flight controller had in force while it logged: offset and scale of each axis.

use std::collections::HashMap;

use calib::calibration::{Readings, system_name};
use findings::{Finding, Kind};
use nalgebra::{Matrix3, Vector3};
use sensor::{Base, Sensor};

use crate::error::Error;
use crate::source::{AXES, Source, diagonal};
use crate::target::Settings;

/// Parameter names of one sensor in a flight controller.
pub(super) struct Names {
    /// Pattern of the offset names, such as `CAL_ACC0_{axis}OFF`.
    pub offset: String,
    /// The same of the scale factors; a gyroscope has none.
    pub scale: Option<String>,
}

/// A flight controller that replaces its parameters by those of the export.
pub(super) struct Controller {
    /// Name of the target, which is also the name in a calibration for corrections applied before.
    pub system: &'static str,
    /// Parameters that turn the readings after the correction: each must be absent or at most 0.
    pub turning: Vec<String>,
    /// Source of uncorrected logs, for the advice to the user.
    pub raw: &'static str,
}

impl Controller {
    /// A calibration of a sensor for what the sensor itself reads: `base` where its readings were those, else on top of the
    /// parameters that were in force.
    ///
    /// # Errors
    /// Parameters that are missing where they are needed, or given where the readings are those of the sensor.
    pub fn for_raw(
        &self,
        source: &Source<'_>,
        (sensor, base): (Sensor, &Base<f64>),
        names: &Names,
        settings: &Settings,
    ) -> Result<Base<f64>, Error> {
        let in_force = settings.logged_with.as_deref();
        let readings = source.calibration.readings(sensor);
        match (readings, in_force) {
            (Readings::CorrectedBy(by) | Readings::Mixed(by), None) if by == self.system => {
                let found = Finding::of(Kind::CORRECTED_IN_FORCE)
                    .detail("system", system_name(by))
                    .detail("of", sensor.name());
                Err(Error::settings(found.detail("raw", self.raw)))
            }
            (Readings::Mixed(by), Some(_)) => {
                let [corrected, others] = source.calibration.corrected_by(sensor, by);
                let found = Finding::of(Kind::CORRECTED_PARTLY)
                    .detail("system", system_name(by))
                    .detail("corrected", corrected);
                Err(Error::settings(found.detail("others", others)))
            }
            (Readings::Restored { by }, Some(_)) => {
                let found = Finding::of(Kind::CORRECTION_TAKEN_OFF);
                let found = found.detail("system", system_name(by));
                Err(Error::settings(found.detail("of", sensor.name())))
            }
            (_, Some(text)) => self.on_top(base, names, &parameters(text)?),
            (_, None) => Ok(*base),
        }
    }

    /// `d (s (raw − o) − b) = s d (raw − (o + b / s))`.
    fn on_top(
        &self,
        base: &Base<f64>,
        names: &Names,
        in_force: &HashMap<String, f64>,
    ) -> Result<Base<f64>, Error> {
        if let Some(name) = self
            .turning
            .iter()
            .find(|name| in_force.get(*name).is_some_and(|v| *v > 0.0))
        {
            let found = Finding::of(Kind::READINGS_TURNED).detail("parameter", name);
            return Err(Error::settings(found.detail("raw", self.raw)));
        }
        let value = |pattern: &str, axis: &str| {
            let name = pattern.replace("{axis}", axis);
            let found = in_force.get(&name).copied();
            found.ok_or_else(|| {
                let found = Finding::of(Kind::PARAMETER_MISSING);
                Error::settings(found.detail("parameter", name))
            })
        };
        let [x, y, z] = AXES.map(|axis| value(&names.offset, axis));
        let offset = Vector3::new(x?, y?, z?);
        let scale = match &names.scale {
            Some(pattern) => {
                let [x, y, z] = AXES.map(|axis| value(pattern, axis));
                Vector3::new(x?, y?, z?)
            }
            None => Vector3::repeat(1.0),
        };
        // ArduPilot writes 0 where nothing was calibrated.
        let scale = scale.map(|s| if s == 0.0 { 1.0 } else { s });
        Ok(Base {
            t: diagonal(&base.t) * Matrix3::from_diagonal(&scale),
            bias: offset + base.bias.component_div(&scale),
        })
    }

    /// The line that says that both are in it.
    pub fn remark(settings: &Settings) -> &'static str {
        match settings.logged_with {
            Some(_) => {
                "# put together with the parameters that were in force: for what the sensors themselves read\n"
            }
            None => "",
        }
    }

    /// Returns true if neither the calibration nor the settings state whether the readings were corrected.
    pub fn is_unknown(source: &Source<'_>, settings: &Settings) -> bool {
        let sensors = [Sensor::Accelerometer, Sensor::Gyroscope].into_iter();
        let there = sensors.filter(|sensor| source.calibration.triad(*sensor).is_some());
        let mut readings = there.map(|sensor| source.calibration.readings(sensor));
        settings.logged_with.is_none() && readings.any(|readings| readings == Readings::NotStated)
    }
}

/// Values by name, a line each: `NAME,VALUE`, `NAME VALUE` or `NAME=VALUE`, or the five columns of QGroundControl; `#` begins a
/// comment.
fn parameters(text: &str) -> Result<HashMap<String, f64>, Error> {
    let mut all = HashMap::new();
    for (k, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words = line
            .split([',', ' ', '\t', '=', '\r'])
            .filter(|word| !word.is_empty());
        let words: Vec<&str> = words.collect();
        let pair = match words[..] {
            [] => continue,
            [_, _, name, value, _] => (name, Some(value)),
            [name, value, ..] => (name, Some(value)),
            [name] => (name, None),
        };
        let value = pair
            .1
            .and_then(|v| v.parse().ok())
            .filter(|v: &f64| v.is_finite());
        let value = value
            .ok_or_else(|| Error::input(Finding::of(Kind::PARAMETER_LINE).count("line", k + 1)))?;
        all.insert(pair.0.to_owned(), value);
    }
    Ok(all)
}
