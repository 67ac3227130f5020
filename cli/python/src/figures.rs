//! The figures of the command's reports.

use pyo3::prelude::*;
use stillpoint_cli::figures::{Figure, of_calibration, of_discovery};

use crate::error::bug;

/// Title and SVG of each figure.
pub type Figures = Vec<(String, String)>;

/// Returns the figures of a calibration computed here; empty for one that was read from a file.
pub fn calibration(py: Python<'_>, own: &stillpoint::Calibration) -> PyResult<Figures> {
    let Some((outcome, recordings)) = own.outcome() else {
        return Ok(Vec::new());
    };
    let drawn = py.detach(|| {
        let all: Vec<&calib::Recording> = recordings.iter().map(AsRef::as_ref).collect();
        of_calibration(&all, outcome)
    });
    Ok(pairs(drawn.map_err(|message| bug(py, &message))?))
}

/// Returns the figures of a discovery.
pub fn findings(py: Python<'_>, own: &stillpoint::Discovery) -> Figures {
    pairs(py.detach(|| of_discovery(own.as_ref())))
}

fn pairs(drawn: Vec<Figure>) -> Figures {
    drawn.into_iter().map(|f| (f.title, f.svg)).collect()
}
