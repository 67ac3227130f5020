//! Request of a calibration.

use std::borrow::Borrow;

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;
use recording::intervals::{Detector, Span};
use recording::watch::Watch;
use recording::{Error, Recording};
use sensor::{EffectRef, Model, ScalarSensorRef, Sensor};
use serde::{Deserialize, Serialize};

use crate::gravity::{GravitySource, STANDARD_GRAVITY};
use crate::methods::joint::ClockMode;
use crate::residuals::Integrator;

/// Sampling rates of sensors that may be assumed instead of stamps, Hz.
pub const NOMINAL_RATES: std::ops::RangeInclusive<f64> = 0.1..=1e5;

/// The frame that the accelerometer's matrix is reported in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frame {
    /// Upper triangular: the sensor's x axis on the body's, its y axis in the body's x-y plane.
    #[default]
    Triangular,
    /// Symmetric: no rotation between sensor and body.
    Symmetric,
}

/// Source of the bias of a turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GyroBias {
    /// The mean of the two rests beside the turn, which follows a drifting bias.
    #[default]
    Adjacent,
    /// The first rest of the recording, as published (Liu et al. 2021).
    Initial,
}

/// Method of calibration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The method that [`Request::usual_method`] returns.
    Auto,
    /// Accelerometer first, then the gyroscope by propagated gravity, as published.
    #[default]
    Stepwise,
    /// Both sensors and their effects in one weighted problem.
    Joint,
}

/// An instant of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instant {
    /// Number of the recording, from 1.
    pub recording: usize,
    /// Its stamp, s.
    pub t: f64,
}

/// Request of a calibration: method, settings and effects.
#[derive(Clone, Debug)]
pub struct Request {
    /// Method of calibration.
    pub method: Method,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Source of that value; its uncertainty is part of the errors of the scale factors.
    pub gravity_source: GravitySource,
    /// The detector of motion.
    pub detector: Detector,
    /// True if the detector's multiplier is chosen by the fit.
    pub choose_multiplier: bool,
    /// Static intervals given by hand, one list per recording; empty to detect them.
    pub sections: Vec<Vec<Span>>,
    /// Static intervals to leave out, each by an instant within it.
    pub left_out: Vec<Instant>,
    /// Frame of the result.
    pub frame: Frame,
    /// Integration of the rate over a turn.
    pub integrator: Integrator,
    /// Source of the bias of a turn.
    pub gyro_bias: GyroBias,
    /// Step between gyroscope samples to assume instead of the stamps, s.
    pub nominal_step: Option<f64>,
    /// Effects on top of the base models.
    pub effects: Vec<EffectRef>,
    /// Sensors of one dimension: those that were recorded are calibrated beside the others.
    pub sensors: Vec<ScalarSensorRef>,
    /// Latitude, °: the joint method then takes the earth's rotation off the gyroscope. Its vertical part is
    /// known, its horizontal part is estimated, as the heading of the recording is not known.
    pub latitude: Option<f64>,
    /// Take the recordings to be of one device even where they disagree.
    pub force_device: bool,
    /// True if only the accelerometer is requested.
    pub accelerometer_alone: bool,
    /// By which clock the turns are integrated. What is left to the data are the stamps in the stepwise method, as
    /// published.
    pub clock: ClockMode,
    /// Strength of the magnetic field of the place, µT. Without it the scale of a magnetometer stays free.
    pub field: Option<f64>,
    /// Means to use for the accelerometer instead of those of the recordings.
    pub static_means: Vec<Vector3<f64>>,
    /// Told of every step.
    pub watch: Watch,
}

impl Request {
    /// The method where nobody names one: joint, whose stated errors hold under more conditions; stepwise where a recording
    /// has no accelerometer or where what is asked for is the stepwise method's alone (integrator, bias of a turn, an
    /// assumed step, means from a table).
    pub fn usual_method<R: Borrow<Recording>>(&self, recordings: &[R]) -> Method {
        let without_force = |r: &R| r.borrow().accelerometer.is_none();
        if self.of_stepwise().is_some() || recordings.iter().any(without_force) {
            Method::Stepwise
        } else {
            Method::Joint
        }
    }

    /// The first thing asked for that the stepwise method alone does.
    fn of_stepwise(&self) -> Option<&'static str> {
        let asked = [
            ("an integrator", self.integrator != Integrator::default()),
            ("a turn's bias", self.gyro_bias != GyroBias::default()),
            ("a nominal rate", self.nominal_step.is_some()),
            ("static means", !self.static_means.is_empty()),
        ];
        asked
            .into_iter()
            .find(|(_, is_asked)| *is_asked)
            .map(|(what, _)| what)
    }

    /// Refuses what the method would ignore.
    ///
    /// # Errors
    /// [`Error::Usage`] with it.
    pub(super) fn refuse_ignored(&self) -> Result<(), Error> {
        match self.of_stepwise().filter(|_| self.method == Method::Joint) {
            Some(what) => Err(Error::usage(
                Finding::of(Kind::NOT_OF_THIS_METHOD)
                    .detail("setting", what)
                    .detail("method", "joint")
                    .remedy(Remedy::set_to(OptionName::Method, "stepwise")),
            )),
            None => Ok(()),
        }
    }

    /// The base model of a sensor with its effects.
    pub(super) fn model(&self, sensor: Sensor) -> Model {
        let effects = self.effects.iter().cloned();
        effects.fold(Model::base(sensor), Model::with)
    }

    /// The same with a method that is no longer open.
    pub(super) fn decided<R: Borrow<Recording>>(&self, recordings: &[R]) -> Self {
        let method = match self.method {
            Method::Auto => self.usual_method(recordings),
            named => named,
        };
        Self {
            method,
            ..self.clone()
        }
    }
}

impl Default for Request {
    fn default() -> Self {
        Self {
            method: Method::default(),
            gravity: STANDARD_GRAVITY,
            gravity_source: GravitySource::Given,
            detector: Detector::default(),
            choose_multiplier: true,
            sections: Vec::new(),
            left_out: Vec::new(),
            frame: Frame::default(),
            integrator: Integrator::default(),
            gyro_bias: GyroBias::default(),
            nominal_step: None,
            effects: Vec::new(),
            sensors: Vec::new(),
            latitude: None,
            force_device: false,
            accelerometer_alone: false,
            clock: ClockMode::default(),
            field: None,
            static_means: Vec::new(),
            watch: Watch::default(),
        }
    }
}
