//! How a fit ended.

use solver::{Report, Termination};

/// How a fit ended.
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
