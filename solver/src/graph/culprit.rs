//! Search for the coordinate by which a derivative is not finite.

use super::evaluate::gather;
use super::factor::{At, Part, Work};
use crate::graph::elimination::equations::Equations;

impl Equations<'_> {
    /// The name of the first coordinate by which a derivative is not finite, each asked for alone:
    /// where several are carried along together, an infinite one turns the others, as `∞ · 0`, into
    /// what is not a number.
    pub(crate) fn culprit(
        &self,
        factor: usize,
        row: usize,
        column: usize,
        values: &[f64],
    ) -> String {
        let mut names = Vec::new();
        let mut found = None;
        for &block in self.graph.blocks_of(factor) {
            let variable = &self.graph.variables[block as usize];
            for k in variable.free_coordinates() {
                if found.is_none() && self.is_infinite_alone(factor, row, block, k, values) {
                    found = Some(names.len());
                }
                names.push(variable.coordinate(k));
            }
        }
        let place = found.unwrap_or(column);
        names.into_iter().nth(place).unwrap_or_default()
    }

    /// True where the derivative of a row of a factor by one coordinate, asked for alone, is not finite.
    fn is_infinite_alone(
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
