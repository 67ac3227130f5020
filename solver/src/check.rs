//! Are the derivatives those of the residuals?

use serde::{Deserialize, Serialize};

use crate::closure::central_differences;
use crate::parameters::Parameters;
use crate::residual::{Problem, of_shape};

/// Relative step of a difference of Jacobians, `∛ε`.
const STEP: f64 = 6.055_454_452_393_343e-6;

/// Rounding of a Jacobian's entries that a difference may show, relative to the largest.
const ROUNDING: f64 = 1e-14;

/// A derivative that differs from the central difference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mismatch {
    /// Row of the residual.
    pub row: usize,
    /// Name of the parameter; of a second derivative, it is along that parameter alone.
    pub parameter: String,
    /// 1 for an entry of the Jacobian, 2 for a second derivative.
    pub order: u8,
    /// The problem's own value.
    pub derivative: f64,
    /// The central difference.
    pub difference: f64,
}

/// Compares the problem's Jacobian at `parameters` with central differences and returns the entries
/// that differ by more than `tolerance` relative to the largest entry of their column; 1e-6 suits
/// smooth residuals of ordinary size. Second derivatives, where the problem offers them, are compared with
/// differences of the Jacobian along each parameter in the same way. Entries that are not finite are always returned, and all of
/// a matrix that has not the shape `m × n`.
///
/// ```
/// use stillpoint_solver::{Parameters, Residual, Scalar, check_derivatives};
///
/// struct Leaky;
/// impl<D: Scalar> Residual<D> for Leaky {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.push(x[0] * x[0].re()); // the second factor's derivative is lost
///     }
/// }
/// let mismatches = check_derivatives(&Leaky, &Parameters::unnamed(&[3.0]), 1e-6);
/// assert_eq!((mismatches[0].row, mismatches[0].derivative), (0, 3.0));
/// ```
pub fn check_derivatives(
    problem: &dyn Problem,
    parameters: &Parameters,
    tolerance: f64,
) -> Vec<Mismatch> {
    let x = parameters.values();
    let all: Vec<usize> = (0..x.len()).collect();
    let mut residuals = Vec::new();
    let jacobian = problem.linearize(x, &all, &mut residuals);
    let m = residuals.len();
    let jacobian = of_shape(jacobian, m, x.len());
    let differences = central_differences(problem, x, &all, m);
    let mut found = second_mismatches(problem, parameters, m, tolerance);
    for k in all {
        let largest = (0..m)
            .map(|i| differences[(i, k)].abs())
            .fold(0.0, f64::max);
        for row in 0..m {
            let (derivative, difference) = (jacobian[(row, k)], differences[(row, k)]);
            let agree =
                (derivative - difference).abs() <= tolerance * largest.max(f64::MIN_POSITIVE);
            if !agree {
                let parameter = parameters.names()[k].clone();
                found.push(Mismatch {
                    row,
                    parameter,
                    order: 1,
                    derivative,
                    difference,
                });
            }
        }
    }
    found.sort_by_key(|mismatch| mismatch.order);
    found
}

/// Second derivatives along each parameter that differ from `(J(x + h eₖ) − J(x − h eₖ)) eₖ / 2h`.
fn second_mismatches(
    problem: &dyn Problem,
    parameters: &Parameters,
    m: usize,
    tolerance: f64,
) -> Vec<Mismatch> {
    let x = parameters.values();
    let mut found = Vec::new();
    for (k, name) in parameters.names().iter().enumerate() {
        let mut direction = vec![0.0; x.len()];
        direction[k] = 1.0;
        let mut second = Vec::new();
        if !problem.second_derivative(x, &direction, &mut second) {
            return found;
        }
        second.resize(m, f64::NAN);
        let slope = |step: f64| {
            let mut moved = x.to_vec();
            moved[k] += step;
            of_shape(problem.linearize(&moved, &[k], &mut Vec::new()), m, 1)
        };
        let h = STEP * x[k].abs().max(1.0);
        let (above, below) = (slope(h), slope(-h));
        let difference = |row: usize| (above[(row, 0)] - below[(row, 0)]) / (2.0 * h);
        // Rounding of the Jacobian over the step, beside the size of the second derivatives.
        let slopes = (0..m).map(|row| above[(row, 0)].abs()).fold(0.0, f64::max);
        let bends = (0..m).map(|row| difference(row).abs()).fold(0.0, f64::max);
        let room = tolerance * bends + ROUNDING * slopes / h;
        for (row, &derivative) in second.iter().enumerate() {
            let difference = difference(row);
            let agree = (derivative - difference).abs() <= room;
            // Where the difference is not finite there is nothing to compare with.
            if !agree && (difference.is_finite() || !derivative.is_finite()) {
                found.push(Mismatch {
                    row,
                    parameter: name.clone(),
                    order: 2,
                    derivative,
                    difference,
                });
            }
        }
    }
    found
}
