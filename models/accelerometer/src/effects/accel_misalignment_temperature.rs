//! Temperature dependence of the misalignment of an accelerometer.

use nalgebra::Vector3;
use sensor::{
    Effect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, Sensor, off_diagonal, params,
};
use solver::{Scalar, lit};

/// Axes that lean towards one another as the device warms up: `eᵢ = Σⱼ cᵢⱼ (T − T₀) fⱼ` over the two other axes.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | accelerometer error | m/s² | 3 |
/// | `c` | temperature coefficient of the misalignment; its diagonal is `accel_scale_temperature` | rad/K | 6 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `f` | specific force | m/s² | 3 |
///
/// A recording shows it that has each orientation warm and cold.
#[derive(Clone, Copy, Debug)]
pub struct AccelMisalignmentTemperature;

impl Effect for AccelMisalignmentTemperature {
    const NAME: &'static str = "accel_misalignment_temperature";
    const SENSOR: Sensor = Sensor::Accelerometer;
    const EQUATION: &'static str = "A_i += Σ_j c_ij (T - T0) f_j, j ≠ i";
    const FORMULA: Option<&'static str> = Some("dT * ({i}{j} * f{j} + {i}{k} * f{k})");
    const PARAMS: &'static [Param] = &params("rad/K", ["xy", "xz", "yx", "yz", "zx", "zy"]);
    const TYPICAL: f64 = 1e-4;
    const NEEDS: Option<&'static [Quantity]> =
        Some(&[Quantity::SpecificForce, Quantity::Temperature]);

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        off_diagonal(p) * truth.specific_force * lit::<D>(warmer)
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
        let e = AccelMisalignmentTemperature.error(&truth, &p);
        assert!((e - Vector3::new(2e-3, 6e-3, -2e-3)).norm() < 1e-15);
    }
}
