//! Intervals that the fit did not see: cross-validation over blocks of rests.

use estimate::methods::joint::BiasNoise;
use nalgebra::{DMatrix, DVector};

use crate::gap::channel::Channel;
use crate::gap::sequence::Misfit;
use crate::state::State;

findings::tuning! {
    /// Blocks that the rests are dealt into, or as many as there are recordings.
    BLOCKS: usize = 8;

    /// Eigenvalues below this share of the largest are directions that the rest of the data say nothing of.
    UNSEEN: f64 = 1e-8;
}

/// Computes the prediction error of each channel over blocks that are left out in turn, summed over all blocks.
///
/// With `P = N (Nᵀ V N)⁻¹ Nᵀ` a block `B` that is left out is missed by `(P_BB)⁺ (P r)_B`, of covariance
/// `(P_BB)⁺`: no refit is needed. The errors of the parameters that the other blocks give are in it, and
/// what only the block could tell (its directions) is projected out.
pub fn held_out(state: &State, noise: BiasNoise) -> Option<[Misfit; 3]> {
    held_out_at_share(state, noise, 1.0)
}

/// The held-out misfits of `before` at the noise that the fit of `after` found: its biases' and the scatter of its turns. What
/// `after` explains and `before` lacks is scatter to the fit of `before`.
pub fn held_out_as_after(before: &State, after: &State) -> Option<[Misfit; 3]> {
    let [own, other] = [before, after].map(|state| state.scatter_of_turns().powi(2));
    let share = if own > 0.0 { other / own } else { 1.0 };
    held_out_at_share(before, after.noise, share)
}

/// The held-out misfits with a share of the variance by which turns scatter.
fn held_out_at_share(state: &State, noise: BiasNoise, share: f64) -> Option<[Misfit; 3]> {
    let whitened = state.projected.at_share(noise, share)?;
    let mut sums = [Misfit::default(); 3];
    for block in blocks(state) {
        let of = |first: usize, last: usize| -> Vec<usize> {
            let places = 0..block.len();
            places
                .filter(|&k| (first..last).contains(&block[k]))
                .collect()
        };
        let [rate, turns] = state.fit.first_rows;
        let force = of(0, rate);
        let end = of(turns, state.rows());
        let direction: Vec<usize> = force.iter().copied().chain(end).collect();
        let seen = whitened.by_recording(state.projected.units(&block));
        let (precision, pr) = seen.normal(0..block.len(), &whitened.z);
        let norm = missed(&precision, &pr, &force);
        let with_force = missed(&precision, &pr, &direction);
        sums[0].add(norm);
        sums[1].add(missed(&precision, &pr, &of(rate, turns)));
        sums[2].add(Misfit {
            chi2: (with_force.chi2 - norm.chi2).max(0.0),
            dof: with_force.dof - norm.dof,
        });
    }
    Some(sums)
}

/// `√(χ²/dof)` of one channel; 1 of one that the joint fit has no rows of.
pub fn gap_of(misfits: &[Misfit; 3], channel: Channel) -> f64 {
    misfits.get(channel as usize).map_or(1.0, Misfit::gap)
}

/// The rows of every block: neighbouring rests with their chunks and the turns that begin in them.
fn blocks(state: &State) -> Vec<Vec<usize>> {
    let rests = state.fit.data.rests.len().max(1);
    let count = BLOCKS.get().max(state.fit.data.sources.len()).min(rests);
    let mut blocks = vec![Vec::new(); count];
    for (row, rest) in state.fit.rest_of_row.iter().enumerate() {
        blocks[(rest * count / rests).min(count - 1)].push(row);
    }
    blocks
}

/// The rows `wanted` of a block that is left out as a whole, whose part of `P` and `P r` these are: its other rows are taken
/// out of the data first, `P → P − P_·o (P_oo)⁺ P_o·`.
fn missed(precision: &DMatrix<f64>, pr: &DVector<f64>, wanted: &[usize]) -> Misfit {
    let others: Vec<usize> = (0..precision.nrows())
        .filter(|i| !wanted.contains(i))
        .collect();
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
            precision[(rows[i], columns[j])]
        })
    };
    let moved = |rows: &[usize]| DMatrix::from_fn(rows.len(), 1, |i, _| pr[rows[i]]);
    let across = part(wanted, &others);
    let (inverse, _) = pseudo_inverse(&part(&others, &others));
    let own = part(wanted, wanted) - &across * &inverse * across.transpose();
    let y = moved(wanted) - &across * &inverse * moved(&others);
    let (inverse, rank) = pseudo_inverse(&own);
    Misfit {
        chi2: (y.transpose() * inverse * &y)[(0, 0)],
        dof: rank as f64,
    }
}

fn pseudo_inverse(a: &DMatrix<f64>) -> (DMatrix<f64>, usize) {
    let n = a.nrows();
    let mut inverse = DMatrix::zeros(n, n);
    if n == 0 {
        return (inverse, 0);
    }
    let eigen = a.clone().symmetric_eigen();
    // The precision of a whitened row is at most 1.
    let mut rank = 0;
    for (value, vector) in eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
    {
        if *value > UNSEEN.get() {
            inverse += vector * vector.transpose() / *value;
            rank += 1;
        }
    }
    (inverse, rank)
}

#[cfg(test)]
mod tests {
    use estimate::methods::joint::left_null_space;
    use faer::Mat;

    use super::*;

    #[test]
    fn a_block_left_out_is_missed_as_by_a_fit_without_it() {
        let j = Mat::from_fn(12, 3, |i, k| (((i * 7 + k * 5 + i * k) % 11) as f64) - 5.0);
        let r = Mat::from_fn(12, 1, |i, _| ((i * 5 % 7) as f64) - 3.0);
        let null = left_null_space(&j);
        let precision = &null * null.transpose();
        let pr = &precision * &r;
        let (block, rest): (Vec<usize>, Vec<usize>) = (0..12).partition(|i| (4..8).contains(i));
        let dense = |rows: &[usize]| DMatrix::from_fn(rows.len(), 3, |i, k| j[(rows[i], k)]);
        let values = |rows: &[usize]| DMatrix::from_fn(rows.len(), 1, |i, _| r[(rows[i], 0)]);
        let normal = (dense(&rest).transpose() * dense(&rest))
            .try_inverse()
            .unwrap();
        let x = &normal * dense(&rest).transpose() * values(&rest);
        let wanted = &block[..3];
        let missed_by_fit = values(wanted) - dense(wanted) * x;
        let own = dense(wanted);
        let covariance = DMatrix::identity(3, 3) + &own * normal * own.transpose();
        let direct = missed_by_fit.transpose() * covariance.try_inverse().unwrap() * &missed_by_fit;
        let own_block = DMatrix::from_fn(block.len(), block.len(), |i, k| {
            precision[(block[i], block[k])]
        });
        let of_block = DVector::from_fn(block.len(), |i, _| pr[(block[i], 0)]);
        let found = missed(&own_block, &of_block, &[0, 1, 2]);
        assert_eq!(found.dof, 3.0);
        assert!((found.chi2 / direct[(0, 0)] - 1.0).abs() < 1e-9);
    }
}
