//! Kalibr's `imu.yaml`.

use calib::Calibration;
use nalgebra::{Matrix3, Vector3};
use saphyr::{LoadableYamlNode as _, Yaml};
use sensor::Base;

use super::calibration;
use crate::error::Error;

/// A file larger than this is no calibration, bytes.
const LARGEST: usize = 1 << 20;

/// A calibration of Kalibr (scale-misalignment): `a_m = M_a a + b`, `w_m = M_g C w + A C a + b` as
/// `T_a = M_a⁻¹`, `T_g = (M_g C)⁻¹`, `G = T_g A C`; the biases are not in the file.
///
/// # Errors
/// No YAML, a missing or misshapen matrix, and one without inverse.
pub fn kalibr(text: &str) -> Result<Calibration, Error> {
    let input = |place: &str, what: String| Error::Input {
        place: place.into(),
        what,
    };
    if text.len() > LARGEST {
        return Err(input("", "a file of over 1 MB is no imu.yaml".into()));
    }
    let documents = Yaml::load_from_str(text).map_err(|e| {
        let at = format!(
            "line {}, column {}: ",
            e.marker().line(),
            e.marker().col() + 1
        );
        input(&at, format!("no YAML: {}", e.info()))
    })?;
    let root = documents.first();
    let root = root.ok_or_else(|| input("", "the file is empty".into()))?;
    // A result has the IMUs under imu0, imu1 …; a configuration has one at the top.
    let root = root.as_mapping_get("imu0").unwrap_or(root);
    let matrix = |sensor: &str, key: &str| {
        let place = format!("{sensor}.{key}: ");
        let found = root
            .as_mapping_get(sensor)
            .and_then(|s| s.as_mapping_get(key));
        let found = found.ok_or_else(|| {
            let what = "missing; an imu.yaml of Kalibr's model scale-misalignment has it";
            input(&place, what.into())
        })?;
        rows(found).ok_or_else(|| input(&place, "three rows of three numbers expected".into()))
    };
    let inverse = |m: Matrix3<f64>, place: &str| {
        let singular = || input(place, "the matrix has no inverse".into());
        m.try_inverse().ok_or_else(singular)
    };
    let m_a = matrix("accelerometers", "M")?;
    let (m_g, a) = (matrix("gyroscopes", "M")?, matrix("gyroscopes", "A")?);
    let c = matrix("gyroscopes", "C_gyro_i")?;
    let t_a = inverse(m_a, "accelerometers.M: ")?;
    let t_g = inverse(m_g * c, "gyroscopes.M: ")?;
    let g = t_g * a * c;
    let of = |t: Matrix3<f64>| Base {
        t,
        bias: Vector3::zeros(),
    };
    let warnings = vec![
        "imported from Kalibr: it states no errors, and its file has no biases (they are 0 here); `stillpoint bias` estimates \
         them from a recording"
            .to_owned(),
    ];
    Ok(calibration(
        "kalibr",
        &of(t_a),
        &of(t_g),
        Some(&g),
        warnings,
    ))
}

fn rows(value: &Yaml<'_>) -> Option<Matrix3<f64>> {
    let number = |v: &Yaml<'_>| {
        let number = v.as_floating_point().or(v.as_integer().map(|i| i as f64));
        number.filter(|v| v.is_finite())
    };
    let row = |v: &Yaml<'_>| -> Option<Vec<f64>> {
        let all: Option<Vec<f64>> = v.as_vec()?.iter().map(number).collect();
        all.filter(|row| row.len() == 3)
    };
    let all: Option<Vec<Vec<f64>>> = value.as_vec()?.iter().map(row).collect();
    let all = all.filter(|rows| rows.len() == 3)?;
    Some(Matrix3::from_fn(|i, j| all[i][j]))
}
