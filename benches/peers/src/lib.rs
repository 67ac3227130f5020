//! The crate levenberg-marquardt and this project's solver on the same residuals and Jacobians.
//!
//! | to … | see |
//! |---|---|
//! | compare times per problem | `src/bin/table.rs` |
//! | compare by criterion | `benches/per_iteration.rs` |
//! | count instructions, which repeat on a loaded machine | `instructions.py` |
//!
//! An iteration is the same for all: one Jacobian with everything done until the next one (the
//! factorisation, the damped solutions, the residuals of the steps tried). Its time is that of whole
//! fits, from the start to the result as the solver hands it over, divided by the Jacobians taken.

/// Where their files are: in the folder that `STILLPOINT_DATA` names.
#[path = "../../../tests/src/needed_data.rs"]
pub mod needed_data;

/// NIST's problems, as the tests of the workspace read them.
#[path = "../../../tests/src/problems/nist/mod.rs"]
pub mod nist;

/// The accelerometer fit, as the benches of the workspace have it.
#[path = "../../../tests/src/problems/accelerometer.rs"]
mod calibration;

mod peer;
mod problems;

pub use problems::{Named, accelerometer, all, regressions};

use std::hint::black_box;

use ::solver::{Damping, Mask, Options, Parameters, Problem, Variant, solve};

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// This project's solver, as it is.
    Default,
    /// The same without second derivatives.
    Plain,
    /// The crate levenberg-marquardt, as it is.
    Peer,
}

impl Solver {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Default, Self::Plain, Self::Peer];

    /// A short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Default => "stillpoint",
            Self::Plain => "stillpoint-without-geodesic",
            Self::Peer => "levenberg-marquardt",
        }
    }

    /// A whole fit; how many Jacobians it took.
    pub fn fit(self, problem: &dyn Problem, start: &Parameters) -> usize {
        let variant = match self {
            Self::Peer => return peer::fit(problem, start),
            Self::Default => Variant::default(),
            Self::Plain => Variant::LevenbergMarquardt {
                damping: Damping::DelayedGratification,
                geodesic: false,
            },
        };
        let options = Options {
            variant,
            ..Options::default()
        };
        let report = solve(problem, start, &Mask::all(start.len()), &options);
        black_box(report).map_or(1, |report| report.jacobian_evaluations)
    }
}
