//! Placements where the field is another: near iron, a magnet or a current.

use nalgebra::Vector3;

use super::factors::Reading;
use super::problem::{Minimum, Problem};
use crate::methods::chance;

findings::tuning! {
    /// Taken for disturbed where so large a difference happens by chance in fewer than this many recordings.
    UNLIKELY: f64 = 1e-3;
}

/// The placement that differs most from the others' field, if by more than chance; with its difference (norm, unit of the
/// readings).
/// `left` is what [`readings_left`] finds at the minimum.
pub fn most_disturbed(
    problem: &Problem<'_>,
    minimum: &Minimum,
    left: &[Vector3<f64>],
) -> Option<(usize, f64)> {
    let squares = left.iter().zip(&minimum.variances);
    let squares = squares.map(|(left, variance)| left.norm_squared() / variance);
    let used = problem.placements.iter().filter(|p| p.is_used).count();
    let (place, square) = squares
        .enumerate()
        .filter(|(k, _)| problem.placements[*k].is_used)
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    let p = chance::of_chi2(square, 3.0) * used as f64;
    (p < UNLIKELY.get()).then(|| (place, left[place].norm()))
}

/// Reading less model of each placement, in the unit of the readings.
pub fn readings_left(problem: &Problem<'_>, minimum: &Minimum) -> Vec<Vector3<f64>> {
    let report = &minimum.report;
    let of = |(k, placement): (usize, &super::Placement)| {
        let blocks = &minimum.blocks;
        let own = blocks.biases.get(placement.part).copied();
        let x: Vec<f64> = [
            blocks.model,
            blocks.fields[placement.recording],
            blocks.headings[k],
            blocks.errors,
        ]
        .into_iter()
        .chain(own)
        .flat_map(|block| report.value(block).iter().copied())
        .collect();
        let factor = Reading::new(problem.model, placement, problem.strength, 1.0);
        let factor = factor.with_own_bias(own.is_some());
        let mut out = Vec::new();
        solver::Factor::values(&factor, &x, &mut out);
        Vector3::from_column_slice(&out)
    };
    problem.placements.iter().enumerate().map(of).collect()
}
