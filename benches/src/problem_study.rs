//! The default on published collections that it was not tuned on.

use serde::Serialize;
use solver::{Error, Options, Report, solve};
use stillpoint_tests::problems::{self, Case};

/// First-order optimality asked of a solution.
pub const OPTIMALITY: f64 = 1e-8;

/// Relative difference from the best known value allowed, absolute where that is zero.
pub const VALUE: f64 = 1e-6;

/// Constraint violation allowed.
pub const FEASIBILITY: f64 = 1e-9;

/// One fit.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// `unconstrained`, `bounded` or `linear`.
    pub group: String,
    /// Name of the problem.
    pub problem: String,
    /// Sum of squares found.
    pub sum_of_squares: f64,
    /// First-order optimality, see [`Case::optimality`].
    pub optimality: f64,
    /// Residuals evaluated alone.
    pub residuals: usize,
    /// Jacobians evaluated.
    pub jacobians: usize,
    /// Second derivatives evaluated, each along one direction.
    pub second_derivatives: usize,
    /// Why it stopped.
    pub reason: String,
    /// A known minimum, to [`VALUE`], at a first-order point, to [`OPTIMALITY`].
    pub solved: bool,
}

/// Every group with its name.
pub fn groups() -> [(&'static str, Vec<Case>); 3] {
    [
        ("unconstrained", problems::unconstrained()),
        ("bounded", problems::bounded()),
        ("linear", problems::linearly_constrained()),
    ]
}

/// Solves every problem of every group with the default options.
pub fn run() -> Vec<Outcome> {
    let groups = groups();
    let cases = groups
        .iter()
        .flat_map(|(group, cases)| cases.iter().map(move |case| (*group, case)));
    cases.map(|(group, case)| outcome(group, case)).collect()
}

/// Solves one problem by default from its start, moved into the constraints if it is outside.
///
/// # Errors
/// Those of [`solve`].
pub fn fit(case: &Case) -> Result<Report, Error> {
    let options = Options {
        constraints: case.constraints(),
        ..Options::default()
    };
    let mut start = case.parameters(1.0);
    options.constraints.project(&mut start, &case.mask())?;
    solve(&*case.problem, &start, &case.mask(), &options)
}

fn outcome(group: &str, case: &Case) -> Outcome {
    let (group, problem) = (group.to_owned(), case.name.clone());
    let report = match fit(case) {
        Ok(report) => report,
        Err(error) => {
            return Outcome {
                group,
                problem,
                sum_of_squares: f64::NAN,
                optimality: f64::NAN,
                residuals: 0,
                jacobians: 0,
                second_derivatives: 0,
                reason: error.to_string(),
                solved: false,
            };
        }
    };
    let sum_of_squares = 2.0 * report.cost;
    let optimality = if case.linear.is_empty() {
        case.optimality(report.parameters.values())
    } else {
        report.relative_offset * sum_of_squares.sqrt().min(1.0)
    };
    Outcome {
        group,
        problem,
        sum_of_squares,
        optimality,
        residuals: report.evaluations.residuals,
        jacobians: report.evaluations.jacobians,
        second_derivatives: report.evaluations.second_derivatives,
        reason: report.termination.to_string(),
        solved: case.is_minimum(sum_of_squares, VALUE)
            && optimality <= OPTIMALITY
            && report.infeasibility <= FEASIBILITY,
    }
}
