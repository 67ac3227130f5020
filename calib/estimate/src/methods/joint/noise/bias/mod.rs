//! Noise of the biases beside white noise: random walk and flicker.

mod flicker;
mod rows;
mod within;

use sensor::Sensor;
use serde::Serialize;

use super::weights::{ComponentKind, NoiseLevel};

pub use flicker::{Fading, Flicker, IN_SLOPE};
pub use within::{Within, within};

findings::tuning! {
    /// The mean square of the slope over a window of length `T` of a random walk of unit density is `6/5 / T`.
    pub WALK_IN_SLOPE: f64 = 1.2;
}

/// Noise of the biases, of accelerometer and gyroscope.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BiasNoise {
    /// Density of the random walk, m/s²/√s and rad/s/√s.
    pub walk: [f64; 2],
    /// Bias instability `B` of every axis, m/s² and rad/s: two-sided density `B²/(2πf)`, Allan deviation flat at
    /// `0.664 B`.
    pub flicker: [[f64; 3]; 2],
}

/// Kinds of noise in the order accelerometer, gyroscope.
const WALKS: [ComponentKind; 2] = [
    ComponentKind::AccelerometerWalk,
    ComponentKind::GyroscopeWalk,
];
const FLICKERS: [[ComponentKind; 3]; 2] = [
    [
        ComponentKind::AccelerometerFlicker(0),
        ComponentKind::AccelerometerFlicker(1),
        ComponentKind::AccelerometerFlicker(2),
    ],
    [
        ComponentKind::GyroscopeFlicker(0),
        ComponentKind::GyroscopeFlicker(1),
        ComponentKind::GyroscopeFlicker(2),
    ],
];

impl BiasNoise {
    /// Random walks of these densities.
    pub fn walks(walk: [f64; 2]) -> Self {
        Self {
            walk,
            ..Self::default()
        }
    }

    /// Kinds and sizes, walks first.
    pub fn sizes(&self) -> impl Iterator<Item = (ComponentKind, f64)> + use<> {
        let flickers = FLICKERS.into_iter().flatten();
        let kinds = WALKS.into_iter().chain(flickers);
        let sizes = self.walk.into_iter();
        kinds.zip(sizes.chain(self.flicker.into_iter().flatten()))
    }

    /// Levels of the components.
    pub fn levels(&self) -> Vec<NoiseLevel> {
        let of = |(kind, size)| NoiseLevel { kind, size };
        self.sizes().map(of).collect()
    }

    /// The noise at these levels.
    pub fn of(levels: &[NoiseLevel]) -> Self {
        let size = |kind: ComponentKind| {
            let found = levels.iter().find(|level| level.kind == kind);
            found.map_or(0.0, |level| level.size)
        };
        Self {
            walk: WALKS.map(size),
            flicker: FLICKERS.map(|axes| axes.map(size)),
        }
    }

    /// The kind of the walk of a sensor's bias.
    pub fn walk_of(sensor: Sensor) -> ComponentKind {
        WALKS[usize::from(sensor == Sensor::Gyroscope)]
    }

    /// Shares of the walk and of the flicker of one sensor.
    #[must_use]
    pub fn with_shares(mut self, sensor: Sensor, walk: f64, flicker: f64) -> Self {
        let place = usize::from(sensor == Sensor::Gyroscope);
        self.walk[place] *= walk;
        self.flicker[place].iter_mut().for_each(|b| *b *= flicker);
        self
    }

    /// The walk of one sensor, of this density, and a share of its flicker.
    #[must_use]
    pub fn with_walk(self, sensor: Sensor, walk: f64, flicker: f64) -> Self {
        let mut noise = self.with_shares(sensor, 1.0, flicker);
        noise.walk[usize::from(sensor == Sensor::Gyroscope)] = walk;
        noise
    }

    /// The noise of one sensor's bias as in `other`.
    #[must_use]
    pub fn with_bias_of(mut self, sensor: Sensor, other: &Self) -> Self {
        let place = usize::from(sensor == Sensor::Gyroscope);
        self.walk[place] = other.walk[place];
        self.flicker[place] = other.flicker[place];
        self
    }

    /// Returns true if the bias of a sensor flickers on some axis.
    pub fn flickers(&self, sensor: Sensor) -> bool {
        self.flicker_of(sensor).iter().any(|b| *b > 0.0)
    }

    /// The flicker of a sensor's bias, by axis.
    pub fn flicker_of(&self, sensor: Sensor) -> [f64; 3] {
        self.flicker[usize::from(sensor == Sensor::Gyroscope)]
    }

    /// Mean square of the slope of a line through a window of `length` seconds, of one axis of one sensor (0 or 1).
    pub fn slope_variance(&self, place: usize, axis: usize, length: f64) -> f64 {
        let t = length.max(1e-9);
        let walk = WALK_IN_SLOPE.get() * self.walk[place].powi(2) / t;
        walk + IN_SLOPE * (self.flicker[place][axis] / t).powi(2)
    }
}
