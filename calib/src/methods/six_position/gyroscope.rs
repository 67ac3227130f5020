//! The gyroscope's part of the six-position method, and why it means nothing for a phone.

use nalgebra::{Matrix3x6, Vector3};

use super::placement::Face;
use crate::calibration::Triad;

/// The earth's rate, rad/s, as the authors use it (IERS: 7.292115e-5).
pub const EARTH_RATE: f64 = 7.29e-5;

/// Bias and scale factor error from the means at rest.
///
/// `b = (up + down)/2` and `S = (up − down − 2 Ω)/(2 Ω)` per axis, `Ω` the earth's rate (its sine of
/// the latitude is left out, as published). The scale comes from a signal of 7.29e-5 rad/s: where
/// the bias moves more than that between placements, `S` is noise. The standard errors say so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroscopePart {
    /// Bias, rad/s.
    pub bias: Vector3<f64>,
    /// Its standard error, rad/s.
    pub bias_std: Vector3<f64>,
    /// Scale factor error `S`.
    pub scale_error: Vector3<f64>,
    /// Its standard error.
    pub scale_error_std: Vector3<f64>,
}

impl GyroscopePart {
    /// From mean readings by face (3 × 6), rad/s.
    ///
    /// How well a mean repeats is taken from the four placements in which the axis is horizontal:
    /// what they differ by is the wandering of the bias, most of it, and the rest of the earth's rate.
    pub fn solve(means: &Matrix3x6<f64>) -> Self {
        let pair = |axis: usize| (means[(axis, 2 * axis)], means[(axis, 2 * axis + 1)]);
        let repeat = Vector3::from_fn(|axis, _| {
            let across: Vec<f64> = (0..6)
                .filter(|k| k / 2 != axis)
                .map(|k| means[(axis, k)])
                .collect();
            let mean = across.iter().sum::<f64>() / 4.0;
            (across.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 3.0).sqrt()
        });
        Self {
            bias: Vector3::from_fn(|axis, _| {
                let (down, up) = pair(axis);
                0.5 * (up + down)
            }),
            bias_std: repeat / 2f64.sqrt(),
            scale_error: Vector3::from_fn(|axis, _| {
                let (down, up) = pair(axis);
                (up - down - 2.0 * EARTH_RATE) / (2.0 * EARTH_RATE)
            }),
            scale_error_std: repeat * 2f64.sqrt() / (2.0 * EARTH_RATE),
        }
    }

    /// Whether the earth's rate stands out from the wandering of the bias: three standard errors of
    /// every scale factor below one.
    pub fn is_meaningful(&self) -> bool {
        3.0 * self.scale_error_std.max() < 1.0
    }

    /// The bias as a calibration; the scale is left at one, because a scale of noise would spoil
    /// every turn.
    pub(super) fn triad(&self) -> Triad {
        let identity = nalgebra::Matrix3::<f64>::identity();
        Triad {
            model: "w = T (W - b)".into(),
            t: std::array::from_fn(|i| std::array::from_fn(|j| identity[(i, j)])),
            bias: self.bias.into(),
            t_std: [[None; 3]; 3],
            bias_std: [0, 1, 2].map(|k| Some(self.bias_std[k])),
            residual_rms: 0.0,
            reduced_chi2: None,
            static_intervals: Some(Face::ALL.len()),
            dynamic_intervals: None,
            rank: 3,
            condition: 1.0,
            unobservable: vec![
                "gyro scale factors: the earth's rate is below the bias's wandering".into(),
            ],
            recordings: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_perfect_gyroscope_at_the_pole_has_no_error_and_a_wandering_one_no_meaning() {
        let mut means = Matrix3x6::zeros();
        for (k, face) in Face::ALL.iter().enumerate() {
            means.set_column(
                k,
                &(face.direction() * EARTH_RATE + Vector3::new(1e-3, 0.0, -2e-3)),
            );
        }
        let part = GyroscopePart::solve(&means);
        assert!((part.bias - Vector3::new(1e-3, 0.0, -2e-3)).norm() < 1e-15);
        assert!(part.scale_error.norm() < 1e-9 && part.is_meaningful());
        means[(0, 2)] += 2e-4;
        assert!(!GyroscopePart::solve(&means).is_meaningful());
    }
}
