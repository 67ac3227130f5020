//! The disagreement, with everything that the model's parameters could explain taken out.

use estimate::methods::joint::{
    BiasNoise, Component, ComponentKind, NoiseLevel, Within, left_null_space,
};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, MatRef, Par, Side};

/// `z = Nᵀ r ~ N(Nᵀ E β, I + Σ θ_c C_c)`, `N` (`m × q`) the left null space of the Jacobian of a model: what is left when
/// all its parameters, directions and biases have had their share; `C_c` those of walk and flicker of the biases.
#[derive(Clone, Debug)]
pub struct Projected {
    /// `N` (`m × q`).
    pub null: Mat<f64>,
    /// `Nᵀ r` (`q × 1`).
    pub z: Mat<f64>,
    /// `Nᵀ C N` (`q × q`) of the noise of the biases.
    pub noise: Vec<(ComponentKind, Mat<f64>)>,
    /// The scatter of the turns at its likeliest (`q × q`), where they are off by far more than the noise.
    pub scatter: Option<Mat<f64>>,
    /// What the readings within static intervals say of that noise, in its order: no error of a model shows there.
    pub within: Vec<Within>,
}

impl Projected {
    /// Of white-whitened residuals (`m`), Jacobian (`m × n`) and kinds of noise (`m × m`) with their levels.
    pub fn new(
        residuals: &[f64],
        jacobian: &Mat<f64>,
        (noise, levels): (&[Component], &[NoiseLevel]),
    ) -> Self {
        let null = left_null_space(jacobian);
        let r = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
        let of_biases = |c: &&Component| c.kind.is_walk() || c.kind.is_flicker();
        let of_turns = |c: &&Component| c.kind == ComponentKind::TurnScatter;
        let scatter = noise.iter().find(of_turns).and_then(|c| {
            let size = levels.iter().find(|level| level.kind == c.kind)?.size;
            (size > 0.0).then(|| faer::Scale(size * size) * c.covariance.both_sides(&null))
        });
        let noise = noise.iter().filter(of_biases);
        Self {
            scatter,
            z: null.transpose() * &r,
            noise: noise
                .map(|c| (c.kind, c.covariance.both_sides(&null)))
                .collect(),
            within: Vec::new(),
            null,
        }
    }

    /// Kinds of noise of the biases, in order.
    pub fn kinds(&self) -> Vec<ComponentKind> {
        self.noise.iter().map(|(kind, _)| *kind).collect()
    }

    /// Degrees of freedom `q`.
    pub fn dof(&self) -> usize {
        self.z.nrows()
    }

    /// `Nᵀ E` (`q × k`) of white-whitened columns.
    pub fn columns(&self, e: MatRef<'_, f64>) -> Mat<f64> {
        self.null.transpose() * e
    }

    /// `V = I + Σ θ_c C_c` (`q × q`); `None` where that is the identity.
    pub fn covariance(&self, noise: BiasNoise) -> Option<Mat<f64>> {
        let q = self.dof();
        let mut sum: Option<Mat<f64>> = None;
        for (kind, size) in noise.sizes() {
            let own = self.noise.iter().find(|(own, _)| *own == kind);
            if let (Some((_, c)), true) = (own, size > 0.0) {
                *sum.get_or_insert_with(|| Mat::identity(q, q)) += faer::Scale(size * size) * c;
            }
        }
        sum
    }

    fn log_likelihood_within(&self, noise: &BiasNoise) -> f64 {
        let variance = |(kind, _): &(ComponentKind, Mat<f64>)| {
            let size = noise.sizes().find(|(own, _)| own == kind);
            size.map_or(0.0, |(_, size)| size * size)
        };
        let theta: Vec<f64> = self.noise.iter().map(variance).collect();
        self.within.iter().map(|w| w.log_likelihood(&theta)).sum()
    }

    /// The whole at given noise of the biases; `None` where that is not finite.
    pub fn at(&self, noise: BiasNoise) -> Option<Whitened> {
        self.at_share(noise, 1.0)
    }

    /// The same with a share of the variance by which turns scatter.
    pub fn at_share(&self, noise: BiasNoise, share: f64) -> Option<Whitened> {
        let mut covariance = self.covariance(noise);
        if let (Some(scatter), true) = (&self.scatter, share > 0.0) {
            let q = self.dof();
            *covariance.get_or_insert_with(|| Mat::identity(q, q)) += faer::Scale(share) * scatter;
        }
        let factor = match covariance {
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
            within: self.log_likelihood_within(&noise),
            square: z.squared_norm_l2(),
            z,
            factor,
            log_determinant,
        })
    }
}

/// The disagreement at given noise of the biases, whitened.
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
    /// Log-likelihood of the readings within static intervals.
    within: f64,
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
        self.within - 0.5 * (self.log_determinant + self.square)
    }
}

#[cfg(test)]
mod tests {
    use estimate::methods::joint::Covariance;
    use faer::linalg::solvers::DenseSolveCore;

    use super::*;

    #[test]
    fn the_square_is_that_of_the_disagreement_under_its_whole_covariance() {
        let j = Mat::from_fn(9, 2, |i, k| ((i * 3 + k * 7) % 5) as f64 - 2.0);
        let r: Vec<f64> = (0..9).map(|i| ((i * 4 % 9) as f64) - 4.0).collect();
        let walk = Mat::from_fn(9, 9, |i, k| (i.min(k) + 1) as f64);
        let component = Component {
            kind: ComponentKind::AccelerometerWalk,
            covariance: Covariance::dense(walk.clone()),
        };
        let projected = Projected::new(&r, &j, (&[component], &[]));
        assert_eq!(projected.dof(), 7);
        let at = projected.at(BiasNoise::walks([0.5, 0.0])).unwrap();
        // zᵀ (Nᵀ(I + k²C)N)⁻¹ z with the inverse written out.
        let v = Mat::<f64>::identity(9, 9) + faer::Scale(0.25) * &walk;
        let inner = projected.null.transpose() * (&v * &projected.null);
        let inverse = inner.llt(Side::Lower).unwrap().inverse();
        let direct = (projected.z.transpose() * (inverse * &projected.z))[(0, 0)];
        assert!((at.square / direct - 1.0).abs() < 1e-12);
        assert!(
            (projected.at(BiasNoise::default()).unwrap().square - projected.z.squared_norm_l2())
                .abs()
                < 1e-12
        );
    }
}
