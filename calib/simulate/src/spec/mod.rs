//! Specification of a simulation.

mod check;
pub(crate) mod complaint;
mod names;
mod own;
mod parse;
mod wanted;

pub use own::OwnEffects;
pub use parse::EXAMPLE;
pub use wanted::{Effects, SIZE};

use std::collections::BTreeMap;

use complaint::Complaint;
use effects::effect_file::effects_of;
use effects::{catalogue_of, earth_rotation, effect_named};
use findings::{Finding, Kind};
use gyroscope::EARTH_RATE;
use sensor::{Definition, EffectRef, Nature, Quantity, Sensor};
use serde::{Deserialize, Serialize};

use crate::device::Grade;
use crate::hidden::Hidden;
use crate::motion::{Cart, HandHeld, Path, Planned, SixPosition, Still, Surroundings, Walking};
use crate::noise::{Distribution, Noise, Spikes};
use crate::sampling::{Clock, Readout, Resampled, Sampling, Stamp};
use crate::surroundings::{Fault, MagneticField, Temperature, Unsteady, Vibration};

/// A simulation in full. The default is a hand-held session of a consumer-grade device.
///
/// ```
/// use stillpoint_simulate::Spec;
///
/// let session = Spec::hand_held(7).with_effect("gyro_g_sensitivity", 1.0).run()?;
/// assert!(session.truth.get("gyro_g_sensitivity.xx").is_some());
/// # Ok::<(), recording::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Spec {
    /// Seed of everything random.
    pub seed: u64,
    /// Samples per second.
    pub rate: f64,
    /// Position of the time stamp in a sample's window.
    pub stamp: Stamp,
    /// Value of a sample: the mean over its window, or the value at an instant.
    pub sampling: Sampling,
    /// Norm of gravity, m/s².
    pub gravity: f64,
    /// Latitude, degrees north: switches the earth's rotation on.
    pub latitude: Option<f64>,
    /// From the hand's centre of rotation to the sensor, body frame, m.
    pub lever_arm: [f64; 3],
    /// Motion of the device.
    pub motion: Motion,
    /// Quality of the device: errors and white noise that are not given are drawn from it.
    pub grade: Grade,
    /// True parameters by name (`accel.s_x`, `gyro.b_z`), instead of random ones.
    pub parameters: BTreeMap<String, f64>,
    /// Effects by name, with their parameters or their `size`.
    pub effects: Effects,
    /// Noise, clock and readout of the accelerometer.
    pub accelerometer: SensorSpec,
    /// Noise, clock and readout of the gyroscope.
    pub gyroscope: SensorSpec,
    /// The magnetic field of the place: switches a magnetometer on.
    pub magnetic_field: Option<MagneticField>,
    /// Noise, clock and readout of the magnetometer, µT.
    pub magnetometer: SensorSpec,
    /// Temperature and thermometer; constant and unrecorded without.
    pub temperature: Option<Temperature>,
    /// Vibration of the table at rest.
    pub vibration: Option<Vibration>,
    /// Motion during placements, where the device should be at rest.
    pub unsteady: Option<Unsteady>,
    /// Effects beside the catalogue, as expressions; `effects` switches them on.
    pub definitions: Vec<Definition>,
    /// Effects of another crate; `effects` switches them on. A text of the spec lacks them.
    #[serde(skip)]
    pub own: OwnEffects,
    /// Faults of the recording.
    pub faults: Vec<Fault>,
    /// Disturbances outside the catalogue of effects.
    pub hidden: Vec<Hidden>,
}

impl Default for Spec {
    fn default() -> Self {
        Self {
            seed: 0,
            rate: 100.0,
            stamp: Stamp::Centre,
            sampling: Sampling::Average,
            gravity: 9.80665,
            latitude: None,
            lever_arm: [0.02, -0.01, 0.015],
            motion: Motion::default(),
            grade: Grade::Consumer,
            parameters: BTreeMap::new(),
            effects: Effects::new(),
            accelerometer: SensorSpec::default(),
            gyroscope: SensorSpec::default(),
            magnetic_field: None,
            magnetometer: SensorSpec::default(),
            temperature: None,
            vibration: None,
            unsteady: None,
            definitions: Vec::new(),
            own: OwnEffects::default(),
            faults: Vec::new(),
            hidden: Vec::new(),
        }
    }
}

/// The kinds of motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// Many placements by hand.
    HandHeld(HandHeld),
    /// Placements and turns as a plan says.
    Planned(Planned),
    /// Every axis up and down.
    SixPosition(SixPosition),
    /// At rest.
    Still(Still),
    /// A straight run on wheels.
    Cart(Cart),
    /// A straight walk.
    Walking(Walking),
}

impl Default for Motion {
    fn default() -> Self {
        Self::HandHeld(HandHeld::default())
    }
}

impl Motion {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        match self {
            Self::HandHeld(motion) => motion.path(around),
            Self::Planned(motion) => motion.path(around),
            Self::SixPosition(motion) => motion.path(around),
            Self::Still(motion) => motion.path(around),
            Self::Cart(motion) => motion.path(around),
            Self::Walking(motion) => motion.path(around),
        }
    }
}

/// Noise, clock and readout of one sensor. The unit `u` is m/s², rad/s or µT.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct SensorSpec {
    /// White noise density, u/√Hz; that of the grade where it is not given.
    pub white: Option<f64>,
    /// Bias random walk density, u/√s.
    pub random_walk: f64,
    /// Bias instability (flicker, 1/f), u.
    pub instability: f64,
    /// Distribution of single samples of white noise.
    pub distribution: Distribution,
    /// Corner of a low pass of second order that the white noise goes through, Hz.
    pub low_pass: Option<f64>,
    /// Correlation of neighbouring samples of the white noise, which keeps its density at low frequency.
    pub correlation: f64,
    /// Single readings that are far off.
    pub spikes: Option<Spikes>,
    /// Change of the bias from the begin to the end (norm), fast at first, u.
    pub thermal_drift: f64,
    /// Readings closer to zero than this are zero, u.
    pub dead_zone: f64,
    /// Least significant bit, u; 0 for none.
    pub step: f64,
    /// Write 16-bit counts around 32768 instead of units.
    pub counts: bool,
    /// Largest reading in either direction, u.
    pub range: Option<f64>,
    /// The sensor's clock.
    pub clock: Clock,
    /// The sensor's own rate where the recording has another: samples are held or interpolated.
    pub resampled: Option<Resampled>,
}

impl SensorSpec {
    pub(crate) fn readout(&self) -> Readout {
        Readout {
            range: self.range,
            step: self.step,
            counts: self.counts,
            dead_zone: self.dead_zone,
        }
    }

    /// SI units per unit of what is written down.
    pub(crate) fn unit_per_count(&self) -> f64 {
        if self.counts { self.step } else { 1.0 }
    }
}

impl Spec {
    /// A hand-held session of a consumer-grade device.
    pub fn hand_held(seed: u64) -> Self {
        Self {
            seed,
            ..Self::default()
        }
    }

    /// `seconds` at rest.
    pub fn still(seed: u64, seconds: f64) -> Self {
        let motion = Motion::Still(Still {
            duration: seconds,
            ..Still::default()
        });
        Self {
            seed,
            motion,
            ..Self::default()
        }
    }

    /// With this effect at `size` typical sizes, and with what it takes to show: temperature, a table
    /// that vibrates, a latitude.
    #[must_use]
    pub fn with_effect(mut self, name: &str, size: f64) -> Self {
        let of_text = || {
            let mut own = self.definitions.iter();
            own.find(|own| own.name == name)?.effect().ok()
        };
        let known = effect_named(name).or_else(of_text);
        let needs = known
            .as_ref()
            .map_or_else(Vec::new, |effect| effect.needs());
        if needs.iter().any(|need| need.is_thermal()) && self.temperature.is_none() {
            let mut temperature = Temperature::default();
            if needs.contains(&Quantity::Warming) {
                // It has to cool down as well.
                (temperature.swing, temperature.period) = (6.0, 300.0);
            }
            self.temperature = Some(temperature);
        }
        if needs.contains(&Quantity::Vibration) {
            self.vibration.get_or_insert_default();
        }
        if known
            .as_ref()
            .is_some_and(|e| e.sensor() == Sensor::Magnetometer)
        {
            self.magnetic_field.get_or_insert_default();
        }
        if known.is_some_and(|effect| effect.nature() == Nature::EarthRotation) {
            self.latitude.get_or_insert(45.0);
            return self;
        }
        self.effects
            .insert(name.to_owned(), BTreeMap::from([(SIZE.to_owned(), size)]));
        self
    }

    /// With something outside the catalogue of effects.
    #[must_use]
    pub fn with_hidden(mut self, hidden: Hidden) -> Self {
        self.hidden.push(hidden);
        self
    }

    /// With something that goes wrong.
    #[must_use]
    pub fn with_fault(mut self, fault: Fault) -> Self {
        self.faults.push(fault);
        self
    }

    /// Without white noise, random walk and instability.
    #[must_use]
    pub fn noise_free(mut self) -> Self {
        for sensor in [
            &mut self.accelerometer,
            &mut self.gyroscope,
            &mut self.magnetometer,
        ] {
            sensor.white = Some(0.0);
            sensor.random_walk = 0.0;
            sensor.instability = 0.0;
        }
        self
    }

    /// Gravity as it is, not as the estimator is told, m/s².
    pub fn true_gravity(&self) -> f64 {
        let factors = self.hidden.iter().map(Hidden::gravity_factor);
        self.gravity * factors.product::<f64>()
    }

    /// Share by which the stamps of the device run fast.
    pub(crate) fn clock_rate_error(&self) -> f64 {
        self.hidden.iter().map(Hidden::rate_error).sum()
    }

    /// Returns the specification of one sensor.
    pub fn sensor(&self, sensor: Sensor) -> &SensorSpec {
        match sensor {
            Sensor::Accelerometer => &self.accelerometer,
            Sensor::Gyroscope => &self.gyroscope,
            Sensor::Magnetometer => &self.magnetometer,
        }
    }

    /// Noise densities of one sensor.
    pub fn noise(&self, sensor: Sensor) -> Noise {
        let own = self.sensor(sensor);
        Noise {
            white: own.white.unwrap_or(self.grade.white(sensor)),
            random_walk: own.random_walk,
            instability: own.instability,
        }
    }

    /// The catalogue of one sensor with the definitions and the effects of another crate after it.
    ///
    /// # Errors
    /// The key of what is wrong with a definition, and what.
    pub(crate) fn catalogue(&self, sensor: Sensor) -> Result<Vec<EffectRef>, Complaint> {
        let defined = effects_of(&self.definitions)?;
        let mut all: Vec<_> = catalogue_of(sensor).chain(defined).collect();
        all.retain(|effect| effect.sensor() == sensor);
        for own in self.own.of(sensor) {
            if all.iter().any(|other| other.name() == own.name()) {
                let found = Finding::of(Kind::EFFECT_TAKEN).detail("name", own.name());
                return Err(Complaint::new(format!("effects.{}", own.name()), found));
            }
            all.push(own.clone());
        }
        Ok(all)
    }

    /// The effects with the earth's rotation in it, if there is a latitude.
    pub(crate) fn all_effects(&self) -> Effects {
        let mut effects = self.effects.clone();
        if let Some(latitude) = self.latitude {
            let (sin, cos) = latitude.to_radians().sin_cos();
            let rate = [("x", 0.0), ("y", EARTH_RATE * cos), ("z", EARTH_RATE * sin)];
            let rate = rate.map(|(axis, value)| (axis.to_owned(), value));
            effects.insert(earth_rotation().name().to_owned(), BTreeMap::from(rate));
        }
        effects
    }

    pub(crate) fn surroundings(&self) -> Surroundings<'_> {
        Surroundings {
            seed: self.seed,
            gravity: self.true_gravity(),
            vibration: self.vibration.as_ref(),
            unsteady: self.unsteady.as_ref(),
            faults: &self.faults,
        }
    }
}
