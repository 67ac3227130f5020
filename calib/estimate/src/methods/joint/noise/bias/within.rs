//! Evidence of the biases' noise from the slopes of the readings within static intervals: no error of a model shows
//! there.

use recording::averages::median;
use sensor::Sensor;

use super::{IN_SLOPE, WALK_IN_SLOPE};
use crate::methods::joint::data::Data;
use crate::methods::joint::noise::weights::ComponentKind;

findings::tuning! {
    /// Squares beyond this many times the usual one are of intervals in which something moved: they count as so much.
    MOST: f64 = 9.0;

    /// The median of the square of a normal number of variance one.
    MEDIAN_SQUARE: f64 = 0.455;
}

/// The slope of a chunk on one axis over what white noise makes of it: `y ~ N(0, 1 + Σ θ_c s_c)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Within {
    /// `y²`.
    pub square: f64,
    /// `s_c` of every component.
    pub by_component: Vec<f64>,
}

impl Within {
    /// Its variance at these variances of the components.
    pub fn variance(&self, theta: &[f64]) -> f64 {
        let parts = self.by_component.iter().zip(theta);
        1.0 + parts.map(|(s, t)| s * t).sum::<f64>()
    }

    /// Its log-likelihood there, up to a constant.
    pub fn log_likelihood(&self, theta: &[f64]) -> f64 {
        let v = self.variance(theta);
        -0.5 * (v.ln() + self.square / v)
    }
}

/// The slopes of all chunks, with what each of `kinds` adds to their variance at unit size.
pub fn within(data: &Data, kinds: &[ComponentKind]) -> Vec<Within> {
    let mut all = Vec::new();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let mut own = of_sensor(data, sensor, kinds);
        let squares = own.iter().map(|w| w.square);
        let most = median(squares).map_or(f64::INFINITY, |m| {
            MOST.get() * (m / MEDIAN_SQUARE.get()).max(1.0)
        });
        own.iter_mut().for_each(|w| w.square = w.square.min(most));
        all.extend(own);
    }
    all
}

fn of_sensor(data: &Data, sensor: Sensor, kinds: &[ComponentKind]) -> Vec<Within> {
    let mut all = Vec::new();
    for chunk in &data.chunks {
        let source = &data.sources[data.rests[chunk.rest].recording];
        let (Some(mean), Some(noise)) = (chunk.mean(sensor), source.noise(sensor)) else {
            continue;
        };
        let white = noise.variance_of(&mean) * (mean.count as f64 / mean.spread);
        let t = mean.span.length().max(1e-9);
        let adds = |kind: &ComponentKind, axis: usize| match (kind, sensor) {
            (ComponentKind::AccelerometerWalk, Sensor::Accelerometer)
            | (ComponentKind::GyroscopeWalk, Sensor::Gyroscope) => WALK_IN_SLOPE.get() / t,
            (ComponentKind::AccelerometerFlicker(own), Sensor::Accelerometer)
            | (ComponentKind::GyroscopeFlicker(own), Sensor::Gyroscope)
                if *own == axis =>
            {
                IN_SLOPE / (t * t)
            }
            _ => 0.0,
        };
        for axis in 0..3 {
            let variance = white[axis];
            if variance > 0.0 && mean.slope[axis].is_finite() {
                all.push(Within {
                    square: mean.slope[axis].powi(2) / variance,
                    by_component: kinds.iter().map(|k| adds(k, axis) / variance).collect(),
                });
            }
        }
    }
    all
}
