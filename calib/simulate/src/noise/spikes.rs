//! Single readings that are far off.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::random::Random;

/// Spikes: now and then one axis of one sample is off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub struct Spikes {
    /// Share of the samples.
    pub share: f64,
    /// By how much, in either direction, u.
    pub size: f64,
}

impl Spikes {
    /// Draws the error that is added to the next sample, in the unit of `size`.
    pub(crate) fn draw(&self, random: &mut Random) -> Vector3<f64> {
        let mut spike = Vector3::zeros();
        if random.uniform(0.0..1.0) < self.share {
            spike[random.below(3)] = self.size * random.sign();
        }
        spike
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;

    #[test]
    fn as_many_samples_spike_as_were_asked_for_and_by_as_much() {
        let spikes = Spikes {
            share: 0.01,
            size: 2.0,
        };
        let mut random = Random::new(1, Purpose::Motion);
        let drawn: Vec<_> = (0..100_000).map(|_| spikes.draw(&mut random)).collect();
        let hit: Vec<_> = drawn.iter().filter(|s| s.norm() > 0.0).collect();
        assert!(hit.iter().all(|s| s.norm() == 2.0));
        // √(100,000 · 0.01) = 32; four of them.
        assert!(hit.len().abs_diff(1000) < 128, "{}", hit.len());
    }
}
