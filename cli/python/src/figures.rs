//! The figures of the command's reports.

use pyo3::prelude::*;
use stillpoint_cli::figures::{Figure, of_calibration, of_discovery};

use crate::error::bug;

/// Title and SVG of each figure.
pub type Figures = Vec<(String, String)>;

/// Of a calibration that was made here; none of one that was read.
pub fn calibration(py: Python<'_>, own: &stillpoint::Calibration) -> PyResult<Figures> {
    let Some((outcome, recordings)) = own.outcome() else {
        return Ok(Vec::new());
    };
    let drawn = py.detach(|| {
        let all: Vec<&calib::Recording> = recordings.iter().map(AsRef::as_ref).collect();
        of_calibration(&all, outcome)
    });
    pairs(py, drawn)
}

/// Of a discovery.
pub fn findings(py: Python<'_>, own: &stillpoint::Findings) -> PyResult<Figures> {
    pairs(py, py.detach(|| of_discovery(own.as_ref())))
}

fn pairs(py: Python<'_>, drawn: Result<Vec<Figure>, String>) -> PyResult<Figures> {
    let drawn = drawn.map_err(|message| bug(py, &message))?;
    Ok(drawn.into_iter().map(|f| (f.title, f.svg)).collect())
}
