//! Native module of the Python package: the facade with numpy arrays, and the command.
//!
//! Users import the package `stillpoint` in `../stillpoint`. It turns arguments into the plain values that these
//! functions take, and results into dictionaries, frames and pages. The functions here release the interpreter while
//! they work.

mod arrays;
mod error;
mod figures;
mod options;
mod progress;
mod recording;
mod results;
mod work;

use pyo3::prelude::*;

/// The compiled part of the package `stillpoint`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::recording::Recording;
    #[pymodule_export]
    use super::results::{Calibration, Corrector, Findings};
    #[pymodule_export]
    use super::work::{
        allan, calibrate, discover, effect_names, evaluate, run_command, simulate, version,
    };
}
