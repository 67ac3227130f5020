//! A factor: residuals of a few blocks.

use pulp::{Arch, Simd, WithSimd};

use crate::residual::Residual;
use crate::scalar::Wide;

/// Residuals `r` (`m`) of a few blocks of variables, with their derivatives.
///
/// Derived for every [`Residual`] over any scalar, whose `x` are the stored values of the factor's
/// blocks one after the other; implement it by hand where the Jacobian has a faster form, also for
/// many rows side by side.
pub trait Factor: Send + Sync {
    /// Replaces `out` by the residuals at `x`, the stored values of the blocks one after the other;
    /// as many at every `x`.
    fn values(&self, x: &[f64], out: &mut Vec<f64>);

    /// Replaces `residuals` by those at `x` and `jacobian` by `∂r(x ⊞ δ)/∂δ` at `δ = 0`, row after
    /// row; its columns are the steps of the blocks one after the other (of a plain block the stored
    /// values), held ones too.
    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>);

    /// [`linearize`](Self::linearize) for the free columns only; for the solver.
    #[doc(hidden)]
    fn linearize_free(&self, at: &At<'_>, work: &mut Work) {
        work.arch.dispatch(Own {
            factor: self,
            at,
            work,
        });
    }
}

/// A Jacobian of one's own, compiled for the vector instructions that the machine has where it is inlined.
struct Own<'a, F: ?Sized> {
    factor: &'a F,
    at: &'a At<'a>,
    work: &'a mut Work,
}

impl<F: Factor + ?Sized> WithSimd for Own<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factor, at, work } = self;
        factor.linearize(at.x, &mut work.residuals, &mut work.jacobian);
        at.keep_free(work);
    }
}

/// A point of a factor.
#[doc(hidden)]
#[derive(Debug)]
pub struct At<'a> {
    /// Stored values, block after block.
    pub x: &'a [f64],
    pub(crate) parts: &'a [Part<'a>],
    /// Number of free columns.
    pub(crate) width: usize,
}

/// One block of a factor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part<'a> {
    /// Stored values.
    pub numbers: usize,
    /// Coordinates of a step, held ones too.
    pub dimension: usize,
    /// Those that are free, all if `None`.
    pub free: Option<&'a [u32]>,
    /// `∂(x ⊞ δ)/∂δ` by the free coordinates, `numbers × width`, row after row; `None` for the unit
    /// matrix.
    pub basis: Option<&'a [f64]>,
}

impl Part<'_> {
    /// Number of free coordinates.
    pub fn width(&self) -> usize {
        self.free.map_or(self.dimension, <[u32]>::len)
    }
}

/// Room for the evaluation of factors.
#[doc(hidden)]
#[derive(Debug, Default)]
pub struct Work {
    pub(crate) residuals: Vec<f64>,
    pub(crate) jacobian: Vec<f64>,
    spare: Vec<f64>,
    arch: Arch,
    narrow: Lanes<6>,
    wide: Lanes<12>,
}

/// Points and residuals over dual numbers.
#[derive(Debug)]
struct Lanes<const N: usize> {
    x: Vec<Wide<N>>,
    out: Vec<Wide<N>>,
}

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self {
            x: Vec::new(),
            out: Vec::new(),
        }
    }
}

impl At<'_> {
    /// Drops the columns of what is held.
    fn keep_free(&self, work: &mut Work) {
        if self.parts.iter().all(|part| part.free.is_none()) {
            return;
        }
        let all: usize = self.parts.iter().map(|part| part.dimension).sum();
        work.spare.clear();
        for row in work.jacobian.chunks_exact(all.max(1)) {
            let mut first = 0;
            for part in self.parts {
                match part.free {
                    None => work
                        .spare
                        .extend_from_slice(&row[first..first + part.dimension]),
                    Some(free) => work
                        .spare
                        .extend(free.iter().map(|&k| row[first + k as usize])),
                }
                first += part.dimension;
            }
        }
        std::mem::swap(&mut work.jacobian, &mut work.spare);
    }

    /// Residuals and Jacobian by dual numbers of `N` lanes.
    #[inline(always)]
    fn by_duals<const N: usize>(
        &self,
        residual: &impl Residual<Wide<N>>,
        lanes: &mut Lanes<N>,
        residuals: &mut Vec<f64>,
        jacobian: &mut Vec<f64>,
    ) {
        for pass in 0..self.width.div_ceil(N).max(1) {
            let first = pass * N;
            self.seed(first, &mut lanes.x);
            lanes.out.clear();
            residual.residuals(&lanes.x, &mut lanes.out);
            if pass == 0 {
                residuals.clear();
                residuals.extend(lanes.out.iter().map(|r| r.re));
                jacobian.clear();
                jacobian.resize(lanes.out.len() * self.width, 0.0);
            }
            if self.width == 0 {
                return;
            }
            let lane_count = N.min(self.width - first);
            for (row, value) in jacobian.chunks_exact_mut(self.width).zip(&lanes.out) {
                row[first..first + lane_count].copy_from_slice(&value.slopes[..lane_count]);
            }
        }
    }

    /// Writes the point with derivatives by the columns from `first` on.
    #[inline(always)]
    fn seed<const N: usize>(&self, first: usize, x: &mut Vec<Wide<N>>) {
        x.clear();
        let (mut value, mut column) = (0, 0);
        for part in self.parts {
            let width = part.width();
            let values = &self.x[value..value + part.numbers];
            for (k, &v) in values.iter().enumerate() {
                let Some(basis) = part.basis else {
                    let lane = (column + k).checked_sub(first);
                    x.push(match lane.filter(|&lane| lane < N && width > 0) {
                        Some(lane) => {
                            let mut seeded = Wide::constant(v);
                            seeded.slopes[lane] = 1.0;
                            seeded
                        }
                        None => v.into(),
                    });
                    continue;
                };
                let mut seeded = Wide::constant(v);
                for (c, slope) in basis[k * width..(k + 1) * width].iter().enumerate() {
                    if let Some(lane) = (column + c).checked_sub(first).filter(|&l| l < N) {
                        seeded.slopes[lane] = *slope;
                    }
                }
                x.push(seeded);
            }
            value += part.numbers;
            column += width;
        }
    }
}

impl<R> Factor for R
where
    R: Residual<f64> + Residual<Wide<6>> + Residual<Wide<12>> + Send + Sync,
{
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        out.clear();
        Residual::<f64>::residuals(self, x, out);
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        // By the stored values: what a caller without manifolds can mean.
        let parts = [Part {
            numbers: x.len(),
            dimension: x.len(),
            free: None,
            basis: None,
        }];
        let at = At {
            x,
            parts: &parts,
            width: x.len(),
        };
        at.by_duals(self, &mut Lanes::<12>::default(), residuals, jacobian);
    }

    fn linearize_free(&self, at: &At<'_>, work: &mut Work) {
        work.arch.dispatch(Duals {
            residual: self,
            at,
            work,
        });
    }
}

/// Residuals by dual numbers, compiled for the vector instructions that the machine has.
struct Duals<'a, R> {
    residual: &'a R,
    at: &'a At<'a>,
    work: &'a mut Work,
}

impl<R: Residual<Wide<6>> + Residual<Wide<12>>> WithSimd for Duals<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { residual, at, work } = self;
        let (residuals, jacobian) = (&mut work.residuals, &mut work.jacobian);
        if at.width <= 6 {
            at.by_duals(residual, &mut work.narrow, residuals, jacobian);
        } else {
            at.by_duals(residual, &mut work.wide, residuals, jacobian);
        }
    }
}
