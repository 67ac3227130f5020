//! Options of a graph, and its report.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::problem::{Block, Graph};
use crate::constraints::ActiveConstraint;
use crate::graph::elimination::Method;
use crate::graph::uncertainty::null_space::NullVector;
use crate::minimise::system::Evaluations;
use crate::report::{Iteration, Termination};
use crate::search::Damping;

/// Way to solve a graph and conditions to stop. What is missing where it is read is as in the default.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct GraphOptions {
    /// Rule of the damping; Nielsen's falls by a hundred where the cost fell as promised, to a tenth, until
    /// a second step has failed.
    pub damping: Damping,
    /// The damping once a step has failed, relative to the squared column norms; the steps before are those of Gauss and
    /// Newton, with `1e-8` at most.
    pub first_damping: f64,
    /// Most steps tried.
    pub max_iterations: usize,
    /// Relative offset `‖P r‖ / ‖r‖` at which a point counts as a minimum; the cost is `offset²` of
    /// itself above the minimum, by the linearised problem.
    pub gradient_tolerance: f64,
    /// Smallest step `‖D p‖` relative to `‖D x‖`.
    pub step_tolerance: f64,
    /// True to go on from there, undamped, to what double precision allows; `false` ends with the
    /// step that reaches `gradient_tolerance`.
    pub last_digits: bool,
    /// True to look at the end for what the factors do not determine: a factorisation more, and where
    /// there is something, the time of a few steps.
    pub rank: bool,
    /// If true, robust losses start wide, as least squares, and narrow to their scales in at most 20 stages: for
    /// starts far from the solution, as [`Options::graduated`](crate::Options::graduated). Where too few
    /// residuals count at the start this happens by itself.
    pub graduated: bool,
    /// Threads that evaluate factors; the result is the same to the last bit. 1 starts none.
    pub threads: usize,
    /// Longest time to spend; looked at before every step.
    pub time_limit: Option<Duration>,
    /// Set from another thread, it stops the run before its next step. Not written.
    #[serde(skip)]
    pub cancel: Option<Arc<AtomicBool>>,
}

impl Default for GraphOptions {
    fn default() -> Self {
        Self {
            damping: Damping::Nielsen,
            first_damping: 1e-4,
            max_iterations: 500,
            gradient_tolerance: 1e-8,
            step_tolerance: 1e-15,
            last_digits: true,
            rank: true,
            graduated: false,
            threads: 1,
            time_limit: None,
            cancel: None,
        }
    }
}

/// The result of [`solve_graph`](super::solve_graph).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GraphReport {
    /// Stored values of all blocks, one after the other: a start for
    /// [`Graph::start_at`](super::Graph::start_at).
    pub values: Vec<f64>,
    /// First value of every block, and the number of values.
    pub(crate) first: Vec<usize>,
    /// Value of the minimised cost there: `½ ‖r‖²`, or half the sum of the losses.
    #[serde(with = "crate::infinite")]
    pub cost: f64,
    /// Number of residuals.
    pub residuals: usize,
    /// Number of free coordinates.
    pub unknowns: usize,
    /// Why the solver stopped.
    pub termination: Termination,
    /// The steps tried.
    pub iterations: Vec<Iteration>,
    /// Number of all evaluations of the graph.
    pub evaluations: Evaluations,
    /// `‖P r‖ / ‖r‖`, where `P` projects on the columns of the Jacobian: nothing but rounding where the residuals
    /// are zero; without
    /// [`GraphOptions::last_digits`] perhaps, if it is small, by the factor of the step before.
    pub relative_offset: f64,
    /// Length of the Gauss–Newton step that is left, relative to the values, both scaled by the
    /// column norms.
    #[serde(with = "crate::infinite")]
    pub relative_step: f64,
    /// Method by which the linear equations were solved.
    pub method: Method,
    /// The bounds that hold there, by the names of the coordinates, with their multipliers.
    #[serde(default)]
    pub active: Vec<ActiveConstraint>,
    /// Rank of the Jacobian there, without what bounds hold, as [`Products::rank`](super::Products::rank); `None` where it was not
    /// looked for (see [`GraphOptions::rank`]; a run cancelled or out of time does not), and where more
    /// directions are free than are followed, 32.
    #[serde(default)]
    pub rank: Option<usize>,
    /// Directions that no factor determines there, by name: the solution is one of many. The first 32.
    #[serde(default)]
    pub null_space: Vec<NullVector>,
}

impl GraphReport {
    /// Stored values of a block; none where there is no such block.
    pub fn value(&self, block: Block) -> &[f64] {
        let number = block.number();
        match (self.first.get(number), self.first.get(number + 1)) {
            (Some(&from), Some(&to)) => &self.values[from..to],
            _ => &[],
        }
    }

    /// The blocks with a coordinate that no factor determines, alone or together with others, in the
    /// order in which they were added.
    pub fn undetermined(&self) -> Vec<Block> {
        let components = self.null_space.iter().flat_map(|v| &v.components);
        let mut blocks: Vec<Block> = components.map(|c| c.0).collect();
        blocks.sort_unstable();
        blocks.dedup();
        blocks
    }

    pub(crate) fn first(graph: &Graph<'_>) -> Vec<usize> {
        let mut first: Vec<usize> = graph.variables.iter().map(|v| v.first).collect();
        first.push(graph.values.len());
        first
    }
}
