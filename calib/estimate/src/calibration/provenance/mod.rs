//! Where a calibration comes from, and whether it is as it was written.

mod inputs;
mod seal;

pub use seal::Edited;

pub use inputs::{
    Input, Options, Provenance, SIGN_CONVENTION, SensorInput, TemperatureInput, fingerprint,
};
