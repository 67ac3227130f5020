//! The functions.

use std::ffi::OsString;
use std::path::PathBuf;

use calib::document::to_json;
use pyo3::prelude::*;
use stillpoint::Request;

use crate::error::{bug, exception};
use crate::options::{Options, catalogue};
use crate::progress::watched;
use crate::recording::Recording;
use crate::results::{Calibration, Findings};

/// Calibrates; `progress(stage, steps)` is called at every step.
#[pyfunction]
pub fn calibrate(
    py: Python<'_>,
    recordings: Vec<PyRef<'_, Recording>>,
    options: Options<'_>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Calibration> {
    let request = options.request(py)?;
    let all: Vec<stillpoint::Recording> = recordings.iter().map(|r| r.0.clone()).collect();
    watched(py, progress, move |watch| {
        let request = Request {
            watch: Some(watch),
            ..request
        };
        stillpoint::calibrate(&all, &request)
    })
    .map(Calibration)
}

/// Finds what the base models lack.
#[pyfunction]
pub fn discover(
    py: Python<'_>,
    recordings: Vec<PyRef<'_, Recording>>,
    options: Options<'_>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Findings> {
    let request = options.request(py)?;
    let all: Vec<stillpoint::Recording> = recordings.iter().map(|r| r.0.clone()).collect();
    watched(py, progress, move |watch| {
        let request = Request {
            watch: Some(watch),
            ..request
        };
        stillpoint::discover(&all, &request)
    })
    .map(Findings)
}

/// Evaluates a recording, raw or with a calibration, and returns the residuals as a JSON document.
#[pyfunction]
pub fn evaluate(
    py: Python<'_>,
    recording: &Recording,
    calibration: Option<&Bound<'_, Calibration>>,
    options: Options<'_>,
) -> PyResult<String> {
    let request = options.request(py)?;
    let recording = recording.0.clone();
    let calibration = calibration.map(|calibration| calibration.get().0.clone());
    let found = watched(py, None, move |watch| {
        let request = Request {
            watch: Some(watch),
            ..request
        };
        stillpoint::evaluate(&recording, calibration.as_ref(), &request)
    })?;
    to_json(&found).map_err(|error| bug(py, &error.to_string()))
}

/// The noise of a recording at rest: a JSON document.
#[pyfunction]
pub fn allan(py: Python<'_>, recording: &Recording, rest: Option<(f64, f64)>) -> PyResult<String> {
    let found = py.detach(|| stillpoint::allan(&recording.0, rest)?.to_json());
    found.map_err(|error| exception(py, &error))
}

/// A simulated recording, and the truth as a JSON document.
#[pyfunction]
pub fn simulate(
    py: Python<'_>,
    spec: String,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Recording, String)> {
    let simulated = watched(py, progress, move |watch| {
        stillpoint::simulate(&spec, Some(&watch))
    })?;
    let truth = simulated.truth_json();
    let truth = truth.map_err(|error| exception(py, &error))?;
    Ok((Recording(simulated.recording), truth))
}

/// Names of all effects.
#[pyfunction]
pub fn effect_names(py: Python<'_>, effect_files: Vec<PathBuf>) -> PyResult<Vec<String>> {
    Ok(catalogue(py, &effect_files)?.names())
}

/// Runs the command; the process is its own from then on.
#[pyfunction]
pub fn run_command(py: Python<'_>, args: Vec<OsString>) -> u8 {
    py.detach(|| stillpoint_cli::run(args))
}

/// The version of the package.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
