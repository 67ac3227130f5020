//! Temperature dependence of the misalignment of a gyroscope.

use nalgebra::Vector3;
use sensor::{
    Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, off_diagonal, params,
};
use solver::{Scalar, lit};

/// Axes that lean towards one another as the device warms up: `eᵢ = Σⱼ cᵢⱼ (T − T₀) ωⱼ` over the two other axes.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | gyroscope error | rad/s | 3 |
/// | `c` | temperature coefficient of the misalignment; its diagonal is `gyro_scale_temperature` | rad/K | 6 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `ω` | angular rate | rad/s | 3 |
///
/// A recording shows it that has each orientation warm and cold.
#[derive(Clone, Copy, Debug)]
pub struct GyroMisalignmentTemperature;

impl Effect for GyroMisalignmentTemperature {
    const NAME: &'static str = "gyro_misalignment_temperature";
    const SENSOR: Sensor = Sensor::Gyroscope;
    const EQUATION: &'static str = "W_i += Σ_j c_ij (T - T0) w_j, j ≠ i";
    const FORMULA: Option<&'static str> = Some("dT * ({i}{j} * w{j} + {i}{k} * w{k})");
    const PARAMS: &'static [Param] = &params("rad/K", ["xy", "xz", "yx", "yz", "zx", "zy"]);
    const TYPICAL: f64 = 1e-4;
    const NEEDS: Option<&'static [Quantity]> =
        Some(&[Quantity::AngularRate, Quantity::Temperature]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        off_diagonal(p) * truth.angular_rate * lit::<D>(warmer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_reads_its_neighbours_by_ten_kelvin_times_the_coefficient() {
        let signal = Vector3::new(1.0, 2.0, 3.0);
        let truth = Kinematics {
            temperature: 35.0,
            ..Kinematics::new(signal, signal)
        };
        let p = [1e-4, 0.0, 0.0, 2e-4, 0.0, -1e-4];
        let e = GyroMisalignmentTemperature.error(&truth, &p);
        assert!((e - Vector3::new(2e-3, 6e-3, -2e-3)).norm() < 1e-15);
    }
}
