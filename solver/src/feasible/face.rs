//! A face of the feasible set: some constraints held, steps along the rest.

use faer::{Mat, MatRef};

use super::multipliers::nonnegative;
use super::{Active, Polytope, Side};
use crate::linear::vector::{add, dot, norm, unscaled};
use crate::linear::{Factor, QrFactor, multiply};
use crate::minimise::point::Point;

/// Diagonal of a pivoted `R` (of unit rows) below which constraints count as dependent.
const DEPENDENT: f64 = 1e-12;

/// The held constraints `A D⁻¹ y = …` with unit rows, and an orthonormal basis of the directions
/// `y = D p` that keep them.
pub(crate) struct Face {
    active: Vec<Active>,
    /// Unit rows of `A D⁻¹`, transposed (`n × k`).
    normals: Mat<f64>,
    /// Norms of the rows of `A D⁻¹`.
    norms: Vec<f64>,
    /// Orthonormal basis of the span of the normals (`n × rank`).
    range: Mat<f64>,
    /// Orthonormal basis of its complement (`n × (n − rank)`).
    kernel: Mat<f64>,
    scale: Vec<f64>,
}

impl Face {
    /// The face on which `active` hold, in scaled parameters.
    pub fn new(polytope: &Polytope, active: Vec<Active>, scale: &[f64]) -> Self {
        let n = scale.len();
        let scaled = |j: usize, k: usize| polytope.rows()[active[j].row].a[k] / scale[k];
        let norms: Vec<f64> = (0..active.len())
            .map(|j| norm(&(0..n).map(|k| scaled(j, k)).collect::<Vec<_>>()))
            .collect();
        let unit = |j: usize| if norms[j] > 0.0 { norms[j] } else { 1.0 };
        let normals = Mat::from_fn(n, active.len(), |k, j| scaled(j, k) / unit(j));
        let (q, rank) = if active.is_empty() {
            (Mat::identity(n, n), 0)
        } else {
            let qr = normals.col_piv_qr();
            let r = qr.R();
            let rank = (0..n.min(active.len()))
                .take_while(|&k| r[(k, k)].abs() > DEPENDENT)
                .count();
            (qr.compute_Q(), rank)
        };
        Self {
            range: Mat::from_fn(n, rank, |i, k| q[(i, k)]),
            kernel: Mat::from_fn(n, n - rank, |i, k| q[(i, rank + k)]),
            active,
            normals,
            norms,
            scale: scale.to_vec(),
        }
    }

    /// The face at a point that the cost falls along, or rests on: of the constraints that it touches
    /// those that hold back the steepest scaled descent, and all equalities.
    pub fn at(polytope: &Polytope, point: &Point, scale: &[f64]) -> Self {
        // No step that lowers the cost is longer than a few residuals.
        let length = norm(&point.at.residuals);
        let touching = polytope.touching(&point.z, scale, length);
        Self::new(polytope, touching, scale).holding(polytope, &point.gradient())
    }

    /// The face without the constraints that a gradient does not press on.
    fn holding(self, polytope: &Polytope, gradient: &[f64]) -> Self {
        let pressed = self.multipliers(gradient);
        let held = |(active, m): (&Active, &f64)| {
            (active.side == Side::Both || *m != 0.0).then_some(*active)
        };
        let active: Vec<Active> = self.active.iter().zip(&pressed).filter_map(held).collect();
        if active.len() == self.active.len() {
            return self;
        }
        Self::new(polytope, active, &self.scale)
    }

    /// The constraints held.
    pub fn active(&self) -> &[Active] {
        &self.active
    }

    /// `∂cost/∂limit` of every held constraint: `argmin ‖D⁻¹ (gradient − Aᵀ μ)‖` with `μ ≥ 0` at
    /// lower limits and `μ ≤ 0` at upper ones; what is left is the steepest scaled descent, reversed,
    /// that no held constraint forbids.
    pub fn multipliers(&self, gradient: &[f64]) -> Vec<f64> {
        self.unit_multipliers(&unscaled(gradient, &self.scale))
            .iter()
            .zip(self.active.iter().zip(&self.norms))
            .map(|(m, (active, norm))| {
                if *norm > 0.0 {
                    active.side.sign() * m / norm
                } else {
                    0.0
                }
            })
            .collect()
    }

    /// `‖D⁻¹ (gradient − Aᵀ μ)‖` with these multipliers: zero at a minimum.
    pub fn unbalanced(&self, gradient: &[f64]) -> f64 {
        let scaled = unscaled(gradient, &self.scale);
        let balance = multiply(self.inward().as_ref(), &self.unit_multipliers(&scaled));
        norm(&add(&scaled, -1.0, &balance))
    }

    /// Multipliers of the inward unit normals.
    fn unit_multipliers(&self, scaled: &[f64]) -> Vec<f64> {
        let free: Vec<bool> = self.active.iter().map(|a| a.side == Side::Both).collect();
        nonnegative(self.inward().as_ref(), scaled, &free)
    }

    /// The normals, turned to where the set is.
    fn inward(&self) -> Mat<f64> {
        Mat::from_fn(self.normals.nrows(), self.normals.ncols(), |i, j| {
            self.active[j].side.sign() * self.normals[(i, j)]
        })
    }

    /// The shortest scaled step that puts `z` on the face.
    pub fn onto(&self, polytope: &Polytope, z: &[f64]) -> Vec<f64> {
        let rank = self.range.ncols();
        if rank == 0 {
            return vec![0.0; z.len()];
        }
        let gap = |j: usize| {
            let active = self.active[j];
            let miss = polytope.limit(active) - dot(&polytope.rows()[active.row].a, z);
            if self.norms[j] > 0.0 {
                miss / self.norms[j]
            } else {
                0.0
            }
        };
        // Nᵀ U w = gap with U the range.
        let system = self.normals.transpose() * &self.range;
        let gaps: Vec<f64> = (0..self.active.len()).map(|j| -gap(j)).collect();
        let w = QrFactor::new(system.as_ref(), &vec![1.0; rank]).undamped(&gaps);
        let y = multiply(self.range.as_ref(), &w.unwrap_or_else(|| vec![0.0; rank]));
        unscaled(&y, &self.scale)
    }

    /// The Jacobian along the face, factored.
    pub fn factor(&self, jacobian: MatRef<'_, f64>) -> FaceFactor<'_> {
        let scaled = Mat::from_fn(jacobian.nrows(), jacobian.ncols(), |i, k| {
            jacobian[(i, k)] / self.scale[k]
        });
        let along = &scaled * &self.kernel;
        let dimension = along.ncols();
        let reduced = (dimension > 0).then(|| QrFactor::new(along.as_ref(), &vec![1.0; dimension]));
        FaceFactor {
            face: self,
            reduced,
        }
    }

    /// `D⁻¹ Z`, the directions along the face in the parameters' units (`n × d`).
    pub fn directions(&self) -> Mat<f64> {
        Mat::from_fn(self.kernel.nrows(), self.kernel.ncols(), |i, k| {
            self.kernel[(i, k)] / self.scale[i]
        })
    }
}

/// Solves for steps along a face.
pub(crate) struct FaceFactor<'a> {
    face: &'a Face,
    /// `None` at a vertex, where there is no direction left.
    reduced: Option<QrFactor>,
}

impl FaceFactor<'_> {
    fn expand(&self, u: &[f64]) -> Vec<f64> {
        let y = multiply(self.face.kernel.as_ref(), u);
        unscaled(&y, &self.face.scale)
    }
}

impl Factor for FaceFactor<'_> {
    fn damped(&self, b: &[f64], lambda: f64) -> Option<Vec<f64>> {
        let u = self
            .reduced
            .as_ref()
            .map_or(Some(Vec::new()), |f| f.damped(b, lambda))?;
        Some(self.expand(&u))
    }

    fn undamped(&self, b: &[f64]) -> Option<Vec<f64>> {
        let u = self
            .reduced
            .as_ref()
            .map_or(Some(Vec::new()), |f| f.undamped(b))?;
        Some(self.expand(&u))
    }

    fn tangential(&self, b: &[f64]) -> f64 {
        self.reduced.as_ref().map_or(0.0, |f| f.tangential(b))
    }
}
