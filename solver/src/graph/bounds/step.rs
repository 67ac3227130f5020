//! The minimum of the damped model within bounds.

use super::{Bound, Bounds, Held};
use crate::graph::elimination::Factored;
use crate::graph::elimination::equations::Normal;
use crate::graph::elimination::structure::Structure;

/// Rounds without progress after which bounds are exchanged one by one.
const PATIENCE: usize = 10;

/// Most rounds, each a factorisation, beside three for every bound.
const ROUNDS: usize = 50;

/// Pull on a bound, relative to `‖J_k‖ ‖r‖`, that is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Side on which the minimum lies along a bounded unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Inside,
    Lower,
    Upper,
}

/// Minimises `gᵀp + ½ pᵀ(H + Λ)p` over steps `p` that keep the bounds, as the dense solver does over
/// any constraints.
///
/// Some unknowns are held at their bounds and the others solved for; then all that went beyond a bound are
/// held, and all that are pulled inside set free, until none is. Where that does not make them fewer, the
/// last one alone is exchanged, which ends for every positive definite matrix.
///
/// Source: Júdice and Pires, "A block principal pivoting algorithm for large-scale strictly monotone
/// linear complementarity problems", 1994.
#[derive(Debug)]
pub(crate) struct BoundedStep {
    pub bounds: Bounds,
    /// Sides of the last minimum: the next one is looked for there first.
    sides: Vec<Side>,
    /// `H` without what is held.
    left: Vec<f64>,
    /// `Σ y_k p_k` of the last step, `y` the model's slope at its end: zero but for those held.
    pub pressed: f64,
}

/// The model `gᵀp + ½ pᵀ(H + Λ)p` at stored values.
pub(crate) struct Model<'a> {
    pub structure: &'a Structure,
    pub normal: &'a Normal,
    /// The diagonal `Λ`.
    pub more: &'a [f64],
    pub values: &'a [f64],
    /// The diagonal of `D`.
    pub scale: &'a [f64],
}

impl BoundedStep {
    /// Nothing held.
    pub fn new(bounds: Bounds) -> Self {
        Self {
            sides: vec![Side::Inside; bounds.0.len()],
            bounds,
            left: Vec::new(),
            pressed: 0.0,
        }
    }

    /// Writes the minimum; `false` where the model has none.
    pub fn minimum(
        &mut self,
        model: &Model<'_>,
        factored: &mut Factored,
        step: &mut [f64],
    ) -> bool {
        for (side, bound) in self.sides.iter_mut().zip(&self.bounds.0) {
            if bound.lower == bound.upper {
                *side = Side::Lower;
            }
        }
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        for _ in 0..ROUNDS + 3 * self.sides.len() {
            let Some(slope) = self.on_these_sides(model, factored, step) else {
                return false;
            };
            let wrong: Vec<(usize, Side)> = (0..self.sides.len())
                .filter_map(|k| Some((k, self.better(k, model, step, &slope)?)))
                .collect();
            let Some(&last) = wrong.last() else {
                self.pressed = pressed(&self.bounds.0, step, &slope);
                return true;
            };
            if wrong.len() < fewest {
                (fewest, patience) = (wrong.len(), PATIENCE);
            } else {
                patience = patience.saturating_sub(1);
            }
            let exchanged = if patience > 0 { &wrong[..] } else { &[last] };
            for &(k, side) in exchanged {
                self.sides[k] = side;
            }
        }
        // Rounding goes in circles: the last step, cut at the bounds.
        for bound in &self.bounds.0 {
            let [lower, upper] = room(bound, model.values);
            step[bound.unknown] = step[bound.unknown].clamp(lower, upper);
        }
        let slope = slope(model, step);
        self.pressed = pressed(&self.bounds.0, step, &slope);
        true
    }

    /// The minimum with the unknowns on their sides, and the model's slope there.
    fn on_these_sides(
        &mut self,
        model: &Model<'_>,
        factored: &mut Factored,
        step: &mut [f64],
    ) -> Option<Vec<f64>> {
        let h = &model.normal.h;
        for (p, g) in step.iter_mut().zip(&model.normal.gradient) {
            *p = -g;
        }
        let held = self.held(step.len());
        let Some(held) = held else {
            return factored
                .factor_and_solve(h, model.more, step)
                .then(|| vec![0.0; step.len()]);
        };
        let fixed = self.fixed(step.len(), model.values);
        let pull = model.structure.multiply(h, &fixed);
        step.iter_mut().zip(&pull).for_each(|(b, pull)| *b -= pull);
        held.clear(step);
        held.leave(model.structure, h, &mut self.left);
        if !factored.factor_and_solve(&self.left, model.more, step) {
            return None;
        }
        step.iter_mut()
            .zip(&fixed)
            .for_each(|(p, fixed)| *p += fixed);
        Some(slope(model, step))
    }

    /// Unknowns that their sides hold.
    fn held(&self, unknowns: usize) -> Option<Held> {
        let mut held = vec![false; unknowns];
        let mut count = 0;
        for (bound, &side) in self.bounds.0.iter().zip(&self.sides) {
            if side != Side::Inside {
                held[bound.unknown] = true;
                count += 1;
            }
        }
        (count > 0).then_some(Held { held, count })
    }

    /// The steps of those held, onto their bounds.
    fn fixed(&self, unknowns: usize, values: &[f64]) -> Vec<f64> {
        let mut fixed = vec![0.0; unknowns];
        for (bound, side) in self.bounds.0.iter().zip(&self.sides) {
            let [lower, upper] = room(bound, values);
            fixed[bound.unknown] = match side {
                Side::Inside => 0.0,
                Side::Lower => lower,
                Side::Upper => upper,
            };
        }
        fixed
    }

    /// The other side of a bounded unknown, if it is on a wrong one.
    fn better(&self, k: usize, model: &Model<'_>, step: &[f64], slope: &[f64]) -> Option<Side> {
        let bound = &self.bounds.0[k];
        let [lower, upper] = room(bound, model.values);
        let (p, y) = (step[bound.unknown], slope[bound.unknown]);
        let rounding = ROUNDING * model.scale[bound.unknown] * model.normal.square.sqrt();
        match self.sides[k] {
            Side::Inside if p < lower => Some(Side::Lower),
            Side::Inside if p > upper => Some(Side::Upper),
            Side::Lower if y < -rounding && bound.lower < bound.upper => Some(Side::Inside),
            Side::Upper if y > rounding => Some(Side::Inside),
            _ => None,
        }
    }
}

/// Room of a bounded unknown, down and up.
fn room(bound: &Bound, values: &[f64]) -> [f64; 2] {
    let x = values[bound.value];
    [bound.lower - x, bound.upper - x]
}

/// `g + (H + Λ) p`.
fn slope(model: &Model<'_>, step: &[f64]) -> Vec<f64> {
    let mut slope = model.structure.multiply(&model.normal.h, step);
    for (k, slope) in slope.iter_mut().enumerate() {
        *slope += model.normal.gradient[k] + model.more[k] * step[k];
    }
    slope
}

fn pressed(bounds: &[Bound], step: &[f64], slope: &[f64]) -> f64 {
    bounds
        .iter()
        .map(|bound| step[bound.unknown] * slope[bound.unknown])
        .sum()
}
