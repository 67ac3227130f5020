//! Trial of an effect that calls itself linear.

use crate::effect::any_effect::AnyEffect;
use crate::effect::needs::trials;

/// A difference below this share of the errors is rounding.
const ROUNDING: f64 = 1e-12;

/// Returns true if the effect says that it is linear, and is not: at a trial instant its error is not linear in the parameters, or it
/// changes with the sensor's own signal.
///
/// Readings are corrected in one step where all effects are linear, so that a wrong claim corrects wrongly.
pub fn is_linear_in_name_only(effect: &dyn AnyEffect) -> bool {
    effect.is_linear()
        && trials(effect).any(|(truth, p)| {
            let own = effect.sensor();
            let error = effect.error_f64(&truth, &p);
            let thrice: Vec<f64> = p.iter().map(|p| 3.0 * p).collect();
            let elsewhere = truth.with_signal(own, truth.signal(own) * -0.6);
            let is_off = |other| {
                ((error - other) as nalgebra::Vector3<f64>).norm() > ROUNDING * error.norm()
            };
            is_off(effect.error_f64(&truth, &thrice) / 3.0)
                || is_off(effect.error_f64(&elsewhere, &p))
        })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use solver::Scalar;

    use super::*;
    use crate::{Effect, Kinematics, Param, Sensor, params};

    /// Linear in its parameters, and in sight of its own signal or of the other one.
    struct Leak<const OWN: bool>;

    impl<const OWN: bool> Effect for Leak<OWN> {
        const NAME: &'static str = "gyro_leak";
        const SENSOR: Sensor = Sensor::Gyroscope;
        const EQUATION: &'static str = "W_i += k_i s_i";
        const PARAMS: &'static [Param] = &params("", ["x", "y", "z"]);
        const TYPICAL: f64 = 1e-3;
        const LINEAR: bool = true;

        fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
            let seen = if OWN {
                &truth.angular_rate
            } else {
                &truth.specific_force
            };
            Vector3::from_fn(|i, _| p[i] * seen[i])
        }
    }

    #[test]
    fn an_effect_of_its_own_signal_is_not_linear() {
        assert!(is_linear_in_name_only(&Leak::<true>));
        assert!(!is_linear_in_name_only(&Leak::<false>));
    }
}
