//! Kalibr's `imu.yaml`, and that of the crate imu-calib, which adds the biases.

use calib::Calibration;
use calib::recording::shown::shown;
use findings::{Finding, Findings, Kind};
use nalgebra::{Matrix3, Vector3};
use saphyr::{LoadableYamlNode as _, Yaml};
use sensor::Base;

use super::calibration;
use super::yaml::{matrix_of, number_list};
use crate::error::Error;

/// A file larger than this is no calibration, bytes.
const LARGEST: usize = 1 << 20;

/// Kalibr's models of an IMU.
const CALIBRATED: &str = "calibrated";
const SCALE_MISALIGNMENT: &str = "scale-misalignment";
const SIZE_EFFECT: &str = "scale-misalignment-size-effect";

/// Largest deviation of `C Cᵀ` from the identity for a rotation written with few digits.
const NO_ROTATION: f64 = 1e-3;

/// A calibration of Kalibr: `a_m = M_a a + b_a`, `w_m = M_g C w + A C a + b_g` as `T_a = M_a⁻¹`, `T_g = (M_g C)⁻¹`,
/// `G = T_g A C`. Kalibr itself writes no biases; imu-calib writes them as `b` beside `M`.
///
/// # Errors
/// No YAML, an unknown model, a missing or misshapen matrix, and one without inverse.
///
/// # Examples
/// ```
/// let yaml = "imu0:\n  model: calibrated\n  accelerometers:\n    M: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n    b: [0.1, 0.2, 0.3]\n";
/// let calibration = stillpoint_exchange::import::kalibr(yaml)?;
/// assert_eq!(calibration.accelerometer.map(|a| a.bias), Some([0.1, 0.2, 0.3]));
/// # Ok::<(), stillpoint_exchange::Error>(())
/// ```
pub fn kalibr(text: &str) -> Result<Calibration, Error> {
    if text.len() > LARGEST {
        let found = Finding::of(Kind::IMPORT_TOO_LARGE);
        return Err(Error::input(found.count("limit", LARGEST)));
    }
    let text = text.trim_start_matches('\u{feff}');
    let documents = Yaml::load_from_str(text).map_err(|e| {
        let found = Finding::of(Kind::NO_YAML)
            .at_line(e.marker().line() as u64)
            .at_column(e.marker().col() as u64 + 1);
        Error::input(found.detail("reason", e.info()))
    })?;
    let root = documents
        .first()
        .ok_or_else(|| Error::input(Finding::of(Kind::IMPORT_EMPTY)))?;
    let mut warnings = Findings::new();
    let imu = Imu::first_of(root, &mut warnings)?;
    let model = imu.model()?;
    let accelerometer = imu.accelerometer(model)?;
    let gyroscope = imu.gyroscope(model)?;
    if accelerometer.is_none() && gyroscope.is_none() {
        return Err(Error::input(Finding::of(Kind::NO_SENSORS_STATED)));
    }
    warnings.extend(imu.unread());
    if model == SIZE_EFFECT {
        let places = Finding::of(Kind::PLACES_NOT_READ);
        warnings.push(places.detail("entries", "rx_i, ry_i, rz_i"));
    }
    warnings.extend(imu.worth(accelerometer.is_some(), gyroscope.is_some()));
    let (rates, g) = gyroscope.unzip();
    let calibration = calibration(
        "kalibr",
        accelerometer.as_ref(),
        rates.as_ref(),
        g.as_ref(),
        warnings,
    );
    Ok(calibration)
}

/// The tool, as findings call it.
const TOOL: &str = "Kalibr";

/// One IMU of the file.
struct Imu<'a> {
    root: &'a Yaml<'a>,
}

/// A sensor's entry and the keys of it that are read.
const SENSORS: [(&str, &[&str]); 2] = [
    ("accelerometers", &["M", "b", "rx_i", "ry_i", "rz_i"]),
    ("gyroscopes", &["M", "A", "C_gyro_i", "b"]),
];

impl<'a> Imu<'a> {
    /// The first: a result has them under imu0, imu1 …; a configuration has one at the top.
    fn first_of(root: &'a Yaml<'a>, warnings: &mut Findings) -> Result<Self, Error> {
        let Some(entries) = root.as_mapping() else {
            return Err(Error::input(Finding::of(Kind::NO_ENTRIES)));
        };
        let names = entries.keys().filter_map(Yaml::as_str);
        let is_imu = |name: &&str| {
            name.strip_prefix("imu")
                .is_some_and(|k| k.parse::<u32>().is_ok())
        };
        let mut names: Vec<&str> = names.filter(is_imu).collect();
        names.sort_unstable();
        let Some(first) = names.first() else {
            return Ok(Self { root });
        };
        if names.len() > 1 {
            let first = Finding::of(Kind::FIRST_IMU_TAKEN);
            warnings.push(first.detail("units", names.join(", ")));
        }
        let root = root.as_mapping_get(first).unwrap_or(root);
        Ok(Self { root })
    }

    fn model(&self) -> Result<&'static str, Error> {
        let Some(model) = self.root.as_mapping_get("model") else {
            return Ok(SCALE_MISALIGNMENT);
        };
        let known = [CALIBRATED, SCALE_MISALIGNMENT, SIZE_EFFECT];
        let found = model
            .as_str()
            .and_then(|own| known.into_iter().find(|known| *known == own));
        found.ok_or_else(|| {
            let own = model.as_str().unwrap_or_default();
            let found = Finding::of(Kind::MODEL_UNKNOWN).detail("found", shown(own));
            Error::input(found.detail("known", known.join(", ")))
        })
    }

    /// `M_a⁻¹` and the bias.
    fn accelerometer(&self, model: &str) -> Result<Option<Base<f64>>, Error> {
        let Some(sensor) = self.root.as_mapping_get("accelerometers") else {
            return Ok(None);
        };
        let m = entry(sensor, "accelerometers", "M", model)?;
        Ok(Some(Base {
            t: inverse(m, "accelerometers.M")?,
            bias: bias(sensor, "accelerometers")?,
        }))
    }

    /// `(M_g C)⁻¹` and the bias, and `G`.
    fn gyroscope(&self, model: &str) -> Result<Option<WithSensitivity>, Error> {
        let name = "gyroscopes";
        let Some(sensor) = self.root.as_mapping_get(name) else {
            return Ok(None);
        };
        let m = entry(sensor, name, "M", model)?;
        let c = entry(sensor, name, "C_gyro_i", model)?;
        let a = match sensor.as_mapping_get("A") {
            None if model == CALIBRATED => Matrix3::zeros(),
            _ => entry(sensor, name, "A", model)?,
        };
        if (c * c.transpose() - Matrix3::identity()).amax() > NO_ROTATION || c.determinant() < 0.0 {
            return Err(of_entry(Kind::NO_ROTATION, "gyroscopes.C_gyro_i"));
        }
        let t = inverse(m * c, "gyroscopes.M")?;
        let base = Base {
            t,
            bias: bias(sensor, name)?,
        };
        Ok(Some((base, t * a * c)))
    }

    /// Returns the warnings about the import: no standard errors, and sensors without a bias.
    fn worth(&self, has_force: bool, has_rate: bool) -> Vec<Finding> {
        let there = [has_force, has_rate];
        let without = SENSORS.iter().zip(there).filter(|((name, _), there)| {
            let sensor = self.root.as_mapping_get(name);
            *there && sensor.is_none_or(|sensor| sensor.as_mapping_get("b").is_none())
        });
        let without: Vec<&str> = without.map(|((name, _), _)| *name).collect();
        let of = |kind: Kind| Finding::of(kind).detail("tool", TOOL);
        let mut worth = vec![of(Kind::ERRORS_NOT_STATED)];
        if !without.is_empty() {
            let sensors = without.join(" and ");
            worth.push(of(Kind::BIAS_NOT_STATED).detail("sensors", sensors));
        }
        worth
    }

    /// Returns a warning for each entry of a sensor that the import does not know.
    fn unread(&self) -> Vec<Finding> {
        let mut said = Vec::new();
        for (name, known) in SENSORS {
            let entries = self.root.as_mapping_get(name).and_then(Yaml::as_mapping);
            let keys = entries
                .into_iter()
                .flat_map(|e| e.keys())
                .filter_map(Yaml::as_str);
            for key in keys.filter(|key| !known.contains(key)) {
                let shown: String = key.chars().take(40).filter(|c| !c.is_control()).collect();
                said.push(
                    Finding::of(Kind::ENTRY_UNKNOWN)
                        .detail("tool", TOOL)
                        .detail("entry", format!("{name}.{shown}")),
                );
            }
        }
        said
    }
}

/// A matrix of a sensor. What Kalibr's model `calibrated` leaves out is the identity.
fn entry(sensor: &Yaml<'_>, name: &str, key: &str, model: &str) -> Result<Matrix3<f64>, Error> {
    let place = format!("{name}.{key}");
    match sensor.as_mapping_get(key) {
        Some(found) => matrix_of(found).ok_or_else(|| of_entry(Kind::MATRIX_EXPECTED, place)),
        None if model == CALIBRATED => Ok(Matrix3::identity()),
        None => {
            let found = Finding::of(Kind::ENTRY_MISSING).detail("entry", place);
            Err(Error::input(found.detail("model", model)))
        }
    }
}

/// The bias of a sensor, 0 where the file has none.
fn bias(sensor: &Yaml<'_>, name: &str) -> Result<Vector3<f64>, Error> {
    let Some(found) = sensor.as_mapping_get("b") else {
        return Ok(Vector3::zeros());
    };
    let three = number_list(found).filter(|all| all.len() == 3);
    let three = three.ok_or_else(|| of_entry(Kind::VECTOR_EXPECTED, format!("{name}.b")))?;
    Ok(Vector3::from_column_slice(&three))
}

fn inverse(m: Matrix3<f64>, place: &str) -> Result<Matrix3<f64>, Error> {
    m.try_inverse()
        .ok_or_else(|| of_entry(Kind::ENTRY_SINGULAR, place))
}

fn of_entry(kind: Kind, entry: impl Into<String>) -> Error {
    Error::input(Finding::of(kind).detail("entry", entry))
}

/// A gyroscope's base model and its g-sensitivity, (rad/s)/(m/s²).
type WithSensitivity = (Base<f64>, Matrix3<f64>);
