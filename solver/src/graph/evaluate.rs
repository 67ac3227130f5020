//! Residuals and Jacobian of single factors at stored values.

use super::factor::{At, Part, Work};
use super::problem::Graph;
use crate::graph::elimination::equations::{Equations, Failure};
use crate::graph::elimination::structure::NONE;

/// Tangent bases of the blocks that need one.
#[derive(Default)]
pub(crate) struct Bases {
    entries: Vec<f64>,
    /// Begin of a block's basis; [`NONE`] for the unit matrix.
    first: Vec<u32>,
}

/// Memory of a thread.
#[derive(Default)]
pub(crate) struct Bench<'a> {
    pub work: Work,
    pub x: Vec<f64>,
    pub parts: Vec<Part<'a>>,
    /// True where someone else looks for what is not finite.
    pub unchecked: bool,
}

impl Equations<'_> {
    pub(crate) fn bases(&self, values: &[f64]) -> Bases {
        let mut bases = Bases::default();
        let mut full = Vec::new();
        for variable in &self.graph.variables {
            let plain = variable.manifold.is_flat() && variable.free.is_none();
            if plain || variable.width() == 0 {
                bases.first.push(NONE);
                continue;
            }
            bases.first.push(bases.entries.len() as u32);
            let (n, d) = (variable.numbers as usize, variable.dimension as usize);
            full.clear();
            full.resize(n * d, 0.0);
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

    /// Evaluates one factor.
    pub(crate) fn evaluate<'b>(
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
        let rows = self.rows_of(factor).unwrap_or(work.residuals.len());
        if work.residuals.len() != rows || work.jacobian.len() != rows * width {
            let (found, expected) = if work.residuals.len() == rows {
                (work.jacobian.len(), rows * width)
            } else {
                (work.residuals.len(), rows)
            };
            return Err(Failure::Length(factor, found, expected));
        }
        if bench.unchecked {
            return Ok(());
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
pub(crate) fn gather(graph: &Graph<'_>, blocks: &[u32], values: &[f64], x: &mut Vec<f64>) {
    x.clear();
    for &block in blocks {
        let variable = &graph.variables[block as usize];
        x.extend_from_slice(&values[variable.first..variable.first + variable.numbers as usize]);
    }
}
