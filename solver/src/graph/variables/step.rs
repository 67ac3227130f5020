//! Steps of a graph's unknowns, and names for what went wrong.

use crate::error::Error;
use crate::graph::elimination::equations::{Equations, Failure};
use crate::graph::elimination::structure::Structure;
use crate::minimise::scaling::unit_if_zero;

impl Structure {
    /// `‖J_k‖` of every unknown.
    pub fn column_norms(&self, h: &[f64]) -> Vec<f64> {
        let mut norms = Vec::with_capacity(self.unknowns());
        for position in 0..self.order.len() {
            let width = self.width(position);
            let first = self.entry[self.column[position]];
            norms.extend((0..width).map(|k| h[first + k * (width + 1)].max(0.0).sqrt()));
        }
        norms
    }

    /// `H x`.
    pub fn multiply(&self, h: &[f64], x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; x.len()];
        for column in 0..self.order.len() {
            let of_column = self.first[column]..self.first[column + 1];
            for slot in self.column[column]..self.column[column + 1] {
                let row = self.row[slot] as usize;
                let of_row = self.first[row]..self.first[row + 1];
                let block = &h[self.entry[slot]..self.entry[slot + 1]];
                let columns = block.chunks_exact(of_row.len());
                for (c, (entries, k)) in columns.zip(of_column.clone()).enumerate() {
                    if row == column {
                        // The lower triangle alone: of wide blocks no other is there.
                        out[k] += entries[c] * x[k];
                        for r in c + 1..entries.len() {
                            out[of_row.start + r] += entries[r] * x[k];
                            out[k] += entries[r] * x[of_row.start + r];
                        }
                    } else {
                        for (entry, r) in entries.iter().zip(of_row.clone()) {
                            out[r] += entry * x[k];
                            out[k] += entry * x[r];
                        }
                    }
                }
            }
        }
        out
    }

    /// [`column_norms`](Self::column_norms) with 1 for 0, to divide by.
    pub fn units(&self, h: &[f64]) -> Vec<f64> {
        self.column_norms(h).into_iter().map(unit_if_zero).collect()
    }
}

impl Equations<'_> {
    /// All stored values after a step of the unknowns.
    pub fn stepped(&self, values: &[f64], step: &[f64]) -> Vec<f64> {
        let mut out = values.to_vec();
        let mut full = Vec::new();
        for (position, &block) in self.structure.order.iter().enumerate() {
            let variable = &self.graph.variables[block as usize];
            let own = &step[self.structure.first[position]..self.structure.first[position + 1]];
            let place = variable.first..variable.first + variable.numbers as usize;
            if variable.manifold.is_flat() {
                for (k, p) in variable.free_coordinates().zip(own) {
                    out[variable.first + k] += p;
                }
                continue;
            }
            full.clear();
            full.resize(variable.dimension as usize, 0.0);
            for (k, p) in variable.free_coordinates().zip(own) {
                full[k] = *p;
            }
            variable
                .manifold
                .retract(&values[place.clone()], &full, &mut out[place]);
        }
        out
    }

    /// Message for the user of a failure at the start.
    pub fn error(&self, failure: Failure, values: &[f64]) -> Error {
        match failure {
            Failure::Residual(factor, row, value) => Error::NotFinite {
                row: self.row[factor] as usize + row,
                value,
            },
            Failure::Length(factor, found, expected) => Error::FactorLength {
                factor,
                found,
                expected,
            },
            Failure::Derivative(factor, row, column) => Error::DerivativeNotFinite {
                row: self.row[factor] as usize + row,
                parameter: self.culprit(factor, row, column, values),
            },
        }
    }
}
