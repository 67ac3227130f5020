//! NIST from start 2, and the accelerometer fit of nine parameters.

use std::path::{Path, PathBuf};

use solver::{Parameters, Problem, Residual, Scalar, lit};

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

/// `‖T (m − b)‖ − g`: nine parameters from the means of static intervals.
struct Accelerometer(Vec<[f64; 3]>);

impl<D: Scalar> Residual<D> for Accelerometer {
    fn residuals(&self, x: &[D], out: &mut Vec<D>) {
        for m in &self.0 {
            let [a, b, c] = [0, 1, 2].map(|k| -x[6 + k] + m[k]);
            let f = [
                x[0] * a + x[3] * b + x[4] * c,
                x[1] * b + x[5] * c,
                x[2] * c,
            ];
            out.push((f[0] * f[0] + f[1] * f[1] + f[2] * f[2]).sqrt() - lit::<D>(9.79));
        }
    }
}

/// Means of 23 placements on a spiral over the sphere, distorted and rounded.
fn placements() -> Vec<[f64; 3]> {
    let place = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / 23.0;
        let (angle, radius) = (2.4 * i as f64, (1.0 - z * z).sqrt());
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let distort = |u: [f64; 3]| [9.8 * u[0] + 0.04, 9.79 * u[1] + 0.004, 9.81 * u[2] - 0.02];
    let round = |m: [f64; 3]| m.map(|v| (v * 100.0).round() / 100.0);
    (0..23).map(place).map(distort).map(round).collect()
}

/// The accelerometer fit.
pub fn accelerometer() -> Named {
    Named {
        name: "accelerometer".into(),
        problem: Box::new(Accelerometer(placements())),
        start: Parameters::unnamed(&[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    }
}

/// NIST's problems from start 2; none, with a message, where the files are missing.
pub fn regressions() -> Vec<Named> {
    let folder = folder();
    let found = Regression::all(&folder).unwrap_or_else(|error| {
        eprintln!("NIST's problems are skipped: {error}");
        Vec::new()
    });
    let named = |p: Regression| Named {
        name: p.data.name.clone(),
        start: p.start(2),
        problem: Box::new(p),
    };
    found.into_iter().map(named).collect()
}

/// The accelerometer fit, and NIST.
pub fn all() -> Vec<Named> {
    let mut all = vec![accelerometer()];
    all.extend(regressions());
    all
}

/// `nist` in the folder that `STILLPOINT_DATA` names, by default `shared/data` beside the workspace.
fn folder() -> PathBuf {
    let data = std::env::var_os("STILLPOINT_DATA").map(PathBuf::from);
    data.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"))
        .join("nist")
}
