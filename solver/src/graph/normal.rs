//! The normal equations `H = JᵀJ`, `g = Jᵀr` of a graph at a point.

use super::factor::{At, Part, Work};
use super::outer::add_outer;
use super::problem::Graph;
use super::structure::{NONE, Structure, pair};
use crate::loss::Loss;

/// Least curvature of a loss relative to its slope: keeps outliers' rows positive.
const LEAST_CURVATURE: f64 = 1e-2;

/// Factors that a thread evaluates before what it found is added up.
const PORTION: usize = 2048;

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

/// Where an evaluation failed.
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
}

/// Shown a factor's number, its residuals and its Jacobian.
pub(crate) type See<'a> = &'a mut dyn FnMut(usize, &mut [f64], &mut [f64]);

/// Tangent bases of the blocks that need one.
#[derive(Default)]
struct Bases {
    entries: Vec<f64>,
    /// Where a block's basis begins; [`NONE`] for the unit matrix.
    first: Vec<u32>,
}

/// What a thread works with.
#[derive(Default)]
struct Bench<'a> {
    work: Work,
    x: Vec<f64>,
    parts: Vec<Part<'a>>,
}

/// Residuals and Jacobians of a portion of factors, one after the other.
#[derive(Default)]
struct Found {
    residuals: Vec<f64>,
    jacobian: Vec<f64>,
    failure: Option<Failure>,
}

impl<'a> Equations<'a> {
    /// Counts the residuals at a point.
    pub fn new(graph: &'a Graph<'a>, structure: &'a Structure, threads: usize) -> Self {
        let mut row = Vec::with_capacity(graph.factors.len() + 1);
        row.push(0);
        let (mut x, mut out) = (Vec::new(), Vec::new());
        let mut rows = 0;
        for (factor, entry) in graph.factors.iter().enumerate() {
            gather(graph, graph.blocks_of(factor), &graph.values, &mut x);
            entry.factor.values(&x, &mut out);
            rows += out.len() as u32;
            row.push(rows);
        }
        Self {
            graph,
            structure,
            row,
            threads: threads.max(1),
        }
    }

    /// Number of residuals.
    pub fn rows(&self) -> usize {
        self.row.last().map_or(0, |&r| r as usize)
    }

    fn rows_of(&self, factor: usize) -> std::ops::Range<usize> {
        self.row[factor] as usize..self.row[factor + 1] as usize
    }

    /// The cost at stored values; infinite where it is not finite.
    pub fn cost(&self, values: &[f64]) -> f64 {
        let (mut x, mut out) = (Vec::new(), Vec::new());
        let mut sum = 0.0;
        for (factor, entry) in self.graph.factors.iter().enumerate() {
            gather(self.graph, self.graph.blocks_of(factor), values, &mut x);
            entry.factor.values(&x, &mut out);
            if out.len() != self.rows_of(factor).len() {
                return f64::INFINITY;
            }
            sum += cost_of(self.graph.loss_of(factor), &out);
        }
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    /// Forms the normal equations at stored values.
    pub fn linearize(&self, values: &[f64], normal: &mut Normal) -> Result<(), Failure> {
        normal.h.clear();
        let entries = self.structure.entry.last().copied().unwrap_or(0);
        normal.h.resize(entries, 0.0);
        normal.gradient.clear();
        normal.gradient.resize(self.structure.unknowns(), 0.0);
        (normal.cost, normal.square) = (0.0, 0.0);
        let mut sum = Sum {
            equations: self,
            normal,
            next_pair: 0,
            panel: super::outer::Panel::default(),
        };
        self.visit(values, &mut |factor, residuals, jacobian| {
            sum.add(factor, residuals, jacobian);
        })?;
        sum.finish();
        Ok(())
    }

    /// Shows residuals and Jacobian (free columns, row after row) of every factor in turn, under
    /// their losses.
    pub fn visit(&self, values: &[f64], see: See<'_>) -> Result<(), Failure> {
        let bases = self.bases(values);
        if self.threads == 1 {
            let mut bench = Bench::default();
            for factor in 0..self.graph.factors.len() {
                self.evaluate(factor, values, &bases, &mut bench)?;
                see(factor, &mut bench.work.residuals, &mut bench.work.jacobian);
            }
            return Ok(());
        }
        self.visit_in_threads(values, &bases, see)
    }

    /// As [`visit`](Self::visit), factors evaluated side by side and seen one after the other, so
    /// that the sums are the same to the last bit.
    fn visit_in_threads(&self, values: &[f64], bases: &Bases, see: See<'_>) -> Result<(), Failure> {
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
                    scope.spawn(move || self.evaluate_all(own, values, bases, found));
                }
            });
            for (thread, found) in found.iter_mut().enumerate() {
                if let Some(failure) = found.failure {
                    return Err(failure);
                }
                let (mut r, mut j) = (0, 0);
                for factor in portion(thread) {
                    let rows = self.rows_of(factor).len();
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
        bases: &Bases,
        found: &mut Found,
    ) {
        found.residuals.clear();
        found.jacobian.clear();
        found.failure = None;
        let mut bench = Bench::default();
        for factor in factors {
            if let Err(failure) = self.evaluate(factor, values, bases, &mut bench) {
                found.failure = Some(failure);
                return;
            }
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

    fn bases(&self, values: &[f64]) -> Bases {
        let mut bases = Bases::default();
        for variable in &self.graph.variables {
            let plain = variable.manifold.is_flat() && variable.free.is_none();
            if plain || variable.width() == 0 {
                bases.first.push(NONE);
                continue;
            }
            bases.first.push(bases.entries.len() as u32);
            let (n, d) = (variable.numbers as usize, variable.dimension as usize);
            let mut full = vec![0.0; n * d];
            let x = &values[variable.first..variable.first + n];
            variable.manifold.tangent(x, &mut full);
            for row in full.chunks_exact(d) {
                bases
                    .entries
                    .extend(variable.free_coordinates().map(|k| row[k]));
            }
        }
        bases
    }

    /// Evaluates one factor, under its loss.
    fn evaluate<'b>(
        &'b self,
        factor: usize,
        values: &[f64],
        bases: &'b Bases,
        bench: &mut Bench<'b>,
    ) -> Result<(), Failure> {
        let blocks = self.graph.blocks_of(factor);
        gather(self.graph, blocks, values, &mut bench.x);
        bench.parts.clear();
        let mut width = 0;
        for &block in blocks {
            let variable = &self.graph.variables[block as usize];
            let part = Part {
                numbers: variable.numbers as usize,
                dimension: variable.dimension as usize,
                free: variable.free.as_deref(),
                basis: Some(bases.first[block as usize])
                    .filter(|&first| first != NONE)
                    .map(|first| &bases.entries[first as usize..]),
            };
            width += part.width();
            bench.parts.push(part);
        }
        let at = At {
            x: &bench.x,
            parts: &bench.parts,
            width,
        };
        self.graph.factors[factor]
            .factor
            .linearize_free(&at, &mut bench.work);
        let work = &mut bench.work;
        let rows = self.rows_of(factor).len();
        if work.residuals.len() != rows || work.jacobian.len() != rows * width {
            let (found, expected) = if work.residuals.len() == rows {
                (work.jacobian.len(), rows * width)
            } else {
                (work.residuals.len(), rows)
            };
            return Err(Failure::Length(factor, found, expected));
        }
        check_finite(factor, width, &work.residuals, &work.jacobian)
    }
}

fn check_finite(factor: usize, width: usize, r: &[f64], j: &[f64]) -> Result<(), Failure> {
    // A sum is finite only if all its terms are, or nearly so: the places are looked at then.
    let sum = r.iter().chain(j).map(|v| v * 0.0).sum::<f64>();
    if sum == 0.0 {
        return Ok(());
    }
    if let Some(row) = r.iter().position(|v| !v.is_finite()) {
        return Err(Failure::Residual(factor, row, r[row]));
    }
    match j.iter().position(|v| !v.is_finite()) {
        Some(place) => Err(Failure::Derivative(factor, place / width, place % width)),
        None => Ok(()),
    }
}

/// Writes the stored values of blocks one after the other.
fn gather(graph: &Graph<'_>, blocks: &[u32], values: &[f64], x: &mut Vec<f64>) {
    x.clear();
    for &block in blocks {
        let variable = &graph.variables[block as usize];
        x.extend_from_slice(&values[variable.first..variable.first + variable.numbers as usize]);
    }
}

/// What a factor costs.
pub(crate) fn cost_of(loss: Option<&Loss>, residuals: &[f64]) -> f64 {
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    match loss {
        None => 0.5 * square,
        Some(loss) => loss.cost_of_square(square),
    }
}

/// Rewrites residuals and rows of a factor so that they give the gradient and the Gauss–Newton
/// Hessian of its loss.
///
/// Source: Triggs, McLauchlan, Hartley and Fitzgibbon, "Bundle adjustment: a modern synthesis", 2000,
/// section 4.3.
pub(crate) fn rewrite(loss: &Loss, residuals: &mut [f64], jacobian: &mut [f64], width: usize) {
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    let (slope, bend) = loss.slope_and_bend(square);
    let root = slope.sqrt();
    // `c = ρ′ + 2 s ρ″` along r, `ρ′` across it: `√ρ′ (I − α r rᵀ/‖r‖²)`, `(1 − α)² = c/ρ′`.
    let curvature = (slope + 2.0 * square * bend).max(LEAST_CURVATURE * slope);
    let along = if slope > 0.0 {
        (curvature / slope).sqrt()
    } else {
        1.0
    };
    let alpha = 1.0 - along;
    if alpha != 0.0 && square > 0.0 && width > 0 {
        for c in 0..width {
            let rows = || jacobian.iter().skip(c).step_by(width);
            let dot: f64 = rows().zip(&*residuals).map(|(j, r)| j * r).sum();
            let factor = alpha * dot / square;
            let rows = jacobian.iter_mut().skip(c).step_by(width);
            rows.zip(&*residuals).for_each(|(j, r)| *j -= factor * r);
        }
    }
    jacobian.iter_mut().for_each(|j| *j *= root);
    residuals.iter_mut().for_each(|r| *r *= root / along);
}

/// Normal equations being added up.
struct Sum<'a> {
    equations: &'a Equations<'a>,
    normal: &'a mut Normal,
    next_pair: usize,
    panel: super::outer::Panel,
}

impl Sum<'_> {
    fn add(&mut self, factor: usize, residuals: &mut [f64], jacobian: &mut [f64]) {
        let Equations {
            graph, structure, ..
        } = self.equations;
        let loss = graph.loss_of(factor);
        self.normal.cost += cost_of(loss, residuals);
        let n = structure.free[factor] as usize;
        if n == 0 {
            self.normal.square += residuals.iter().map(|r| r * r).sum::<f64>();
            return;
        }
        let width = jacobian.len() / residuals.len().max(1);
        if let Some(loss) = loss {
            rewrite(loss, residuals, jacobian, width);
        }
        self.normal.square += residuals.iter().map(|r| r * r).sum::<f64>();
        let pairs = &structure.pairs[self.next_pair..self.next_pair + n * (n + 1) / 2];
        self.next_pair += pairs.len();
        let mut first_a = 0;
        let blocks = graph.blocks_of(factor);
        let free = |k: &usize| structure.position[blocks[*k] as usize] != NONE;
        for (place_a, a) in (0..blocks.len()).filter(free).enumerate() {
            let position_a = structure.position[blocks[a] as usize] as usize;
            let width_a = structure.width(position_a);
            let gradient = &mut self.normal.gradient[structure.first[position_a]..][..width_a];
            for (row, r) in jacobian.chunks_exact(width).zip(&*residuals) {
                for (g, j) in gradient.iter_mut().zip(&row[first_a..first_a + width_a]) {
                    *g += j * r;
                }
            }
            let mut first_b = first_a;
            for (place_b, b) in (place_a..).zip((a..blocks.len()).filter(free)) {
                let position_b = structure.position[blocks[b] as usize] as usize;
                let width_b = structure.width(position_b);
                let slot = pairs[pair(place_a, place_b, n)] as usize;
                let (row, column) = if position_a >= position_b {
                    ((first_a, width_a), (first_b, width_b))
                } else {
                    ((first_b, width_b), (first_a, width_a))
                };
                if self.panel.takes(row.1, column.1) {
                    self.panel.push(
                        &mut self.normal.h,
                        structure,
                        slot,
                        jacobian,
                        width,
                        row,
                        column,
                    );
                } else {
                    let entries = structure.entry[slot]..structure.entry[slot + 1];
                    let out = &mut self.normal.h[entries];
                    add_outer(out, jacobian, width, row, column);
                }
                first_b += width_b;
            }
            first_a += width_a;
        }
    }

    fn finish(&mut self) {
        let structure = self.equations.structure;
        self.panel.flush(&mut self.normal.h, structure);
    }
}

impl Equations<'_> {
    /// Whether the derivative of a row of a factor by one coordinate, asked for alone, is not finite.
    pub(super) fn is_infinite_alone(
        &self,
        factor: usize,
        row: usize,
        block: u32,
        coordinate: usize,
        values: &[f64],
    ) -> bool {
        let blocks = self.graph.blocks_of(factor);
        let mut x = Vec::new();
        gather(self.graph, blocks, values, &mut x);
        let one = [coordinate as u32];
        let mut basis = Vec::new();
        let mut parts = Vec::with_capacity(blocks.len());
        for &b in blocks {
            let variable = &self.graph.variables[b as usize];
            let (n, d) = (variable.numbers as usize, variable.dimension as usize);
            if b == block {
                let mut full = vec![0.0; n * d];
                let x = &values[variable.first..variable.first + n];
                variable.manifold.tangent(x, &mut full);
                basis.extend(full.chunks_exact(d).map(|row| row[coordinate]));
            }
            parts.push((n, d, b == block));
        }
        let parts: Vec<Part<'_>> = parts
            .iter()
            .map(|&(numbers, dimension, own)| Part {
                numbers,
                dimension,
                free: Some(if own { &one } else { &[] }),
                basis: own.then_some(&basis[..]),
            })
            .collect();
        let at = At {
            x: &x,
            parts: &parts,
            width: 1,
        };
        let mut work = Work::default();
        self.graph.factors[factor]
            .factor
            .linearize_free(&at, &mut work);
        work.jacobian.get(row).is_some_and(|v| !v.is_finite())
    }
}
