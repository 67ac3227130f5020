//! Manifolds of blocks: the numbers stored and the steps that may be taken.

use std::fmt::Debug;

use crate::scalar::{Jet, LANES, Scalar, derivatives, variable};

/// A manifold: `numbers` stored values of which a step has `dimension` coordinates.
///
/// | symbol | meaning | length |
/// |---|---|---|
/// | `x`, `y` | points, as stored | `numbers` |
/// | `δ` | step at `x` | `dimension` |
/// | `x ⊞ δ` | [`retract`](Self::retract): the point after the step | `numbers` |
/// | `y ⊟ x` | [`local`](Self::local): the step from `x` to `y` | `dimension` |
///
/// `x ⊞ 0 = x` and `x ⊞ (y ⊟ x) = y`; [`check_manifold`] tests both. Written once over any scalar:
/// derivatives of `⊞` at `δ = 0` follow from dual numbers, so `sqrt` and divisions by `‖δ‖` need a
/// series near zero.
///
/// ```
/// use stillpoint_solver::{Manifold, Scalar, check_manifold};
///
/// /// A positive number, stored as it is, stepped by factors.
/// #[derive(Debug)]
/// struct Positive;
///
/// impl Manifold for Positive {
///     fn numbers(&self) -> usize { 1 }
///     fn dimension(&self) -> usize { 1 }
///     fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
///         out[0] = x[0] * step[0].exp();
///     }
///     fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
///         out[0] = (y[0] / x[0]).ln();
///     }
/// }
/// assert!(check_manifold(&Positive, &[2.0], &[0.3]) < 1e-8);
/// ```
pub trait Manifold: Debug + Send + Sync + 'static {
    /// Number of values that a point stores.
    fn numbers(&self) -> usize;

    /// Number of coordinates of a step.
    fn dimension(&self) -> usize;

    /// Writes `x ⊞ δ`.
    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]);

    /// Writes `y ⊟ x`.
    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]);

    /// True where `x ⊞ δ = x + δ`.
    fn is_flat(&self) -> bool {
        false
    }

    /// The stored number `i` to which a coordinate `k` of every step is added, `(x ⊞ δ)ᵢ = xᵢ + δₖ` whatever the others are:
    /// [`Graph::bound`](crate::Graph::bound) can keep it within bounds. `None` where there is none; [`check_manifold`] tests it.
    fn plain(&self, coordinate: usize) -> Option<usize> {
        (self.is_flat() && coordinate < self.dimension()).then_some(coordinate)
    }
}

/// `n` plain numbers: `x ⊞ δ = x + δ`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Euclidean(pub usize);

impl Manifold for Euclidean {
    fn numbers(&self) -> usize {
        self.0
    }

    fn dimension(&self) -> usize {
        self.0
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        for (out, (&x, &step)) in out.iter_mut().zip(x.iter().zip(step)) {
            *out = x + step;
        }
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        for (out, (&x, &y)) in out.iter_mut().zip(x.iter().zip(y)) {
            *out = y - x;
        }
    }

    fn is_flat(&self) -> bool {
        true
    }
}

/// A manifold behind a pointer, derived from every [`Manifold`].
pub(crate) trait AnyManifold: Debug + Send + Sync {
    /// [`Manifold::is_flat`].
    fn is_flat(&self) -> bool;
    /// [`Manifold::plain`].
    fn plain(&self, coordinate: usize) -> Option<usize>;
    /// `x ⊞ δ`.
    fn retract(&self, x: &[f64], step: &[f64], out: &mut [f64]);
    /// `∂(x ⊞ δ)/∂δ` at `δ = 0`, `numbers × dimension`, row after row.
    fn tangent(&self, x: &[f64], basis: &mut [f64]);
}

/// Numbers of a manifold up to which none are put on the heap.
const FEW: usize = 8;

impl<M: Manifold> AnyManifold for M {
    fn is_flat(&self) -> bool {
        Manifold::is_flat(self)
    }

    fn plain(&self, coordinate: usize) -> Option<usize> {
        Manifold::plain(self, coordinate)
    }

    fn retract(&self, x: &[f64], step: &[f64], out: &mut [f64]) {
        Manifold::retract(self, x, step, out);
    }

    fn tangent(&self, x: &[f64], basis: &mut [f64]) {
        let d = Manifold::dimension(self);
        let mut room = [[Jet::from(0.0); FEW]; 3];
        let mut more = Vec::new();
        let [at, out, step] = if x.len().max(d) <= FEW {
            room.each_mut().map(|part| &mut part[..])
        } else {
            let longest = x.len().max(d);
            more.resize(3 * longest, Jet::from(0.0));
            let (at, others) = more.split_at_mut(longest);
            let (out, step) = others.split_at_mut(longest);
            [at, out, step]
        };
        let (at, out, step) = (&mut at[..x.len()], &mut out[..x.len()], &mut step[..d]);
        at.iter_mut().zip(x).for_each(|(at, &x)| *at = Jet::from(x));
        for first in (0..d).step_by(LANES) {
            out.copy_from_slice(at);
            step.fill(Jet::from(0.0));
            let lanes = LANES.min(d - first);
            for lane in 0..lanes {
                step[first + lane] = variable(0.0, lane);
            }
            Manifold::retract(self, at, step, out);
            for (row, value) in basis.chunks_exact_mut(d).zip(&*out) {
                row[first..first + lanes].copy_from_slice(&derivatives(value)[..lanes]);
            }
        }
    }
}

/// The largest departure of a manifold from its rules at `x` (as stored) with the step `δ`: of
/// `x ⊞ 0` from `x`, of `(x ⊞ δ) ⊟ x` from `δ`, of `x ⊞ (y ⊟ x)` from `y = x ⊞ δ`, and of the
/// derivative of `⊞` at 0 from central differences (good to some 1e-9), of `⊟` from its inverse; of numbers that
/// [`Manifold::plain`] names from `xᵢ + δₖ`.
/// Infinite where something is not finite or a length is wrong.
pub fn check_manifold<M: Manifold>(manifold: &M, x: &[f64], step: &[f64]) -> f64 {
    let (n, d) = (manifold.numbers(), manifold.dimension());
    if x.len() != n || step.len() != d {
        return f64::INFINITY;
    }
    let retract = |x: &[f64], step: &[f64]| {
        let mut out = vec![0.0; n];
        Manifold::retract(manifold, x, step, &mut out);
        out
    };
    let local = |x: &[f64], y: &[f64]| {
        let mut out = vec![0.0; d];
        Manifold::local(manifold, x, y, &mut out);
        out
    };
    let y = retract(x, step);
    let mut worst = distance(&retract(x, &vec![0.0; d]), x);
    worst = larger(worst, distance(&local(x, &y), step));
    worst = larger(worst, distance(&retract(x, &local(x, &y)), &y));
    let mut basis = vec![0.0; n * d];
    manifold.tangent(x, &mut basis);
    for k in 0..d {
        if let Some(i) = Manifold::plain(manifold, k) {
            let sum = x.get(i).map_or(f64::INFINITY, |x| x + step[k]);
            worst = larger(worst, (y.get(i).map_or(0.0, |y| *y) - sum).abs());
        }
        let moved = |h: f64| {
            let mut small = vec![0.0; d];
            small[k] = h;
            retract(x, &small)
        };
        let h = 1e-5;
        let slope: Vec<f64> = moved(h)
            .iter()
            .zip(moved(-h))
            .map(|(a, b)| (a - b) / (2.0 * h))
            .collect();
        let column: Vec<f64> = (0..n).map(|i| basis[i * d + k]).collect();
        worst = larger(worst, distance(&slope, &column));
        // `⊟` along the column: the unit step `k`.
        let along: Vec<Jet> = (0..n)
            .map(|i| {
                crate::scalar::jet(
                    x[i],
                    std::array::from_fn(|l| if l == 0 { column[i] } else { 0.0 }),
                )
            })
            .collect();
        let at: Vec<Jet> = x.iter().map(|&x| Jet::from(x)).collect();
        let mut out = vec![Jet::from(0.0); d];
        Manifold::local(manifold, &at, &along, &mut out);
        let slopes: Vec<f64> = out.iter().map(|v| derivatives(v)[0]).collect();
        let unit: Vec<f64> = (0..d).map(|i| f64::from(u8::from(i == k))).collect();
        worst = larger(worst, distance(&slopes, &unit));
    }
    worst
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |most, (a, b)| larger(most, (a - b).abs()))
}

fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}
