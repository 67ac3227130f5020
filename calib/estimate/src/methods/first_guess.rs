//! The unit of the readings, from the readings: `signal ≈ scale · (raw − zero)`.
//!
//! Raw counts of tens of thousands around an unknown zero are as good a recording as one in SI
//! units; the fits work on readings brought near SI first and are carried back after.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::residuals::StaticMean;
use crate::truth::RawUnit;

findings::tuning! {
    /// Static readings whose median norm lies within this fraction of gravity are m/s².
    SI_NORM: f64 = 0.5;
}

impl RawUnit {
    /// Static means near SI units.
    pub fn means_to_si(&self, means: &[StaticMean]) -> Vec<StaticMean> {
        means
            .iter()
            .map(|mean| StaticMean {
                raw: self.to_si(&mean.raw),
                white: mean.white * self.scale,
                ..*mean
            })
            .collect()
    }
}

/// The unit of an accelerometer from its static means, by the sphere they lie on; `None` where they
/// lie on no sphere.
pub fn accelerometer_unit(means: &[Vector3<f64>], gravity: f64) -> Option<RawUnit> {
    let mut norms: Vec<f64> = means.iter().map(|m| m.norm() / gravity).collect();
    norms.sort_by(f64::total_cmp);
    let middle = norms.get(norms.len() / 2)?;
    if (middle - 1.0).abs() < SI_NORM.get() {
        return Some(RawUnit::SI);
    }
    let (zero, radius) = sphere(means)?;
    Some(RawUnit {
        scale: gravity / radius,
        zero,
    })
}

/// Centre and radius of the sphere `|m|² = 2 c·m + (r² − |c|²)`, linear least squares.
fn sphere(points: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    let n = points.len();
    let middle = points.iter().sum::<Vector3<f64>>() / n as f64;
    let size = points
        .iter()
        .map(|p| (p - middle).norm())
        .fold(0.0, f64::max);
    let near: Vec<Vector3<f64>> = points.iter().map(|p| (p - middle) / size).collect();
    let matrix = DMatrix::from_fn(n, 4, |i, k| if k < 3 { 2.0 * near[i][k] } else { 1.0 });
    let squares = DVector::from_fn(n, |i, _| near[i].norm_squared());
    let solution = matrix.svd(true, true).solve(&squares, 1e-9).ok()?;
    let centre = Vector3::new(solution[0], solution[1], solution[2]);
    let radius = (solution[3] + centre.norm_squared()).sqrt();
    (radius.is_finite() && radius > 0.0 && size > 0.0)
        .then(|| (middle + centre * size, radius * size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_around_a_zero_of_32768_show_their_unit() {
        let faces = [Vector3::x(), Vector3::y(), Vector3::z()];
        let means: Vec<_> = faces
            .iter()
            .flat_map(|f| [*f, -f])
            .map(|f| Vector3::new(32768.0, 33000.0, 31000.0) + f * 4096.0)
            .collect();
        let unit = accelerometer_unit(&means, 9.8).unwrap();
        assert!((unit.scale - 9.8 / 4096.0).abs() < 1e-12);
        assert!((unit.zero - Vector3::new(32768.0, 33000.0, 31000.0)).norm() < 1e-8);
    }

    #[test]
    fn metres_per_second_squared_stay_what_they_are() {
        let means = [Vector3::new(0.2, 0.0, 9.6), Vector3::new(-9.9, 0.1, 0.0)];
        assert_eq!(accelerometer_unit(&means, 9.8), Some(RawUnit::SI));
    }
}
