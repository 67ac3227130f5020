//! Calibrations and findings.

use std::path::PathBuf;

use numpy::{PyReadonlyArray2, PyReadwriteArray2};
use pyo3::prelude::*;

use crate::arrays::{rows, rows_to_fill};
use crate::error::exception;
use crate::figures::{self, Figures};
use crate::options::catalogue;
use crate::progress::watched;
use crate::recording::{Recording, sensor};

/// A calibration of one device.
#[pyclass(frozen, module = "stillpoint._native")]
#[derive(Clone, Debug)]
pub struct Calibration(pub stillpoint::Calibration);

/// Name, value, standard error and unit of a parameter.
type Parameter = (String, f64, Option<f64>, String);

#[pymethods]
impl Calibration {
    /// From the text of a file; effects of one's own are defined in `effect_files`.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str, effect_files: Vec<PathBuf>) -> PyResult<Self> {
        let own = catalogue(py, &effect_files)?;
        let read = stillpoint::Calibration::from_json(text, &own);
        read.map(Self).map_err(|error| exception(py, &error))
    }

    /// From a file.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, effect_files: Vec<PathBuf>) -> PyResult<Self> {
        let own = catalogue(py, &effect_files)?;
        let read = stillpoint::Calibration::load(path, &own);
        read.map(Self).map_err(|error| exception(py, &error))
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        self.0.to_json().map_err(|error| exception(py, &error))
    }

    fn parameters(&self) -> Vec<Parameter> {
        let parameters = self.0.parameters().into_iter();
        parameters
            .map(|p| (p.name, p.value, p.std, p.unit))
            .collect()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings()
    }

    #[getter]
    fn failed_gates(&self) -> Vec<String> {
        self.0.failed_gates()
    }

    #[getter]
    fn is_base_only(&self) -> bool {
        self.0.is_base_only()
    }

    /// Corrects `raw` into `corrected` without a copy between; for calibrations without effects.
    fn correct(
        &self,
        py: Python<'_>,
        of: &str,
        raw: PyReadonlyArray2<'_, f64>,
        mut corrected: PyReadwriteArray2<'_, f64>,
    ) -> PyResult<()> {
        let of = sensor(py, of)?;
        let (from, to) = (rows(&raw, "raw")?, rows_to_fill(&mut corrected, "out")?);
        let done = py.detach(|| self.0.correct(of, from, to));
        done.map_err(|error| exception(py, &error))
    }

    /// Corrects samples one by one, effects included.
    fn corrector(&self, py: Python<'_>) -> PyResult<Corrector> {
        let own = stillpoint::Corrector::of(&self.0);
        own.map(Corrector).map_err(|error| exception(py, &error))
    }

    /// The corrected recording.
    fn apply(&self, py: Python<'_>, recording: &Recording) -> PyResult<Recording> {
        let (own, raw) = (self.0.clone(), recording.0.clone());
        watched(py, None, move |watch| {
            stillpoint::apply_watched(&own, &raw, Some(&watch))
        })
        .map(Recording)
    }

    fn figures(&self, py: Python<'_>) -> PyResult<Figures> {
        figures::calibration(py, &self.0)
    }
}

/// Corrects samples one by one.
#[pyclass(module = "stillpoint._native")]
#[derive(Clone, Debug)]
pub struct Corrector(pub stillpoint::Corrector);

#[pymethods]
impl Corrector {
    /// Specific force and angular rate behind one sample.
    fn correct(
        &mut self,
        t: f64,
        accel: [f64; 3],
        gyro: [f64; 3],
        temperature: Option<f64>,
    ) -> ([f64; 3], [f64; 3]) {
        self.0.correct(t, accel, gyro, temperature)
    }
}

/// Result of an effect search.
#[pyclass(frozen, module = "stillpoint._native")]
#[derive(Clone, Debug)]
pub struct Findings(pub stillpoint::Discovery);

#[pymethods]
impl Findings {
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        self.0.to_json().map_err(|error| exception(py, &error))
    }

    #[getter]
    fn verdict(&self) -> &'static str {
        self.0.verdict().name()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings()
    }

    #[getter]
    fn calibration(&self) -> Calibration {
        Calibration(self.0.calibration())
    }

    fn figures(&self, py: Python<'_>) -> Figures {
        figures::findings(py, &self.0)
    }
}
