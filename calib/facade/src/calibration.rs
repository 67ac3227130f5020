//! The result, and what it makes of readings.

use findings::{Finding, Findings, Front, Kind, Verdict};
use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use calib::calibrate::Outcome;
use calib::calibration::{Triad, check_units, doubts, in_unit_of, load_with, read_calibration};
use calib::document::to_json;
use nalgebra::Vector3;
use output::{Existing, Output};
use sensor::{PLACES, Sensor, base_names};

use crate::{Catalogue, Error, Recording, Watch};

/// A parameter of a calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// `accel.s_x`, `gyro.b_z`, `gyro_g_sensitivity.xx`; a bias of one recording of several ends in ` in NAME`.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its standard error; `None` where it was held.
    pub std: Option<f64>,
    /// Its unit; empty without one.
    pub unit: String,
}

/// A calibration of one device: `a = T (A − b)` for each sensor, and effects on top.
#[derive(Clone, Debug)]
pub struct Calibration {
    inner: Arc<calib::Calibration>,
    made: Option<Arc<(Outcome, Vec<Recording>)>>,
}

impl Calibration {
    pub(crate) fn of(calibration: calib::Calibration) -> Self {
        Self {
            inner: Arc::new(calibration),
            made: None,
        }
    }

    pub(crate) fn made(outcome: Outcome, recordings: Vec<Recording>) -> Self {
        Self {
            inner: Arc::new(outcome.calibration.clone()),
            made: Some(Arc::new((outcome, recordings))),
        }
    }

    pub(crate) fn inner(&self) -> &calib::Calibration {
        &self.inner
    }

    /// Reads a calibration file; effects of one's own are found in `catalogue`.
    ///
    /// # Errors
    /// A file that cannot be read, is no calibration, or has an effect that nobody here knows.
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{Calibration, Catalogue};
    ///
    /// let error = Calibration::load("no_such.json", &Catalogue::default()).unwrap_err();
    /// assert_eq!(error.file.as_deref(), Some("no_such.json"));
    /// ```
    pub fn load(path: impl AsRef<Path>, catalogue: &Catalogue) -> Result<Self, Error> {
        let read = load_with(path.as_ref(), catalogue.own())?;
        Ok(Self::of(read.with_sensors(catalogue.sensors())?))
    }

    /// Reads the text of a calibration file.
    ///
    /// # Errors
    /// As [`Calibration::load`].
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{Calibration, Catalogue};
    ///
    /// let error = Calibration::from_json("{}", &Catalogue::default()).unwrap_err();
    /// assert!(error.message.contains("schema"));
    /// ```
    pub fn from_json(text: &str, catalogue: &Catalogue) -> Result<Self, Error> {
        let name = Path::new("calibration");
        let read = read_calibration(text, name, catalogue.own())?;
        Ok(Self::of(read.with_sensors(catalogue.sensors())?))
    }

    /// Writes cal.json, whole or not at all; a file that is there is replaced.
    ///
    /// # Errors
    /// A file that cannot be written.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// # let folder = tempfile::tempdir().unwrap();
    /// # let path = folder.path().join("cal.json");
    /// calibration.save(&path)?;
    /// let again = stillpoint::Calibration::load(&path, &stillpoint::Catalogue::default())?;
    /// assert_eq!(again.parameters(), calibration.parameters());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let claimed = Output::claim(path.as_ref(), Existing::Replace, &[])?;
        Ok(claimed.write(self.to_json()?.as_bytes())?)
    }

    /// The file that `calibrate -o` writes, to the byte.
    ///
    /// # Errors
    /// A number that JSON cannot hold: a bug of ours.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// let text = calibration.to_json()?;
    /// let again = stillpoint::Calibration::from_json(&text, &stillpoint::Catalogue::default())?;
    /// assert_eq!(again.parameters(), calibration.parameters());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(to_json(self.inner.as_ref())?)
    }

    /// Every parameter with its standard error: both base models, then effects, then sensors of one dimension.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// let names: Vec<String> = calibration.parameters().into_iter().map(|p| p.name).collect();
    /// assert_eq!(names.len(), 24);
    /// assert_eq!(names[23], "gyro.b_z");
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut all = Vec::new();
        for sensor in Sensor::ALL {
            if let Some(triad) = self.inner.triad(sensor) {
                push_triad(&mut all, sensor, triad);
            }
        }
        let effects = self.inner.effects.iter();
        let effects = effects.map(|own| (&own.name, &own.parameters));
        let scalars = self.inner.scalars.iter();
        let scalars = scalars.map(|own| (&own.name, &own.parameters));
        for (of, parameters) in effects.chain(scalars) {
            all.extend(parameters.iter().map(|p| Parameter {
                name: format!("{of}.{}", p.name),
                value: p.value,
                std: p.std,
                unit: p.unit.clone(),
            }));
        }
        all
    }

    /// Names of the parameters that were estimated together, and their covariance (`n × n`, by rows, in their units): those of the sensors
    /// and of effects. A sensor of one dimension has its own, in the file.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// let (names, covariance) = calibration.covariance();
    /// let k = names.iter().position(|name| name == "gyro.b_z").unwrap();
    /// let bias = calibration.parameters().into_iter().find(|p| p.name == "gyro.b_z").unwrap();
    /// assert!((covariance[k][k].sqrt() / bias.std.unwrap() - 1.0).abs() < 1e-9);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn covariance(&self) -> (&[String], &[Vec<f64>]) {
        (&self.inner.parameters, &self.inner.covariance)
    }

    /// `T` (3 × 3, by rows, no unit) and `b` (3, in the unit of the readings, m/s² or rad/s) of a sensor; `None` where it
    /// was not calibrated.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// use stillpoint::Sensor;
    ///
    /// let (t, b) = calibration.base(Sensor::Accelerometer).unwrap();
    /// assert_eq!(t[1][0], 0.0); // upper triangular: the sensor's x axis is the body's
    /// assert!(b.iter().all(|b| b.abs() < 1.0)); // m/s²
    /// assert!(calibration.base(Sensor::Magnetometer).is_none());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn base(&self, sensor: Sensor) -> Option<([[f64; 3]; 3], [f64; 3])> {
        let triad = self.inner.triad(sensor)?;
        Some((triad.t, triad.bias))
    }

    /// Returns true if every corrected reading is `T (raw − b)`, with no effect on top.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// assert!(calibration.is_base_only());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn is_base_only(&self) -> bool {
        self.inner.effects.is_empty()
    }

    /// Corrects readings of a sensor from one array into another (`n × 3`), without a copy between: `T (raw − b)`.
    ///
    /// # Errors
    /// [`ErrorKind::Usage`](crate::ErrorKind::Usage) for arrays of different lengths, for a sensor that was not calibrated
    /// and for a calibration with effects, which need [`apply`].
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{Recording, Request, Sensor, apply, calibrate};
    ///
    /// let (t, accel, gyro, _) = stillpoint::example::session();
    /// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// let calibration = calibrate(&[recording.clone()], &Request::default())?;
    /// let mut corrected = vec![[0.0; 3]; gyro.len()];
    /// calibration.correct(Sensor::Gyroscope, &gyro, &mut corrected)?;
    /// assert!(apply(&calibration, &recording)?.values(Sensor::Gyroscope).eq(corrected));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn correct(
        &self,
        sensor: Sensor,
        raw: &[[f64; 3]],
        corrected: &mut [[f64; 3]],
    ) -> Result<(), Error> {
        if raw.len() != corrected.len() {
            return Err(Error::usage(
                Finding::of(Kind::COUNT_OTHER)
                    .detail("key", "corrected")
                    .detail("found", format!("{} rows", corrected.len()))
                    .detail("expected", raw.len().to_string()),
            ));
        }
        let Some(triad) = self.inner.triad(sensor) else {
            let found = Finding::of(Kind::SENSOR_NOT_IN_CALIBRATION);
            return Err(Error::usage(found.of_sensor(sensor)));
        };
        if !self.is_base_only() {
            return Err(Error::usage(Finding::of(Kind::EFFECTS_LOOK_FURTHER)));
        }
        let base = triad.base();
        for (raw, corrected) in raw.iter().zip(corrected) {
            *corrected = base.correct(&Vector3::from(*raw)).into();
        }
        Ok(())
    }

    /// Returns the warnings for the user, one sentence each: the uncertain quantity, its uncertainty, and the advice.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// for warning in calibration.warnings() {
    ///     println!("{warning}");
    /// }
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn warnings(&self) -> Vec<String> {
        self.inner.warnings.texts(Front::Rust)
    }

    /// The verdict on it: good, with care or not to be used, with the reasons in order and what to do next.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// let verdict = calibration.verdict();
    /// assert_ne!(verdict.level, stillpoint::finding::Grade::Bad);
    /// assert!(!verdict.next.is_empty());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn verdict(&self) -> Verdict {
        self.inner.verdict()
    }

    /// Everything that was found, each with its kind, place, numbers and ways out.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// let assumed = |found: &stillpoint::finding::Finding| found.kind == stillpoint::finding::Kind::GRAVITY_ASSUMED;
    /// assert!(calibration.findings().iter().any(assumed));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn findings(&self) -> Findings {
        self.inner.findings()
    }

    /// Reasons not to use it as it stands, a sentence each; none where it is good.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// assert!(calibration.failed_gates().is_empty());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn failed_gates(&self) -> Vec<String> {
        self.inner.failed_gates.texts(Front::Rust)
    }

    /// The fits behind it and the recordings they were made on; `None` where it was read or solved in closed form.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// # let calibration = stillpoint::calibrate(&[recording], &stillpoint::Request::default())?;
    /// let (_, recordings) = calibration.outcome().unwrap();
    /// assert_eq!(recordings.len(), 1);
    /// let read = stillpoint::Calibration::from_json(&calibration.to_json()?, &Default::default())?;
    /// assert!(read.outcome().is_none());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn outcome(&self) -> Option<(&Outcome, &[Recording])> {
        self.made.as_ref().map(|made| (&made.0, made.1.as_slice()))
    }
}

impl AsRef<calib::Calibration> for Calibration {
    fn as_ref(&self) -> &calib::Calibration {
        &self.inner
    }
}

fn push_triad(all: &mut Vec<Parameter>, sensor: Sensor, triad: &Triad) {
    let unit = match (&triad.units, sensor) {
        (Some(units), _) => units.reading.clone(),
        (None, sensor) => sensor.unit().into(),
    };
    let names = base_names(sensor);
    for (name, (i, j)) in names.iter().zip(PLACES) {
        all.push(Parameter {
            name: name.clone(),
            value: triad.t[i][j],
            std: triad.t_std[i][j],
            unit: String::new(),
        });
    }
    let mut biases = |suffix: &str, bias: &[f64; 3], std: &[Option<f64>; 3]| {
        for (k, name) in names[9..].iter().enumerate() {
            all.push(Parameter {
                name: format!("{name}{suffix}"),
                value: bias[k],
                std: std[k],
                unit: unit.clone(),
            });
        }
    };
    if triad.recordings.is_empty() {
        biases("", &triad.bias, &triad.bias_std);
    }
    for own in &triad.recordings {
        biases(&format!(" in {}", own.recording), &own.bias, &own.bias_std);
    }
}

/// The corrected recording: base model plus effects, each sensor on its own clock. A sensor that the calibration does not
/// speak of stays raw, which a warning says; so do doubts whether it is of this device.
///
/// # Errors
/// Readings of another unit than those that the calibration was made from; an effect that needs what cannot be known of
/// this recording.
///
/// # Examples
/// ```
/// use stillpoint::{Recording, Request, Sensor, apply, calibrate};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let calibration = calibrate(&[recording.clone()], &Request::default())?;
/// let corrected = apply(&calibration, &recording)?;
/// let [x, y, z] = corrected.values(Sensor::Accelerometer).next().unwrap();
/// assert!(((x * x + y * y + z * z).sqrt() - 9.80665).abs() < 0.1);
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn apply(calibration: &Calibration, recording: &Recording) -> Result<Recording, Error> {
    apply_watched(calibration, recording, None)
}

/// [`apply`] under a watch.
///
/// # Errors
/// As [`apply`]; the end by the watch.
///
/// # Examples
/// ```
/// use stillpoint::{Recording, Request, apply_watched, calibrate};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let calibration = calibrate(&[recording.clone()], &Request::default())?;
/// assert!(apply_watched(&calibration, &recording, None).is_ok());
/// # Ok::<(), stillpoint::Error>(())
/// ```
pub fn apply_watched(
    calibration: &Calibration,
    recording: &Recording,
    watch: Option<&Watch>,
) -> Result<Recording, Error> {
    let own = calibration.as_ref();
    let raw = in_unit_of(own, Cow::Borrowed(recording.as_ref()))?;
    let raw = raw.as_ref();
    check_units(own, raw)?;
    let mut doubts = doubts(own, raw)?;
    doubts.extend(own.edited().map(|edited| edited.finding()));
    let mut corrected = calib::calibration::apply_under(&Watch::of_call(watch), own, raw)?;
    corrected.warnings.extend(doubts);
    corrected.warnings.extend(raw.unit_assumed());
    Ok(corrected.into())
}
