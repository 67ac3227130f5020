//! Provenance of a calibration, and detection of later edits.

mod applied_before;
mod inputs;
mod seal;

pub use applied_before::{Readings, system_name};
pub use seal::Edited;

pub use inputs::{
    Input, Options, Provenance, SIGN_CONVENTION, SensorInput, TemperatureInput, fingerprint,
};
