//! Noise of a recording at rest.

use calib::document::to_json;
use calib::intervals::Span;
use calib::noise::{AtRest, NoiseSummary, RecordingCurves};

use findings::{Finding, Front, Kind};

use crate::request::backwards;
use crate::{Error, ErrorKind, Recording};

/// Allan deviations and noise terms of the sensors, as the file of `allan -o` has them.
#[derive(Clone, Debug)]
pub struct Noise(NoiseSummary);

impl Noise {
    /// The file that `allan -o` writes.
    ///
    /// # Errors
    /// A number that JSON cannot hold: a bug of ours.
    ///
    /// # Examples
    /// ```
    /// # let spec = "seed = 1\nrate = 50.0\n[motion.still]\nduration = 120.0\n";
    /// # let noise = stillpoint::allan(&stillpoint::simulate(spec, None)?.recording, None)?;
    /// assert!(noise.to_json()?.contains("\"schema\""));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(to_json(&self.0)?)
    }

    /// Returns the warnings for the user, one sentence each: terms that the recording is too short for, missing
    /// samples.
    ///
    /// # Examples
    /// ```
    /// # let spec = "seed = 1\nrate = 50.0\n[motion.still]\nduration = 120.0\n";
    /// # let noise = stillpoint::allan(&stillpoint::simulate(spec, None)?.recording, None)?;
    /// for warning in noise.warnings() {
    ///     println!("{warning}");
    /// }
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn warnings(&self) -> Vec<String> {
        self.0.warnings.texts(Front::Rust)
    }
}

impl AsRef<NoiseSummary> for Noise {
    fn as_ref(&self) -> &NoiseSummary {
        &self.0
    }
}

/// Overlapping Allan deviation σ(τ) of each axis, m/s² and rad/s over s, and the five noise terms with their intervals.
/// `rest` is the stretch to analyse, begin and end in s; without it all of the recording, or the longest static interval
/// where the device moved, which a warning says.
///
/// # Errors
/// [`ErrorKind::NotEnoughInformation`] where the device moved and was never at rest for a minute, and for too few samples.
///
/// # Examples
/// ```
/// let spec = "seed = 1\nrate = 50.0\n[motion.still]\nduration = 120.0\n";
/// let recording = stillpoint::simulate(spec, None)?.recording;
/// let noise = stillpoint::allan(&recording, None)?;
/// let gyroscope = noise.as_ref().gyroscope.as_ref().unwrap();
/// assert_eq!(gyroscope.axes[0].curve[0].tau, 0.02);
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn allan(recording: &Recording, rest: Option<(f64, f64)>) -> Result<Noise, Error> {
    let curves = |within| RecordingCurves::of(recording.as_ref(), within);
    let noise = |curves: &RecordingCurves| Ok(Noise(NoiseSummary::of(curves)?));
    if let Some((from, to)) = rest {
        if from >= to || from.is_nan() || to.is_nan() {
            return Err(Error::usage(backwards(from, to).detail("key", "rest")));
        }
        return noise(&curves(Some(Span { from, to })));
    }
    let all = curves(None);
    match all.stillness.at_rest() {
        AtRest::Throughout => noise(&all),
        AtRest::For(rest) => {
            let mut found = noise(&curves(Some(rest)))?;
            let said = Finding::of(Kind::ONLY_REST_ANALYSED).between(rest.from, rest.to);
            found.0.warnings.push_first(said);
            Ok(found)
        }
        AtRest::TooShort(longest) => {
            let length = longest.map_or(0.0, |rest| rest.length());
            let found = Finding::of(Kind::NEVER_AT_REST).number("length", length, "s");
            Err(Error::of(ErrorKind::NotEnoughInformation, found))
        }
    }
}
