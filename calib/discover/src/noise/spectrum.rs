//! The noise of the biases at every size of one kind of it, from one factorisation.

use std::sync::Arc;

use estimate::methods::joint::Columns;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Side};

/// `V(θ) = V₀ + θ C` (`q × q`) of a recording, as `V(θ)⁻¹ = Wᵀ (I + θ Λ)⁻¹ W` with `W = Uᵀ L₀⁻¹`, `L₀ L₀ᵀ = V₀` and
/// `U Λ Uᵀ = L₀⁻¹ C L₀⁻ᵀ`: the same `W` for all `θ`.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// `W` (`q × q`).
    turn: Arc<Mat<f64>>,
    /// `Λ` (`q`).
    rates: Vec<f64>,
    /// `ln det V₀`.
    log_determinant: f64,
}

impl Spectrum {
    /// Builds it from `V₀`, the identity where there is none, and `C`; `None` where one of them is not finite.
    pub fn new(v: Option<&Mat<f64>>, c: Mat<f64>) -> Option<Self> {
        let q = c.nrows();
        let factor = match v {
            Some(v) => Some(v.llt(Side::Lower).ok()?.L().to_owned()),
            None => None,
        };
        let solved = |mut a: Mat<f64>| {
            if let Some(l) = &factor {
                solve_lower_triangular_in_place(l.as_ref(), a.as_mut(), Par::Seq);
            }
            a
        };
        let once = solved(c);
        let eigen = solved(once.transpose().to_owned());
        let eigen = eigen.self_adjoint_eigen(Side::Lower).ok()?;
        let rates = eigen.S().column_vector().iter();
        let mut turn = eigen.U().to_owned();
        if let Some(l) = &factor {
            solve_upper_triangular_in_place(l.transpose(), turn.as_mut(), Par::Seq);
        }
        let pivots = factor.iter();
        let pivots = pivots.flat_map(|l| (0..q).map(|k| 2.0 * l[(k, k)].ln()));
        Some(Self {
            rates: rates.map(|rate| rate.max(0.0)).collect(),
            log_determinant: pivots.sum(),
            turn: Arc::new(turn.transpose().to_owned()),
        })
    }

    /// `V(θ)` as a root.
    pub fn at(&self, theta: f64) -> Root {
        let scale = self.rates.iter();
        Root::Turned {
            turn: Arc::clone(&self.turn),
            scale: scale
                .map(|rate| (1.0 + theta * rate).sqrt().recip())
                .collect(),
        }
    }

    /// `ln det V(θ)`.
    pub fn log_determinant(&self, theta: f64) -> f64 {
        let more = self.rates.iter().map(|rate| (theta * rate).ln_1p());
        self.log_determinant + more.sum::<f64>()
    }
}

/// `R` (`q × q`) with `V⁻¹ = Rᵀ R`.
#[derive(Clone, Debug)]
pub enum Root {
    /// `V = I`.
    Identity,
    /// `R = L⁻¹` by the Cholesky factor `L` of `V`.
    Inverse(Mat<f64>),
    /// `R = D W` with a diagonal `D`.
    Turned {
        /// `W`, which sizes of one kind of noise share.
        turn: Arc<Mat<f64>>,
        /// `D`.
        scale: Vec<f64>,
    },
}

impl Root {
    /// `R F`.
    pub fn times(&self, mut f: Mat<f64>) -> Mat<f64> {
        match self {
            Self::Identity => {}
            Self::Inverse(l) => {
                solve_lower_triangular_in_place(l.as_ref(), f.as_mut(), Par::Seq);
            }
            Self::Turned { turn, scale } => {
                f = turn.as_ref() * f;
                scaled(&mut f, scale);
            }
        }
        f
    }

    /// `W`, where it has one.
    fn turn(&self) -> Option<&Arc<Mat<f64>>> {
        match self {
            Self::Turned { turn, .. } => Some(turn),
            _ => None,
        }
    }
}

/// `D F`.
fn scaled(f: &mut Mat<f64>, scale: &[f64]) {
    for column in f.as_mut().col_iter_mut() {
        for (value, scale) in column.iter_mut().zip(scale) {
            *value *= scale;
        }
    }
}

/// `R F` of columns, part by part.
pub fn product(roots: &[Root], mut f: Columns) -> Columns {
    for (k, root) in roots.iter().enumerate() {
        let values = &mut f.part_mut(k).values;
        *values = root.times(std::mem::replace(values, Mat::zeros(0, 0)));
    }
    f
}

/// Columns `F` with `W F`, kept from one size of the noise to the next.
#[derive(Debug)]
pub struct Kept<'a> {
    columns: &'a Columns,
    turned: Option<(Vec<Arc<Mat<f64>>>, Columns)>,
}

impl<'a> Kept<'a> {
    /// A spectrum of these columns, without any product yet.
    pub fn of(columns: &'a Columns) -> Self {
        Self {
            columns,
            turned: None,
        }
    }

    /// `R F`, part by part.
    pub fn times(&mut self, roots: &[Root]) -> Columns {
        let turns: Option<Vec<&Arc<Mat<f64>>>> = roots.iter().map(Root::turn).collect();
        let Some(turns) = turns else {
            return product(roots, self.columns.clone());
        };
        let is_of = |own: &[Arc<Mat<f64>>]| {
            let mut pairs = own.iter().zip(&turns);
            pairs.all(|(own, turn)| Arc::ptr_eq(own, turn))
        };
        let known = self.turned.take().filter(|(own, _)| is_of(own));
        let (own, turned) = known.unwrap_or_else(|| {
            let mut all = self.columns.clone();
            for (k, turn) in turns.iter().enumerate() {
                let values = &mut all.part_mut(k).values;
                *values = turn.as_ref() * &*values;
            }
            (turns.iter().map(|turn| Arc::clone(turn)).collect(), all)
        });
        let mut all = turned.clone();
        self.turned = Some((own, turned));
        for (k, root) in roots.iter().enumerate() {
            if let Root::Turned { scale, .. } = root {
                scaled(&mut all.part_mut(k).values, scale);
            }
        }
        all
    }
}
