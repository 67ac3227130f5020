//! From the frame after a turn and its two gradients to residual rows.

use nalgebra::Vector3;
use sensor::{BASE_PARAMETERS, PLACES};

use super::affine::{Affine, FRAME_FIELDS};
use super::lanes::WIDTH;
use crate::residuals::TurnData;

/// Rotation of two vectors perpendicular to gravity by a turn, and its derivatives by the parameters.
#[derive(Clone, Debug)]
pub(super) struct Slopes {
    /// The two vectors after the turn, `a₁` and `a₂`.
    pub frame: [Vector3<f64>; 2],
    /// `gᵢ = eᵢ · ∂v/∂p` for each free parameter, with `v` the small rotation in the frame before the
    /// turn that a change of parameters amounts to.
    pub gradients: [Vec<f64>; 2],
}

impl Slopes {
    /// Builds those of turn `lane` of a group from the sums of [`super::affine::differentiate`].
    pub fn from_sums(sums: &[f64], lane: usize, affine: &Affine<'_>, free: &[usize]) -> Self {
        let (first, second) = sums.split_at(sums.len() / 2);
        let each = [first, second].map(|sums| {
            let field = |k: usize| sums[k * WIDTH + lane];
            let frame = Vector3::from_fn(|i, _| field(i));
            let slope = |&k: &usize| slope(&field, affine, k);
            (frame, free.iter().map(slope).collect())
        });
        let [(a1, g1), (a2, g2)] = each;
        Self {
            frame: [a1, a2],
            gradients: [g1, g2],
        }
    }

    /// Gravity after the turn for the length that `before` had: `|u₀| a₁ × a₂`.
    pub fn gravity(&self, before: &Vector3<f64>) -> Vector3<f64> {
        self.frame[0].cross(&self.frame[1]) * before.norm()
    }

    /// Its derivative by free parameter `column`: `|u₀| (g₁ a₂ − g₂ a₁)`.
    pub fn column(&self, before: &Vector3<f64>, column: usize) -> Vector3<f64> {
        let [g1, g2] = &self.gradients;
        (self.frame[1] * g1[column] - self.frame[0] * g2[column]) * before.norm()
    }

    /// The three rows of the turn divided by `sigma`: residuals and, row by row, their derivatives.
    pub fn rows(&self, turn: &TurnData, sigma: f64) -> [(f64, Vec<f64>); 3] {
        let weight = sigma.recip();
        let residual = (self.gravity(&turn.before) - turn.after) * weight;
        let columns: Vec<Vector3<f64>> = (0..self.gradients[0].len())
            .map(|k| self.column(&turn.before, k) * weight)
            .collect();
        std::array::from_fn(|i| (residual[i], columns.iter().map(|c| c[i]).collect()))
    }
}

/// The gradient by parameter `k` of the model from the sums over the steps.
fn slope(field: &impl Fn(usize) -> f64, affine: &Affine<'_>, k: usize) -> f64 {
    if let Some((i, j)) = PLACES.get(k) {
        return field(3 + 3 * i + j);
    }
    if k < BASE_PARAMETERS {
        let axis = k - PLACES.len();
        return -(0..3)
            .map(|i| affine.base.t[(i, axis)] * field(12 + i))
            .sum::<f64>();
    }
    let entries = affine.features.entries().iter().enumerate();
    -entries
        .filter(|(_, entry)| entry.parameter == k - BASE_PARAMETERS)
        .map(|(n, _)| field(FRAME_FIELDS + n))
        .sum::<f64>()
}
