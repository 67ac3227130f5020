//! The gyroscope's part of the six-position method, and why it means nothing for a phone.

use findings::{Finding, Kind};
use nalgebra::{Matrix3x6, Vector3};
use sensor::{Base, Sensor};

use super::placement::Face;
use crate::calibration::Triad;
use crate::methods::small_sample::widening;

/// The earth's rate, rad/s, as the authors use it (IERS: 7.292115e-5).
pub const EARTH_RATE: f64 = 7.29e-5;

/// Placements in which an axis is horizontal.
const ACROSS: usize = 4;

findings::tuning! {
    /// Largest believable scale factor error: ten times that of a poor sensor.
    BELIEVABLE_SCALE_ERROR: f64 = 0.1;
}

/// Visibility of the earth's rate in the readings at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EarthRotation {
    /// The bias wanders by more than it between placements.
    Hidden,
    /// It would stand out, but is not there as assumed on some axis: about `S = −1` where readings do
    /// not follow it at all, −2 where they follow it with the other sign, and `sin φ − 1` at latitude `φ`,
    /// whose sine the published formula leaves out.
    Absent,
    /// It stands out on every axis and `S` is a believable scale factor error.
    Seen,
}

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
            let mean = across.iter().sum::<f64>() / ACROSS as f64;
            let squares = across.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
            (squares / (ACROSS - 1) as f64).sqrt()
        });
        Self {
            bias: Vector3::from_fn(|axis, _| {
                let (down, up) = pair(axis);
                0.5 * (up + down)
            }),
            bias_std: repeat * (widening(ACROSS - 1) / 2f64.sqrt()),
            scale_error: Vector3::from_fn(|axis, _| {
                let (down, up) = pair(axis);
                (up - down - 2.0 * EARTH_RATE) / (2.0 * EARTH_RATE)
            }),
            scale_error_std: repeat * 2f64.sqrt() / (2.0 * EARTH_RATE),
        }
    }

    /// Judges the visibility of the earth's rate: whether it stands out from the motion of the bias (three standard
    /// errors of every scale factor below one), and whether it is there (every `|S|` below 0.1).
    pub fn earth_rotation(&self) -> EarthRotation {
        // Comparisons are written so that NaN counts as hidden.
        let stands_out = self.scale_error_std.iter().all(|std| 3.0 * std < 1.0);
        let believable = self
            .scale_error
            .iter()
            .all(|s| s.abs() < BELIEVABLE_SCALE_ERROR.get());
        match (stands_out, believable) {
            (false, _) => EarthRotation::Hidden,
            (true, false) => EarthRotation::Absent,
            (true, true) => EarthRotation::Seen,
        }
    }

    /// The bias as a calibration; the scale is left at one, because a scale of noise would spoil
    /// every turn.
    pub(super) fn triad(&self) -> Triad {
        let base = Base {
            bias: self.bias,
            ..Base::identity()
        };
        Triad {
            bias_std: [0, 1, 2].map(|k| Some(self.bias_std[k])),
            static_intervals: Some(Face::ALL.len()),
            rank: 3,
            unobservable: vec![Finding::of(Kind::NOT_SEEN_BY_EARTH_RATE).what()],
            ..Triad::of(Sensor::Gyroscope, &base)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings of a gyroscope with a bias that shows `share` of the earth's rate.
    fn showing(share: f64) -> Matrix3x6<f64> {
        let bias = Vector3::new(1e-3, 0.0, -2e-3);
        Matrix3x6::from_columns(&Face::ALL.map(|face| face.direction() * share * EARTH_RATE + bias))
    }

    #[test]
    fn a_perfect_gyroscope_at_the_pole_has_no_error_and_a_wandering_one_no_meaning() {
        let mut means = showing(1.0);
        let part = GyroscopePart::solve(&means);
        assert!((part.bias - Vector3::new(1e-3, 0.0, -2e-3)).norm() < 1e-15);
        assert!(part.scale_error.norm() < 1e-9);
        assert_eq!(part.earth_rotation(), EarthRotation::Seen);
        means[(0, 2)] += 2e-4;
        let part = GyroscopePart::solve(&means);
        assert_eq!(part.earth_rotation(), EarthRotation::Hidden);
    }

    /// However small the standard errors: without the earth's rate `S = −1`, with its opposite −2, and
    /// at 45° `√½ − 1`.
    #[test]
    fn a_gyroscope_that_does_not_show_the_earths_rate_has_no_scale_factor_from_it() {
        for (share, s) in [
            (0.0, -1.0),
            (-1.0, -2.0),
            (0.5_f64.sqrt(), 0.5_f64.sqrt() - 1.0),
        ] {
            let part = GyroscopePart::solve(&showing(share));
            assert!((part.scale_error - Vector3::repeat(s)).norm() < 1e-9);
            assert!(part.scale_error_std.norm() < 1e-9);
            assert_eq!(part.earth_rotation(), EarthRotation::Absent, "{share}");
        }
    }
}
