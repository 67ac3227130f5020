//! Search for effects that the base models lack.

use findings::{Finding, Front, Kind};
use std::sync::Arc;

use calib::discover::{EffectFinding, Verdict, discover as look, validate};
use calib::document::to_json;
use calib::limits::built_in;

use crate::{Calibration, Error, Recording, Request};

/// Settings that mean nothing to a search.
const IGNORED: [&str; 9] = [
    "method",
    "effects",
    "sections",
    "gyro_recordings",
    "nominal_rate",
    "frame",
    "integrator",
    "gyro_bias",
    "field",
];

/// Result of an effect search, with the content of `findings.json`.
#[derive(Clone, Debug)]
pub struct Discovery(Arc<calib::discover::Discovery>);

impl Discovery {
    /// Returns the verdict: nothing missing, named effects, an unexplained disagreement, or both.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let findings = stillpoint::discover(&[recording], &stillpoint::Request::default())?;
    /// assert_eq!(findings.verdict(), stillpoint::SearchVerdict::Nothing); // its device lacks nothing
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn verdict(&self) -> Verdict {
        self.0.findings.verdict
    }

    /// The effects that were missing, most evident first.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let findings = stillpoint::discover(&[recording], &stillpoint::Request::default())?;
    /// for effect in findings.effects() {
    ///     println!("{}: the gap falls from {} to {}", effect.name, effect.gap_before, effect.gap_after);
    /// }
    /// # assert!(findings.effects().is_empty());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn effects(&self) -> &[EffectFinding] {
        &self.0.findings.effects
    }

    /// The calibration with what was named.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let findings = stillpoint::discover(&[recording], &stillpoint::Request::default())?;
    /// assert_eq!(findings.calibration().parameters().len(), 24); // nothing was named
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn calibration(&self) -> Calibration {
        Calibration::of(self.0.findings.calibration.clone())
    }

    /// Returns the warnings of the final calibration for the user, one sentence each.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let findings = stillpoint::discover(&[recording], &stillpoint::Request::default())?;
    /// for warning in findings.warnings() {
    ///     println!("{warning}");
    /// }
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn warnings(&self) -> Vec<String> {
        self.0.findings.calibration.warnings.texts(Front::Rust)
    }

    /// The file that `discover -o` writes, to the byte.
    ///
    /// # Errors
    /// A number that JSON cannot hold: a bug of ours.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let findings = stillpoint::discover(&[recording], &stillpoint::Request::default())?;
    /// assert!(findings.to_json()?.contains("\"verdict\": \"none\""));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(to_json(&self.0.findings)?)
    }
}

impl AsRef<calib::discover::Discovery> for Discovery {
    fn as_ref(&self) -> &calib::discover::Discovery {
        &self.0
    }
}

/// Finds what the base models lack: fits them, looks where the recordings disagree, names the missing effect, adds it and
/// measures the gap before and after. A gap is the root of the reduced χ² of what remains: 1 is explained to the noise.
///
/// # Errors
/// As [`calibrate`](crate::calibrate); a validation recording that the fit has seen.
///
/// # Examples
/// ```
/// use stillpoint::{Request, SearchVerdict, discover, simulate};
///
/// let spec = "seed = 3\nrate = 50.0\n[motion.hand_held]\nplacements = 16\n[effects.gyro_g_sensitivity]\nsize = 1.0\n";
/// let recording = simulate(spec, None)?.recording;
/// let findings = discover(&[recording], &Request { gravity: Some(9.80665), ..Request::default() })?;
/// assert_eq!(findings.verdict(), SearchVerdict::Named);
/// assert_eq!(findings.effects()[0].name, "gyro_g_sensitivity");
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn discover(recordings: &[Recording], request: &Request) -> Result<Discovery, Error> {
    if recordings.is_empty() {
        return Err(Error::usage(Finding::of(Kind::RECORDINGS_MISSING)));
    }
    request.refuse("search", &IGNORED)?;
    let how = request.for_discovery(recordings.len())?;
    let recordings: Vec<Recording> = recordings.iter().map(Recording::at_hand_speed).collect();
    let all: Vec<&calib::Recording> = recordings.iter().map(AsRef::as_ref).collect();
    let validation = request.validation.as_ref().map(AsRef::as_ref);
    if let Some(validation) = validation {
        refuse_seen(validation, &all)?;
    }
    let discovery = how.watch.over(|| {
        let mut discovery = look(&all, &how)?;
        if let Some(validation) = validation {
            let validated = validate(validation, &how, &discovery)?;
            discovery.findings.validation = validated.gaps;
            discovery.findings.confirmations = validated.confirmations;
            let warnings = &mut discovery.findings.calibration.warnings;
            warnings.extend(validated.doubts);
        }
        let calibration = &mut discovery.findings.calibration;
        calibration.state_limits(built_in(calibration));
        Ok(discovery)
    })?;
    Ok(Discovery(Arc::new(discovery)))
}

/// Refuses a validation recording with the samples of one of `recordings`, whatever its stamps.
fn refuse_seen(
    validation: &calib::Recording,
    recordings: &[&calib::Recording],
) -> Result<(), Error> {
    let own = [&validation.accelerometer, &validation.gyroscope];
    let same = |recording: &&&calib::Recording| {
        let others = [&recording.accelerometer, &recording.gyroscope];
        own.iter().zip(others).any(|pair| match pair {
            (Some(one), Some(other)) => one.values == other.values,
            _ => false,
        })
    };
    match recordings.iter().find(same) {
        Some(seen) => Err(Error::usage(
            Finding::of(Kind::VALIDATION_SEEN).detail("other", seen.name.clone()),
        )),
        None => Ok(()),
    }
}
