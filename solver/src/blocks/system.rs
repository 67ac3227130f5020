//! A block problem in its free parameters.

use super::jacobian::BlockJacobian;
use super::problem::{BlockProblem, Term};
use crate::linear::{Jacobian, Linearization};
use crate::parameters::Mask;
use crate::residual::of_shape;
use crate::system::{System, culprit};
use crate::vector::half_square;

/// Shared parameters under a mask, then all blocks.
pub(crate) struct BlockSystem<'a> {
    problem: &'a BlockProblem<'a>,
    free: Vec<usize>,
    offsets: Vec<usize>,
    /// Terms in the order of their blocks.
    order: Vec<usize>,
}

impl<'a> BlockSystem<'a> {
    /// Lays out the columns.
    pub fn new(problem: &'a BlockProblem<'a>, mask: &Mask) -> Self {
        let free = mask.free_indices();
        let mut offsets = vec![free.len()];
        for block in &problem.blocks {
            offsets.push(offsets[offsets.len() - 1] + block.len());
        }
        let mut order: Vec<usize> = (0..problem.terms.len()).collect();
        order.sort_by_key(|&t| problem.terms[t].block);
        Self {
            problem,
            free,
            offsets,
            order,
        }
    }

    /// Start values of the free parameters.
    pub fn start(&self) -> Vec<f64> {
        let shared = self.free.iter().map(|&k| self.problem.shared.values()[k]);
        shared
            .chain(self.problem.blocks.iter().flatten().copied())
            .collect()
    }

    /// The name of a column that belongs to a block.
    pub fn name(&self, column: usize) -> String {
        let block = self.offsets.partition_point(|&first| first <= column) - 1;
        format!(
            "parameter {} of block {block}",
            column - self.offsets[block]
        )
    }

    /// All shared parameters and every block at `z`.
    pub fn split(&self, z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let blocks = self
            .offsets
            .windows(2)
            .map(|w| z[w[0]..w[1]].to_vec())
            .collect();
        (
            self.shared(self.problem.shared.values().to_vec(), z),
            blocks,
        )
    }

    fn shared(&self, mut base: Vec<f64>, z: &[f64]) -> Vec<f64> {
        for (&k, &value) in self.free.iter().zip(z) {
            base[k] = value;
        }
        base
    }

    /// The parameters of one term, from shared ones that are laid out already.
    fn own(&self, term: &Term<'_>, shared: &[f64], z: &[f64]) -> Vec<f64> {
        let last = term.block + 1 + usize::from(term.coupled);
        let mut x = shared.to_vec();
        x.extend_from_slice(&z[self.offsets[term.block]..self.offsets[last]]);
        x
    }

    /// The free ones among the parameters of a term.
    fn free_of(&self, x: &[f64]) -> Vec<usize> {
        let own = self.problem.shared.len()..x.len();
        self.free.iter().copied().chain(own).collect()
    }

    fn terms(&self) -> impl Iterator<Item = &Term<'a>> {
        self.order.iter().map(|&t| &self.problem.terms[t])
    }
}

impl System for BlockSystem<'_> {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        let shared = self.shared(self.problem.shared.values().to_vec(), z);
        let (mut all, mut own) = (Vec::new(), Vec::new());
        for term in self.terms() {
            term.problem.values(&self.own(term, &shared, z), &mut own);
            all.extend_from_slice(&own);
        }
        all
    }

    fn linearize(&self, z: &[f64]) -> Linearization {
        let shared = self.shared(self.problem.shared.values().to_vec(), z);
        let (mut residuals, mut own_residuals) = (Vec::new(), Vec::new());
        let mut jacobian =
            BlockJacobian::new(self.free.len(), self.offsets.clone(), self.order.len());
        let mut free = self.free.clone();
        for term in self.terms() {
            let x = self.own(term, &shared, z);
            free.truncate(self.free.len());
            free.extend(shared.len()..x.len());
            let matrix = term.problem.linearize(&x, &free, &mut own_residuals);
            let matrix = of_shape(matrix, own_residuals.len(), free.len());
            jacobian.push(term.block, term.coupled, matrix.as_ref());
            residuals.extend_from_slice(&own_residuals);
        }
        let cost = half_square(&residuals);
        Linearization {
            residuals,
            cost,
            jacobian: Jacobian::Blocks(jacobian),
        }
    }

    fn culprit(&self, z: &[f64], row: usize) -> Option<usize> {
        let shared = self.shared(self.problem.shared.values().to_vec(), z);
        let (mut first, mut residuals) = (0, Vec::new());
        for term in self.terms() {
            let x = self.own(term, &shared, z);
            term.problem.values(&x, &mut residuals);
            if row < first + residuals.len() {
                let free = self.free_of(&x);
                let own = culprit(term.problem.as_ref(), &x, &free, row - first)?;
                return Some(match own.checked_sub(self.free.len()) {
                    Some(place) => self.offsets[term.block] + place,
                    None => own,
                });
            }
            first += residuals.len();
        }
        None
    }

    fn second_derivative(&self, z: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let shared = self.shared(self.problem.shared.values().to_vec(), z);
        let direction = self.shared(vec![0.0; shared.len()], v);
        let (mut all, mut out) = (Vec::new(), Vec::new());
        for term in self.terms() {
            let (x, v) = (self.own(term, &shared, z), self.own(term, &direction, v));
            if !term.problem.second_derivative(&x, &v, &mut out) {
                return None;
            }
            all.extend_from_slice(&out);
        }
        all.iter().all(|v| v.is_finite()).then_some(all)
    }
}
