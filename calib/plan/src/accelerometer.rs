//! Information of placements about the accelerometer alone.

use nalgebra::{SMatrix, SVector, Vector3};

/// Parameters of the accelerometer's base model in the triangular frame.
pub const FORCE_PARAMETERS: usize = 9;

/// Their names, in the order of the published list without the three that are fixed.
pub const FORCE_NAMES: [&str; FORCE_PARAMETERS] = [
    "accel.s_x",
    "accel.s_y",
    "accel.s_z",
    "accel.alpha_yz",
    "accel.alpha_zy",
    "accel.alpha_zx",
    "accel.b_x",
    "accel.b_y",
    "accel.b_z",
];

/// Row and column in `T` of the first six.
pub const FORCE_PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// A row of the Jacobian.
pub type ForceRow = SVector<f64, FORCE_PARAMETERS>;
/// An information matrix or a covariance.
pub type ForceMatrix = SMatrix<f64, FORCE_PARAMETERS, FORCE_PARAMETERS>;

/// `∂(‖T (A − b)‖/g)` at the perfect sensor with `u` up: `u_i u_j` for the six of `T`, `−u` for `b/g`.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `u` | direction of the specific force, body frame | 1 | 3 |
/// | `T` | upper triangular scale and misalignment matrix | 1 | 3 × 3 |
/// | `b/g` | bias over gravity | 1 | 3 |
pub fn force_row(u: &Vector3<f64>) -> ForceRow {
    ForceRow::from_fn(|k, _| match FORCE_PLACES.get(k) {
        Some((i, j)) => u[*i] * u[*j],
        None => -u[k - 6],
    })
}

/// `Σ h hᵀ` of placements whose norms have unit noise.
pub fn force_information<'a>(
    directions: impl IntoIterator<Item = &'a Vector3<f64>>,
) -> ForceMatrix {
    directions
        .into_iter()
        .map(force_row)
        .map(|h| h * h.transpose())
        .sum()
}

/// `∫ (∂e/∂p)ᵀ (∂e/∂p)` over all directions `v` of the corrected reading's error `e = δT v − δb/g`: diagonal, `E v_i v_j`
/// `= δ_ij/3` for the elements of `T`, 1 for the biases, and nothing between them as `E v = 0`.
pub fn error_weights() -> ForceRow {
    ForceRow::from_fn(|k, _| if k < 6 { 1.0 / 3.0 } else { 1.0 })
}

/// Root mean square over all directions of the norm of the error of a corrected reading, for the covariance `c` of
/// the parameters: `√ tr(C W)`, in the unit of the noise of one placement. This is V-optimality's criterion.
pub fn reading_error(c: &ForceMatrix) -> f64 {
    c.diagonal().dot(&error_weights()).sqrt()
}

/// The covariance of the nine parameters, `None` where the placements leave one open.
pub fn force_covariance(information: &ForceMatrix) -> Option<ForceMatrix> {
    let largest = information.diagonal().max();
    let factor = information.cholesky()?;
    let least = factor.l_dirty().diagonal().min();
    (least * least > OPEN.get() * largest).then(|| factor.inverse())
}

findings::tuning! {
    /// A pivot below this share of the largest information is rounding.
    OPEN: f64 = 1e-9;
}

/// [`reading_error`] of placements, `None` where they leave a parameter open.
///
/// ```
/// use stillpoint_plan::{edges, placement_error};
///
/// // 10/4 of the noise variance: the twelve edges are as good as twelve placements can be.
/// assert!((placement_error(&edges()).unwrap().powi(2) - 2.5).abs() < 1e-9);
/// ```
pub fn placement_error(directions: &[Vector3<f64>]) -> Option<f64> {
    let covariance = force_covariance(&force_information(directions))?;
    Some(reading_error(&covariance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::faces_edges_corners;

    #[test]
    fn the_published_26_placements_leave_1_067_of_the_noise() {
        // Computed independently (numpy): 1.06595.
        let error = placement_error(&faces_edges_corners()).unwrap();
        assert!((error - 1.065_950).abs() < 1e-6, "{error}");
    }

    #[test]
    fn placements_in_one_plane_leave_parameters_open() {
        let flat: Vec<_> = (0..12)
            .map(|k| f64::from(k).sin_cos())
            .map(|(s, c)| Vector3::new(s, c, 0.0))
            .collect();
        assert!(placement_error(&flat).is_none());
    }

    #[test]
    fn the_row_is_the_difference_of_the_norm() {
        let u = Vector3::new(0.48, -0.6, 0.64);
        let norm = |p: &ForceRow| {
            let mut t = nalgebra::Matrix3::identity();
            for (k, place) in FORCE_PLACES.iter().enumerate() {
                t[*place] += p[k];
            }
            (t * (u - Vector3::new(p[6], p[7], p[8]))).norm()
        };
        let h = force_row(&u);
        for k in 0..FORCE_PARAMETERS {
            let mut step = ForceRow::zeros();
            step[k] = 1e-6;
            let difference = (norm(&step) - norm(&-step)) / 2e-6;
            assert!((difference - h[k]).abs() < 1e-9, "{k}");
        }
    }
}
