//! The result: `cal.json`, and what it says of a raw reading.

mod apply;
mod check;
mod clock;
mod document;
mod doubts;
mod effect_values;
mod frame;
mod gravity;
mod left_out;
mod magnetic_field;
mod misfit;
mod not_calibrated;
mod of_recording;
mod provenance;
mod scalar;
mod units;
mod values;

pub use apply::{apply, apply_under, apply_with};
pub use check::FINDINGS_SCHEMA;
pub use check::refuse_newer;
pub use check::{load, load_with, read_calibration};
pub use clock::{BetweenSamples, RecordingClock};
pub use doubts::doubts;
pub use effect_values::{EffectParameter, EffectValues, Outside};
pub use effects::{catalogue, effect_named};
pub use frame::in_symmetric_frame;
pub use left_out::{Enlarged, LeftOut};
pub use magnetic_field::{MagneticField, RecordingField};
pub use misfit::{Remainder, WITH_WALKS, WITHOUT_WALKS};
pub use not_calibrated::{NotCalibrated, NotCalibratedReason};
pub use provenance::{
    Edited, Input, Options, Provenance, Readings, SIGN_CONVENTION, SensorInput, TemperatureInput,
    fingerprint, system_name,
};
pub use scalar::ScalarValues;
pub use units::{TriadUnits, check_units, in_unit_of, read_in_unit_of};

use findings::{Finding, Findings, Kind, Step};
use nalgebra::{Matrix3, Vector3};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{Base, Model, Sensor};
use serde::{Deserialize, Serialize};

use crate::gravity::GravitySource;
use crate::limits::LimitLine;
use crate::prior::PriorUse;

/// The schema this version writes.
pub const SCHEMA: &str = "stillpoint.calibration/1";

/// A calibration of one device, as written to `cal.json`. SI units unless the readings are raw
/// counts: then `T` is SI units per count and `bias` is in counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct Calibration {
    /// [`SCHEMA`].
    pub schema: String,
    /// Program and version.
    pub created_by: String,
    /// Local gravity used, m/s².
    pub gravity: f64,
    /// Source of that value.
    #[serde(default)]
    pub gravity_source: GravitySource,
    /// `stepwise`, `six-position` or `joint`.
    pub method: String,
    /// The accelerometer.
    pub accelerometer: Option<Triad>,
    /// The gyroscope.
    pub gyroscope: Option<Triad>,
    /// The magnetometer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magnetometer: Option<Triad>,
    /// The field in which it was calibrated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub magnetic_field: Option<MagneticField>,
    /// Sensors of one dimension.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scalars: Vec<ScalarValues>,
    /// Sensors that were recorded and are not calibrated; each stands in its sensor's place in the file.
    #[serde(skip)]
    pub not_calibrated: Vec<NotCalibrated>,
    /// Effects on top of the base models.
    pub effects: Vec<EffectValues>,
    /// Names in the order of the covariance.
    pub parameters: Vec<String>,
    /// Covariance of `parameters`.
    pub covariance: Vec<Vec<f64>>,
    /// Residuals of the data by channel, before any error is inflated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub misfit: Vec<Remainder>,
    /// Effects that the model leaves out, and how much less certain each would make a parameter.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOut>,
    /// Findings that a user should know; the document has their texts here, and all findings under `findings`.
    #[serde(with = "findings::texts::of_warnings")]
    pub warnings: Findings,
    /// Findings that forbid the use of the calibration as it stands.
    #[serde(
        default,
        with = "findings::texts::of_gates",
        skip_serializing_if = "<[_]>::is_empty"
    )]
    pub failed_gates: Findings,
    /// Limits that were judged, with their values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<LimitLine>,
    /// Contribution of a prior of the device's type.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prior: Option<PriorUse>,
    /// By which clock the turns of each recording were integrated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clocks: Vec<RecordingClock>,
    /// Biases estimated again since, oldest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub history: Vec<BiasUpdate>,
    /// The steps that a front end offers next in its own commands; no part of the document, which is the same by whatever call it was made.
    #[serde(skip)]
    pub next: Option<Vec<Step>>,
    /// Recordings, options and conventions.
    #[serde(flatten)]
    pub provenance: Provenance,
}

/// A bias estimated again with everything else kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BiasUpdate {
    /// `accel` or `gyro`.
    pub sensor: String,
    /// The recording it was estimated on.
    pub recording: String,
    /// Rests used.
    pub rests: usize,
    /// The bias before.
    pub bias_before: [f64; 3],
    /// The bias since.
    pub bias: [f64; 3],
}

/// The base model of one sensor and how well it is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Triad {
    /// The equation.
    pub model: String,
    /// Scale factors and misalignments (3 × 3, rows).
    #[serde(rename = "T")]
    pub t: [[f64; 3]; 3],
    /// Bias. Where each recording has its own, their mean, or where they differ that of the last.
    pub bias: [f64; 3],
    /// Standard errors of `T`; null where the element was held fixed.
    #[serde(rename = "T_std")]
    pub t_std: [[Option<f64>; 3]; 3],
    /// Standard errors of the bias.
    pub bias_std: [Option<f64>; 3],
    /// For which time the bias holds, and how much it moved; of the last recording where each has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bias_time: Option<BiasTime>,
    /// Root mean square of the residuals: m/s² of gravity's norm, or degrees of its direction.
    pub residual_rms: f64,
    /// Residual over what the noise within the intervals allows, squared, per degree of freedom.
    pub reduced_chi2: Option<f64>,
    /// Static intervals used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_intervals: Option<usize>,
    /// Turns used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamic_intervals: Option<usize>,
    /// Rank of the Jacobian.
    pub rank: usize,
    /// Its condition number, with unit columns.
    pub condition: f64,
    /// Combinations of parameters that the data cannot see.
    pub unobservable: Vec<String>,
    /// Units of the readings, of `T` and of `bias`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<TriadUnits>,
    /// Biases by recording, where there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<RecordingBias>,
}

/// For which time a bias holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BiasTime {
    /// `mean over the static intervals`: what `bias` is.
    pub holds: String,
    /// Begin of the first static interval, s, on the recording's clock.
    pub from: f64,
    /// End of the last, s.
    pub to: f64,
    /// The bias at the begin, if it moved evenly.
    pub start: [f64; 3],
    /// The bias at the end, if it moved evenly.
    pub end: [f64; 3],
    /// Change from begin to end.
    pub change: [f64; 3],
    /// Its standard errors, walks of the bias counted as noise.
    pub change_std: [f64; 3],
}

/// The bias of one recording of several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingBias {
    /// The recording, as the user named it.
    pub recording: String,
    /// Its bias.
    pub bias: [f64; 3],
    /// Standard errors.
    pub bias_std: [Option<f64>; 3],
}

impl Triad {
    /// Builds the triad of a base model of which nothing else is known yet.
    pub fn of(sensor: Sensor, base: &Base<f64>) -> Self {
        Self {
            model: sensor.equation().into(),
            t: std::array::from_fn(|i| std::array::from_fn(|j| base.t[(i, j)])),
            bias: base.bias.into(),
            t_std: [[None; 3]; 3],
            bias_std: [None; 3],
            bias_time: None,
            residual_rms: 0.0,
            reduced_chi2: None,
            static_intervals: None,
            dynamic_intervals: None,
            rank: 0,
            condition: 1.0,
            unobservable: Vec::new(),
            units: None,
            recordings: Vec::new(),
        }
    }

    /// The base model.
    pub fn base(&self) -> Base<f64> {
        Base {
            t: Matrix3::from_fn(|i, j| self.t[i][j]),
            bias: Vector3::from(self.bias),
        }
    }
}

impl Calibration {
    /// Builds a calibration by a `method`, in which no sensor is calibrated yet.
    pub fn by(method: &str, gravity: f64, gravity_source: GravitySource) -> Self {
        Self {
            schema: SCHEMA.into(),
            created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
            gravity,
            gravity_source,
            method: method.into(),
            accelerometer: None,
            gyroscope: None,
            magnetometer: None,
            magnetic_field: None,
            scalars: Vec::new(),
            not_calibrated: Vec::new(),
            effects: Vec::new(),
            parameters: Vec::new(),
            covariance: Vec::new(),
            misfit: Vec::new(),
            left_out: Vec::new(),
            warnings: Findings::new(),
            failed_gates: Findings::new(),
            limits: Vec::new(),
            prior: None,
            clocks: Vec::new(),
            history: Vec::new(),
            next: None,
            provenance: Provenance::of(Vec::new(), None),
        }
    }

    /// Writes down what it was made from.
    pub fn state_inputs<'a>(
        &mut self,
        recordings: impl IntoIterator<Item = (&'a Recording, Option<&'a Segmentation>)>,
        options: Option<Options>,
    ) {
        let scale = |triad: &Option<Triad>| Some(triad.as_ref()?.base().scale());
        let scales = [scale(&self.accelerometer), scale(&self.gyroscope)];
        let inputs = recordings.into_iter();
        let inputs = inputs.map(|(r, intervals)| Input::of(r, intervals, scales));
        self.provenance = Provenance::of(inputs.collect(), options);
        self.state_units();
        self.seal();
    }

    /// Writes down how it was judged against limits.
    pub fn state_limits(&mut self, limits: Vec<LimitLine>) {
        self.limits = limits;
        self.seal();
    }

    /// Writes the units of both sensors down.
    pub fn state_units(&mut self) {
        for (sensor, triad) in [
            (Sensor::Accelerometer, &mut self.accelerometer),
            (Sensor::Gyroscope, &mut self.gyroscope),
        ] {
            if let Some(triad) = triad {
                triad.units = Some(TriadUnits::of(sensor, triad.base().scale()));
            }
        }
        if let (Some(triad), Some(field)) = (&mut self.magnetometer, &self.magnetic_field) {
            triad.units = Some(TriadUnits {
                reading: field.unit_of_readings().into(),
                t: "1".into(),
                corrected: field.unit.clone(),
            });
        }
    }

    /// Returns true if this recording is one that it was made from; `None` where the file does not list its recordings.
    pub fn was_made_from(&self, recording: &Recording) -> Option<bool> {
        let is_stated = !self.provenance.inputs.is_empty();
        is_stated.then(|| self.input_of(recording).is_some())
    }

    /// Returns its entry on this recording, where it was made from it.
    fn input_of(&self, recording: &Recording) -> Option<&Input> {
        let samples = fingerprint(recording);
        let mut inputs = self.provenance.inputs.iter();
        inputs.find(|input| input.samples_sha256 == samples)
    }

    /// The triad of a sensor.
    pub fn triad(&self, sensor: Sensor) -> Option<&Triad> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_ref(),
            Sensor::Gyroscope => self.gyroscope.as_ref(),
            Sensor::Magnetometer => self.magnetometer.as_ref(),
        }
    }

    /// The triad of a sensor, to be changed.
    pub(crate) fn triad_mut(&mut self, sensor: Sensor) -> Option<&mut Triad> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer.as_mut(),
            Sensor::Gyroscope => self.gyroscope.as_mut(),
            Sensor::Magnetometer => self.magnetometer.as_mut(),
        }
    }

    /// Refuses effects that nobody here knows: the corrected signal would lack them.
    ///
    /// # Errors
    /// [`Error::NotEnough`] with the effect's name.
    pub fn knows_its_effects(&self) -> Result<(), Error> {
        self.effects.iter().try_for_each(|values| {
            let known = values.effect().map(|_| ());
            known.map_err(|_| {
                let found = Finding::of(Kind::EFFECT_NOT_HERE);
                Error::not_enough(found.detail("effect", values.name.clone()))
            })
        })
    }

    /// The model of a sensor and its parameters, base first; `None` where the sensor was not
    /// calibrated.
    pub fn model(&self, sensor: Sensor) -> Option<(Model, Vec<f64>)> {
        let mut model = Model::base(sensor);
        let mut p = self.triad(sensor)?.base().parameters().to_vec();
        for values in &self.effects {
            let Some(effect) = values.effect().ok().filter(|e| e.sensor() == sensor) else {
                continue;
            };
            model = model.with(effect);
            p.extend(values.parameters.iter().map(|v| v.value));
        }
        Some((model, p))
    }
}
