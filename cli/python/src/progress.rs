//! Work that lets the interpreter run on, tells of its steps, and ends on Ctrl-C.

use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use stillpoint::{Error, Watch};

use crate::error::exception;

/// Runs `work` and returns its result. Its watch checks for signals at every step and calls `told(stage, steps)`, if
/// given.
pub fn watched<T: Send>(
    py: Python<'_>,
    told: Option<Py<PyAny>>,
    work: impl FnOnce(Watch) -> Result<T, Error> + Send,
) -> PyResult<T> {
    let raised: Arc<Mutex<Option<PyErr>>> = Arc::default();
    let here = Arc::clone(&raised);
    let watch = Watch::new(move |progress| {
        let step = Python::attach(|py| {
            py.check_signals()?;
            match &told {
                Some(told) => told
                    .call1(py, (progress.stage.name(), progress.steps))
                    .map(|_| ()),
                None => Ok(()),
            }
        });
        match step {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                *here.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                ControlFlow::Break(())
            }
        }
    });
    let result = py.detach(|| work(watch));
    if let Some(error) = raised.lock().unwrap_or_else(PoisonError::into_inner).take() {
        return Err(error);
    }
    // A signal after the last step.
    py.check_signals()?;
    result.map_err(|error| exception(py, &error))
}
