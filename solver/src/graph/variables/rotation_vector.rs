//! Rotations stored as rotation vectors, and blocks made of two manifolds.

use std::f64::consts::TAU;

use super::manifold::Manifold;
use super::quaternion::{conjugate, exponential, logarithm, multiply};
use crate::scalar::{Scalar, lit};

/// A rotation, stored as a rotation vector `ω` in rad, as bundle adjustment files have it; a step is a
/// rotation vector in the rotated frame: `ω ⊞ φ = log(exp(ω) exp(φ))`.
///
/// Three plain numbers, `Euclidean(3)`, cannot turn every way where `‖ω‖` is near a full turn: a turn by
/// `θ` about an axis across `ω` changes `ω` by `θ ‖ω‖ / (2 sin(‖ω‖/2))`, and the solver crawls. This
/// block can, from any start that is not a full turn exactly. After a step `‖ω‖` is at most half a turn.
/// A factor with a Jacobian of its own gives it by `φ`, as on every manifold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RotationVector;

impl Manifold for RotationVector {
    fn numbers(&self) -> usize {
        3
    }

    fn dimension(&self) -> usize {
        3
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        let turned = logarithm(&multiply(&exponential(x), &exponential(step)));
        // Derivatives at no step belong to the vector as it is stored, whatever its length.
        let turned = match step.iter().all(|s| s.re() == 0.0) {
            true => longer(turned, x),
            false => turned,
        };
        out.copy_from_slice(&turned);
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        out.copy_from_slice(&logarithm(&multiply(
            &conjugate(&exponential(x)),
            &exponential(y),
        )));
    }
}

/// The same rotation as `v` by the full turns more or less that bring it to `x`.
fn longer<D: Scalar>(v: [D; 3], x: &[D]) -> [D; 3] {
    let square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    let length = square.re().sqrt();
    let along: f64 = v.iter().zip(x).map(|(v, x)| v.re() * x.re()).sum();
    let turns = ((along / length - length) / TAU).round();
    // No axis to turn about: no rotation, or one by full turns alone.
    if length == 0.0 || turns == 0.0 {
        return v;
    }
    let factor = square.sqrt().recip() * (turns * TAU) + lit::<D>(1.0);
    v.map(|v| v * factor)
}

/// Two manifolds in one block: the numbers and the coordinates of the first, then those of the second.
///
/// ```
/// use stillpoint_solver::{Euclidean, Graph, RotationVector};
///
/// // A camera of a bundle adjustment file: rotation vector, place, focal length and two of distortion.
/// let camera = (RotationVector, Euclidean(6));
/// let mut graph = Graph::new();
/// graph.add("c0", camera, &[0.1, 6.2, 0.0, 0.0, 0.0, -6.0, 800.0, 0.0, 0.0])?;
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
impl<A: Manifold, B: Manifold> Manifold for (A, B) {
    fn numbers(&self) -> usize {
        self.0.numbers() + self.1.numbers()
    }

    fn dimension(&self) -> usize {
        self.0.dimension() + self.1.dimension()
    }

    fn retract<D: Scalar>(&self, x: &[D], step: &[D], out: &mut [D]) {
        let (first, second) = out.split_at_mut(self.0.numbers());
        let (a, b) = x.split_at(first.len());
        let (of_a, of_b) = step.split_at(self.0.dimension());
        self.0.retract(a, of_a, first);
        self.1.retract(b, of_b, second);
    }

    fn local<D: Scalar>(&self, x: &[D], y: &[D], out: &mut [D]) {
        let (first, second) = out.split_at_mut(self.0.dimension());
        let (a, b) = x.split_at(self.0.numbers());
        let (to_a, to_b) = y.split_at(a.len());
        self.0.local(a, to_a, first);
        self.1.local(b, to_b, second);
    }

    fn is_flat(&self) -> bool {
        self.0.is_flat() && self.1.is_flat()
    }

    fn plain(&self, coordinate: usize) -> Option<usize> {
        match coordinate.checked_sub(self.0.dimension()) {
            None => self.0.plain(coordinate),
            Some(of_second) => Some(self.0.numbers() + self.1.plain(of_second)?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::manifold::{AnyManifold, Euclidean, check_manifold};
    use super::*;

    #[test]
    fn rotation_vectors_and_pairs_keep_the_rules_of_a_manifold() {
        for omega in [
            [0.0; 3],
            [0.3, -0.2, 1.1],
            [0.0, 1e-9, 0.0],
            [1.2, 1.2, -1.2],
        ] {
            for size in [0.0, 1e-9, 1e-4, 0.3] {
                let step = [size, -0.5 * size, 0.2 * size];
                let worst = check_manifold(&RotationVector, &omega, &step);
                assert!(worst < 2e-9, "{omega:?} {size}: {worst:e}");
                let [x, y, z] = omega;
                let pair = (RotationVector, Euclidean(2));
                let worst = check_manifold(
                    &pair,
                    &[x, y, z, 5.0, -6.0],
                    &[step[0], step[1], step[2], 0.1, 0.2],
                );
                assert!(worst < 2e-9, "{omega:?} {size}: {worst:e}");
            }
        }
    }

    /// `∂ω/∂φ = I + ½ ω× + (1/θ² − (1 + cos θ)/(2 θ sin θ)) ω×²` of the right Jacobian's inverse, at lengths beyond half a
    /// turn too.
    ///
    /// Source: Solà, Deray and Atchuthan, "A micro Lie theory for state estimation in robotics", 2018, equation 144.
    #[test]
    fn derivatives_of_a_long_vector_are_those_of_the_closed_form() {
        for angle in [0.5f64, 3.0, 3.3, 6.0, 6.2, 7.0] {
            let axis = [0.6, 0.0, -0.8];
            let w = axis.map(|a| a * angle);
            let hat = [[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]];
            let weight = 1.0 / angle.powi(2) - (1.0 + angle.cos()) / (2.0 * angle * angle.sin());
            let mut basis = [0.0; 9];
            AnyManifold::tangent(&RotationVector, &w, &mut basis);
            for i in 0..3 {
                for k in 0..3 {
                    let one = f64::from(u8::from(i == k));
                    let square: f64 = (0..3).map(|j| hat[i][j] * hat[j][k]).sum();
                    let expected = one + 0.5 * hat[i][k] + weight * square;
                    let found = basis[3 * i + k];
                    assert!(
                        (found - expected).abs() < 1e-10 * (1.0 + expected.abs()),
                        "{angle} {i} {k}: {found} {expected}"
                    );
                }
            }
        }
    }
}
