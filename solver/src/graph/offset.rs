//! Distance of a graph's point from a minimum: offset and relative step, by the factor at hand.

use super::solve::{Run, TELLING};
use crate::linear::vector::{dot, scaled_norm};

/// Share of the offset sought that a step by the factor at hand has to stay below: the offset that
/// it tells is not exact.
const SURE: f64 = 0.5;

/// Unknowns that a residual depends on: where they are more, [`Run::steepness`] says too much, and a
/// factorisation that could be spared is done.
const TOUCHED: f64 = 12.0;

impl Run<'_> {
    /// Twice what the model promises, but for the damping: `−gᵀp`, less what bounds take up.
    pub(super) fn decrement(&self) -> f64 {
        let pressed = self.bounded.as_ref().map_or(0.0, |b| b.pressed);
        -dot(&self.normal.gradient, &self.step) - pressed
    }

    /// True where the offset is small by the factor at hand, that of the equations before the last step:
    /// where that did what the linearised problem said, they have hardly changed, and the last
    /// factorisation is spared. Leaves the step by this factor in `self.step`.
    pub(super) fn is_near_by_last_factor(&mut self, near: f64) -> bool {
        // Which bounds hold a new factorisation tells.
        let alike = self.tries > 0
            && self.as_predicted
            && self.factor_damping <= TELLING
            && self.bounded.is_none();
        if !alike || self.steepness() > SURE * near {
            return false;
        }
        let known = (self.offset, self.relative_step);
        for (p, g) in self.step.iter_mut().zip(&self.normal.gradient) {
            *p = -g;
        }
        self.factored.solve(&self.normal.h, &mut self.step);
        self.judge_step();
        let finite = self.step.iter().all(|v| v.is_finite());
        if !(finite && self.offset <= SURE * near) {
            (self.offset, self.relative_step) = known;
            self.tries -= 1;
            return false;
        }
        true
    }

    /// Hardly more than the offset, and quickly known: where a residual depends on `c` unknowns,
    /// `H ≤ c D²`, so that `gᵀ H⁻¹ g ≥ gᵀ D⁻² g / c`.
    fn steepness(&self) -> f64 {
        let scale = self.scaling.diagonal();
        let sum: f64 = (self.normal.gradient.iter().zip(scale))
            .map(|(g, d)| (g / d).powi(2))
            .sum();
        (sum / (TOUCHED * self.normal.square)).sqrt()
    }

    /// Updates offset and relative step.
    pub(super) fn judge_step(&mut self) {
        let scale = self.scaling.diagonal();
        let decrement = self.decrement();
        self.offset = if decrement > 0.0 {
            (decrement / self.normal.square).sqrt()
        } else {
            0.0
        };
        let length = scaled_norm(&self.step, scale);
        let size = self.size();
        self.relative_step = if length > 0.0 { length / size } else { 0.0 };
    }

    /// `‖D x‖`, where a coordinate of a curved block counts as 1.
    pub(super) fn size(&self) -> f64 {
        let structure = self.equations.structure;
        let scale = self.scaling.diagonal();
        let mut sum = 0.0;
        for (position, &block) in structure.order.iter().enumerate() {
            let variable = &self.equations.graph.variables[block as usize];
            let first = structure.first[position];
            for (k, coordinate) in variable.free_coordinates().enumerate() {
                let x = if variable.manifold.is_flat() {
                    self.values[variable.first + coordinate]
                } else {
                    1.0
                };
                sum += (scale[first + k] * x).powi(2);
            }
        }
        sum.sqrt()
    }
}
