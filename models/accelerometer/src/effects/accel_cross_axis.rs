//! Cross-axis nonlinearity of an accelerometer.

use nalgebra::Vector3;
use sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
use solver::Scalar;

/// The product of the two cross axes leaks into the third: `eᵢ = kᵢ fⱼ fₖ` with `i, j, k` cyclic.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `k` | cross-axis coefficient | 1/(m/s²) | 3 |
/// | `f` | specific force | m/s² | 3 |
#[derive(Clone, Copy, Debug)]
pub struct AccelCrossAxis;

impl Effect for AccelCrossAxis {
    const NAME: &'static str = "accel_cross_axis";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += k_i f_j f_k";
    const FORMULA: Option<&'static str> = Some("{i} * f{j} * f{k}");
    const PARAMS: &'static [Param] = &params("1/(m/s^2)", ["x", "y", "z"]);
    const TYPICAL: f64 = 1e-4;
    const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::SpecificForce]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let f = &truth.specific_force;
        Vector3::from_fn(|i, _| p[i] * f[(i + 1) % 3] * f[(i + 2) % 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn x_reads_the_product_of_y_and_z() {
        let e = AccelCrossAxis.error(
            &Kinematics::at_rest(Vector3::new(10.0, -2.0, 5.0)),
            &[1e-4, 1e-4, 1e-4],
        );
        assert!((e - Vector3::new(-1e-3, 5e-3, -2e-3)).norm() < 1e-15);
    }
}
