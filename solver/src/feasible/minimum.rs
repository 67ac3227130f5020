//! The minimum of the damped model over the feasible set.

use super::least_distance::least_distance;
use super::quadratic_program::active_at_minimum;
use super::{Active, Face, Model};
use crate::linear::vector::{add, norm, unscaled};
use crate::linear::{Factor, multiply, transpose_multiply};

/// Most constraints added one by one after the quadratic program.
const REPAIRS: usize = 20;

/// Scaled gradient without multipliers, relative to that at the start, that counts as none.
const STATIONARY: f64 = 1e-9;

/// The same relative to the residual, of which the gradient is rounded.
const ROUNDING: f64 = 1e-13;

impl Model<'_> {
    /// The step to the minimum and the face it is on.
    ///
    /// The interior point tells the active constraints and QR on their face solves for the step. Where
    /// it tells them wrong, which it may at a vertex of many constraints, the least-distance problem
    /// does.
    pub fn minimum(&self) -> Option<(Face, Vec<f64>)> {
        let interior = active_at_minimum(self).and_then(|active| self.on_face(active));
        if interior.as_ref().is_some_and(|(_, p)| self.is_minimum(p)) {
            return interior;
        }
        least_distance(self)
            .and_then(|active| self.on_face(active))
            .or(interior)
    }

    /// The minimum on the face of `active`, with what it violates added until it violates nothing.
    fn on_face(&self, mut active: Vec<Active>) -> Option<(Face, Vec<f64>)> {
        for _ in 0..REPAIRS {
            let face = Face::new(self.polytope, active.clone(), self.scale);
            let p = self.along(&face)?;
            match self.polytope.violated(self.z, &p, self.scale) {
                None => return Some((face, p)),
                Some(more) if active.contains(&more) => return None,
                Some(more) => active.push(more),
            }
        }
        None
    }

    /// Onto the face by the shortest step, then the minimum along it.
    fn along(&self, face: &Face) -> Option<Vec<f64>> {
        let onto = face.onto(self.polytope, self.z);
        let shifted = add(self.residuals, 1.0, &multiply(self.jacobian, &onto));
        let factor = face.factor(self.jacobian);
        Some(add(&onto, 1.0, &self.solved(&factor, &shifted)?))
    }

    /// The damped or, without damping, the shortest undamped minimum.
    pub(super) fn solved(&self, factor: &dyn Factor, b: &[f64]) -> Option<Vec<f64>> {
        if self.lambda > 0.0 {
            factor.damped(b, self.lambda)
        } else {
            factor.undamped(b)
        }
    }

    /// True where multipliers of the right signs balance the gradient after a step.
    fn is_minimum(&self, p: &[f64]) -> bool {
        let after = add(self.residuals, 1.0, &multiply(self.jacobian, p));
        let mut gradient = transpose_multiply(self.jacobian, &after);
        for ((g, p), s) in gradient.iter_mut().zip(p).zip(self.scale) {
            *g += self.lambda * s * s * p;
        }
        let (end, length) = (add(self.z, 1.0, p), norm(self.residuals));
        let touching = self.polytope.touching(&end, self.scale, length);
        let face = Face::new(self.polytope, touching, self.scale);
        let left = face.unbalanced(&gradient);
        let before = norm(&unscaled(
            &transpose_multiply(self.jacobian, self.residuals),
            self.scale,
        ));
        left <= STATIONARY * before + ROUNDING * length
    }
}

#[cfg(test)]
mod tests {
    use faer::Mat;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::constraints::Constraints;
    use crate::feasible::Polytope;
    use crate::parameters::{Mask, Parameters};

    /// An equality, two-sided constraints and dependent ones, all of which meet at the origin.
    fn meeting() -> Constraints {
        let all = f64::INFINITY;
        Constraints::new()
            .tie("x0", "x3")
            .linear(&[("x0", 2.0), ("x3", -2.0)], 0.0, 0.0)
            .bound("x0", 0.0, 1.0)
            .bound("x1", -0.5, 0.0)
            .order("x1", "x2")
            .linear(&[("x0", 1.0), ("x2", 3.0)], 0.0, all)
            .linear(&[("x1", 1.0), ("x2", -1.0)], -all, 0.0)
            .linear(&[("x0", 1.0), ("x1", -1.0), ("x2", 1.0)], 0.0, 2.0)
    }

    #[test]
    fn least_distance_alone_finds_the_minimum_among_dependent_constraints() {
        let start = Parameters::unnamed(&[0.0; 4]);
        let polytope = Polytope::new(&meeting(), &start, &Mask::all(4));
        let polytope = polytope.unwrap().unwrap();
        let mut held = [0; 6];
        for seed in 0..500 {
            let random = &mut ChaCha8Rng::seed_from_u64(seed);
            let jacobian = Mat::from_fn(6, 4, |_, _| random.random_range(-1.0..1.0));
            let residuals: Vec<f64> = (0..6).map(|_| random.random_range(-1.0..1.0)).collect();
            let scale: Vec<f64> = (0..4).map(|_| random.random_range(0.1..10.0)).collect();
            let model = Model {
                polytope: &polytope,
                z: start.values(),
                jacobian: jacobian.as_ref(),
                residuals: &residuals,
                scale: &scale,
                lambda: [0.0, 1e-6, 1.0][seed as usize % 3],
            };
            let active = least_distance(&model).unwrap();
            let face = Face::new(&polytope, active.clone(), &scale);
            let p = model.along(&face).unwrap();
            assert!(
                polytope.violated(start.values(), &p, &scale).is_none(),
                "{seed}"
            );
            assert!(model.is_minimum(&p), "{seed}");
            held[active.len()] += 1;
        }
        // From the equalities alone to a vertex.
        assert!(held[2..].iter().all(|count| *count > 10), "{held:?}");
    }
}
