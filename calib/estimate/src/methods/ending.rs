//! Ending of a fit.

use solver::{Report, Termination};

/// Ending of a fit: the reason and the number of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ending {
    /// Why.
    pub termination: Termination,
    /// Steps of the last run.
    pub steps: usize,
}

impl From<&Report> for Ending {
    fn from(report: &Report) -> Self {
        Self {
            termination: report.termination,
            steps: report.iterations.len(),
        }
    }
}
