//! From arrays in memory to a calibration: `a = T (A − b)` of an accelerometer and a gyroscope, with standard errors.
//!
//! ```text
//! arrays · files ──► Recording ──► calibrate ──► Calibration ──► apply ──► Recording
//! simulate ────────►           ├─► discover ──► Discovery
//!                              └─► allan ──► Noise     evaluate ──► Evaluation
//! samples as they come ──► guided::Session ──► Instruction
//! ```
//!
//! ```
//! use stillpoint::{Recording, Request, calibrate, simulate};
//!
//! // Stamps in s, specific force in m/s², angular rate in rad/s, temperature in °C; one row per stamp.
//! let (t, accel, gyro, celsius) = stillpoint::example::session();
//! let recording = Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
//! let calibration = calibrate(&[recording.clone()], &Request::default())?;
//! for p in calibration.parameters() {
//!     println!("{} = {} ± {:?} {}", p.name, p.value, p.std, p.unit);
//! }
//! let corrected = stillpoint::apply(&calibration, &recording)?;
//! # assert_eq!(corrected.rows(stillpoint::Sensor::Gyroscope), gyro.len());
//! # Ok::<(), stillpoint::Error>(())
//! ```
//!
//! Results equal those of the command `stillpoint` to the last bit: both call the same functions, and
//! [`Calibration::to_json`] gives the bytes that `calibrate -o` writes. Units are SI everywhere. Nothing here panics on
//! data: what is wrong is an [`Error`] with its kind, its place and what to do. Long work tells its steps to a [`Watch`],
//! which may end it.
//!
//! Why the package is called `stillpoint-imu` and the library `stillpoint`: the package `stillpoint` is the command,
//! as `cargo install stillpoint` should give it.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod allan;
mod calibrate;
mod calibration;
mod catalogue;
mod corrector;
mod discover;
mod error;
mod evaluate;
pub mod example;
pub mod guided;
mod recording;
mod request;
mod simulate;

pub use allan::{Noise, allan};
pub use calib::Evaluation;
pub use calib::calibrate::{Frame, GyroBias, Outcome};
pub use calib::discover::{EffectFinding, Verdict as SearchVerdict};
pub use calib::intervals::DetectorOptions;
pub use calib::methods::joint::ClockMode;
pub use calib::recording::{
    AccelUnit, ColumnMap, FieldUnit, GyroUnit, ReadOptions, Rows, TimeUnit,
};
pub use calib::residuals::Integrator;
pub use calib::watch::{Progress, Stage, Watch};
pub use calibrate::calibrate;
pub use calibration::{Calibration, Parameter, apply, apply_watched};
pub use catalogue::Catalogue;
pub use corrector::Corrector;
pub use discover::{Discovery, discover};
pub use error::{Error, ErrorKind};
pub use evaluate::evaluate;
pub use recording::Recording;
pub use request::{Method, Request};
pub use sensor::{ScalarSensor, Sensor};
pub use simulate::{Simulated, simulate, simulate_with};

/// Findings of recordings and calibrations as data, and the verdict made of them.
pub mod finding {
    pub use findings::{
        Consequence, Detail, Finding, Findings, Front, Grade, Kind, Level, Number, OptionName,
        Place, Remedy, Setting, Step, Verdict,
    };
}

/// Items for writing a custom effect.
///
/// See [`Catalogue`] for an example from the equation to the corrected recording.
pub mod effect {
    pub use nalgebra::Vector3;
    pub use sensor::{
        AnyEffect, AnyScalarSensor, Effect, Kinematics, Nature, Param, Quantity,
        REFERENCE_TEMPERATURE, Role, Sensor, Since, mat3, off_diagonal, params,
    };
    pub use solver::{Scalar, lit};
}

/// The Rust block of the crate's README compiles and holds.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
