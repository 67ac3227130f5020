//! The normal equations `H = JᵀJ`, `g = Jᵀr` of a graph at a point.

use super::accumulate::Sum;
use super::equations::{Equations, Failure, Normal};
use super::structure::Structure;
use crate::error::Error;
use crate::graph::evaluate::{Bases, Bench, gather};
use crate::graph::problem::Graph;
use crate::graph::reweight::cost_of;

/// Factors that a thread evaluates before what it found is added up.
const PORTION: usize = 2048;

/// Shown a factor's number, its residuals and its Jacobian.
pub(crate) type See<'a> = &'a mut dyn FnMut(usize, &mut [f64], &mut [f64]);

/// Residuals and Jacobians of a portion of factors, one after the other.
#[derive(Default)]
struct Found {
    /// Number of residuals of every factor.
    rows: Vec<usize>,
    residuals: Vec<f64>,
    jacobian: Vec<f64>,
    failure: Option<Failure>,
}

impl<'a> Equations<'a> {
    /// Forms the normal equations at a start, and counts the residuals on the way.
    ///
    /// # Errors
    /// Nothing free, no residuals, and what is not finite.
    pub fn start(
        graph: &'a Graph<'a>,
        structure: &'a Structure,
        threads: usize,
        values: &[f64],
        normal: &mut Normal,
    ) -> Result<Self, Error> {
        let mut equations = Self {
            threads: threads.max(1),
            ..Self::of(graph, structure)
        };
        let free = structure.unknowns();
        let mut row = Vec::with_capacity(graph.factors.len() + 1);
        row.push(0);
        let mut rows = 0;
        let formed = equations.form(values, normal, &mut |residuals| {
            rows += residuals as u32;
            row.push(rows);
        });
        if formed.is_err() || free == 0 || rows == 0 {
            row = equations.count(values);
        }
        equations.row = row;
        formed.map_err(|failure| equations.error(failure, values))?;
        if free == 0 || rows == 0 {
            let residuals = equations.rows();
            return Err(Error::Empty { residuals, free });
        }
        Ok(equations)
    }

    /// First residual of every factor, and their number.
    fn count(&self, values: &[f64]) -> Vec<u32> {
        let (mut x, mut out) = (Vec::new(), Vec::new());
        let mut rows = 0;
        let mut row = vec![0];
        for (factor, entry) in self.graph.factors.iter().enumerate() {
            gather(self.graph, self.graph.blocks_of(factor), values, &mut x);
            entry.factor.values(&x, &mut out);
            rows += out.len() as u32;
            row.push(rows);
        }
        row
    }

    /// The cost at stored values; infinite where it is not finite.
    pub fn cost(&self, values: &[f64]) -> f64 {
        let (mut x, mut out) = (Vec::new(), Vec::new());
        let mut sum = 0.0;
        for (factor, entry) in self.graph.factors.iter().enumerate() {
            gather(self.graph, self.graph.blocks_of(factor), values, &mut x);
            entry.factor.values(&x, &mut out);
            if self.rows_of(factor) != Some(out.len()) {
                return f64::INFINITY;
            }
            sum += cost_of(self.loss_of(factor).as_ref(), &out);
        }
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    /// Forms the normal equations at stored values.
    pub fn linearize(&self, values: &[f64], normal: &mut Normal) -> Result<(), Failure> {
        self.form(values, normal, &mut |_| {})
    }

    /// Forms the normal equations, and tells of every factor how many residuals it has.
    fn form(
        &self,
        values: &[f64],
        normal: &mut Normal,
        tell: &mut dyn FnMut(usize),
    ) -> Result<(), Failure> {
        // Every slot is written by the first factor that has it.
        let entries = self.structure.entry.last().copied().unwrap_or(0);
        if normal.h.len() != entries {
            // Zero pages of the system, not written here: they are the most of a bundle adjustment's memory.
            normal.h = vec![0.0; entries];
        }
        normal.gradient.clear();
        normal.gradient.resize(self.structure.unknowns(), 0.0);
        let mut sum = Sum::new(self, normal);
        let seen = self.visit_unchecked(values, &mut |factor, residuals, jacobian| {
            tell(residuals.len());
            sum.add(factor, residuals, jacobian);
        });
        sum.finish();
        if seen.is_err() || !self.is_finite(normal) {
            // One by one: which it was. A sum that overflows is no failure of a factor.
            self.visit(values, &mut |_, _, _| {})?;
        }
        seen
    }

    /// True where the normal equations are finite: if so, all residuals and derivatives were.
    fn is_finite(&self, normal: &Normal) -> bool {
        let s = self.structure;
        let diagonal = |position: usize| {
            let (first, width) = (s.entry[s.column[position]], s.width(position));
            (0..width).all(|k| normal.h[first + k * (width + 1)].is_finite())
        };
        normal.cost.is_finite() && normal.square.is_finite() && (0..s.order.len()).all(diagonal)
    }

    /// Shows residuals and Jacobian (free columns, row after row) of every factor in turn, before
    /// their losses.
    pub fn visit(&self, values: &[f64], see: See<'_>) -> Result<(), Failure> {
        self.visit_all(values, false, see)
    }

    /// Like [`visit`](Self::visit), where the caller finds out whether all was finite.
    fn visit_unchecked(&self, values: &[f64], see: See<'_>) -> Result<(), Failure> {
        self.visit_all(values, true, see)
    }

    fn visit_all(&self, values: &[f64], unchecked: bool, see: See<'_>) -> Result<(), Failure> {
        let bases = self.bases(values);
        if self.threads == 1 {
            let mut bench = Bench {
                unchecked,
                ..Bench::default()
            };
            for factor in 0..self.graph.factors.len() {
                self.evaluate(factor, values, &bases, &mut bench)?;
                see(factor, &mut bench.work.residuals, &mut bench.work.jacobian);
            }
            return Ok(());
        }
        self.visit_in_threads(values, unchecked, &bases, see)
    }

    /// Like [`visit`](Self::visit), factors evaluated side by side and seen one after the other, so
    /// that the sums are the same to the last bit.
    fn visit_in_threads(
        &self,
        values: &[f64],
        unchecked: bool,
        bases: &Bases,
        see: See<'_>,
    ) -> Result<(), Failure> {
        let mut found: Vec<Found> = (0..self.threads).map(|_| Found::default()).collect();
        let count = self.graph.factors.len();
        for start in (0..count).step_by(PORTION * self.threads) {
            let portion = |thread: usize| {
                let first = (start + thread * PORTION).min(count);
                first..(first + PORTION).min(count)
            };
            std::thread::scope(|scope| {
                for (thread, found) in found.iter_mut().enumerate() {
                    let own = portion(thread);
                    scope.spawn(move || self.evaluate_all(own, values, unchecked, bases, found));
                }
            });
            for (thread, found) in found.iter_mut().enumerate() {
                if let Some(failure) = found.failure {
                    return Err(failure);
                }
                let (mut r, mut j) = (0, 0);
                for (factor, &rows) in portion(thread).zip(&found.rows) {
                    let entries = rows * self.width(factor);
                    see(
                        factor,
                        &mut found.residuals[r..r + rows],
                        &mut found.jacobian[j..j + entries],
                    );
                    r += rows;
                    j += entries;
                }
            }
        }
        Ok(())
    }

    fn evaluate_all(
        &self,
        factors: std::ops::Range<usize>,
        values: &[f64],
        unchecked: bool,
        bases: &Bases,
        found: &mut Found,
    ) {
        found.rows.clear();
        found.residuals.clear();
        found.jacobian.clear();
        found.failure = None;
        let mut bench = Bench {
            unchecked,
            ..Bench::default()
        };
        for factor in factors {
            if let Err(failure) = self.evaluate(factor, values, bases, &mut bench) {
                found.failure = Some(failure);
                return;
            }
            found.rows.push(bench.work.residuals.len());
            found.residuals.extend_from_slice(&bench.work.residuals);
            found.jacobian.extend_from_slice(&bench.work.jacobian);
        }
    }

    /// Number of free columns of a factor.
    fn width(&self, factor: usize) -> usize {
        let blocks = self.graph.blocks_of(factor).iter();
        blocks
            .map(|&b| self.graph.variables[b as usize].width())
            .sum()
    }
}
