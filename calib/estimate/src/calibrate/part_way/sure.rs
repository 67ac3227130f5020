//! The certainty of directions that the lengths of forces determine.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// Parameters of the base: an upper triangular matrix and a bias.
pub(super) const BASE: usize = 9;

findings::tuning! {
    /// A direction is known to this, rad, by the noise alone: a turn is off by five of it at least.
    UNSURE: f64 = 1e-3;
}

/// The inverse of the normal equations of a base for a noise of one; `None` where the forces do not determine it.
#[derive(Clone, Debug)]
pub(super) struct Sure(Option<SMatrix<f64, BASE, BASE>>);

impl Sure {
    /// By the derivatives of the lengths, those of the base first.
    pub fn of<const N: usize>(slopes: impl Iterator<Item = [f64; N]>) -> Self {
        let base = slopes.map(|own| SVector::<f64, BASE>::from_column_slice(&own[..BASE]));
        let normal: SMatrix<f64, BASE, BASE> = base.map(|own| own * own.transpose()).sum();
        Self(normal.cholesky().map(|own| own.inverse()))
    }

    /// Returns true if the direction of a corrected force is known; `t` is the matrix of the base, `noise` that of a length.
    pub fn knows(&self, t: &Matrix3<f64>, force: &Vector3<f64>, noise: f64) -> bool {
        let (Some(covariance), Some(inverse)) = (&self.0, t.try_inverse()) else {
            return false;
        };
        let raw = inverse * force;
        let across = Matrix3::identity() - force * force.transpose() / force.norm_squared();
        let mut slopes = SMatrix::<f64, 3, BASE>::zeros();
        for (k, (i, j)) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
            .into_iter()
            .enumerate()
        {
            slopes[(i, k)] = raw[j];
        }
        slopes.fixed_columns_mut::<3>(6).copy_from(&-t);
        let slopes = across * slopes / force.norm();
        let variance = (slopes * covariance * slopes.transpose()).trace();
        noise * variance.sqrt() < UNSURE.get()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the lengths of these forces (as read by a perfect sensor) determine.
    fn sure(forces: &[Vector3<f64>]) -> Sure {
        Sure::of(forces.iter().map(|f| {
            let u = f.normalize();
            let [x, y, z] = [u.x, u.y, u.z];
            let of_t = [x * f.x, x * f.y, x * f.z, y * f.y, y * f.z, z * f.z];
            let mut all = [0.0; BASE];
            all[..6].copy_from_slice(&of_t);
            all[6..].copy_from_slice((-u).as_slice());
            all
        }))
    }

    fn knows(forces: &[Vector3<f64>]) -> bool {
        let known = sure(forces);
        let all = forces.iter();
        all.into_iter()
            .all(|f| known.knows(&Matrix3::identity(), f, 3e-4))
    }

    #[test]
    fn a_direction_is_known_where_forces_lie_all_around_and_not_where_most_lie_in_one_direction() {
        let around = |k: usize| {
            let (a, z) = (2.4 * k as f64, (k as f64 + 0.5) / 10.0 - 1.0);
            Vector3::new(a.cos(), a.sin(), 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z
        };
        let all: Vec<_> = (0..20).map(|k| around(k) * 9.8).collect();
        assert!(knows(&all));
        let near = |k: usize| (Vector3::z() + 0.02 * around(k)).normalize() * 9.8;
        let mut few: Vec<_> = (0..18).map(near).collect();
        few.extend([Vector3::x() * 9.8, Vector3::y() * 9.8]);
        assert!(!knows(&few));
    }
}
