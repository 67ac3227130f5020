//! A graph: blocks of variables and factors over a few of them.

use std::collections::HashMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::factor::Factor;
use super::ranges::Ranges;
use crate::error::Error;
use crate::graph::variables::manifold::{AnyManifold, Manifold};
use crate::loss::{Loss, LossScale};

/// A block of variables of a [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Block(pub(crate) u32);

impl Block {
    /// Its number, from 0, in the order in which blocks were added.
    pub fn number(self) -> usize {
        self.0 as usize
    }
}

/// `min ½ Σ ‖r_f(x_a, x_b, …)‖²` over named blocks of variables, each on a manifold, with factors
/// over a few of them.
///
/// Time and memory follow the graph: many small blocks that only large ones connect are eliminated
/// one by one (bundle adjustment, groups with shared parameters), the others by a sparse Cholesky
/// factorisation in a fill-reducing order, dense where little of it is zero.
///
/// Numbers of blocks may have bounds ([`Graph::bound`]); linear constraints over several are not
/// offered here, see [`solve`](crate::solve()) for those.
///
/// ```
/// use stillpoint_solver::{Euclidean, Graph, GraphOptions, Residual, Scalar, lit, solve_graph};
///
/// /// The distance between two points in the plane, as measured.
/// struct Distance(f64);
///
/// impl<D: Scalar> Residual<D> for Distance {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         let (dx, dy) = (x[2] - x[0], x[3] - x[1]);
///         out.push((dx * dx + dy * dy).sqrt() - lit::<D>(self.0));
///     }
/// }
///
/// let mut graph = Graph::new();
/// let a = graph.add("a", Euclidean(2), &[0.0, 0.0])?;
/// let b = graph.add("b", Euclidean(2), &[4.1, 0.0])?;
/// let c = graph.add("c", Euclidean(2), &[0.2, 2.0])?;
/// graph.hold(a);
/// graph.hold_part(b, 1);
/// graph.add_factor(&[a, b], Distance(4.0));
/// graph.add_factor(&[a, c], Distance(3.0));
/// graph.add_factor(&[b, c], Distance(5.0));
/// let report = solve_graph(&graph, &GraphOptions::default())?;
/// assert!((report.value(c)[1] - 3.0).abs() < 1e-12);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
#[derive(Default)]
pub struct Graph<'a> {
    pub(crate) variables: Vec<Variable>,
    /// Stored values, block after block.
    pub(crate) values: Vec<f64>,
    pub(crate) factors: Vec<Entry<'a>>,
    /// Blocks of the factors, one factor after the other.
    pub(crate) touched: Vec<u32>,
    pub(crate) losses: Vec<Loss>,
    /// Bounds by block and coordinate.
    pub(crate) ranges: Ranges,
    /// Blocks by name.
    numbers: HashMap<Arc<str>, u32>,
}

/// A block.
pub(crate) struct Variable {
    pub name: Arc<str>,
    pub manifold: Arc<dyn AnyManifold>,
    /// Begin of its stored values.
    pub first: usize,
    pub numbers: u32,
    pub dimension: u32,
    /// Free coordinates of a step; all if `None`.
    pub free: Option<Box<[u32]>>,
    /// Loss of all factors of the block that have none of their own; an index, 0 for none.
    pub loss: u32,
}

impl Variable {
    /// Number of free coordinates.
    pub fn width(&self) -> usize {
        self.free
            .as_ref()
            .map_or(self.dimension as usize, |free| free.len())
    }

    /// The free coordinates.
    pub fn free_coordinates(&self) -> impl Iterator<Item = usize> {
        (0..self.width()).map(|k| self.free.as_ref().map_or(k, |free| free[k] as usize))
    }

    /// The stored number of the block to which a coordinate of every step is added.
    pub fn plain(&self, coordinate: usize) -> Option<usize> {
        let number = self.manifold.plain(coordinate)?;
        (number < self.numbers as usize).then_some(number)
    }

    /// Name of a coordinate.
    pub fn coordinate(&self, k: usize) -> String {
        if self.dimension == 1 {
            self.name.to_string()
        } else {
            format!("{}.{k}", self.name)
        }
    }
}

/// A factor and where its blocks are listed.
pub(crate) struct Entry<'a> {
    pub factor: Box<dyn Factor + 'a>,
    /// End of its blocks in the list of all.
    pub end: u32,
    /// Its loss: an index into the losses plus one; 0 for none.
    pub loss: u32,
}

impl<'a> Graph<'a> {
    /// No blocks, no factors.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a block with its start, as the manifold stores it.
    ///
    /// # Errors
    /// A name that another block has, a start of another length than the manifold's, or with what is
    /// not finite.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        manifold: impl Manifold,
        start: &[f64],
    ) -> Result<Block, Error> {
        let name = name.into();
        if self.numbers.contains_key(name.as_str()) {
            return Err(Error::RepeatedName { block: name });
        }
        let (numbers, dimension) = (manifold.numbers(), manifold.dimension());
        if start.len() != numbers || start.iter().any(|v| !v.is_finite()) {
            return Err(Error::BlockStart {
                block: name,
                found: start.len(),
                numbers,
            });
        }
        let number = self.variables.len() as u32;
        let name: Arc<str> = name.into();
        self.numbers.insert(Arc::clone(&name), number);
        self.variables.push(Variable {
            name,
            manifold: Arc::new(manifold),
            first: self.values.len(),
            numbers: numbers as u32,
            dimension: dimension as u32,
            free: None,
            loss: 0,
        });
        self.values.extend_from_slice(start);
        Ok(Block(number))
    }

    /// Adds a factor over blocks, in the order in which it reads them.
    ///
    /// The factor is a type that implements [`Residual`](crate::Residual), or [`Factor`] with a Jacobian of its own; a closure of
    /// [`from_fn`](crate::from_fn) is none. Its `x` holds the blocks' numbers one after the other: a rotation has four there, a
    /// quaternion with the real part first, although it has three degrees of freedom.
    pub fn add_factor(&mut self, blocks: &[Block], factor: impl Factor + 'a) {
        self.push(blocks, Box::new(factor), 0);
    }

    /// Adds a factor whose residuals together cost `½ σ² ρ(‖r‖² / σ²)`: an outlier counts as a
    /// whole. The scale of the loss is to be given.
    pub fn add_robust_factor(&mut self, blocks: &[Block], factor: impl Factor + 'a, loss: Loss) {
        let loss = self.loss_index(loss);
        self.push(blocks, Box::new(factor), loss);
    }

    fn push(&mut self, blocks: &[Block], factor: Box<dyn Factor + 'a>, loss: u32) {
        self.touched.extend(blocks.iter().map(|b| b.0));
        self.factors.push(Entry {
            factor,
            end: self.touched.len() as u32,
            loss,
        });
    }

    fn loss_index(&mut self, loss: Loss) -> u32 {
        let place = self.losses.iter().position(|l| *l == loss);
        let place = place.unwrap_or_else(|| {
            self.losses.push(loss);
            self.losses.len() - 1
        });
        place as u32 + 1
    }

    /// Puts a loss on every factor of a block that has none of its own.
    pub fn set_loss(&mut self, block: Block, loss: Loss) {
        let loss = self.loss_index(loss);
        if let Some(variable) = self.variables.get_mut(block.number()) {
            variable.loss = loss;
        }
    }

    /// Holds a block at its value.
    pub fn hold(&mut self, block: Block) {
        if let Some(variable) = self.variables.get_mut(block.number()) {
            variable.free = Some(Box::new([]));
        }
    }

    /// Holds one coordinate of a block's steps: of a plain block the stored value of that number.
    pub fn hold_part(&mut self, block: Block, coordinate: usize) {
        if let Some(variable) = self.variables.get_mut(block.number()) {
            variable.free = Some(
                variable
                    .free_coordinates()
                    .filter(|&k| k != coordinate)
                    .map(|k| k as u32)
                    .collect(),
            );
        }
    }

    /// Frees all coordinates of a block.
    pub fn release(&mut self, block: Block) {
        if let Some(variable) = self.variables.get_mut(block.number()) {
            variable.free = None;
        }
    }

    /// Frees the coordinates whose name (`name.0`, `name.1`, …; the block's name where it has one
    /// coordinate) passes, and holds the others.
    pub fn free_where(&mut self, is_free: impl Fn(&str) -> bool) {
        for variable in &mut self.variables {
            let free: Box<[u32]> = (0..variable.dimension)
                .filter(|&k| is_free(&variable.coordinate(k as usize)))
                .collect();
            variable.free = (free.len() < variable.dimension as usize).then_some(free);
        }
    }

    /// The stored values of a block: its start.
    pub fn value(&self, block: Block) -> &[f64] {
        self.of(&self.values, block)
    }

    /// Stored values of all blocks, one after the other.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The residuals at stored values of all blocks, as the factors give them, one factor after the
    /// other.
    pub fn residuals(&self, values: &[f64]) -> Vec<f64> {
        let (mut x, mut out, mut all) = (Vec::new(), Vec::new(), Vec::new());
        for (factor, entry) in self.factors.iter().enumerate() {
            x.clear();
            for &block in self.blocks_of(factor) {
                x.extend_from_slice(self.of(values, Block(block)));
            }
            entry.factor.values(&x, &mut out);
            all.extend_from_slice(&out);
        }
        all
    }

    /// Value of the minimised cost at stored values of all blocks: `½ ‖r‖²`, or half the sum of the losses.
    pub fn cost(&self, values: &[f64]) -> f64 {
        let (mut x, mut out, mut sum) = (Vec::new(), Vec::new(), 0.0);
        for (factor, entry) in self.factors.iter().enumerate() {
            x.clear();
            for &block in self.blocks_of(factor) {
                x.extend_from_slice(self.of(values, Block(block)));
            }
            entry.factor.values(&x, &mut out);
            sum += super::reweight::cost_of(self.loss_of(factor), &out);
        }
        sum
    }

    /// Starts all blocks where a report ended.
    pub fn start_at(&mut self, values: &[f64]) {
        if values.len() == self.values.len() {
            self.values.copy_from_slice(values);
        }
    }

    /// The block of this name.
    pub fn block(&self, name: &str) -> Option<Block> {
        self.numbers.get(name).copied().map(Block)
    }

    /// The name of a block.
    pub fn name(&self, block: Block) -> &str {
        &self.variables[block.number()].name
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.variables.len()
    }

    /// Number of factors.
    pub fn factors(&self) -> usize {
        self.factors.len()
    }

    /// A block's part of values of all blocks.
    pub(crate) fn of<'v>(&self, values: &'v [f64], block: Block) -> &'v [f64] {
        let variable = &self.variables[block.number()];
        &values[variable.first..variable.first + variable.numbers as usize]
    }

    /// Blocks of a factor.
    pub(crate) fn blocks_of(&self, factor: usize) -> &[u32] {
        let first = factor
            .checked_sub(1)
            .map_or(0, |before| self.factors[before].end);
        &self.touched[first as usize..self.factors[factor].end as usize]
    }

    /// Loss of a factor: its own, or that of the first of its blocks that has one.
    pub(crate) fn loss_of(&self, factor: usize) -> Option<&Loss> {
        if self.losses.is_empty() {
            return None;
        }
        let own = self.factors[factor].loss;
        let of_blocks = || {
            let blocks = self.blocks_of(factor).iter();
            blocks
                .map(|&b| self.variables[b as usize].loss)
                .find(|&loss| loss > 0)
        };
        let index = Some(own).filter(|&own| own > 0).or_else(of_blocks)?;
        self.losses.get(index as usize - 1)
    }

    /// Checks before anything is evaluated.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for factor in 0..self.factors.len() {
            let blocks = self.blocks_of(factor);
            for (k, &block) in blocks.iter().enumerate() {
                if block as usize >= self.variables.len() {
                    return Err(Error::UnknownBlock {
                        block: block as usize,
                        blocks: self.variables.len(),
                    });
                }
                if blocks[..k].contains(&block) {
                    return Err(Error::RepeatedBlock {
                        factor,
                        block: self.variables[block as usize].name.to_string(),
                    });
                }
            }
        }
        for loss in &self.losses {
            loss.check()?;
            match loss.scale() {
                Some(LossScale::Estimated(_)) => {
                    return Err(Error::Unsupported {
                        variant: "a graph".into(),
                        what: "a loss of estimated scale",
                    });
                }
                Some(LossScale::Given(value)) if !(value * value).is_normal() || value < 0.0 => {
                    return Err(Error::LossScale { value });
                }
                _ => {}
            }
        }
        Ok(())
    }
}

impl std::fmt::Debug for Graph<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Graph")
            .field("blocks", &self.variables.len())
            .field("factors", &self.factors.len())
            .finish()
    }
}
