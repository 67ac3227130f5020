//! Disturbances by a device or its surroundings that no effect of the catalogue describes.
//!
//! A disturbance adds an error to the raw reading. It is for tests of what is found when nothing that
//! is known fits; each has one `amplitude` that sets its size.

mod disturbance;
mod heading;
mod pattern;
mod periodic;
mod relaxation;
mod rezeroing;
mod size_effect;
mod telegraph;

use std::collections::BTreeMap;
use std::sync::Arc;

use sensor::Sensor;
use serde::{Deserialize, Serialize};

use super::motion::Motion;
use super::random::{Purpose, Random};
use super::spec::complaint::{Complaint, number};

pub(crate) use disturbance::{Disturbance, Instant};
pub use heading::Heading;
pub use pattern::Pattern;
pub use periodic::Periodic;
pub use relaxation::Relaxation;
pub use rezeroing::Rezeroing;
pub use size_effect::SizeEffect;
pub use telegraph::Telegraph;

/// Something outside the catalogue of effects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Hidden {
    /// A bias that swings.
    Periodic(Periodic),
    /// A bias that depends on orientation in fine detail.
    Pattern(Pattern),
    /// A bias that jumps between two values.
    Telegraph(Telegraph),
    /// A bias fixed in the world, like that of a magnetic field.
    Heading(Heading),
    /// A bias that decays after each turn.
    Relaxation(Relaxation),
    /// A bias that jumps at the same time into every rest.
    Rezeroing(Rezeroing),
    /// The three accelerometers sit in different places. Not to be seen in turns by hand.
    SizeEffect(SizeEffect),
    /// Gravity is not what the estimator is told. Not to be seen without another source.
    WrongGravity {
        /// True gravity over the spec's `gravity`, less 1.
        amplitude: f64,
    },
    /// The clock of both sensors and the thermometer runs fast. Not to be seen without another clock.
    FastClock {
        /// Seconds that it says too much per second.
        amplitude: f64,
    },
}

/// A disturbance and the sensor that it disturbs.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    /// Disturbed sensor.
    pub sensor: Sensor,
    /// The disturbance.
    pub disturbance: Arc<dyn Disturbance>,
}

/// Truth about a hidden disturbance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HiddenTruth {
    /// Its name in a spec.
    pub name: String,
    /// Its size, in the unit of the spec.
    pub amplitude: f64,
    /// Random values that were drawn for it, by name.
    pub drawn: BTreeMap<String, Vec<f64>>,
}

impl Hidden {
    /// Its name in a spec.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Periodic(_) => "periodic",
            Self::Pattern(_) => "pattern",
            Self::Telegraph(_) => "telegraph",
            Self::Heading(_) => "heading",
            Self::Relaxation(_) => "relaxation",
            Self::Rezeroing(_) => "rezeroing",
            Self::SizeEffect(_) => "size_effect",
            Self::WrongGravity { .. } => "wrong_gravity",
            Self::FastClock { .. } => "fast_clock",
        }
    }

    /// Its size: m/s² or rad/s of a bias, m of the size effect, a share of gravity or time.
    pub fn amplitude(&self) -> f64 {
        let mut copy = self.clone();
        *copy.amplitude_mut()
    }

    /// The same with another size.
    #[must_use]
    pub fn with_amplitude(mut self, amplitude: f64) -> Self {
        *self.amplitude_mut() = amplitude;
        self
    }

    fn amplitude_mut(&mut self) -> &mut f64 {
        match self {
            Self::Periodic(Periodic { amplitude, .. })
            | Self::Pattern(Pattern { amplitude, .. })
            | Self::Telegraph(Telegraph { amplitude, .. })
            | Self::Heading(Heading { amplitude, .. })
            | Self::Relaxation(Relaxation { amplitude, .. })
            | Self::Rezeroing(Rezeroing { amplitude, .. })
            | Self::SizeEffect(SizeEffect { amplitude })
            | Self::WrongGravity { amplitude }
            | Self::FastClock { amplitude } => amplitude,
        }
    }

    /// True gravity over what the estimator is told.
    pub(crate) fn gravity_factor(&self) -> f64 {
        match self {
            Self::WrongGravity { amplitude } => 1.0 + amplitude,
            _ => 1.0,
        }
    }

    /// Share by which the stamps run fast.
    pub(crate) fn rate_error(&self) -> f64 {
        match self {
            Self::FastClock { amplitude } => *amplitude,
            _ => 0.0,
        }
    }

    /// The disturbance at `place` in the list, drawn for this motion; `None` for those that change
    /// the world or the clock instead of a reading.
    pub(crate) fn place(&self, seed: u64, place: usize, motion: &Motion) -> Option<Placed> {
        let mut random = Random::new(seed, Purpose::Hidden(place));
        let (sensor, disturbance): (Sensor, Arc<dyn Disturbance>) = match self {
            Self::Periodic(periodic) => (periodic.sensor, Arc::new(*periodic)),
            Self::Pattern(pattern) => (pattern.sensor, Arc::new(pattern.draw(&mut random))),
            Self::Telegraph(telegraph) => {
                let drawn = telegraph.draw(motion.end(), &mut random);
                (telegraph.sensor, Arc::new(drawn))
            }
            Self::Heading(heading) => (heading.sensor, Arc::new(*heading)),
            Self::Relaxation(relaxation) => (relaxation.sensor, Arc::new(relaxation.along(motion))),
            Self::Rezeroing(rezeroing) => {
                let drawn = rezeroing.along(motion, &mut random);
                (rezeroing.sensor, Arc::new(drawn))
            }
            Self::SizeEffect(size) => (Sensor::Accelerometer, Arc::new(size.draw(&mut random))),
            Self::WrongGravity { .. } | Self::FastClock { .. } => return None,
        };
        Some(Placed {
            sensor,
            disturbance,
        })
    }

    /// Checks its numbers; the error names the key.
    pub(crate) fn check(&self, place: usize) -> Result<(), Complaint> {
        let key = |name: &str| format!("hidden.{place}.{}.{name}", self.name());
        let largest = match self {
            Self::SizeEffect(_) => 1.0,
            Self::WrongGravity { .. } => 0.5,
            Self::FastClock { .. } => 0.1,
            _ => 1e6,
        };
        number(&key("amplitude"), self.amplitude(), -largest..=largest)?;
        match self {
            Self::Periodic(p) => {
                number(&key("period"), p.period, 1e-3..=1e9)?;
                number(&key("phase"), p.phase, -1e3..=1e3)
            }
            Self::Pattern(p) => number(&key("wavenumber"), p.wavenumber, 0.1..=100.0),
            // Switches are held in memory: at most some millions.
            Self::Telegraph(t) => number(&key("dwell"), t.dwell, 1.0..=1e9),
            Self::Heading(h) => number(&key("azimuth"), h.azimuth, -1e3..=1e3),
            Self::Relaxation(r) => number(&key("tau"), r.tau, 1e-3..=1e9),
            Self::Rezeroing(r) => number(&key("after"), r.after, 0.0..=1e9),
            Self::SizeEffect(_) | Self::WrongGravity { .. } | Self::FastClock { .. } => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
