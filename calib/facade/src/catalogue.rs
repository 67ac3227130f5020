//! Effects of one's own beside those of the catalogue.

use findings::{Finding, Kind};
use std::path::Path;
use std::sync::Arc;

use calib::effect_file::{catalogue_with, parse_effects};
use sensor::{
    AnyEffect, AnyScalarSensor, EffectRef, ScalarSensorRef, Sensor, is_linear_in_name_only,
};

use crate::Error;

/// The effects that this program knows, and effects of one's own.
///
/// An effect `e(truth, p)` is an error in SI units at the true signal, `raw = base⁻¹(truth + Σ e)`, silent at its nominal
/// parameters. One of one's own is a type with `effect::Effect`, in any crate, or a definition in TOML; an `Arc` of
/// it joins a catalogue, is fitted, applied, and found again in a calibration that is read with the same catalogue.
///
/// Requests and calibrations share what joined a catalogue.
///
/// # Examples
/// ```
/// use std::sync::Arc;
/// use stillpoint::effect::{Effect, Kinematics, Param, Scalar, Sensor, Vector3, params};
/// use stillpoint::{Calibration, Catalogue, Method, Recording, Request, apply, calibrate};
///
/// /// Specific force along x leaks into every axis of the rate: `W_i += k_i f_x`.
/// struct Tug;
/// impl Effect for Tug {
///     const NAME: &'static str = "gyro_tug";
///     const SENSOR: Sensor = Sensor::Gyroscope;
///     const EQUATION: &'static str = "W_i += k_i f_x";
///     const PARAMS: &'static [Param] = &params("(rad/s)/(m/s²)", ["x", "y", "z"]);
///     const TYPICAL: f64 = 1e-4;
///     fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
///         Vector3::new(p[0], p[1], p[2]) * truth.specific_force.x
///     }
/// }
///
/// let catalogue = Catalogue::default().with(Arc::new(Tug))?;
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
/// let request = Request {
///     method: Method::Joint,
///     effects: vec!["gyro_tug".into()],
///     catalogue: catalogue.clone(),
///     ..Request::default()
/// };
/// let calibration = calibrate(&[recording.clone()], &request)?;
/// let again = Calibration::from_json(&calibration.to_json()?, &catalogue)?;
/// let corrected = [&calibration, &again].map(|c| apply(c, &recording));
/// # let [one, other] = corrected;
/// # let rows = |r: Recording| r.values(Sensor::Gyroscope).collect::<Vec<_>>();
/// # assert_eq!(rows(one?), rows(other?));
/// assert!(Calibration::from_json(&calibration.to_json()?, &Catalogue::default()).is_err());
/// # Ok::<(), stillpoint::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    effects: Vec<EffectRef>,
    sensors: Vec<ScalarSensorRef>,
}

impl Catalogue {
    /// With an effect of one's own.
    ///
    /// # Errors
    /// [`ErrorKind::Usage`](crate::ErrorKind::Usage) where the name is taken, and where the effect says `LINEAR` and is not.
    ///
    /// # Examples
    /// ```
    /// use std::sync::Arc;
    /// use stillpoint::effect::{Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Scalar, Sensor};
    /// use stillpoint::effect::{Vector3, params};
    /// use stillpoint::{Catalogue, ErrorKind};
    ///
    /// /// A bias that goes with the cube of the temperature: `W_i += c_i (T - T0)^3`.
    /// struct Cubic;
    /// impl Effect for Cubic {
    ///     const NAME: &'static str = "gyro_temperature_cube";
    ///     const SENSOR: Sensor = Sensor::Gyroscope;
    ///     const EQUATION: &'static str = "W_i += c_i (T - T0)^3";
    ///     const PARAMS: &'static [Param] = &params("rad/s/K^3", ["x", "y", "z"]);
    ///     const TYPICAL: f64 = 1e-7;
    ///     const LINEAR: bool = true;
    ///     const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::Temperature]);
    ///     fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
    ///         let cube = (truth.temperature - REFERENCE_TEMPERATURE).powi(3);
    ///         Vector3::from_fn(|i, _| p[i] * cube)
    ///     }
    /// }
    ///
    /// let catalogue = Catalogue::default().with(Arc::new(Cubic))?;
    /// assert!(catalogue.names().contains(&"gyro_temperature_cube".to_owned()));
    /// let twice = catalogue.with(Arc::new(Cubic)).unwrap_err(); // another `Arc` of the same name
    /// assert_eq!(twice.kind, ErrorKind::Usage);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn with(mut self, effect: Arc<dyn AnyEffect>) -> Result<Self, Error> {
        self.add(effect.into())?;
        Ok(self)
    }

    /// With a sensor of one dimension of one's own: [`calibrate`](crate::calibrate) calibrates it where it was recorded
    /// ([`Recording::with_scalar`](crate::Recording::with_scalar)), and [`apply`](crate::apply) corrects its readings.
    ///
    /// # Errors
    /// [`ErrorKind::Usage`](crate::ErrorKind::Usage) where the name is taken.
    ///
    /// # Examples
    /// ```
    /// use std::sync::Arc;
    /// use stillpoint::effect::{Kinematics, Param, Scalar};
    /// use stillpoint::{Catalogue, ScalarSensor};
    ///
    /// /// `R = d + b`.
    /// struct Rangefinder;
    /// impl ScalarSensor for Rangefinder {
    ///     const NAME: &'static str = "rangefinder";
    ///     const UNIT: &'static str = "m";
    ///     const EQUATION: &'static str = "R = d + b";
    ///     const PARAMS: &'static [Param] = &[Param::new("b", "m", 0.0)];
    ///     fn reading<D: Scalar>(&self, signal: D, _: &Kinematics<f64>, p: &[D]) -> D {
    ///         signal + p[0]
    ///     }
    /// }
    ///
    /// let catalogue = Catalogue::default().with_sensor(Arc::new(Rangefinder))?;
    /// assert!(catalogue.with_sensor(Arc::new(Rangefinder)).is_err());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn with_sensor(mut self, sensor: Arc<dyn AnyScalarSensor>) -> Result<Self, Error> {
        let name = sensor.name();
        let is_own = self.sensors.iter().any(|own| own.name() == name);
        if is_own || Sensor::ALL.iter().any(|known| known.name() == name) {
            let taken = Finding::of(Kind::NAME_TAKEN).detail("name", sensor.name());
            return Err(Error::usage(taken));
        }
        self.sensors.push(sensor.into());
        Ok(self)
    }

    /// With the effects that `toml` defines by expressions.
    ///
    /// # Errors
    /// What is wrong with a definition, with its line; a name that is taken.
    ///
    /// # Examples
    /// ```
    /// let toml = r#"
    ///     [[definitions]]
    ///     name = "gyro_swirl"
    ///     sensor = "gyroscope"
    ///     x = "k * fy * fz"
    ///     parameters = [{ name = "k", unit = "rad/s/(m/s^2)^2", typical = 5e-6 }]
    /// "#;
    /// let catalogue = stillpoint::Catalogue::default().with_definitions(toml)?;
    /// assert!(catalogue.names().contains(&"gyro_swirl".to_owned()));
    /// assert!(catalogue.with_definitions(toml).is_ok()); // the same once more
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn with_definitions(mut self, toml: &str) -> Result<Self, Error> {
        for effect in parse_effects(toml, "definitions")? {
            self.add(effect)?;
        }
        Ok(self)
    }

    /// With the effects that a TOML file defines by expressions.
    ///
    /// # Errors
    /// As [`Catalogue::with_definitions`]; a file that cannot be read.
    ///
    /// # Examples
    /// ```
    /// let error = stillpoint::Catalogue::default().with_file("no_such.toml").unwrap_err();
    /// assert_eq!(error.file.as_deref(), Some("no_such.toml"));
    /// ```
    pub fn with_file(mut self, path: impl AsRef<Path>) -> Result<Self, Error> {
        for effect in calib::effect_file::read_effects(path.as_ref())? {
            self.add(effect)?;
        }
        Ok(self)
    }

    /// The names of all effects, those of the program first.
    ///
    /// # Examples
    /// ```
    /// let names = stillpoint::Catalogue::default().names();
    /// assert!(names.iter().any(|name| name == "gyro_g_sensitivity"));
    /// ```
    pub fn names(&self) -> Vec<String> {
        let all = catalogue_with(&self.effects);
        all.map(|effect| effect.name().to_owned()).collect()
    }

    pub(crate) fn own(&self) -> &[EffectRef] {
        &self.effects
    }

    pub(crate) fn sensors(&self) -> &[ScalarSensorRef] {
        &self.sensors
    }

    fn add(&mut self, effect: EffectRef) -> Result<(), Error> {
        let taken = catalogue_with(&self.effects).find(|other| other.name() == effect.name());
        match taken {
            Some(other) if other.is(&effect) => Ok(()),
            Some(_) => Err(Error::usage(
                Finding::of(Kind::EFFECT_TAKEN).detail("name", effect.name()),
            )),
            None if is_linear_in_name_only(&*effect) => Err(Error::usage(
                Finding::of(Kind::EFFECT_NOT_LINEAR).detail("name", effect.name()),
            )),
            None => {
                self.effects.push(effect);
                Ok(())
            }
        }
    }
}
