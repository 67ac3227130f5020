//! Two coordinates of a direction.

use nalgebra::{Matrix3x2, Vector3};
use solver::{Scalar, lit};

/// Coordinates of the sphere near a reference direction: `u = (u₀ + E x) / |u₀ + E x|`, `E` (3 × 2) two
/// unit vectors across `u₀`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chart {
    /// The direction with coordinates zero.
    pub reference: Vector3<f64>,
    /// The unit vectors across it.
    pub across: Matrix3x2<f64>,
}

impl Chart {
    /// Around the direction of `vector`; `None` of a vector without one.
    pub fn around(vector: &Vector3<f64>) -> Option<Self> {
        let reference = vector.try_normalize(f64::MIN_POSITIVE)?;
        let smallest = reference.iamin();
        let mut other = Vector3::zeros();
        other[smallest] = 1.0;
        let first = reference.cross(&other).normalize();
        let second = reference.cross(&first);
        Some(Self {
            reference,
            across: Matrix3x2::from_columns(&[first, second]),
        })
    }

    /// The direction with coordinates `x` (2).
    pub fn direction<D: Scalar>(&self, x: &[D]) -> Vector3<D> {
        let lifted = |v: nalgebra::Vector3<f64>| v.map(lit::<D>);
        let sum = lifted(self.reference)
            + lifted(self.across.column(0).into()) * x[0]
            + lifted(self.across.column(1).into()) * x[1];
        sum * sum.dot(&sum).sqrt().recip()
    }

    /// `∂u/∂x` (3 × 2) at `x`.
    pub fn slope(&self, x: &[f64]) -> Matrix3x2<f64> {
        let sum = self.reference + self.across.column(0) * x[0] + self.across.column(1) * x[1];
        let length = sum.norm();
        let u = sum / length;
        (self.across - u * (u.transpose() * self.across)) / length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_reference_the_slope_is_the_two_vectors_across() {
        let chart = Chart::around(&Vector3::new(0.0, 0.0, -3.0)).unwrap();
        assert_eq!(chart.reference, -Vector3::z());
        assert!((chart.slope(&[0.0, 0.0]) - chart.across).norm() < 1e-15);
        assert!((chart.across.transpose() * chart.across).is_identity(1e-15));
        assert!((chart.direction::<f64>(&[0.3, -0.4]).norm() - 1.0).abs() < 1e-15);
    }
}
