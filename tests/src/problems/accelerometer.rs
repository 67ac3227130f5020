//! The calibration problem itself, small: nine parameters of an accelerometer from the means of 23 placements.

use solver::{Residual, Scalar, lit};

/// `‖T (m − b)‖ − g`, `T` upper triangular, from the means `m` of static intervals.
#[derive(Debug)]
pub struct Accelerometer(
    /// The means, m/s².
    pub Vec<[f64; 3]>,
);

impl<D: Scalar> Residual<D> for Accelerometer {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for m in &self.0 {
            let [a, b, c] = [0, 1, 2].map(|k| -x[6 + k] + m[k]);
            let f = [
                x[0] * a + x[3] * b + x[4] * c,
                x[1] * b + x[5] * c,
                x[2] * c,
            ];
            out.push((f[0] * f[0] + f[1] * f[1] + f[2] * f[2]).sqrt() - lit::<D>(9.79));
        }
    }
}

/// Means of 23 placements on a spiral over the sphere, distorted by a known sensor.
pub fn placements() -> Vec<[f64; 3]> {
    let place = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / 23.0;
        let (angle, radius) = (2.4 * i as f64, (1.0 - z * z).sqrt());
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    (0..23)
        .map(place)
        .map(|u| [9.8 * u[0] + 0.04, 9.79 * u[1] + 0.004, 9.81 * u[2] - 0.02])
        .collect()
}
