//! Variants side by side on the same problems and starts.

mod graphs;
mod performance;
mod table;

pub use graphs::{compare_graphs, graph_variants};
pub use performance::Profile;
pub use table::{ComparedRun, Measure, Table};

use crate::clock::timed;
use crate::linear::vector::half_square;
use crate::options::{Options, Variant};
use crate::parameters::{Mask, Parameters};
use crate::residual::Problem;
use crate::solve::solve;

/// Knowledge of a problem that a comparison may use; the default knows nothing.
#[derive(Clone, Debug, Default)]
pub struct Comparison {
    /// Name of the problem.
    pub name: String,
    /// All options but the variant.
    pub options: Options,
    /// Free parameters; all of them if `None`.
    pub mask: Option<Mask>,
    /// The least cost known; the least that any run finds if `None`.
    pub best: Option<f64>,
    /// The solution known, to count digits by; those of the cost if `None`.
    pub solution: Option<Vec<f64>>,
}

/// Solves from every start with every variant.
///
/// ```
/// use stillpoint_solver::{DualNum, Jet, Measure, Parameters, Variant, compare, from_fn};
///
/// let decay = from_fn(|x: &[Jet], out: &mut Vec<Jet>| {
///     out.extend([(0.0, 2.0), (1.0, 1.2), (2.0, 0.7)].map(|(t, y)| x[0] * (-x[1] * t).exp() - y));
/// });
/// let starts = [[1.0, 1.0], [5.0, 0.1]].map(|x| Parameters::unnamed(&x));
/// let table = compare(&decay, &starts, &Variant::all());
/// println!("{table}");
/// assert_eq!(table.runs.len(), 20);
/// assert_eq!(table.successes("lm-nielsen"), 2);
/// let picture = table.performance_svg(Measure::Jacobians);
/// assert!(picture.starts_with("<svg"));
/// ```
pub fn compare(problem: &dyn Problem, starts: &[Parameters], variants: &[Variant]) -> Table {
    compare_with(&Comparison::default(), problem, starts, variants)
}

/// [`compare`] with a name, options, and what is known of the solution.
pub fn compare_with(
    comparison: &Comparison,
    problem: &dyn Problem,
    starts: &[Parameters],
    variants: &[Variant],
) -> Table {
    let mut runs = Vec::with_capacity(starts.len() * variants.len());
    for (number, start) in starts.iter().enumerate() {
        for &variant in variants {
            runs.push(run(comparison, problem, (number, start), variant));
        }
    }
    let finite = runs.iter().map(|run| run.cost).filter(|c| c.is_finite());
    let best = (comparison.best).unwrap_or_else(|| finite.fold(f64::INFINITY, f64::min));
    for run in &mut runs {
        run.judge(best);
    }
    Table { runs }
}

fn run(
    comparison: &Comparison,
    problem: &dyn Problem,
    (number, start): (usize, &Parameters),
    variant: Variant,
) -> ComparedRun {
    let options = Options {
        variant,
        ..comparison.options.clone()
    };
    let mask = comparison.mask.clone().unwrap_or(Mask::all(start.len()));
    let mut first = Vec::new();
    problem.values(start.values(), &mut first);
    let (outcome, seconds) = timed(|| solve(problem, start, &mask, &options));
    let mut found = ComparedRun {
        problem: comparison.name.clone(),
        start: number + 1,
        variant: variant.name(),
        success: false,
        converged: false,
        residuals: 0,
        jacobians: 0,
        second_derivatives: 0,
        seconds,
        cost: f64::INFINITY,
        first_cost: half_square(&first),
        digits: 0.0,
        reason: String::new(),
    };
    match outcome {
        Err(error) => found.reason = error.to_string(),
        Ok(report) => {
            found.converged = report.termination.converged();
            found.residuals = report.evaluations.residuals;
            found.jacobians = report.evaluations.jacobians;
            found.second_derivatives = report.evaluations.second_derivatives;
            found.cost = report.cost;
            found.reason = report.termination.to_string();
            if let Some(solution) = &comparison.solution {
                found.digits = digits(report.parameters.values(), solution);
            } else {
                found.digits = f64::NAN;
            }
        }
    }
    found
}

/// Digits agreed in the worst parameter, from 0 to 16.
fn digits(found: &[f64], known: &[f64]) -> f64 {
    let each = found.iter().zip(known).map(|(x, k)| {
        let apart = (x - k).abs();
        let relative = if *k == 0.0 { apart } else { apart / k.abs() };
        if relative.is_nan() {
            0.0
        } else {
            (-relative.log10()).clamp(0.0, 16.0)
        }
    });
    each.fold(16.0, f64::min)
}
