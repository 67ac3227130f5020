//! The disagreement, with everything that the model's parameters could explain taken out.

use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, MatRef, Par, Side};

use crate::methods::joint::{Restricted, left_null_space};

/// Random walk densities of the biases of accelerometer (m/s²/√s) and gyroscope (rad/s/√s).
pub type Walks = [f64; 2];

/// `z = Nᵀ r ~ N(Nᵀ E β, I + k_a² C_a + k_g² C_g)`, `N` (`m × q`) the left null space of the Jacobian of a
/// model: what is left when all its parameters, directions and biases have had their share.
#[derive(Clone, Debug)]
pub struct Projected {
    /// `N` (`m × q`).
    pub null: Mat<f64>,
    /// `Nᵀ r` (`q × 1`).
    pub z: Mat<f64>,
    /// `Nᵀ C N` (`q × q`) of the walks of accelerometer and gyroscope; `None` without the sensor.
    pub walks: [Option<Mat<f64>>; 2],
}

impl Projected {
    /// Of white-whitened residuals (`m`), Jacobian (`m × n`) and walk covariances (`m × m`).
    pub fn new(residuals: &[f64], jacobian: &Mat<f64>, walks: [Option<&Mat<f64>>; 2]) -> Self {
        let null = left_null_space(jacobian);
        let r = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
        Self {
            z: null.transpose() * &r,
            walks: walks.map(|c| c.map(|c| null.transpose() * (c * &null))),
            null,
        }
    }

    /// Degrees of freedom `q`.
    pub fn dof(&self) -> usize {
        self.z.nrows()
    }

    /// `Nᵀ E` (`q × k`) of white-whitened columns.
    pub fn columns(&self, e: MatRef<'_, f64>) -> Mat<f64> {
        self.null.transpose() * e
    }

    /// The densities that make the data likeliest when nothing is missing.
    pub fn likeliest_walks(&self) -> Walks {
        let restricted = Restricted {
            z: self.z.col(0).iter().copied().collect(),
            covariances: self.walks.iter().flatten().cloned().collect(),
        };
        let variances = restricted.variances(&vec![true; restricted.covariances.len()]);
        let mut found = variances.into_iter();
        [0, 1].map(|s| match &self.walks[s] {
            Some(_) => found.next().map_or(0.0, f64::sqrt),
            None => 0.0,
        })
    }

    /// `V = I + k_a² C_a + k_g² C_g` (`q × q`); `None` where that is the identity.
    pub fn covariance(&self, walks: Walks) -> Option<Mat<f64>> {
        let q = self.dof();
        let mut sum: Option<Mat<f64>> = None;
        for (c, k) in self.walks.iter().zip(walks) {
            if let (Some(c), true) = (c, k > 0.0) {
                *sum.get_or_insert_with(|| Mat::identity(q, q)) += faer::Scale(k * k) * c;
            }
        }
        sum
    }

    /// The whole at given densities; `None` where they are not finite.
    pub fn at(&self, walks: Walks) -> Option<Whitened> {
        let factor = match self.covariance(walks) {
            Some(v) => Some(v.llt(Side::Lower).ok()?.L().to_owned()),
            None => None,
        };
        let mut z = self.z.clone();
        let log_determinant = match &factor {
            Some(l) => {
                solve_lower_triangular_in_place(l.as_ref(), z.as_mut(), Par::Seq);
                (0..self.dof()).map(|k| 2.0 * l[(k, k)].ln()).sum()
            }
            None => 0.0,
        };
        Some(Whitened {
            square: z.squared_norm_l2(),
            z,
            factor,
            log_determinant,
        })
    }
}

/// The disagreement at given densities of the walks, whitened.
#[derive(Clone, Debug)]
pub struct Whitened {
    /// `L⁻¹ z` (`q × 1`).
    pub z: Mat<f64>,
    /// `L` of `V = L Lᵀ`; `None` for the identity.
    factor: Option<Mat<f64>>,
    /// `ln det V`.
    pub log_determinant: f64,
    /// `zᵀ V⁻¹ z`: χ² of `q` when nothing is missing.
    pub square: f64,
}

impl Whitened {
    /// `L⁻¹ F` (`q × k`) of projected columns.
    pub fn columns(&self, f: &Mat<f64>) -> Mat<f64> {
        let mut w = f.clone();
        if let Some(l) = &self.factor {
            solve_lower_triangular_in_place(l.as_ref(), w.as_mut(), Par::Seq);
        }
        w
    }

    /// Log-likelihood of the model as it is, up to a constant.
    pub fn log_likelihood(&self) -> f64 {
        -0.5 * (self.log_determinant + self.square)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::linalg::solvers::DenseSolveCore;

    #[test]
    fn the_square_is_that_of_the_disagreement_under_its_whole_covariance() {
        let j = Mat::from_fn(9, 2, |i, k| ((i * 3 + k * 7) % 5) as f64 - 2.0);
        let r: Vec<f64> = (0..9).map(|i| ((i * 4 % 9) as f64) - 4.0).collect();
        let walk = Mat::from_fn(9, 9, |i, k| (i.min(k) + 1) as f64);
        let projected = Projected::new(&r, &j, [Some(&walk), None]);
        assert_eq!(projected.dof(), 7);
        let at = projected.at([0.5, 0.0]).unwrap();
        // zᵀ (Nᵀ(I + k²C)N)⁻¹ z with the inverse written out.
        let v = Mat::<f64>::identity(9, 9) + faer::Scale(0.25) * &walk;
        let inner = projected.null.transpose() * (&v * &projected.null);
        let inverse = inner.llt(Side::Lower).unwrap().inverse();
        let direct = (projected.z.transpose() * (inverse * &projected.z))[(0, 0)];
        assert!((at.square / direct - 1.0).abs() < 1e-12);
        assert!(
            (projected.at([0.0; 2]).unwrap().square - projected.z.squared_norm_l2()).abs() < 1e-12
        );
    }
}
