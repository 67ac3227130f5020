//! Solving a block problem.

use std::ops::ControlFlow;

use faer::Mat;
use serde::{Deserialize, Serialize};

use super::problem::BlockProblem;
use super::system::BlockSystem;
use crate::covariance::{Uncertainty, uncertainty};
use crate::error::Error;
use crate::linear::Jacobian;
use crate::minimise::minimise;
use crate::options::Options;
use crate::parameters::Mask;
use crate::report::Report;
use crate::scaling::unit_if_zero;

/// The result of [`solve_blocks`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BlockReport {
    /// The report, with the shared parameters and their marginal uncertainty (all blocks free);
    /// residuals in the order of the blocks.
    pub shared: Report,
    /// The parameters of every block.
    pub blocks: Vec<Vec<f64>>,
}

/// Minimises `½ ‖r‖²` over the shared parameters that `mask` frees and over all blocks; every
/// iteration costs time in proportion to the number of blocks.
///
/// # Errors
/// As [`solve`](crate::solve); a term of a block that is not there; and constraints, which block
/// problems do not support.
pub fn solve_blocks(
    problem: &BlockProblem<'_>,
    mask: &Mask,
    options: &Options,
) -> Result<BlockReport, Error> {
    check(problem, mask, options)?;
    let system = BlockSystem::new(problem, mask);
    let free = mask.free_indices();
    let name = |column: usize| match free.get(column) {
        Some(&k) => problem.shared.names()[k].clone(),
        None => system.name(column),
    };
    let solution = minimise(
        &system,
        system.start(),
        None,
        options,
        &name,
        &mut |_, _| ControlFlow::Continue(()),
    )?;
    let (shared, blocks) = system.split(&solution.point.z);
    let mut parameters = problem.shared.clone();
    parameters.values_mut().copy_from_slice(&shared);
    let names = free
        .iter()
        .map(|&k| problem.shared.names()[k].clone())
        .collect();
    let (uncertainty, rank) = marginal(&solution.point.at.jacobian, free.len(), names);
    Ok(BlockReport {
        shared: solution.into_report(parameters, uncertainty, rank, None),
        blocks,
    })
}

fn check(problem: &BlockProblem<'_>, mask: &Mask, options: &Options) -> Result<(), Error> {
    if mask.len() != problem.shared.len() {
        return Err(Error::MaskLength {
            mask: mask.len(),
            parameters: problem.shared.len(),
        });
    }
    if !options.constraints.is_empty() {
        return Err(Error::Unsupported {
            variant: "a block problem".into(),
            what: "constraints",
        });
    }
    let blocks = problem.blocks.len();
    for term in &problem.terms {
        let last = term.block.saturating_add(usize::from(term.coupled));
        if last >= blocks {
            return Err(Error::UnknownBlock {
                block: last,
                blocks,
            });
        }
    }
    Ok(())
}

/// Uncertainty of the shared parameters with all blocks free, from the triangle that the
/// elimination leaves, and the rank of the whole.
fn marginal(jacobian: &Jacobian, shared: usize, names: Vec<String>) -> (Uncertainty, usize) {
    let Jacobian::Blocks(blocks) = jacobian else {
        return (uncertainty(&Mat::zeros(0, shared), names), 0);
    };
    let scale: Vec<f64> = blocks
        .column_norms()
        .into_iter()
        .map(unit_if_zero)
        .collect();
    let reduced = blocks
        .eliminate(&scale)
        .reduce(&vec![0.0; blocks.rows()], 0.0);
    let triangle = &reduced.shared;
    let root = Mat::from_fn(triangle.rows().min(shared), shared, |i, k| {
        triangle.column(k)[i] * scale[k]
    });
    let uncertainty = uncertainty(&root, names);
    let rank = uncertainty.rank + reduced.rank_of_blocks();
    (uncertainty, rank)
}
