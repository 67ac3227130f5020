//! Exposure of the rows to a random walk of a bias.

use std::collections::BTreeMap;
use std::ops::Range;

use faer::Mat;
use nalgebra::{DMatrix, Matrix2x3, Vector3};

use crate::methods::joint::blocks::covariance::Covariance;

/// Integral of a walking bias over a group of `d` rows, from its value at the reference time and axis by axis:
/// `∫ w(t) (b(t) − b(t_r)) dt`.
///
/// Of a Brownian path of unit density, `E b_i(s) b_j(t) = δ_ij min(τ(s), τ(t))` with `τ` the distance from
/// the reference on the same side of it, 0 across. Groups do not overlap in time, so that of two the
/// nearer gives its first moment and the farther its total weight: `C = M₁ M₀ᵀ`.
#[derive(Clone, Debug)]
pub struct Exposure {
    /// The rows.
    pub rows: Range<usize>,
    /// The recording, or whatever has a path of its own: paths of different ones are independent.
    pub recording: usize,
    /// True if the group lies after the reference time.
    pub after: bool,
    /// Distance of its near end from the reference, s.
    pub near: f64,
    /// `∫ w dt` (d × 3).
    pub total: DMatrix<f64>,
    /// `∫ τ w dt` (d × 3).
    pub moment: DMatrix<f64>,
    /// Its own covariance (d × d).
    pub own: DMatrix<f64>,
}

impl Exposure {
    /// A mean over `[from, to]`, times `sign`.
    pub fn of_mean(
        rows: Range<usize>,
        recording: usize,
        (from, to): (f64, f64),
        reference: f64,
        sign: f64,
    ) -> Self {
        let middle = 0.5 * (from + to) - reference;
        let half = 0.5 * (to - from);
        let near = (middle.abs() - half).max(0.0);
        let unit = DMatrix::identity(3, 3);
        Self {
            rows,
            recording,
            after: middle >= 0.0,
            near,
            total: &unit * sign,
            moment: &unit * (sign * middle.abs()),
            own: unit * (near + 2.0 * half / 3.0),
        }
    }

    /// Samples at times `t` with the weights `gains` (2 × 3), on one side of the reference: the first of a turn that begins
    /// there may lie before it by rounding.
    pub fn of_samples(
        rows: Range<usize>,
        recording: usize,
        t: &[f64],
        gains: &[Matrix2x3<f64>],
        reference: f64,
    ) -> Self {
        let after = t.get(t.len() / 2).is_none_or(|t| *t >= reference);
        let outwards = if after { 1.0 } else { -1.0 };
        let distance = |t: f64| (outwards * (t - reference)).max(0.0);
        let mut total = Matrix2x3::zeros();
        let mut moment = Matrix2x3::zeros();
        let mut own = nalgebra::Matrix2::zeros();
        // From the far end inwards: `total` holds what lies farther out than the sample at hand.
        let mut add = |t: f64, g: &Matrix2x3<f64>| {
            let tau = distance(t);
            let cross = g * total.transpose();
            own += (g * g.transpose() + cross + cross.transpose()) * tau;
            total += g;
            moment += g * tau;
        };
        let samples = t.iter().zip(gains);
        if after {
            samples.rev().for_each(|(t, g)| add(*t, g));
        } else {
            samples.for_each(|(t, g)| add(*t, g));
        }
        let near = t.iter().map(|t| distance(*t)).fold(f64::INFINITY, f64::min);
        Self {
            rows,
            recording,
            after,
            near,
            total: DMatrix::from_iterator(2, 3, total.iter().copied()),
            moment: DMatrix::from_iterator(2, 3, moment.iter().copied()),
            own: DMatrix::from_iterator(2, 2, own.iter().copied()),
        }
    }
}

/// Covariance of all `m` rows for a walk of unit density.
pub fn covariance(exposures: &[Exposure], m: usize) -> Covariance {
    let of_path = |path: Path<'_, Exposure>| {
        let mut c = Mat::zeros(path.rows.len(), path.rows.len());
        for (k, (one, own)) in path.items.iter().enumerate() {
            put(&mut c, own, own, &one.own);
            for (other, at) in &path.items[..k] {
                if one.after != other.after {
                    continue;
                }
                let (near, far) = if one.near <= other.near {
                    ((one, own), (other, at))
                } else {
                    ((other, at), (one, own))
                };
                let block = &near.0.moment * far.0.total.transpose();
                put(&mut c, near.1, far.1, &block);
                put(&mut c, far.1, near.1, &block.transpose());
            }
        }
        (path.rows, c)
    };
    let paths = paths(exposures, |e| (e.recording, e.rows.clone()));
    Covariance::of_blocks(m, paths.into_iter().map(of_path).collect())
}

/// Rows that feel the same path of a bias.
pub struct Path<'a, T> {
    /// The rows, in ascending order.
    pub rows: Vec<usize>,
    /// Items that feel it, each with its rows as places among these.
    pub items: Vec<(&'a T, Range<usize>)>,
}

/// The paths that items feel, `of` the number of the path and the rows of each.
pub fn paths<T>(items: &[T], of: impl Fn(&T) -> (usize, Range<usize>)) -> Vec<Path<'_, T>> {
    let mut paths: BTreeMap<usize, Path<'_, T>> = BTreeMap::new();
    for item in items {
        let (number, rows) = of(item);
        let path = paths.entry(number).or_insert_with(|| Path {
            rows: Vec::new(),
            items: Vec::new(),
        });
        let first = path.rows.len();
        path.items.push((item, first..first + rows.len()));
        path.rows.extend(rows);
    }
    paths.into_values().collect()
}

/// Writes a block.
pub fn put(c: &mut Mat<f64>, rows: &Range<usize>, columns: &Range<usize>, block: &DMatrix<f64>) {
    for (i, row) in rows.clone().enumerate() {
        for (j, column) in columns.clone().enumerate() {
            c[(row, column)] = block[(i, j)];
        }
    }
}

/// `Σ g diag(σ²) gᵀ`: white noise of variance `σ²` per sample through the gains.
pub fn white(gains: &[Matrix2x3<f64>], variance: &Vector3<f64>) -> nalgebra::Matrix2<f64> {
    let diagonal = nalgebra::Matrix3::from_diagonal(variance);
    gains.iter().map(|g| g * diagonal * g.transpose()).sum()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    #[test]
    fn a_turn_that_begins_at_the_reference_lies_after_it_whatever_rounding_says() {
        let reference = 100.1;
        let gains = vec![Matrix2x3::from_fn(|i, j| if i == j { 1.0 } else { 0.3 }); 100];
        let at = |first: f64| {
            let t: Vec<f64> = (0..100).map(|k| first + 0.05 * f64::from(k)).collect();
            let rest = Exposure::of_mean(0..3, 0, (92.1, reference), reference, -1.0);
            let turn = Exposure::of_samples(3..5, 0, &t, &gains, reference);
            covariance(&[rest, turn], 5).to_dense()
        };
        let (exact, before) = (at(reference), at(reference - 1e-9));
        assert!((&exact - &before).norm_max() < 1e-5 * exact.norm_max());
        // What lies on either side of the reference has nothing in common.
        assert_eq!(before[(0, 3)], 0.0);
    }

    #[test]
    fn the_covariance_is_that_of_many_walks() {
        let (from, to, reference) = (0.0, 10.0, 4.0);
        let steps = 1000;
        let dt = (to - from) / f64::from(steps);
        let gains: Vec<_> = (0..200)
            .map(|k| Matrix2x3::from_fn(|i, j| (i as f64 + 0.3 * j as f64) - 0.01 * f64::from(k)))
            .collect();
        let t: Vec<f64> = (600..800).map(|k| (f64::from(k) + 0.5) * dt).collect();
        let exposures = [
            Exposure::of_mean(0..3, 0, (1.0, 3.0), reference, -1.0),
            Exposure::of_mean(3..6, 0, (4.5, 5.5), reference, 1.0),
            Exposure::of_samples(6..8, 0, &t, &gains, reference),
        ];
        let exact = covariance(&exposures, 8).to_dense();
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let mut sum = Mat::<f64>::zeros(8, 8);
        let walks = 4000;
        for _ in 0..walks {
            let mut path = vec![Vector3::zeros()];
            for _ in 0..steps {
                let step: Vector3<f64> =
                    Vector3::from_fn(|_, _| StandardNormal.sample(&mut random)) * dt.sqrt();
                path.push(path[path.len() - 1] + step);
            }
            let at = |t: f64| (path[(t / dt) as usize] + path[(t / dt) as usize + 1]) * 0.5;
            let start = path[400];
            let mean = |a: usize, b: usize| {
                (a..b)
                    .map(|k| (path[k] + path[k + 1]) * 0.5 - start)
                    .sum::<Vector3<f64>>()
                    / (b - a) as f64
            };
            let turn: nalgebra::Vector2<f64> = t
                .iter()
                .zip(&gains)
                .map(|(t, g)| g * (at(*t) - start))
                .sum();
            let row: Vec<f64> = (-mean(100, 300))
                .iter()
                .chain(mean(450, 550).iter())
                .chain(turn.iter())
                .copied()
                .collect();
            for i in 0..8 {
                for j in 0..8 {
                    sum[(i, j)] += row[i] * row[j] / f64::from(walks);
                }
            }
        }
        for i in 0..8 {
            for j in 0..8 {
                let scale = (exact[(i, i)] * exact[(j, j)]).sqrt();
                // A correlation from 4000 walks has a standard error of at most √2/√4000 = 2.2 %; four.
                assert!(
                    (sum[(i, j)] - exact[(i, j)]).abs() < 0.09 * scale,
                    "{i} {j}"
                );
            }
        }
    }
}
