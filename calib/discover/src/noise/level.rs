//! The settings of the densities at which hypotheses are tried.

use estimate::methods::joint::BiasNoise;
use sensor::Sensor;

use super::projected::{Projected, Whitened};

/// Shares of the likeliest walk and flicker at which hypotheses are tried too: what is taken for them when nothing is
/// missing may be the effect.
const SHARES: [[f64; 2]; 7] = [
    [0.7, 0.7],
    [0.45, 0.45],
    [0.2, 0.2],
    [0.0, 1.0],
    [1.0, 0.0],
    [0.0, 0.45],
    [0.0, 0.0],
];

/// Shares of the variance by which turns scatter that are tried too: what is taken for scatter may be the effect.
pub const SCATTERS: [f64; 4] = [0.5, 0.2, 0.05, 0.0];

/// One setting of the densities.
#[derive(Clone, Debug)]
pub struct Level {
    /// The noise of the biases.
    pub noise: BiasNoise,
    /// Share of the scatter of the turns.
    pub scatter: f64,
    /// The disagreement there.
    pub whitened: Whitened,
    /// The sensor whose density differs from the likeliest; both hold the same there.
    pub of: Option<Sensor>,
    /// Logarithm of its prior probability among those of its sensor.
    pub log_prior: f64,
}

impl Level {
    /// The level of this noise and share of the scatter; `None` where the disagreement is not finite there.
    pub fn at(
        projected: &Projected,
        (noise, scatter): (BiasNoise, f64),
        of: Option<Sensor>,
        log_prior: f64,
    ) -> Option<Self> {
        Some(Self {
            noise,
            scatter,
            whitened: projected.at_share(noise, scatter)?,
            of,
            log_prior,
        })
    }

    /// Returns true if noise of this sensor's bias is judged at this setting.
    pub fn is_of(&self, sensor: Sensor) -> bool {
        self.of.is_none_or(|own| own == sensor)
    }

    /// Returns true if the bias of the sensor that this setting is of has no noise.
    pub fn is_without_noise(&self) -> bool {
        self.of
            .is_some_and(|sensor| self.noise == self.noise.with_shares(sensor, 0.0, 0.0))
    }

    /// Returns true if errors of this sensor are tried at this setting.
    ///
    /// Errors of the gyroscope are tried at every setting: the turns are compared with the accelerometer's directions, so
    /// that an error of the gyroscope can look like a random walk of the accelerometer's bias.
    pub fn is_for(&self, sensor: Sensor) -> bool {
        sensor == Sensor::Gyroscope || self.is_of(sensor)
    }
}

/// The likeliest noise, then for each sensor shares of it, then shares of the scatter of turns.
pub fn levels(projected: &Projected, noise: BiasNoise, given: bool) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let mut add = |noise: BiasNoise, scatter: f64, of: Option<Sensor>| {
        let is_there = |level: &Level| level.noise == noise && level.scatter == scatter;
        if levels.iter().any(is_there) {
            return;
        }
        levels.extend(Level::at(projected, (noise, scatter), of, 0.0));
    };
    add(noise, 1.0, None);
    if given {
        return levels;
    }
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        for [walk, flicker] in SHARES {
            add(noise.with_shares(sensor, walk, flicker), 1.0, Some(sensor));
        }
    }
    if projected.scatters {
        for share in SCATTERS {
            add(noise, share, None);
        }
    }
    levels
}
