//! Recordings with known truth.

use calib::document::to_json;
use calib::simulate::{Spec, Truth};

use crate::watch::under;
use crate::{Error, ErrorKind, Recording, Watch};

/// A simulated recording and the truth behind it.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// What the device recorded.
    pub recording: Recording,
    /// What an estimator is not told.
    pub truth: Truth,
}

impl Simulated {
    /// The truth as the file `truth.json` has it.
    ///
    /// # Errors
    /// A number that JSON cannot hold: a bug of ours.
    pub fn truth_json(&self) -> Result<String, Error> {
        Ok(to_json(&self.truth)?)
    }
}

/// Simulates the recording that a specification in TOML asks for, with known truth: `stillpoint simulate --example`
/// prints every key. The same specification gives the same bits.
///
/// # Errors
/// [`ErrorKind::Usage`] for a specification that contradicts itself, with its line, and for one too long for the memory.
///
/// # Examples
/// ```
/// use stillpoint::{Sensor, simulate};
///
/// let simulated = simulate("seed = 1\nrate = 100.0\n[motion.still]\nduration = 2.0\n", None)?;
/// assert_eq!(simulated.recording.rows(Sensor::Gyroscope), 201);
/// let error = simulate("seed = 1\nrat = 100.0\n", None).unwrap_err();
/// assert!(error.message.contains("rat"));
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn simulate(spec: &str, watch: Option<&Watch>) -> Result<Simulated, Error> {
    let usage = |error: Error| match error.kind {
        ErrorKind::Cancelled => error,
        _ => Error {
            kind: ErrorKind::Usage,
            ..error
        },
    };
    let spec = Spec::from_toml(spec, "spec").map_err(|error| usage(error.into()))?;
    let session = under(watch, || spec.run()).map_err(usage)?;
    Ok(Simulated {
        recording: session.recording.into(),
        truth: session.truth,
    })
}
