//! Exact designs by exchange: one placement after the other is replaced by the best of the candidates.
//!
//! Source: Fedorov, Theory of Optimal Experiments, 1972, chapter 3; many starts, as the criterion has many minima.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::accelerometer::{ForceMatrix, ForceRow, error_weights, force_row};

/// Optimality criterion of a design.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Criterion {
    /// Mean square error of a corrected reading over all directions (V- or I-optimality).
    #[default]
    Reading,
    /// Volume of the confidence ellipsoid (D-optimality).
    Volume,
}

findings::tuning! {
    /// Rounds of exchanges of one start.
    ROUNDS: usize = 40;
    /// Ridge on the diagonal that keeps the information matrix of few placements invertible.
    RIDGE: f64 = 1e-6;
    /// An exchange has to win by this share.
    GAIN: f64 = 1e-9;
}

/// The best `count` of `candidates` (repeats allowed) beside the information that is there already, by exchange from
/// `starts` random designs; the places of the candidates and the criterion's value (a mean square, or `−ln det`).
///
/// The same call gives the same design.
pub fn exchange(
    candidates: &[Vector3<f64>],
    count: usize,
    known: &ForceMatrix,
    criterion: Criterion,
    starts: usize,
) -> (Vec<usize>, f64) {
    let rows: Vec<ForceRow> = candidates.iter().map(force_row).collect();
    let mut random = ChaCha8Rng::seed_from_u64(count as u64);
    let mut best = (Vec::new(), f64::INFINITY);
    if rows.is_empty() || count == 0 {
        return best;
    }
    for _ in 0..starts {
        let start: Vec<usize> = (0..count)
            .map(|_| random.random_range(0..rows.len()))
            .collect();
        let found = descend(&rows, start, known, criterion);
        if found.1 < best.1 - GAIN.get() * best.1.abs().min(1e9) {
            best = found;
        }
    }
    best.0.sort_unstable();
    best
}

/// Exchanges until none helps.
pub(crate) fn descend(
    rows: &[ForceRow],
    mut chosen: Vec<usize>,
    known: &ForceMatrix,
    criterion: Criterion,
) -> (Vec<usize>, f64) {
    let outer = |k: usize| rows[k] * rows[k].transpose();
    let mut information: ForceMatrix = known + ForceMatrix::identity() * RIDGE.get();
    information += chosen.iter().map(|k| outer(*k)).sum::<ForceMatrix>();
    let mut value = value_of(&information, criterion);
    for _ in 0..ROUNDS.get() {
        let before = value;
        for place in chosen.iter_mut() {
            let without = information - outer(*place);
            let Some(inverse) = without.cholesky().map(|c| c.inverse()) else {
                continue;
            };
            let best = best_addition(rows, &inverse, criterion);
            if best == *place {
                continue;
            }
            let with = without + outer(best);
            let found = value_of(&with, criterion);
            if found < value - GAIN.get() * value.abs() {
                (*place, information, value) = (best, with, found);
            }
        }
        if value >= before {
            break;
        }
    }
    (chosen, value)
}

/// The candidate whose addition to a design with covariance `c` gains most: `hᵀ C W C h/(1 + hᵀ C h)`, or `hᵀ C h`.
fn best_addition(rows: &[ForceRow], c: &ForceMatrix, criterion: Criterion) -> usize {
    let gains = rows.iter().map(|h| gain(h, c, criterion)).enumerate();
    gains
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(k, _)| k)
}

/// Returns the gain of a placement with the row `h`, given the covariance `c` of the others.
pub(crate) fn gain(h: &ForceRow, c: &ForceMatrix, criterion: Criterion) -> f64 {
    let carried = c * h;
    let own = h.dot(&carried);
    match criterion {
        Criterion::Volume => own,
        Criterion::Reading => carried.component_mul(&carried).dot(&error_weights()) / (1.0 + own),
    }
}

fn value_of(information: &ForceMatrix, criterion: Criterion) -> f64 {
    let Some(factor) = information.cholesky() else {
        return f64::INFINITY;
    };
    match criterion {
        Criterion::Reading => factor.inverse().diagonal().dot(&error_weights()),
        Criterion::Volume => -2.0 * factor.l_dirty().diagonal().map(f64::ln).sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::faces_edges_corners;

    #[test]
    fn of_the_26_the_twelve_edges_are_the_best_twelve() {
        let all = faces_edges_corners();
        let none = ForceMatrix::zeros();
        let (chosen, square) = exchange(&all, 12, &none, Criterion::Reading, 300);
        // The edges are in the places after the faces; 2.5 is exact.
        assert!((square - 2.5).abs() < 1e-4, "{square} {chosen:?}");
    }

    #[test]
    fn the_same_call_gives_the_same_design() {
        let all = faces_edges_corners();
        let known = ForceMatrix::identity();
        let once = exchange(&all, 10, &known, Criterion::Volume, 20);
        assert_eq!(once, exchange(&all, 10, &known, Criterion::Volume, 20));
    }
}
