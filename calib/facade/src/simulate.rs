//! Recordings with known truth.

use calib::document::to_json;
use calib::simulate::{OwnEffects, Simulation, Spec, Truth};

use crate::{Catalogue, Error, ErrorKind, Recording, Watch};

/// A simulated recording and the truth behind it.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// Simulated recording.
    pub recording: Recording,
    /// True parameters and settings behind the recording.
    pub truth: Truth,
}

impl Simulated {
    /// The truth as the file `truth.json` has it.
    ///
    /// # Errors
    /// A number that JSON cannot hold: a bug of ours.
    ///
    /// # Examples
    /// ```
    /// let spec = "seed = 1\n[motion.still]\nduration = 2.0\n[parameters]\n\"gyro.b_z\" = 0.002\n";
    /// let simulated = stillpoint::simulate(spec, None)?;
    /// assert_eq!(simulated.truth.get("gyro.b_z"), Some(0.002)); // rad/s
    /// assert!(simulated.truth_json()?.contains("gyro.b_z"));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
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
    simulate_with(spec, &Catalogue::default(), watch)
}

/// [`simulate`] where `[effects.NAME]` of the specification may name effects of one's own, so that the truth is known
/// behind what an estimate says of them.
///
/// # Errors
/// As [`simulate`].
///
/// # Examples
/// ```
/// use std::sync::Arc;
/// use stillpoint::effect::{Effect, Kinematics, Param, Scalar, Sensor, Vector3, params};
/// use stillpoint::{Catalogue, simulate_with};
///
/// /// Specific force along x leaks into every axis of the rate: `W_i += k_i f_x`.
/// struct Tug;
/// impl Effect for Tug {
///     const NAME: &'static str = "gyro_tug";
///     const SENSOR: Sensor = Sensor::Gyroscope;
///     const EQUATION: &'static str = "W_i += k_i f_x";
///     const PARAMS: &'static [Param] = &params("rad/s/(m/s^2)", ["x", "y", "z"]);
///     const TYPICAL: f64 = 1e-4;
///     fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
///         Vector3::new(p[0], p[1], p[2]) * truth.specific_force.x
///     }
/// }
///
/// let catalogue = Catalogue::default().with(Arc::new(Tug))?;
/// let spec = "seed = 1\n[motion.still]\nduration = 2.0\n[effects.gyro_tug]\nx = 2e-4\n";
/// let simulated = simulate_with(spec, &catalogue, None)?;
/// assert_eq!(simulated.truth.get("gyro_tug.x"), Some(2e-4));
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn simulate_with(
    spec: &str,
    catalogue: &Catalogue,
    watch: Option<&Watch>,
) -> Result<Simulated, Error> {
    let usage = |error: Error| match error.kind {
        ErrorKind::Cancelled => error,
        _ => Error {
            kind: ErrorKind::Usage,
            ..error
        },
    };
    let own = OwnEffects::new(catalogue.own());
    let spec = Spec::from_toml_with(spec, "spec", own).map_err(|error| usage(error.into()))?;
    let watch = Watch::of_call(watch);
    let run = Simulation::new(&spec).and_then(|simulation| simulation.run_under(&watch));
    let session = run.map_err(|error| usage(error.into()))?;
    Ok(Simulated {
        recording: session.recording.into(),
        truth: session.truth,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SWIRL: &str = r#"
[[definitions]]
name = "gyro_swirl"
sensor = "gyroscope"
x = "k * fz * fz"
parameters = [{ name = "k", unit = "rad/s/(m/s^2)^2", typical = 5e-6 }]
"#;
    const SPEC: &str = "seed = 1\n[motion.still]\nduration = 2.0\n[effects.gyro_swirl]\nk = 1e-5\n";

    /// The same formula gives the same bits, whichever way it is told.
    #[test]
    fn an_effect_of_the_catalogue_is_simulated_as_one_of_the_spec() {
        let catalogue = Catalogue::default().with_definitions(SWIRL).unwrap();
        let ours = simulate_with(SPEC, &catalogue, None).unwrap();
        let theirs = simulate(&format!("{SPEC}{SWIRL}"), None).unwrap();
        assert_eq!(ours.recording.to_csv(), theirs.recording.to_csv());
        assert_eq!(ours.truth.get("gyro_swirl.k"), Some(1e-5));
        let plain = simulate(&SPEC[..SPEC.find("[effects").unwrap()], None).unwrap();
        assert_ne!(ours.recording.to_csv(), plain.recording.to_csv());
    }

    #[test]
    fn a_name_that_is_in_the_spec_and_in_the_catalogue_is_refused() {
        let catalogue = Catalogue::default().with_definitions(SWIRL).unwrap();
        let error = simulate_with(&format!("{SPEC}{SWIRL}"), &catalogue, None).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Usage);
        assert!(
            error.message.contains("`gyro_swirl` is another effect"),
            "{error}"
        );
        let unknown = simulate(SPEC, None).unwrap_err();
        assert!(
            unknown.message.contains("there is no such effect"),
            "{unknown}"
        );
    }
}
