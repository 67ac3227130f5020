//! Statements of the linearised graph besides the minimum: covariances, determinant, solutions.

pub(crate) mod null_space;
pub(crate) mod profile;
mod sandwich;

use std::sync::Arc;

use super::bounds::{Bounds, Held};
use super::problem::{Block, Graph};
use crate::error::Error;
use crate::graph::elimination::Factored;
use crate::graph::elimination::equations::{Equations, Normal};
use crate::graph::elimination::structure::{NONE, Structure};
use crate::graph::uncertainty::null_space::{NullSpace, NullVector};

/// Right sides solved for at once.
const BATCH: usize = 32;

/// A graph linearised at a point and factored, its free coordinates `n`, held ones left out. A bound that
/// holds there (the value lies on it, and the gradient presses it against it) leaves its coordinate no room: its covariance is zero.
///
/// | symbol | meaning |
/// |---|---|
/// | `H` | `JᵀJ` (`n × n`), rows weighted by the losses |
/// | `N` | its null space: what no factor sees |
/// | `H⁺` | `(JᵀJ)⁺`, of minimum norm across `N` in coordinates scaled to columns of unit length |
///
/// ```
/// use stillpoint_solver::{Euclidean, Graph, Products, Residual, Scalar, lit};
///
/// struct Difference(f64);
/// impl<D: Scalar> Residual<D> for Difference {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.push(x[1] - x[0] - lit::<D>(self.0));
///     }
/// }
///
/// let mut graph = Graph::new();
/// let a = graph.add("a", Euclidean(1), &[0.0])?;
/// let b = graph.add("b", Euclidean(1), &[1.0])?;
/// graph.add_factor(&[a, b], Difference(1.0));
/// assert_eq!(Products::new(&graph, graph.values())?.null_space()[0].words, "a + b");
/// graph.hold(a);
/// let products = Products::new(&graph, graph.values())?;
/// assert_eq!(products.rank(), 1);
/// assert!((products.covariance(&[b])[0][0] - 1.0).abs() < 1e-12);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub struct Products<'a> {
    graph: &'a Graph<'a>,
    structure: Arc<Structure>,
    factored: std::cell::RefCell<Factored>,
    /// Without what bounds hold.
    h: Vec<f64>,
    held: Option<Held>,
    values: Vec<f64>,
    /// Number of residuals.
    residuals: usize,
    /// `‖J_k‖`, 1 where it is zero.
    units: Vec<f64>,
    null: NullSpace,
}

impl<'a> Products<'a> {
    /// Linearises at stored values of all blocks ([`GraphReport::values`](super::GraphReport::values)
    /// or [`Graph::values`]).
    ///
    /// # Errors
    /// As [`solve_graph`](super::solve_graph).
    pub fn new(graph: &'a Graph<'a>, values: &[f64]) -> Result<Self, Error> {
        graph.check()?;
        if values.len() != graph.values.len() {
            return Err(Error::BlockStart {
                block: "all".into(),
                found: values.len(),
                numbers: graph.values.len(),
            });
        }
        let structure = Arc::new(Structure::new(graph)?);
        let mut normal = Normal::default();
        let equations = Equations::start(graph, &structure, 1, values, &mut normal)?;
        let bounds = Bounds::new(graph, &structure);
        let held = bounds.held(structure.unknowns(), values, &normal.gradient);
        let mut h = normal.h;
        if let Some(held) = &held {
            let mut left = Vec::new();
            held.leave(&structure, &h, &mut left);
            h = left;
        }
        let units = structure.units(&h);
        let mut factored = Factored::new(&structure)?;
        let local = null_space::Local {
            equations: &equations,
            values,
            h: &h,
            units: &units,
            held: held.as_ref(),
        };
        let null = null_space::find(&local, &mut factored)?;
        let residuals = equations.rows();
        Ok(Self {
            graph,
            structure,
            factored: factored.into(),
            h,
            held,
            values: values.to_vec(),
            residuals,
            units,
            null,
        })
    }

    /// Number of free coordinates, `n`, those that bounds hold included.
    pub fn unknowns(&self) -> usize {
        self.structure.unknowns()
    }

    /// Rank of `J` without what bounds hold: what the factors determine, judged as [`Uncertainty::rank`](crate::Uncertainty).
    pub fn rank(&self) -> usize {
        let held = self.held.as_ref().map_or(0, |held| held.count);
        self.unknowns() - held - self.null.basis.len()
    }

    /// Directions that no factor sees, each with a coordinate that no other has.
    pub fn null_space(&self) -> Vec<NullVector> {
        null_space::in_names(&self.null, self.graph, &self.structure, &self.units)
    }

    /// `ln det H` of what no bound holds; where the rank is short, of its eigenvalues that are not zero.
    pub fn log_determinant(&self) -> f64 {
        let whole = self.factored.borrow().log_determinant();
        let held = self.held.as_ref();
        let held = held.map_or(0.0, |held| held.log_diagonal(&self.structure, &self.h));
        whole - held - self.null.log_share(&self.units)
    }

    /// `H⁺` among the free coordinates of some blocks, in their order: the covariance for residuals of
    /// unit variance. A block that is held or not there adds nothing.
    pub fn covariance(&self, blocks: &[Block]) -> Vec<Vec<f64>> {
        let places: Vec<usize> = blocks.iter().flat_map(|&b| self.places(b)).collect();
        let mut rows = Vec::with_capacity(places.len());
        for batch in places.chunks(BATCH) {
            for column in self.columns(batch).chunks_exact(self.unknowns()) {
                rows.push(places.iter().map(|&k| column[k]).collect());
            }
        }
        rows
    }

    /// Columns of `H⁺`, one after the other.
    fn columns(&self, places: &[usize]) -> Vec<f64> {
        let n = self.unknowns();
        let mut columns = vec![0.0; n * places.len()];
        for (column, &place) in columns.chunks_exact_mut(n).zip(places) {
            column[place] = 1.0;
        }
        self.apply(&mut columns);
        columns
    }

    /// Standard errors of the free coordinates of a block for residuals of unit variance.
    pub fn standard_errors(&self, block: Block) -> Vec<f64> {
        let covariance = self.covariance(&[block]);
        (0..covariance.len())
            .map(|k| covariance[k][k].max(0.0).sqrt())
            .collect()
    }

    /// Replaces every right side (the free coordinates of all blocks, in the order in which the blocks
    /// were added) by `H⁺` times it.
    ///
    /// # Errors
    /// A right side of another length than [`unknowns`](Self::unknowns).
    pub fn solve(&self, right: &mut [Vec<f64>]) -> Result<(), Error> {
        let n = self.unknowns();
        if let Some(wrong) = right.iter().find(|b| b.len() != n) {
            return Err(Error::BlockStart {
                block: "right side".into(),
                found: wrong.len(),
                numbers: n,
            });
        }
        let order = self.order();
        for batch in right.chunks_mut(BATCH) {
            let mut all = vec![0.0; n * batch.len()];
            for (column, b) in all.chunks_exact_mut(n).zip(&*batch) {
                order.iter().zip(b).for_each(|(&k, &b)| column[k] = b);
            }
            self.apply(&mut all);
            for (column, b) in all.chunks_exact(n).zip(batch) {
                order.iter().zip(b).for_each(|(&k, b)| *b = column[k]);
            }
        }
        Ok(())
    }

    /// `H⁺` times columns, in place: with `M = H + E Eᵀ`, `E` a coordinate for each null direction,
    /// `P M⁻¹ P`, where `P` takes the null space out.
    fn apply(&self, columns: &mut [f64]) {
        let n = self.unknowns();
        if let Some(held) = &self.held {
            held.clear(columns);
        }
        for column in columns.chunks_exact_mut(n) {
            column
                .iter_mut()
                .zip(&self.units)
                .for_each(|(b, d)| *b /= d);
            self.null.project(column);
            column
                .iter_mut()
                .zip(&self.units)
                .for_each(|(b, d)| *b *= d);
        }
        self.factored.borrow_mut().solve(&self.h, columns);
        for column in columns.chunks_exact_mut(n) {
            column
                .iter_mut()
                .zip(&self.units)
                .for_each(|(x, d)| *x *= d);
            self.null.project(column);
            column
                .iter_mut()
                .zip(&self.units)
                .for_each(|(x, d)| *x /= d);
        }
    }

    /// Unknowns of a block.
    fn places(&self, block: Block) -> std::ops::Range<usize> {
        let position = self.structure.position.get(block.number());
        match position {
            Some(&p) if p != NONE => {
                self.structure.first[p as usize]..self.structure.first[p as usize + 1]
            }
            _ => 0..0,
        }
    }

    /// Unknowns in the order in which the blocks were added.
    fn order(&self) -> Vec<usize> {
        (0..self.graph.blocks() as u32)
            .flat_map(|b| self.places(Block(b)))
            .collect()
    }
}

impl std::fmt::Debug for Products<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Products")
            .field("unknowns", &self.unknowns())
            .field("rank", &self.rank())
            .finish()
    }
}
