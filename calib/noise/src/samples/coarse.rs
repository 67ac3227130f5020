//! Readings in steps wider than their noise.

use nalgebra::Vector3;
use recording::averages::median;
use recording::readings::COARSE;

findings::tuning! {
    /// Readings of computed signals step by what rounding leaves: no step of a sensor is as small a share of them.
    SMALLEST: f64 = 1e-6;
}

/// An axis that reads in steps wider than its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coarse {
    /// Smallest step, in the unit of the samples.
    pub step: f64,
    /// Scatter of the readings, in the same unit.
    pub spread: f64,
}

impl Coarse {
    /// From the smallest step of an axis, and the spread and the mean of each second of it.
    ///
    /// Means that differ from one second to the next by more than a step are those of a sensor that is slower than its rows.
    pub(crate) fn of(step: f64, blocks: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let (spreads, means): (Vec<f64>, Vec<f64>) = blocks.unzip();
        let largest = means.iter().map(|mean| mean.abs()).fold(0.0, f64::max);
        let changes = means.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let change = median(changes).unwrap_or(0.0);
        let spread = median(spreads)?.hypot(change);
        let is_coarse =
            step.is_finite() && step > SMALLEST.get() * largest && COARSE.get() * spread < step;
        is_coarse.then_some(Self { step, spread })
    }
}

/// The smallest change of each axis from sample to sample; infinite where it never changes.
#[derive(Clone, Debug)]
pub(crate) struct LeastSteps {
    last: Option<Vector3<f64>>,
    least: Vector3<f64>,
}

impl Default for LeastSteps {
    fn default() -> Self {
        Self {
            last: None,
            least: Vector3::repeat(f64::INFINITY),
        }
    }
}

impl LeastSteps {
    /// The next sample.
    pub fn push(&mut self, value: &Vector3<f64>) {
        let Some(last) = self.last.replace(*value) else {
            return;
        };
        let changes = (value - last).map(f64::abs);
        for (least, change) in self.least.iter_mut().zip(changes.iter()) {
            if *change > 0.0 {
                *least = least.min(*change);
            }
        }
    }

    /// By axis.
    pub fn by_axis(&self) -> Vector3<f64> {
        self.least
    }

    /// The least of all axes; none where no axis changes.
    pub fn least(&self) -> Option<f64> {
        Some(self.least.min()).filter(|step| step.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_coarse_beside_a_small_spread_and_not_beside_a_large_one_or_means_that_wander() {
        let blocks =
            |spread: f64, wander: f64| (0..50).map(move |k| (spread, wander * f64::from(k % 3)));
        assert_eq!(
            Coarse::of(1.0, blocks(0.5, 0.0)),
            Some(Coarse {
                step: 1.0,
                spread: 0.5
            })
        );
        for (step, spread, wander) in [(1.0, 0.6, 0.0), (1.0, 0.0, 5.0), (f64::INFINITY, 0.0, 0.0)]
        {
            assert_eq!(Coarse::of(step, blocks(spread, wander)), None);
        }
    }
}
