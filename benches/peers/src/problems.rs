//! NIST from start 1 or 2, and the accelerometer fit of nine parameters.

use std::path::{Path, PathBuf};

use solver::{Parameters, Problem};

use crate::calibration::{Accelerometer, placements};
use crate::nist::Regression;

/// A problem with its start.
pub struct Named {
    /// Its name.
    pub name: String,
    /// Its residuals.
    pub problem: Box<dyn Problem>,
    /// Where the fit starts.
    pub start: Parameters,
}

/// The means to a hundredth, as a person would note them: they lie on no sphere exactly.
fn rounded() -> Vec<[f64; 3]> {
    let round = |m: [f64; 3]| m.map(|v| (v * 100.0).round() / 100.0);
    placements().into_iter().map(round).collect()
}

/// The accelerometer fit.
pub fn accelerometer() -> Named {
    Named {
        name: "accelerometer".into(),
        problem: Box::new(Accelerometer(rounded())),
        start: Parameters::unnamed(&[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    }
}

/// NIST's problems from a start, 1 or 2; none, with a message, where the files are missing.
pub fn regressions(start: usize) -> Vec<Named> {
    let folder = folder();
    let found = Regression::all(&folder).unwrap_or_else(|error| {
        eprintln!("NIST's problems are skipped: {error}");
        Vec::new()
    });
    let named = |p: Regression| Named {
        name: p.data.name.clone(),
        start: p.start(start),
        problem: Box::new(p),
    };
    found.into_iter().map(named).collect()
}

/// The accelerometer fit, and NIST from a start.
pub fn all(start: usize) -> Vec<Named> {
    let mut all = vec![accelerometer()];
    all.extend(regressions(start));
    all
}

/// `nist` in the folder that `STILLPOINT_DATA` names, by default `shared/data` beside the workspace.
fn folder() -> PathBuf {
    let data = std::env::var_os("STILLPOINT_DATA").map(PathBuf::from);
    data.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"))
        .join("nist")
}
