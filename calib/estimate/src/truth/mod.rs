//! Kinematics at every instant of a recording: the one place that makes [`Kinematics`] outside the simulator.
//!
//! ```text
//! recording ─┐                 ┌─ at(t)          one instant: what `apply` corrects with
//! intervals ─┼─► Truth::of ──► ├─ at_rest(k)     the mean of a static interval
//! models ────┘  (or refusal)   └─ along(t, W)    the samples of a turn, on a clock of their own
//! ```
//! Fits, discovery, `apply`, `evaluate`, `bias` and `reckon` all ask here. What an effect needs and nobody can know is
//! an error that names both ([`require`]).

mod attitude;
mod corrector;
mod needs;
mod raw_unit;
mod rests;
mod sensing;
mod smooth_curve;
mod supposed;
#[cfg(test)]
mod tests;
mod thermal;

use effects::covariates::slope_at;
use nalgebra::Vector3;
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::attitude::Attitude;
use sensor::{Kinematics, Quantity, Sensor, Since};

pub use corrector::{Corrector, Sample};
pub use needs::{require, require_of_instants, silent_at_static_intervals, without_instant};
pub use raw_unit::RawUnit;
pub use sensing::{Models, Sensing};
pub use supposed::{supposed, unneeded};

pub(crate) use attitude::levelled;

use attitude::Path;
use rests::KnownRest;
use thermal::Thermal;

/// Corrections of one instant until both sensors agree: each sees the other's signal, and their effects are small.
const ROUNDS: usize = 2;

/// Kinematics of one recording, by its models and static intervals.
#[derive(Clone, Debug)]
pub struct Truth<'a> {
    recording: &'a Recording,
    models: Models,
    start: f64,
    rests: Vec<KnownRest>,
    path: Option<Path>,
    thermal: Thermal,
}

/// A reading at an instant.
#[derive(Clone, Copy, Debug)]
struct Reading {
    /// Near SI units.
    reading: Vector3<f64>,
    /// The signal's derivative by the base model, per second.
    slope: Vector3<f64>,
}

impl<'a> Truth<'a> {
    /// Builds it from `recording`, its `intervals` and the models so far; effects that are to be estimated have first
    /// values in them.
    ///
    /// # Errors
    /// [`Error::NotEnough`] where an effect of the models needs what cannot be known; it names both.
    pub fn of(
        recording: &'a Recording,
        intervals: Option<&Segmentation>,
        models: Models,
    ) -> Result<Self, Error> {
        for effect in models.effects() {
            require(recording, intervals, &models, effect)?;
        }
        let attitude = models
            .effects()
            .any(|effect| effect.needs().contains(&Quantity::Attitude));
        Ok(Self::new(recording, intervals, models, attitude))
    }

    /// The same without a question: what cannot be known is that of a device at rest at reference temperature. For
    /// candidates of which nobody knows yet whether they matter.
    pub fn as_far_as_known(
        recording: &'a Recording,
        intervals: Option<&Segmentation>,
        models: Models,
    ) -> Self {
        let attitude = intervals.is_some() && models.gyroscope.is_some();
        Self::new(recording, intervals, models, attitude)
    }

    fn new(
        recording: &'a Recording,
        intervals: Option<&Segmentation>,
        models: Models,
        attitude: bool,
    ) -> Self {
        let start = recording.start();
        let thermal = recording.temperature.as_ref();
        let thermal = thermal.map_or_else(Thermal::default, Thermal::of);
        let rests = intervals.map_or_else(Vec::new, |s| rests::of(recording, s, &models, &thermal));
        let path = intervals
            .filter(|_| attitude)
            .map(|s| Path::of(recording, s, &models, &rests));
        let mut truth = Self {
            recording,
            models,
            start,
            rests,
            path,
            thermal,
        };
        truth.give_rests_attitudes();
        truth
    }

    fn give_rests_attitudes(&mut self) {
        let Some(path) = &self.path else { return };
        for (rest, attitude) in self.rests.iter_mut().zip(&path.rests) {
            rest.known.attitude = *attitude;
        }
    }

    /// The models that it is by.
    pub fn models(&self) -> &Models {
        &self.models
    }

    /// The truth of static interval `k` as its means see it: nothing turns, time is that of the middle, temperature and its
    /// derivative are means.
    pub fn at_rest(&self, k: usize) -> Kinematics<f64> {
        self.rests.get(k).map_or_else(unneeded, |rest| rest.known)
    }

    /// When the turn before static interval `k` ended, s.
    pub fn turned(&self, k: usize) -> f64 {
        self.rests.get(k).map_or(self.start, |rest| rest.turned)
    }

    /// The mean derivative of the temperature over a stretch, K/s, and whether it rises (1) or falls (−1) in it.
    pub fn thermal(&self, from: f64, to: f64) -> [f64; 2] {
        self.thermal.over(from, to)
    }

    /// The truth at time `t`, s.
    pub fn at(&self, t: f64) -> Kinematics<f64> {
        let force = self.seen(Sensor::Accelerometer, t);
        let rate = self.seen(Sensor::Gyroscope, t);
        let attitude = self
            .path
            .as_ref()
            .map_or_else(Attitude::identity, |path| path.at(t));
        self.instant(t, force, rate, attitude)
    }

    /// The truth at samples of the gyroscope with the times `t` and the `readings` near SI units, on whatever clock the
    /// times are.
    pub fn along(&self, t: &[f64], readings: &[Vector3<f64>]) -> Vec<Kinematics<f64>> {
        let sensing = self.models.gyroscope.as_ref();
        let rates: Vec<Vector3<f64>> = match sensing {
            Some(sensing) => readings.iter().map(|w| sensing.base(w)).collect(),
            None => vec![Vector3::zeros(); readings.len()],
        };
        (0..t.len())
            .map(|k| {
                let rate = Reading {
                    reading: readings[k],
                    slope: slope_at(t, &rates, k),
                };
                let force = self.seen(Sensor::Accelerometer, t[k]);
                let attitude = self
                    .path
                    .as_ref()
                    .map_or_else(Attitude::identity, |path| path.at(t[k]));
                self.instant(t[k], force, sensing.map(|_| rate), attitude)
            })
            .collect()
    }

    /// The reading of a sensor at `t` and its slope; `None` without the sensor or without a model of it.
    fn seen(&self, sensor: Sensor, t: f64) -> Option<Reading> {
        let stream = self.recording.stream(sensor)?;
        let sensing = self.models.get(sensor)?;
        let near = stream
            .t
            .partition_point(|&s| s < t)
            .min(stream.len().checked_sub(1)?);
        let range = near.saturating_sub(2)..(near + 3).min(stream.len());
        let slope = slope_at(
            &stream.t[range.clone()],
            &stream.values[range.clone()],
            near - range.start,
        );
        Some(Reading {
            reading: sensing.unit.to_si(&stream.at(t)?),
            slope: sensing.slope(&slope),
        })
    }

    fn instant(
        &self,
        t: f64,
        force: Option<Reading>,
        rate: Option<Reading>,
        attitude: Attitude<f64>,
    ) -> Kinematics<f64> {
        let mut known = Kinematics {
            time: t - self.start,
            attitude,
            ..unneeded()
        };
        let celsius = self.recording.temperature.as_ref().and_then(|c| c.at(t));
        known.temperature = celsius.unwrap_or(known.temperature);
        [known.temperature_rate, known.warming] = self.thermal(t, t);
        if let Some(rest) = rests::last_before(&self.rests, t) {
            known.last_change = rest.known.last_change;
            known.last_turn = rest.known.last_turn;
            known.since_turn = Since::at(t - rest.turned);
            if t < rest.span.to {
                known.vibration = rest.known.vibration;
            }
        }
        known.specific_force_rate = force.map_or_else(Vector3::zeros, |f| f.slope);
        known.angular_acceleration = rate.map_or_else(Vector3::zeros, |w| w.slope);
        self.models.correct(
            &mut known,
            force.map(|f| f.reading),
            rate.map(|w| w.reading),
        );
        known
    }
}

impl Models {
    /// Fills in both signals from readings near SI units and all else that is known.
    fn correct(
        &self,
        known: &mut Kinematics<f64>,
        force: Option<Vector3<f64>>,
        rate: Option<Vector3<f64>>,
    ) {
        let force = self.accelerometer.as_ref().zip(force);
        let rate = self.gyroscope.as_ref().zip(rate);
        if let Some((sensing, reading)) = &force {
            known.specific_force = sensing.base(reading);
        }
        if let Some((sensing, reading)) = &rate {
            known.angular_rate = sensing.base(reading);
        }
        if self.effects().next().is_none() {
            return;
        }
        for _ in 0..ROUNDS {
            if let Some((sensing, reading)) = &force {
                known.specific_force = sensing.correct(reading, known);
            }
            if let Some((sensing, reading)) = &rate {
                known.angular_rate = sensing.correct(reading, known);
            }
        }
    }
}
