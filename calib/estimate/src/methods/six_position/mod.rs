//! The six-position method ("6-turns"): each axis once up and once down.
//!
//! Model `raw = (I + M) f + b`, exact only where every placement has its axis truly vertical: a
//! tilt of the placement goes straight into the result, and [`SixPosition::tilt`] estimates it from
//! the data.

mod gyroscope;
mod placement;

pub use gyroscope::{EarthRotation, GyroscopePart};
pub use placement::{Face, Placement, Six, placements};

use findings::{Finding, Findings, Kind, Level};
use std::borrow::Borrow;

use nalgebra::{Matrix3, Matrix3x6, Vector3};
use recording::intervals::{Detector, segment};
use recording::{Error, Recording};
use sensor::{Base, Sensor, base_names, inverse};

use crate::calibrate::{Said, implausible, implausible_base};
use crate::calibration::{Calibration, Triad};
use crate::gravity::{Gravity, GravitySource};
use crate::methods::small_sample::widening;

findings::tuning! {
    /// Placements tilted by more than this cost more than a consumer sensor's own errors, rad (0.1°).
    TILT_LIMIT: f64 = 0.1 * std::f64::consts::PI / 180.0;

    /// Placements tilted by more than this (rms) are no six positions: the biases would carry more than
    /// 80 mm/s² of gravity, rad (2°).
    TILT_GATE: f64 = 2.0 * std::f64::consts::PI / 180.0;
}

/// Residuals of three axes in six placements, and what nine elements of `M` and three biases leave of them: the axes share their scatter.
const RESIDUALS: usize = 18;
const SPARE: usize = RESIDUALS - 12;

/// The result of the method.
#[derive(Clone, Debug, PartialEq)]
pub struct SixPosition {
    /// Local gravity used, m/s².
    pub gravity: f64,
    /// Mean readings by face, in the order of [`Face::ALL`] (3 × 6), m/s².
    pub means: Matrix3x6<f64>,
    /// Scale factor errors and misalignments `M`.
    pub m: Matrix3<f64>,
    /// Bias `b`, m/s².
    pub bias: Vector3<f64>,
    /// Root mean square of the residuals, m/s².
    pub residual_rms: f64,
    /// The gyroscope, where it was recorded.
    pub gyroscope: Option<GyroscopePart>,
    /// Warnings for the user.
    pub warnings: Findings,
}

/// The method from recordings to a calibration.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The result.
    pub calibration: Calibration,
    /// Solution that the calibration was made from.
    pub solution: SixPosition,
    /// Sources of the faces' means, in the order of [`Face::ALL`].
    pub labels: [String; 6],
}

/// Calibrates by six recordings, or by one with all placements; `first_order` takes the authors' correction.
///
/// # Errors
/// Placements that are not each axis once up and once down, and means without a solution.
pub fn calibrate<R: Borrow<Recording>>(
    recordings: &[R],
    detector: &Detector,
    gravity: Gravity,
    first_order: bool,
) -> Result<Solved, Error> {
    let six = placements(recordings, detector, gravity.value)?;
    let solution = SixPosition::solve(&six, gravity.value);
    let mut calibration = solution.calibration(first_order)?;
    let said = implausible_in(recordings, detector, &solution)?;
    said.add_to(&mut calibration.failed_gates, &mut calibration.warnings);
    calibration.carry_gravity(gravity.source);
    let uncut = recordings.iter().map(|recording| {
        let recording: &Recording = recording.borrow();
        (recording, None)
    });
    calibration.state_inputs(uncut, None);
    let mixed = calibration.mixed_corrections();
    calibration.warnings.extend(mixed);
    Ok(Solved {
        calibration,
        solution,
        labels: six.placements().each_ref().map(|p| p.label.clone()),
    })
}

/// Everything that gravity, and the turns in a recording of all placements, say against the readings.
fn implausible_in<R: Borrow<Recording>>(
    recordings: &[R],
    detector: &Detector,
    solution: &SixPosition,
) -> Result<Said, Error> {
    if let [one] = recordings {
        let one = one.borrow();
        let cut = segment(one, detector)?;
        return Ok(implausible(one, &cut, None, solution.gravity));
    }
    let all: Vec<&Recording> = recordings.iter().map(R::borrow).collect();
    let base = solution.base();
    Ok(base.map_or_else(Said::default, |base| {
        implausible_base(base, &all, solution.gravity)
    }))
}

impl SixPosition {
    /// Solves `[M | b] = (F − Z) Aᵀ (A Aᵀ)⁻¹` with `A = [Z; 1 … 1]`, `Z` the true specific forces.
    ///
    /// The columns of `Z` are `±g` on one axis, so that `A Aᵀ = diag(2g², 2g², 2g², 6)` and the
    /// solution is half differences over `g` and the mean.
    pub fn solve(six: &Six, gravity: f64) -> Self {
        let means = six.accelerometer();
        let pair = |axis: usize| (means.column(2 * axis), means.column(2 * axis + 1));
        let mut m = Matrix3::zeros();
        for axis in 0..3 {
            let (down, up) = pair(axis);
            m.set_column(axis, &((up - down) / (2.0 * gravity)));
        }
        m -= Matrix3::identity();
        let bias = means.column_mean();
        let squares: f64 = Face::ALL
            .iter()
            .enumerate()
            .map(|(k, face)| {
                let force = face.direction() * gravity;
                (means.column(k) - force - m * force - bias).norm_squared()
            })
            .sum();
        let mut solution = Self {
            gravity,
            means,
            m,
            bias,
            residual_rms: (squares / 18.0).sqrt(),
            gyroscope: six.gyroscope().map(|means| GyroscopePart::solve(&means)),
            warnings: six.warnings.clone(),
        };
        solution.warnings.extend(solution.tilt_warning());
        solution
    }

    /// Root mean square angle between the placed axis and the vertical, rad.
    ///
    /// The mean of an up and a down reading is the bias: along the axis itself whatever the tilt (to
    /// second order), across it with an error of `g/√2` times the tilt about one axis. Six such
    /// differences give the tilt; two axes of tilt make the angle `√2` larger.
    pub fn tilt(&self) -> f64 {
        let middle =
            |axis: usize| (self.means.column(2 * axis) + self.means.column(2 * axis + 1)) * 0.5;
        let middles = [middle(0), middle(1), middle(2)];
        let mut squares = 0.0;
        for (axis, own) in middles.iter().enumerate() {
            for (other, across) in middles.iter().enumerate() {
                if other != axis {
                    squares += (across[axis] - own[axis]).powi(2);
                }
            }
        }
        2.0 * (squares / 6.0).sqrt() / self.gravity
    }

    fn tilt_warning(&self) -> Option<Finding> {
        let tilt = self.tilt();
        (tilt > TILT_LIMIT.get()).then(|| {
            // Six tilted means in a bias, of which two have the axis vertical.
            let of_bias = self.gravity * tilt / 18f64.sqrt();
            Finding::of(Kind::PLACEMENTS_TILTED)
                .number("tilt", tilt, "rad")
                .affects("corrected_reading", of_bias, "m/s^2")
        })
    }

    /// Why the result must not be used, if so.
    fn failed_gates(&self) -> Findings {
        let tilt = self.tilt();
        let gate = Finding::of(Kind::PLACEMENTS_TILTED)
            .number("tilt", tilt, "rad")
            .number("most", TILT_GATE.get(), "rad")
            .affects("corrected_reading", self.gravity * tilt, "m/s^2")
            .at_level(Level::Bad);
        // Also where the tilt is no number.
        if tilt <= TILT_GATE.get() {
            Findings::new()
        } else {
            vec![gate].into()
        }
    }

    /// `f = (I + M)⁻¹ (raw − b)`; `None` where `I + M` has no inverse.
    pub fn base(&self) -> Option<Base<f64>> {
        Some(Base {
            t: inverse(&(Matrix3::identity() + self.m))?,
            bias: self.bias,
        })
    }

    /// The correction to first order that the authors use, `f = (I − M) (raw − b)`.
    pub fn first_order_base(&self) -> Base<f64> {
        Base {
            t: Matrix3::identity() - self.m,
            bias: self.bias,
        }
    }

    /// Converts the solution to a calibration, with standard errors by the scatter of the residuals; `first_order`
    /// takes the authors' correction.
    ///
    /// # Errors
    /// Means that make `I + M` singular.
    pub fn calibration(&self, first_order: bool) -> Result<Calibration, Error> {
        let exact = self
            .base()
            .ok_or_else(|| Error::not_enough(Finding::of(Kind::AXES_SAME)))?;
        let base = if first_order {
            self.first_order_base()
        } else {
            exact
        };
        let scatter = self.residual_rms * (RESIDUALS as f64 / SPARE as f64).sqrt();
        let sigma = scatter * widening(SPARE);
        let (t_std, bias_std) = (sigma / (2f64.sqrt() * self.gravity), sigma / 6f64.sqrt());
        let variances: Vec<f64> = [t_std * t_std; 9]
            .into_iter()
            .chain([bias_std * bias_std; 3])
            .collect();
        let covariance = (0..12)
            .map(|i| {
                (0..12)
                    .map(|j| if i == j { variances[i] } else { 0.0 })
                    .collect()
            })
            .collect();
        let triad = Triad {
            t_std: [[Some(t_std); 3]; 3],
            bias_std: [Some(bias_std); 3],
            residual_rms: self.residual_rms,
            static_intervals: Some(6),
            rank: 12,
            ..Triad::of(Sensor::Accelerometer, &base)
        };
        let mut calibration = Calibration {
            accelerometer: Some(triad),
            gyroscope: self.gyroscope.as_ref().map(GyroscopePart::triad),
            parameters: base_names(Sensor::Accelerometer).to_vec(),
            covariance,
            warnings: self.warnings.clone(),
            failed_gates: self.failed_gates(),
            ..Calibration::by("six-position", self.gravity, GravitySource::Given)
        };
        calibration.state_units();
        calibration.seal();
        Ok(calibration)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.8;

    fn six(raw: impl Fn(&Face) -> Vector3<f64>) -> Six {
        let placements = Face::ALL.map(|face| Placement {
            label: face.name().into(),
            accelerometer: raw(&face),
            gyroscope: None,
        });
        placements_of(placements.to_vec())
    }

    fn placements_of(all: Vec<Placement>) -> Six {
        Six::sort(all, G).unwrap()
    }

    #[test]
    fn a_level_sensor_gives_its_matrix_and_bias_back() {
        let m = Matrix3::new(0.01, 0.002, -0.003, 0.004, -0.02, 0.001, 0.0, 0.005, 0.003);
        let b = Vector3::new(0.1, -0.2, 0.3);
        let found = SixPosition::solve(
            &six(|f| (m + Matrix3::identity()) * f.direction() * G + b),
            G,
        );
        assert!((found.m - m).norm() < 1e-14 && (found.bias - b).norm() < 1e-14);
        assert!(found.tilt() < 1e-13 && found.warnings.is_empty());
        let force = found
            .base()
            .unwrap()
            .correct(&((m + Matrix3::identity()) * Vector3::new(1.0, 2.0, 9.0) + b));
        assert!((force - Vector3::new(1.0, 2.0, 9.0)).norm() < 1e-13);
    }

    /// One placement off by 1° of six: its two half differences across are `g sin 1°/2`; of six
    /// squares one is not zero (the tilt is about one axis).
    #[test]
    fn one_tilted_placement_is_measured_and_warned_about() {
        let tilt = 1f64.to_radians();
        let found = SixPosition::solve(
            &six(|f| match f {
                Face::ZUp => Vector3::new(G * tilt.sin(), 0.0, G * tilt.cos()),
                _ => f.direction() * G,
            }),
            G,
        );
        let expected = 2.0 * (tilt.sin() * tilt.sin() / 4.0 / 6.0).sqrt();
        // The cosine of one degree adds 1.5e-4 of a difference along the axis.
        assert!((found.tilt() / expected - 1.0).abs() < 1e-3);
        assert!(
            found.warnings.texts(findings::Front::CommandLine)[0].contains("tilted by about"),
            "{:?}",
            found.warnings
        );
        assert!(found.calibration(false).unwrap().failed_gates.is_empty());
    }

    /// Each face leans to one side by the same angle up and down: three of six differences across are
    /// `g sin` of it, and the tilt found is `√2` of it (1.4° passes, 4.2° does not).
    #[test]
    fn placements_far_from_level_fail_the_gate() {
        let lean = |face: &Face, degrees: f64| {
            let across = Vector3::from_fn(|i, _| face.direction()[(i + 1) % 3].abs());
            let angle = degrees.to_radians();
            (face.direction() * angle.cos() + across * angle.sin()) * G
        };
        let gates = |degrees: f64| {
            SixPosition::solve(&six(|f| lean(f, degrees)), G)
                .calibration(false)
                .unwrap()
                .failed_gates
        };
        assert!(gates(1.0).is_empty());
        assert!(
            gates(3.0).texts(findings::Front::CommandLine)[0].contains("level the device"),
            "{:?}",
            gates(3.0)
        );
    }
}
