//! Temperature dependence of a misalignment.

use nalgebra::Vector3;
use solver::{Scalar, lit};

use crate::{
    CommonEffect, Kinematics, Param, Quantity, REFERENCE_TEMPERATURE, off_diagonal, params,
};

/// Axes that lean towards one another as the device warms up: `eᵢ = Σⱼ cᵢⱼ (T − T₀) sⱼ` over the two other axes.
///
/// | symbol | meaning | unit | shape |
/// |---|---|---|---|
/// | `e` | error of the sensor | of the signal | 3 |
/// | `c` | temperature coefficient of the misalignment; its diagonal is [`ScaleTemperature`](super::ScaleTemperature) | rad/K | 6 |
/// | `T` | temperature | °C | 1 |
/// | `T₀` | `REFERENCE_TEMPERATURE` | °C | 1 |
/// | `s` | signal: specific force or angular rate | m/s² or rad/s | 3 |
///
/// A recording shows it that has each orientation warm and cold.
#[derive(Clone, Copy, Debug)]
pub struct MisalignmentTemperature;

impl MisalignmentTemperature {
    /// Its parameters.
    pub const PARAMS: [Param; 6] = params("rad/K", ["xy", "xz", "yx", "yz", "zx", "zy"]);
}

impl CommonEffect for MisalignmentTemperature {
    const EQUATION: &'static str = "{S}_i += Σ_j c_ij (T - T0) {s}_j, j ≠ i";
    const FORMULA: Option<&'static str> = Some("dT * ({i}{j} * {s}{j} + {i}{k} * {s}{k})");
    const NEEDS: &'static [Quantity] = &[Quantity::Temperature];

    fn error<D: Scalar>(signal: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let warmer = truth.temperature - REFERENCE_TEMPERATURE;
        off_diagonal(p) * *signal * lit::<D>(warmer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_reads_its_neighbours_by_ten_kelvin_times_the_coefficient() {
        let truth = Kinematics {
            temperature: 35.0,
            ..Kinematics::at_rest(Vector3::zeros())
        };
        let p = [1e-4, 0.0, 0.0, 2e-4, 0.0, -1e-4];
        let e = MisalignmentTemperature::error(&Vector3::new(1.0, 2.0, 3.0), &truth, &p);
        assert!((e - Vector3::new(2e-3, 6e-3, -2e-3)).norm() < 1e-15);
    }
}
