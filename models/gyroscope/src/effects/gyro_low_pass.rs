//! Smoothing of the rate by a filter.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// The rate as a low-pass filter leaves it, to second order: `ω + ½ v ω̈`. Over a turn that begins and ends at rest
/// `∫ R ω̈ dt = −∫ R (ω × ω̇) dt`, so that `e = −½ v (ω × ω̇)` turns the device by as much. The delay of the filter turns it by
/// nothing.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error, as a whole turn has it | rad/s | 3 |
/// | `v` | variance of the filter's impulse response; `τ²` where the filter is `1/(1 + τ s)` | s² | 1 |
/// | `ω`, `ω̇` | angular rate, angular acceleration | rad/s, rad/s² | 3 |
/// | `R` | rotation of the device since the start of the turn | | 3 × 3 |
#[derive(Clone, Copy, Debug)]
pub struct GyroLowPass;

impl Effect for GyroLowPass {
    const NAME: &'static str = "gyro_low_pass";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W += v/2 (dw/dt x w)";
    const PARAMS: &'static [Param] = &params("s^2", ["v"]);
    const TYPICAL: f64 = 2e-5;
    const POSITIVE: bool = true;
    const NEEDS: Option<&'static [Quantity]> =
        Some(&[Quantity::AngularRate, Quantity::AngularAcceleration]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let (w, alpha) = (truth.angular_rate, truth.angular_acceleration);
        let half = p[0] * 0.5;
        Vector3::from_fn(|i, _| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            half * (w[k] * alpha[j] - w[j] * alpha[k])
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    /// Rotation by rates at the middles of steps of `dt`.
    fn rotation(rate: impl Fn(f64) -> Vector3<f64>, dt: f64) -> Rotation3<f64> {
        let steps = (4.0 / dt) as usize;
        let at = |k| rate((k as f64 + 0.5) * dt) * dt;
        (0..steps).fold(Rotation3::identity(), |r, k| r * Rotation3::new(at(k)))
    }

    #[test]
    fn it_turns_the_device_as_the_smoothed_rate_does() {
        // A bell about x, and one about y that is later.
        let bell = |t: f64, centre: f64| 2.0 * (-(t - centre).powi(2) / 0.18).exp();
        let rate = |t: f64| Vector3::new(bell(t, 1.8), bell(t, 2.2), 0.0);
        let step = 1e-3;
        let slope = |t: f64| (rate(t + step) - rate(t - step)) / (2.0 * step);
        let (v, h) = (1e-3_f64, 1e-3_f64.sqrt());
        // Half of it a standard deviation early, half of it late: a filter of variance v.
        let smoothed = |t: f64| (rate(t - h) + rate(t + h)) * 0.5;
        let by_effect = |t: f64| {
            let truth = Kinematics {
                angular_rate: rate(t),
                angular_acceleration: slope(t),
                ..Kinematics::at_rest(Vector3::zeros())
            };
            rate(t) + GyroLowPass.error(&truth, &[v])
        };
        let [truth, filtered, effect] = [
            rotation(rate, step),
            rotation(smoothed, step),
            rotation(by_effect, step),
        ];
        let turned = truth.angle_to(&filtered);
        assert!(turned > 2e-3, "{turned}");
        assert!(filtered.angle_to(&effect) < 0.03 * turned, "{turned}");
    }
}
