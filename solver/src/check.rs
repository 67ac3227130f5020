//! Are the derivatives those of the residuals?

use serde::{Deserialize, Serialize};

use crate::closure::central_differences;
use crate::parameters::Parameters;
use crate::residual::{Problem, of_shape};

/// A derivative that differs from the central difference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mismatch {
    /// Row of the residual.
    pub row: usize,
    /// Name of the parameter.
    pub parameter: String,
    /// What the problem says.
    pub derivative: f64,
    /// The central difference.
    pub difference: f64,
}

/// Compares the problem's Jacobian at `parameters` with central differences and returns the entries
/// that differ by more than `tolerance` relative to the largest entry of their column; 1e-6 suits
/// smooth residuals of ordinary size. Entries that are not finite are always returned, and all of
/// a matrix that has not the shape `m × n`.
///
/// ```
/// # use stillpoint_solver as solver;
/// use solver::{Parameters, Residual, Scalar, check_derivatives};
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
    let mut found = Vec::new();
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
                    derivative,
                    difference,
                });
            }
        }
    }
    found
}
