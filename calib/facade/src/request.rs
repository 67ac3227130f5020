//! Calibration request: method, place, effects and options.

use calib::calibrate::{Frame, GyroBias, Instant, NOMINAL_RATES, Request as CalibRequest};
use calib::discover::Request as DiscoverRequest;
use calib::effect_file::catalogue_with;
use calib::gravity::{ACCEPTED, Gravity, NotOnEarth};
use calib::intervals::{DetectorOptions, Span};
use calib::methods::joint::{BiasNoise, ClockMode};
use calib::recording::figure;
use calib::residuals::Integrator;
use findings::{Finding, Kind};
use sensor::EffectRef;

use crate::{Catalogue, Error, Recording, Watch};

/// Calibration method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Joint; stepwise where a recording has no accelerometer, or where what is asked for is the stepwise method's alone.
    #[default]
    Auto,
    /// Accelerometer first, then the gyroscope by propagated gravity (Liu et al. 2021).
    Stepwise,
    /// Both sensors in one problem weighted by the recording's own noise.
    Joint,
    /// Each axis once up and once down, from six recordings or one.
    SixPosition {
        /// Correct by `I − M` as published, not by the inverse of `I + M`.
        first_order: bool,
    },
}

/// Calibration request. The default is that of the command without options.
///
/// # Examples
/// ```
/// use stillpoint::{Method, Request};
///
/// let request = Request {
///     method: Method::Joint,
///     latitude: Some(48.1),
///     altitude: Some(520.0),
///     effects: vec!["gyro_g_sensitivity".into()],
///     ..Request::default()
/// };
/// assert_eq!(request.alpha, 0.01);
/// ```
#[derive(Clone, Debug)]
pub struct Request {
    /// Calibration method.
    pub method: Method,
    /// Local gravity, m/s². A wrong one goes into the accelerometer's scale factors in full. That of the place where it
    /// is not given, else 9.80665 with errors that cover the whole earth.
    pub gravity: Option<f64>,
    /// Latitude, ° north.
    pub latitude: Option<f64>,
    /// Height above sea level, m.
    pub altitude: Option<f64>,
    /// Strength of the magnetic field of the place, µT; without it the magnetometer's `T` has determinant 1.
    pub field: Option<f64>,
    /// Options of the static interval detector.
    pub detector: DetectorOptions,
    /// Static intervals picked by hand, begin and end in s: a list for each recording, one for all, or none.
    pub sections: Vec<Vec<(f64, f64)>>,
    /// Static intervals to leave out, each by an instant within it: the number of the recording from 1, and a stamp in s.
    pub left_out: Vec<(usize, f64)>,
    /// Recordings to take the gyroscope's turns from instead.
    pub gyro_recordings: Vec<Recording>,
    /// Frame of the accelerometer's matrix.
    pub frame: Frame,
    /// Integration method of the angular rate over a turn.
    pub integrator: Integrator,
    /// Source of the gyroscope bias of a turn.
    pub gyro_bias: GyroBias,
    /// Sampling rate in turns to assume instead of the stamps, Hz.
    pub nominal_rate: Option<f64>,
    /// By which clock turns are integrated.
    pub clock: ClockMode,
    /// Names of effects to fit on top of the base models.
    pub effects: Vec<String>,
    /// Effects of one's own: they may be named in `effects`, and `discover` looks for them.
    pub catalogue: Catalogue,
    /// Take the recordings to be of one device even where they disagree.
    pub force_device: bool,
    /// `discover`: chance of any false claim about a device that lacks nothing.
    pub alpha: f64,
    /// `discover`: random walk densities of the biases where they are known, m/s²/√s and rad/s/√s.
    pub walks: Option<[f64; 2]>,
    /// `discover`: another recording of the device, to show the gap on.
    pub validation: Option<Recording>,
    /// Is told of every step of the work and may end it at the next. Steps are milliseconds apart on recordings of minutes, and seconds
    /// on ten million samples; each call counts its own.
    ///
    /// # Examples
    /// ```
    /// use std::ops::ControlFlow;
    /// use stillpoint::{ErrorKind, Recording, Request, Watch, calibrate};
    ///
    /// let (t, accel, gyro, _) = stillpoint::example::session();
    /// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// let patience = Watch::new(|progress| match progress.steps {
    ///     0..2 => ControlFlow::Continue(()),
    ///     _ => ControlFlow::Break(()),
    /// });
    /// let request = Request { watch: Some(patience), ..Request::default() };
    /// assert_eq!(calibrate(&[recording], &request).unwrap_err().kind, ErrorKind::Cancelled);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub watch: Option<Watch>,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            method: Method::default(),
            gravity: None,
            latitude: None,
            field: None,
            altitude: None,
            detector: DetectorOptions::default(),
            sections: Vec::new(),
            left_out: Vec::new(),
            gyro_recordings: Vec::new(),
            frame: Frame::default(),
            integrator: Integrator::default(),
            gyro_bias: GyroBias::default(),
            nominal_rate: None,
            clock: ClockMode::default(),
            effects: Vec::new(),
            catalogue: Catalogue::default(),
            force_device: false,
            alpha: 0.01,
            walks: None,
            validation: None,
            watch: None,
        }
    }
}

impl Request {
    /// Local gravity by what is given of it.
    pub(crate) fn local_gravity(&self) -> Result<Gravity, Error> {
        let found = Gravity::checked(self.gravity, self.latitude, self.altitude);
        found.map_err(|what| {
            Error::usage(match what {
                NotOnEarth::Gravity(g) => Finding::of(Kind::GRAVITY_NOT_ON_EARTH)
                    .detail("gravity", figure(g))
                    .detail("least", figure(*ACCEPTED.start()))
                    .detail("most", figure(*ACCEPTED.end())),
                NotOnEarth::Latitude(l) => out_of_range("latitude", l, "-90 to 90 °"),
                NotOnEarth::Altitude(h) => out_of_range("altitude", h, "-500 to 9000 m"),
                NotOnEarth::Place {
                    gravity,
                    latitude,
                    normal,
                } => Finding::of(Kind::GRAVITY_NOT_OF_LATITUDE)
                    .detail("gravity", figure(gravity))
                    .detail("latitude", figure(latitude))
                    .detail("normal", format!("{normal:.4}")),
            })
        })
    }

    /// Refuses settings that a method would ignore.
    ///
    /// # Errors
    /// The first of `ignored` that is not at its default.
    pub(crate) fn refuse(&self, method: &str, ignored: &[&str]) -> Result<(), Error> {
        let usual = matches!(self.method, Method::Auto | Method::Joint);
        let given = [
            ("method", !usual),
            ("effects", !self.effects.is_empty()),
            ("sections", !self.sections.is_empty()),
            ("left_out", !self.left_out.is_empty()),
            ("gyro_recordings", !self.gyro_recordings.is_empty()),
            ("nominal_rate", self.nominal_rate.is_some()),
            ("frame", self.frame != Frame::default()),
            ("integrator", self.integrator != Integrator::default()),
            ("gyro_bias", self.gyro_bias != GyroBias::default()),
            ("field", self.field.is_some()),
            ("catalogue", !self.catalogue.sensors().is_empty()),
        ];
        let mut given = given.into_iter().filter(|(_, is_given)| *is_given);
        match given.find(|(name, _)| ignored.contains(name)) {
            None => Ok(()),
            Some((name, _)) => Err(Error::usage(
                Finding::of(Kind::NOT_OF_THIS_METHOD)
                    .detail("setting", name)
                    .detail("method", method),
            )),
        }
    }

    /// For the estimators, with sections for `recordings` recordings.
    pub(crate) fn for_calibration(&self, recordings: usize) -> Result<CalibRequest, Error> {
        let gravity = self.local_gravity()?;
        let (detector, choose_multiplier) = self.detector.detector().map_err(not_positive)?;
        let nominal_step = match self.nominal_rate {
            Some(rate) if NOMINAL_RATES.contains(&rate) => Some(rate.recip()),
            Some(rate) => {
                let expected = "0.1 to 100000 Hz";
                return Err(Error::usage(out_of_range("nominal_rate", rate, expected)));
            }
            None => None,
        };
        Ok(CalibRequest {
            accelerometer_alone: false,
            method: match self.method {
                Method::Auto => calib::calibrate::Method::Auto,
                Method::Joint => calib::calibrate::Method::Joint,
                Method::Stepwise | Method::SixPosition { .. } => calib::calibrate::Method::Stepwise,
            },
            gravity: gravity.value,
            watch: Watch::of_call(self.watch.as_ref()),
            gravity_source: gravity.source,
            detector,
            choose_multiplier,
            sections: self.sections_for(recordings)?,
            left_out: self.left_out_of(recordings)?,
            frame: self.frame,
            integrator: self.integrator,
            gyro_bias: self.gyro_bias,
            nominal_step,
            effects: self.named_effects()?,
            sensors: self.catalogue.sensors().to_vec(),
            latitude: self.latitude,
            force_device: self.force_device,
            clock: self.clock,
            field: self.field,
            static_means: Vec::new(),
        })
    }

    /// For the search.
    pub(crate) fn for_discovery(&self, recordings: usize) -> Result<DiscoverRequest, Error> {
        if !(self.alpha > 0.0 && self.alpha <= 0.5) {
            let expected = "above 0 to 0.5";
            return Err(Error::usage(out_of_range("alpha", self.alpha, expected)));
        }
        let gravity = self.local_gravity()?;
        let (detector, choose_multiplier) = self.detector.detector().map_err(not_positive)?;
        let mut request = DiscoverRequest {
            alpha: self.alpha,
            noise: self.walks.map(|walk| BiasNoise {
                walk,
                ..BiasNoise::default()
            }),
            left_out: self.left_out_of(recordings)?,
            force_device: self.force_device,
            latitude: self.latitude,
            clock: self.clock,
            detector,
            choose_multiplier,
            gravity_source: gravity.source,
            watch: Watch::of_call(self.watch.as_ref()),
            ..DiscoverRequest::new(gravity.value)
        };
        request
            .catalogue
            .extend(self.catalogue.own().iter().cloned());
        Ok(request)
    }

    fn sections_for(&self, recordings: usize) -> Result<Vec<Vec<Span>>, Error> {
        let spans = |list: &Vec<(f64, f64)>| -> Result<Vec<Span>, Error> {
            let span = |&(from, to): &(f64, f64)| {
                let fits = from.is_finite() && to.is_finite() && from < to;
                fits.then_some(Span { from, to })
                    .ok_or_else(|| Error::usage(backwards(from, to).detail("key", "sections")))
            };
            list.iter().map(span).collect()
        };
        let all: Vec<Vec<Span>> = self.sections.iter().map(spans).collect::<Result<_, _>>()?;
        match all.len() {
            1 => Ok(vec![all[0].clone(); recordings]),
            0 => Ok(all),
            n if n == recordings => Ok(all),
            n => Err(Error::usage(
                Finding::of(Kind::SECTIONS_DO_NOT_FIT)
                    .count("count", n)
                    .count("recordings", recordings),
            )),
        }
    }

    fn left_out_of(&self, recordings: usize) -> Result<Vec<Instant>, Error> {
        let instant = |&(recording, t): &(usize, f64)| {
            let is_there = (1..=recordings).contains(&recording) && t.is_finite();
            is_there.then_some(Instant { recording, t }).ok_or_else(|| {
                Error::usage(
                    Finding::of(Kind::INSTANT_OUTSIDE)
                        .detail("time", figure(t))
                        .count("recording", recording)
                        .count("recordings", recordings),
                )
            })
        };
        self.left_out.iter().map(instant).collect()
    }

    fn named_effects(&self) -> Result<Vec<EffectRef>, Error> {
        let find = |name: &String| {
            let mut all = catalogue_with(self.catalogue.own());
            all.find(|effect| effect.name() == name).ok_or_else(|| {
                let unknown = Finding::of(Kind::EFFECT_UNKNOWN);
                let unknown = unknown.detail("effect", format!("`{name}`"));
                let known = self.catalogue.names();
                Error::usage(unknown.or_nearest(name, known.iter().map(String::as_str)))
            })
        };
        self.effects.iter().map(find).collect()
    }
}

fn not_positive(name: &str) -> Error {
    Error::usage(
        Finding::of(Kind::OUT_OF_RANGE)
            .detail("key", name)
            .detail("value", "not positive")
            .detail("expected", "a positive number"),
    )
}

fn out_of_range(name: &str, value: f64, expected: &str) -> Finding {
    Finding::of(Kind::OUT_OF_RANGE)
        .detail("key", name)
        .detail("value", figure(value))
        .detail("expected", expected)
}

/// A stretch that ends before it begins.
pub(crate) fn backwards(from: f64, to: f64) -> Finding {
    Finding::of(Kind::BACKWARDS)
        .detail("from", figure(from))
        .detail("to", figure(to))
}
