//! Every variant on NIST's nonlinear regression problems.

use serde::Serialize;
use solver::{Mask, Options, Variant, solve};
use stillpoint_tests::problems::nist::Regression;

/// Digits at which runs are counted.
pub const LEVELS: [f64; 5] = [4.0, 6.0, 8.0, 9.0, 10.0];

/// One fit.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// Name of the problem.
    pub problem: String,
    /// Start 1 or 2, 3 for the certified values.
    pub start: usize,
    /// Log relative error: digits agreed with the certified value in the worst parameter.
    pub lre: f64,
    /// Steps tried.
    pub steps: usize,
    /// Residuals evaluated alone.
    pub residuals: usize,
    /// Jacobians evaluated.
    pub jacobians: usize,
    /// Second directional derivatives evaluated.
    pub second_derivatives: usize,
    /// Why it stopped.
    pub reason: String,
}

/// All fits of one variant.
#[derive(Clone, Debug, Serialize)]
pub struct VariantRuns {
    /// Name of the variant.
    pub variant: String,
    /// Its fits.
    pub runs: Vec<Run>,
}

impl VariantRuns {
    /// Runs from starts 1 and 2 with at least each of [`LEVELS`] digits.
    pub fn counts(&self) -> [usize; 5] {
        LEVELS.map(|level| self.published().filter(|run| run.lre >= level).count())
    }

    /// Jacobians of the runs from starts 1 and 2.
    pub fn jacobians(&self) -> usize {
        self.published().map(|run| run.jacobians).sum()
    }

    /// Residuals alone, and second derivatives, of the runs from starts 1 and 2.
    pub fn other_evaluations(&self) -> [usize; 2] {
        let sum = |f: fn(&Run) -> usize| self.published().map(f).sum();
        [sum(|run| run.residuals), sum(|run| run.second_derivatives)]
    }

    /// Runs from the published starts.
    pub fn published(&self) -> impl Iterator<Item = &Run> {
        self.runs.iter().filter(|run| run.start < 3)
    }
}

/// Fits every problem from every start with `variant`, all else by default.
pub fn run(problems: &[Regression], variant: Variant) -> VariantRuns {
    let options = Options {
        variant,
        ..Options::default()
    };
    let starts = problems
        .iter()
        .flat_map(|p| [1, 2, 3].map(|start| (p, start)));
    VariantRuns {
        variant: variant.name(),
        runs: starts.map(|(p, start)| fit(p, start, &options)).collect(),
    }
}

fn fit(problem: &Regression, number: usize, options: &Options) -> Run {
    let start = problem.start(number);
    let name = problem.data.name.clone();
    match solve(problem, &start, &Mask::all(start.len()), options) {
        Ok(report) => Run {
            problem: name,
            start: number,
            lre: problem.digits(report.parameters.values()),
            steps: report.iterations.len(),
            residuals: report.evaluations.residuals,
            jacobians: report.evaluations.jacobians,
            second_derivatives: report.evaluations.second_derivatives,
            reason: report.termination.to_string(),
        },
        Err(error) => Run {
            problem: name,
            start: number,
            lre: 0.0,
            steps: 0,
            residuals: 0,
            jacobians: 0,
            second_derivatives: 0,
            reason: error.to_string(),
        },
    }
}
