//! The procedure behind the authors' table of cart runs, with all its constants.
//!
//! Gravity is subtracted on one axis, samples in motion are picked by a filtered norm, and the
//! rest is summed twice over just those samples as if they were `1/rate` apart. It knows no
//! attitude; [`reckon`](super::reckon) does better. It is here because the published numbers come
//! from it.

use nalgebra::{Matrix3, Vector3};
use sensor::Base;

use super::butterworth::FirstOrder;
use recording::Stream;

/// The constants of the procedure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Procedure {
    /// Subtracted from the vertical axis, m/s².
    pub gravity: f64,
    /// The axis that points up: 0, 1, 2 for x, y, z.
    pub vertical: usize,
    /// A sample is in motion where the filtered norm exceeds this, m/s².
    pub level: f64,
    /// Cutoff of the high-pass filter of the norm, Hz.
    pub high_pass: f64,
    /// Cutoff of the low-pass filter of the rectified norm, Hz.
    pub low_pass: f64,
    /// Samples per second, assumed.
    pub rate: f64,
}

impl Default for Procedure {
    fn default() -> Self {
        Self {
            gravity: 9.79,
            vertical: 2,
            level: 0.5,
            high_pass: 0.001,
            low_pass: 3.0,
            rate: 100.0,
        }
    }
}

impl Procedure {
    /// The samples taken to be in motion: `| |a| high-passed | low-passed > level`, with `a` the
    /// corrected samples less gravity.
    pub fn moving(&self, corrected: &Stream) -> Vec<usize> {
        let norm: Vec<f64> = corrected
            .values
            .iter()
            .map(|a| self.without_gravity(a).norm())
            .collect();
        let high = FirstOrder::high_pass(self.high_pass, self.rate).both_ways(&norm);
        let rectified: Vec<f64> = high.iter().map(|v| v.abs()).collect();
        let low = FirstOrder::low_pass(self.low_pass, self.rate).both_ways(&rectified);
        (0..low.len()).filter(|&k| low[k] > self.level).collect()
    }

    /// Position after each of the samples `moving`, m: `v += a/rate`, `p += v/rate`.
    pub fn positions(&self, corrected: &Stream, moving: &[usize]) -> Vec<Vector3<f64>> {
        let (mut velocity, mut position) = (Vector3::zeros(), Vector3::zeros());
        moving
            .iter()
            .filter_map(|&k| corrected.values.get(k))
            .map(|a| {
                velocity += self.without_gravity(a) / self.rate;
                position += velocity / self.rate;
                position
            })
            .collect()
    }

    fn without_gravity(&self, a: &Vector3<f64>) -> Vector3<f64> {
        let mut rest = *a;
        if let Some(vertical) = rest.get_mut(self.vertical) {
            *vertical -= self.gravity;
        }
        rest
    }
}

/// The authors' own calibration of their phone, `a = M (A − B)`, to the four decimals that they
/// published. Their `B` is in units of g and was used as m/s².
pub fn authors_proposed() -> Base<f64> {
    Base {
        t: Matrix3::new(
            0.9994, -0.0001, -0.0002, //
            -0.0001, 0.9998, -0.0001, //
            -0.0002, -0.0001, 0.9983,
        ),
        bias: Vector3::new(0.0041, 0.0004, -0.0019),
    }
}

/// Their six-position calibration to four decimals, `a = (I − M) (A − b)` to first order.
pub fn authors_six_position() -> Base<f64> {
    let m = Matrix3::new(
        0.0002, 0.0062, -0.0036, //
        0.0087, 0.0002, 0.0048, //
        -0.0011, 0.0013, 0.0014,
    );
    Base {
        t: Matrix3::identity() - m,
        bias: Vector3::new(0.0183, 0.0289, -0.0768),
    }
}
