//! Work on all groups of turns, side by side where there is enough of it.

use rayon::prelude::*;

use super::affine::{Affine, propagate};
use super::lanes::WIDTH;
use super::packed::Group;
use super::series::Degree;

/// Samples below which the cost of handing work to other cores exceeds what it saves.
const WORTH_SHARING: usize = 100_000;

/// Gravity after each of `turns` turns.
pub fn propagate_all(groups: &[Group], affine: &Affine<'_>, turns: usize) -> Option<Vec<[f64; 3]>> {
    each_turn(groups, turns, affine, |group, degree, out| {
        propagate(group, affine, degree, out);
    })
}

/// Three numbers of each of `turns` turns, group by group; `None` where a step is too long for the
/// series.
pub fn each_turn(
    groups: &[Group],
    turns: usize,
    affine: &Affine<'_>,
    kernel: impl Fn(&Group, Degree, &mut [f64]) + Send + Sync,
) -> Option<Vec<[f64; 3]>> {
    let each = over_groups(groups, |group| {
        let degree = Degree::for_angle(affine.longest_step(&group.bounds))?;
        let mut out = [0.0; 3 * WIDTH];
        kernel(group, degree, &mut out);
        Some(out)
    });
    let mut all = vec![[0.0; 3]; turns];
    for (group, out) in groups.iter().zip(each) {
        let out = out?;
        for (lane, &turn) in group.turns.iter().enumerate() {
            all[turn] = std::array::from_fn(|i| out[i * WIDTH + lane]);
        }
    }
    Some(all)
}

/// `work` on every group, in order; on all cores where there is enough of it.
pub fn over_groups<R: Send>(groups: &[Group], work: impl Fn(&Group) -> R + Send + Sync) -> Vec<R> {
    if groups.iter().map(Group::samples).sum::<usize>() < WORTH_SHARING {
        return groups.iter().map(work).collect();
    }
    groups.par_iter().map(work).collect()
}
