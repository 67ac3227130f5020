//! A graph with its pattern, and what its normal equations are kept in.

use super::structure::Structure;
use crate::graph::problem::Graph;
use crate::graph::stage::Stage;
use crate::loss::Loss;

/// `H` by slots, `g` by unknowns, cost and residuals.
#[derive(Clone, Debug, Default)]
pub(crate) struct Normal {
    /// Blocks of `H`, see [`Structure`], column after column each.
    pub h: Vec<f64>,
    /// `Jᵀ r`, the gradient of the cost.
    pub gradient: Vec<f64>,
    /// `½ ‖r‖²` or half the sum of the losses.
    pub cost: f64,
    /// `‖r‖²` as the losses weigh it.
    pub square: f64,
}

/// Place at which an evaluation failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Failure {
    /// A residual is not finite: factor, row within it, value.
    Residual(usize, usize, f64),
    /// A derivative is not finite: factor, row and column within it.
    Derivative(usize, usize, usize),
    /// Another number of residuals or derivatives: factor, found, expected.
    Length(usize, usize, usize),
}

/// A graph with its pattern.
pub(crate) struct Equations<'a> {
    pub graph: &'a Graph<'a>,
    pub structure: &'a Structure,
    /// First residual of every factor, and their number.
    pub row: Vec<u32>,
    pub threads: usize,
    /// Losses for the time being.
    pub stage: Stage,
}

impl<'a> Equations<'a> {
    /// Nothing counted yet; one thread, and the losses that are meant.
    pub fn of(graph: &'a Graph<'a>, structure: &'a Structure) -> Self {
        Self {
            graph,
            structure,
            row: Vec::new(),
            threads: 1,
            stage: Stage::Meant,
        }
    }

    /// The loss of a factor, for the time being.
    pub fn loss_of(&self, factor: usize) -> Option<Loss> {
        Some(self.stage.of(*self.graph.loss_of(factor)?))
    }

    /// Number of residuals.
    pub fn rows(&self) -> usize {
        self.row.last().map_or(0, |&r| r as usize)
    }

    /// Number of residuals of a factor, once they are counted.
    pub(crate) fn rows_of(&self, factor: usize) -> Option<usize> {
        let end = *self.row.get(factor + 1)?;
        Some((end - self.row[factor]) as usize)
    }
}
