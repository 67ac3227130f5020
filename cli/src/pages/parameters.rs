//! Parameters in the units that people use, with their intervals and correlations.

use calib::Calibration;
use calib::calibrate::STANDARD_GRAVITY;
use calib::calibration::Triad;

use crate::commands::calibrate::field::field_unit;
use crate::report::{Figure, Group, Picture, Row};
use crate::show;

/// Half of a 95 % interval in standard errors.
const HALF: f64 = 1.96;
const AXES: [&str; 3] = ["x", "y", "z"];

/// A sensor's parameters with what an error of each makes of a reading.
struct Sensor<'a> {
    name: &'static str,
    angle: &'static str,
    triad: &'a Triad,
    /// SI units per unit of the readings.
    scale: f64,
    /// People's unit of the bias and how many of it make the SI unit.
    bias: (&'static str, f64),
    /// A reading that errors are compared at, SI.
    at: f64,
}

/// Scale factors of readings in SI units lie in here.
const NEAR_ONE: std::ops::Range<f64> = 0.5..2.0;

/// The scale factor that all others are shown against: 1 of readings in SI units.
pub fn overall(triad: &Triad) -> f64 {
    Some(triad.base().scale())
        .filter(|scale| !NEAR_ONE.contains(scale))
        .unwrap_or(1.0)
}

fn sensors(calibration: &Calibration) -> Vec<Sensor<'_>> {
    let accelerometer = calibration.accelerometer.as_ref().map(|triad| Sensor {
        name: "accelerometer",
        angle: "alpha",
        scale: overall(triad),
        triad,
        bias: ("mg", 1e3 / STANDARD_GRAVITY),
        at: STANDARD_GRAVITY,
    });
    let gyroscope = calibration.gyroscope.as_ref().map(|triad| Sensor {
        name: "gyroscope",
        angle: "beta",
        scale: overall(triad),
        triad,
        bias: ("°/h", 3600.0 * 1f64.to_degrees()),
        // A brisk turn by hand.
        at: 1.0,
    });
    let magnetometer = calibration.magnetometer.as_ref().map(|triad| Sensor {
        name: "magnetometer",
        angle: "gamma",
        scale: overall(triad),
        triad,
        bias: (field_unit(calibration), 1.0),
        // The earth's field.
        at: calibration
            .magnetic_field
            .as_ref()
            .map_or(50.0, |field| field.last.strength),
    });
    let all = accelerometer.into_iter().chain(gyroscope);
    all.chain(magnetometer).collect()
}

/// All parameters, an axis for each unit.
pub fn forest(calibration: &Calibration) -> Picture {
    let mut groups = Vec::new();
    for sensor in sensors(calibration) {
        let Sensor {
            name,
            angle,
            triad,
            scale,
            bias,
            ..
        } = sensor;
        let half = |std: Option<f64>, factor: f64| std.map(|std| HALF * factor * std);
        let diagonal = |k: usize| Row {
            name: format!("s_{}", AXES[k]),
            value: 1e6 * (triad.t[k][k] / scale - 1.0),
            half: half(triad.t_std[k][k], 1e6 / scale),
        };
        groups.push(Group {
            label: if scale == 1.0 {
                format!("{name}: scale factor less one, ppm")
            } else {
                format!("{name}: scale factor over {scale:.4e} less one, ppm")
            },
            rows: (0..3).map(diagonal).collect(),
        });
        let pairs = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)];
        let pairs = pairs
            .into_iter()
            .filter(|(i, j)| triad.t_std[*i][*j].is_some());
        let misalignment = |(i, j): (usize, usize)| Row {
            name: misalignment(angle, i, j),
            value: 1e3 * triad.t[i][j] / scale,
            half: half(triad.t_std[i][j], 1e3 / scale),
        };
        groups.push(Group {
            label: format!("{name}: misalignment, mrad"),
            rows: pairs.map(misalignment).collect(),
        });
        let (unit, factor) = bias;
        let bias = |k: usize| Row {
            name: format!("b_{}", AXES[k]),
            value: factor * scale * triad.bias[k],
            half: half(triad.bias_std[k], factor * scale),
        };
        groups.push(Group {
            label: format!("{name}: bias, {unit}"),
            rows: (0..3).map(bias).collect(),
        });
    }
    groups.retain(|group| !group.rows.is_empty());
    Picture::Forest("Parameters with 95 % intervals".into(), groups)
}

/// Name of an element beside the diagonal: row `i`, column `j`, as the tables of parameters have it.
fn misalignment(angle: &str, i: usize, j: usize) -> String {
    let other = 3 - i - j;
    format!("{angle}_{}{}", AXES[j], AXES[other])
}

/// Parameters beyond which those of single recordings are left out of the picture of correlations.
const MOST_CORRELATED: usize = 30;

/// Correlations of all free parameters, of many those that recordings share; `None` where there is no covariance.
pub fn correlation(calibration: &Calibration) -> Option<Picture> {
    let covariance = &calibration.covariance;
    let std: Vec<f64> = (0..covariance.len())
        .map(|k| covariance[k].get(k).map_or(0.0, |v| v.sqrt()))
        .collect();
    if covariance.len() < 2 || std.iter().any(|s| s.is_nan()) {
        return None;
    }
    let names = &calibration.parameters;
    let is_shown = |k: &usize| names.len() <= MOST_CORRELATED || !names[*k].contains('[');
    let shown: Vec<usize> = (0..names.len().min(std.len())).filter(is_shown).collect();
    let cell = |i: usize, j: usize| {
        let scale = std[i] * std[j];
        if scale > 0.0 {
            covariance[i][j] / scale
        } else {
            0.0
        }
    };
    let row = |&i: &usize| shown.iter().map(|&j| cell(i, j)).collect();
    let rows = shown.iter().map(row).collect();
    let names = shown.iter().map(|&k| &names[k]).map(|name| {
        let short = [("accel.", "a."), ("gyro.", "g."), ("mag.", "m.")]
            .into_iter()
            .fold(name.clone(), |name, (long, short)| {
                name.replacen(long, short, 1)
            });
        show::printable(&short).into_owned()
    });
    let title = "Correlations of the parameters".to_owned();
    Some(Picture::Matrix(title, names.collect(), rows))
}

impl Sensor<'_> {
    /// A scale factor in words, and an error of it; `std` in the unit of the readings.
    fn scale_factor(&self, axis: &str, std: f64) -> (String, String) {
        let ppm = show::rounded(1e6 * std / self.scale, 2);
        (
            format!("{} {axis} scale", self.name),
            format!("± {ppm} ppm"),
        )
    }

    /// A misalignment in words, and an error of it; `std` in the unit of the readings.
    fn misalignment(&self, axes: &str, std: f64) -> (String, String) {
        let mrad = show::figures(1e3 * std / self.scale, 2);
        (
            format!("{} misalignment {axes}", self.name),
            format!("± {mrad} mrad"),
        )
    }

    /// A bias in words, and an error of it; `std` in the unit of the readings.
    fn bias(&self, axis: &str, std: f64) -> (String, String) {
        let (unit, factor) = self.bias;
        let size = show::rounded(factor * self.scale * std, 2);
        (
            format!("{} {axis} bias", self.name),
            format!("± {size} {unit}"),
        )
    }
}

/// The parameter called `parameter` in words, and an error of it in the unit that people use; `None` for one of a recording or an effect.
pub fn error_in_words(
    calibration: &Calibration,
    parameter: &str,
    std: f64,
) -> Option<(String, String)> {
    let (prefix, own) = parameter.split_once('.')?;
    let all = sensors(calibration).into_iter();
    let sensor = { all }.find(|sensor| sensor.name.starts_with(prefix))?;
    match own.split_once('_')? {
        ("s", axis) => Some(sensor.scale_factor(axis, std)),
        ("b", axis) => Some(sensor.bias(axis, std)),
        (angle, axes) if angle == sensor.angle => Some(sensor.misalignment(axes, std)),
        _ => None,
    }
}

/// The parameter that makes the largest share of a reading's error.
pub fn weakest(calibration: &Calibration) -> Option<Figure> {
    let mut all: Vec<(f64, (String, String))> = Vec::new();
    for sensor in sensors(calibration) {
        let (triad, scale) = (sensor.triad, sensor.scale);
        for (i, axis) in AXES.iter().enumerate() {
            for j in 0..3 {
                let Some(std) = triad.t_std[i][j] else {
                    continue;
                };
                let axes = || format!("{}{}", AXES[j], AXES[3 - i - j]);
                let words = match i == j {
                    true => sensor.scale_factor(axis, std),
                    false => sensor.misalignment(&axes(), std),
                };
                all.push((std / scale, words));
            }
            if let Some(std) = triad.bias_std[i] {
                all.push((scale * std / sensor.at, sensor.bias(axis, std)));
            }
        }
    }
    all.retain(|(share, ..)| share.is_finite());
    let (share, (name, text)) = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let note = format!(
        "{name}, one standard error: {} % of {}",
        show::figures(100.0 * share, 2),
        match name.chars().next() {
            Some('a') => "one g",
            Some('g') => "a turn at 1 rad/s",
            _ => "the magnetic field",
        }
    );
    Some(Figure::new("Weakest parameter", text, note))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_beside_the_diagonal_have_the_names_of_the_tables() {
        let name = |i, j| misalignment("alpha", i, j);
        assert_eq!(
            [
                name(0, 1),
                name(0, 2),
                name(1, 0),
                name(1, 2),
                name(2, 0),
                name(2, 1)
            ],
            [
                "alpha_yz", "alpha_zy", "alpha_xz", "alpha_zx", "alpha_xy", "alpha_yx"
            ]
        );
    }
}
