//! A bias that jumps between two values.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use sensor::{Axis, Sensor};
use serde::{Deserialize, Serialize};

use super::disturbance::{Disturbance, Instant};
use crate::random::Random;

/// `e = ±a` on one axis, the sign changing after times that are exponential with mean `dwell`: random
/// telegraph noise. It begins at `+a`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Telegraph {
    /// The sensor.
    pub sensor: Sensor,
    /// Its axis.
    pub axis: Axis,
    /// `a`, m/s² or rad/s.
    pub amplitude: f64,
    /// Mean time between two jumps, s.
    pub dwell: f64,
}

impl Telegraph {
    /// The jumps up to `end`, s.
    pub(super) fn draw(&self, end: f64, random: &mut Random) -> Drawn {
        let mut next = || -self.dwell * (1.0 - random.uniform(0.0..1.0)).ln();
        let mut jumps = Vec::new();
        let mut t = next();
        while t < end {
            jumps.push(t);
            t += next();
        }
        Drawn {
            telegraph: *self,
            jumps,
        }
    }
}

/// The bias and when it jumps.
#[derive(Debug)]
pub(super) struct Drawn {
    telegraph: Telegraph,
    jumps: Vec<f64>,
}

impl Disturbance for Drawn {
    fn error(&self, at: &Instant) -> Vector3<f64> {
        let jumped = self.jumps.partition_point(|&t| t <= at.time);
        let sign = if jumped % 2 == 0 { 1.0 } else { -1.0 };
        self.telegraph.axis.unit() * (self.telegraph.amplitude * sign)
    }

    fn drawn(&self) -> BTreeMap<String, Vec<f64>> {
        BTreeMap::from([("jumps".to_owned(), self.jumps.clone())])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;

    #[test]
    fn jumps_come_at_the_mean_time_asked_for_with_the_spread_of_an_exponential() {
        let telegraph = Telegraph {
            sensor: Sensor::Gyroscope,
            axis: Axis::X,
            amplitude: 1.0,
            dwell: 5.0,
        };
        let drawn = telegraph.draw(5e4, &mut Random::new(3, Purpose::Hidden(0)));
        let times: Vec<f64> = drawn.jumps.windows(2).map(|w| w[1] - w[0]).collect();
        let n = times.len() as f64;
        let mean = times.iter().sum::<f64>() / n;
        let spread = (times.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / n).sqrt();
        // Four standard errors: 1/√n = 1 % of the mean, √2 times that of the spread.
        assert!((mean - 5.0).abs() < 0.2, "{mean}");
        assert!((spread - 5.0).abs() < 0.3, "{spread}");
    }
}
