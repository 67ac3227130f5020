//! Kalibr: `imu.yaml` of the scale-misalignment model.

use std::fmt::Write as _;

use calib::noise::{NoiseTerm, SensorNoise};
use findings::{Finding, Kind};
use nalgebra::{Matrix3, Rotation3};
use sensor::Sensor;

use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written, matrix_alone};

/// Kalibr's model is of the readings: `a_m = M_a a_i + b`, `w_m = M_g C_gyro_i w_i + A C_gyro_i a_i + b` with `M_a`, `M_g`
/// lower triangular and the frame `i` that makes `M_a` so (`addAccelerometerErrorTerms` and `addGyroscopeErrorTerms` of
/// `IccScaledMisalignedImu` in `kalibr_imu_camera_calibration/IccSensors.py`).
///
/// With `f` in the frame of the calibration and `a_i = Q f`: `T_a⁻¹ = M_a Q`, `T_g⁻¹ Qᵀ = M_g C`, `A = T_g⁻¹ G Qᵀ Cᵀ`.
pub const TARGET: Target = Target {
    name: "kalibr",
    about: "Kalibr's imu.yaml (scale-misalignment): raw = M C f + b",
    form: Form::File,
    keeps: |source| Kept {
        accelerometer: source.accelerometer.as_ref().map(matrix_alone),
        gyroscope: source.gyroscope.as_ref().map(matrix_alone),
        g_sensitivity: true,
        ..Kept::default()
    },
    write,
};

fn write(source: &Source<'_>, settings: &Settings) -> Result<Written, Error> {
    source.needs_si("kalibr")?;
    let accelerometer = source.needs(Sensor::Accelerometer, "kalibr")?;
    let gyroscope = source.needs(Sensor::Gyroscope, "kalibr")?;
    let (m_a, q) = lower_times_rotation(&inverse(&accelerometer.t)?, "accelerometer")?;
    let of_rate = inverse(&gyroscope.t)?;
    let (m_g, c) = lower_times_rotation(&(of_rate * q.transpose()), "gyroscope")?;
    let g = source.g_sensitivity.unwrap_or_else(Matrix3::zeros);
    let a = of_rate * g * q.transpose() * c.transpose();
    let (densities, mut notes) = densities(source, settings);
    let mut text = source.provenance("#");
    text.push_str("imu0:\n  model: scale-misalignment\n");
    text.push_str(&densities);
    let _ = write!(
        text,
        "  T_i_b:\n  - [1.0, 0.0, 0.0, 0.0]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n\
         \x20 time_offset: 0.0\n  accelerometers:\n{}  gyroscopes:\n{}{}{}",
        matrix("M", &m_a),
        matrix("M", &m_g),
        matrix("A", &a),
        matrix("C_gyro_i", &c)
    );
    let angle = Rotation3::from_matrix_unchecked(q).angle();
    notes.push(Finding::of(Kind::FRAME_TURNED).number("angle", angle, "rad"));
    notes.push(Finding::of(Kind::TOPIC_TO_ADD));
    Ok(Written {
        notes,
        ..Written::text(text)
    })
}

fn inverse(t: &Matrix3<f64>) -> Result<Matrix3<f64>, Error> {
    let singular = || Error::format(Finding::of(Kind::MATRIX_SINGULAR));
    t.try_inverse().ok_or_else(singular)
}

/// `A = L R`, `L` lower triangular with a positive diagonal and `R` a rotation: the transpose of a QR factorisation.
fn lower_times_rotation(
    a: &Matrix3<f64>,
    sensor: &'static str,
) -> Result<(Matrix3<f64>, Matrix3<f64>), Error> {
    let qr = a.transpose().qr();
    let (q, r) = (qr.q(), qr.r());
    let signs = Matrix3::from_diagonal(&r.diagonal().map(f64::signum));
    let (lower, rotation) = (r.transpose() * signs, signs * q.transpose());
    if rotation.determinant() > 0.0 {
        return Ok((lower, rotation));
    }
    let target = "kalibr";
    Err(Error::LeftHanded { target, sensor })
}

/// Rows of numbers under a key.
fn matrix(key: &str, m: &Matrix3<f64>) -> String {
    let mut text = format!("    {key}:\n");
    for row in m.row_iter() {
        let _ = writeln!(text, "    - [{:?}, {:?}, {:?}]", row[0], row[1], row[2]);
    }
    text
}

/// White noise and random walk, as far as they are known; Kalibr refuses a file without them, or with zeros.
fn densities(source: &Source<'_>, settings: &Settings) -> (String, Vec<Finding>) {
    let mut text = String::new();
    let mut missing = Vec::new();
    let input = source.calibration.provenance.inputs.first();
    let noise = settings.noise.as_ref();
    let rate = input.and_then(|i| i.gyroscope.as_ref()?.rate);
    let rate = rate.or(noise.and_then(|n| Some(n.gyroscope.as_ref()?.step.recip())));
    let mut put = |key: &str, value: Option<f64>| match value.filter(|v| *v > 0.0) {
        Some(value) => {
            let _ = writeln!(text, "  {key}: {value:?}");
        }
        None => {
            let _ = writeln!(text, "  # {key}: not known");
            missing.push(key.to_owned());
        }
    };
    put("update_rate", rate);
    let own = |of: fn(&calib::calibration::Input) -> Option<f64>| input.and_then(of);
    // Densities of counts are none of a filter's units.
    let in_si = |sensor: &&SensorNoise| sensor.unit != "counts";
    let force = noise.and_then(|n| n.accelerometer.as_ref()).filter(in_si);
    let turn = noise.and_then(|n| n.gyroscope.as_ref()).filter(in_si);
    let white_of_force = own(|i| i.accelerometer.as_ref()?.noise_density);
    let white_of_rate = own(|i| i.gyroscope.as_ref()?.noise_density);
    for (name, noise, white) in [
        ("accelerometer", force, white_of_force),
        ("gyroscope", turn, white_of_rate),
    ] {
        let allan = |term| noise.and_then(|n| density(n, term));
        let white = allan(NoiseTerm::WhiteNoise).or(white);
        put(&format!("{name}_noise_density"), white);
        put(&format!("{name}_random_walk"), allan(NoiseTerm::RandomWalk));
    }
    let notes = if missing.is_empty() {
        Vec::new()
    } else {
        let unknown = Finding::of(Kind::DENSITIES_UNKNOWN);
        vec![unknown.detail("listed", missing.join(", "))]
    };
    (text, notes)
}

/// The root mean square over the axes of a term that the recording shows on all of them.
fn density(noise: &SensorNoise, term: NoiseTerm) -> Option<f64> {
    let of = |axis: &calib::noise::AxisNoise| {
        let found = axis.terms.iter().find(|t| t.term == term);
        found.filter(|t| t.lower > 0.0).map(|t| t.value)
    };
    let values: Option<Vec<f64>> = noise.axes.iter().map(of).collect();
    let values = values?;
    Some((values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt())
}
