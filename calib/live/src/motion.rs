//! Still or not, as it happens: level and spread of both sensors over the last second.

use nalgebra::Vector3;
use serde::Serialize;

findings::tuning! {
    /// Length of the window, s.
    pub(crate) WINDOW: f64 = 1.0;
    /// Fewest samples in it whose spread means something.
    FEWEST: usize = 5;

    /// A window is quiet where its spread is within this factor of the quietest so far: the detector that cuts the recording
    /// later takes ten times the variance.
    FACTOR: f64 = 3.0;
}

/// Limits of what counts as quiet whatever the quietest was: of the accelerometer in units of gravity, of the gyroscope
/// in rad/s. The lower ones are below the noise of any hand-held device, the upper ones below a hand's tremor.
const ACCELEROMETER: [f64; 2] = [0.002, 0.03];
const GYROSCOPE: [f64; 2] = [0.002, 0.025];

findings::tuning! {
    /// A mean rate that no bias explains is a turn, rad/s.
    LEVEL: f64 = 0.02;
    /// The same as long as the bias is not known: it may be as large as that.
    ANY_BIAS: f64 = 0.1;

    /// A hand that holds still turns slower than this, rad/s.
    SLOW: f64 = 0.2;
    /// It wavers less than this, rad/s.
    WAVERING: f64 = 0.25;
}

/// State of motion of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// Too few samples, or an interruption.
    Unknown,
    /// It lies still.
    Still,
    /// It wavers as in a hand that holds it still.
    InHand,
    /// It does not turn, but its accelerometer is shaken, as on a table that vibrates.
    Shaken,
    /// It turns.
    Turning,
}

/// Spread and level of the window before an instant.
#[derive(Clone, Copy, Debug)]
struct Window {
    force_spread: f64,
    rate_spread: f64,
    rate: Vector3<f64>,
}

/// The detector, which learns how quiet the sensors can be.
#[derive(Clone, Debug)]
pub(crate) struct Detector {
    quietest: [f64; 2],
    /// Mean rates of the placements so far, rad/s.
    biases: Vec<Vector3<f64>>,
}

impl Default for Detector {
    fn default() -> Self {
        Self {
            quietest: [f64::INFINITY; 2],
            biases: Vec::new(),
        }
    }
}

impl Detector {
    /// Classifies the motion in a window: specific force in units of gravity, angular rate in rad/s.
    pub(crate) fn judge(&mut self, force: &[Vector3<f64>], rate: &[Vector3<f64>]) -> Motion {
        if force.len() < FEWEST.get() || rate.len() < FEWEST.get() {
            return Motion::Unknown;
        }
        let window = Window {
            force_spread: moments(force).1,
            rate_spread: moments(rate).1,
            rate: moments(rate).0,
        };
        let spreads = [window.force_spread, window.rate_spread];
        let mut within = [false; 2];
        for (k, limits) in [ACCELEROMETER, GYROSCOPE].into_iter().enumerate() {
            self.quietest[k] = self.quietest[k].min(spreads[k]);
            within[k] = spreads[k] <= (FACTOR.get() * self.quietest[k]).clamp(limits[0], limits[1]);
        }
        let turning = self.turning(&window.rate);
        match within {
            [true, true] if turning < self.level() => Motion::Still,
            _ if turning > SLOW.get() || window.rate_spread > WAVERING.get() => Motion::Turning,
            [_, true] if turning >= self.level() => Motion::Turning,
            [_, false] => Motion::InHand,
            _ => Motion::Shaken,
        }
    }

    /// Notes the mean rate of a placement.
    pub(crate) fn learn(&mut self, rate: &[Vector3<f64>]) {
        self.biases.push(moments(rate).0);
    }

    fn level(&self) -> f64 {
        if self.biases.is_empty() {
            ANY_BIAS.get()
        } else {
            LEVEL.get()
        }
    }

    /// The rate beyond the bias, which is the median of those of the placements, rad/s.
    fn turning(&self, rate: &Vector3<f64>) -> f64 {
        let median = |axis: usize| {
            let mut values: Vec<f64> = self.biases.iter().map(|b| b[axis]).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or(0.0)
        };
        (rate - Vector3::from_fn(|axis, _| median(axis))).norm()
    }
}

/// Mean and root mean square spread per axis.
pub(crate) fn moments(values: &[Vector3<f64>]) -> (Vector3<f64>, f64) {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<Vector3<f64>>() / count;
    let squares: f64 = values.iter().map(|v| (v - mean).norm_squared()).sum();
    (mean, (squares / 3.0 / (count - 1.0).max(1.0)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A second of samples about `mean` that waver by `size` at 9 Hz beside noise of `noise`.
    fn window(mean: Vector3<f64>, size: f64, noise: f64) -> Vec<Vector3<f64>> {
        let value = |k: usize| {
            let wave = size * 1.41 * (std::f64::consts::TAU * 9.0 * 0.01 * k as f64).sin();
            let jitter = noise * ((k * k % 97) as f64 / 28.0 - 1.73);
            mean + Vector3::repeat(wave + jitter)
        };
        (0..100).map(value).collect()
    }

    #[test]
    fn level_and_spread_of_both_sensors_tell_what_it_does() {
        let mut detector = Detector::default();
        let up = Vector3::z();
        let (quiet_f, quiet_w) = (window(up, 0.0, 0.001), window(Vector3::zeros(), 0.0, 0.003));
        assert_eq!(detector.judge(&quiet_f, &quiet_w), Motion::Still);
        detector.learn(&quiet_w);
        let about_vertical = window(Vector3::z() * 0.05, 0.0, 0.003);
        assert_eq!(
            detector.judge(&quiet_f, &about_vertical),
            Motion::Turning,
            "a steady turn is no rest"
        );
        let tremor = window(Vector3::zeros(), 0.05, 0.003);
        assert_eq!(
            detector.judge(&window(up, 0.01, 0.001), &tremor),
            Motion::InHand
        );
        assert_eq!(
            detector.judge(&window(up, 0.05, 0.001), &quiet_w),
            Motion::Shaken
        );
        assert_eq!(
            detector.judge(&quiet_f, &window(Vector3::x() * 2.0, 0.3, 0.003)),
            Motion::Turning
        );
        assert_eq!(detector.judge(&quiet_f[..3], &quiet_w), Motion::Unknown);
    }
}
