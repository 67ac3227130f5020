//! The unit of readings that are no SI units: `signal ≈ scale · (raw − zero)`.

use nalgebra::Vector3;
use sensor::BASE_PARAMETERS;

/// The affine map that brings readings near SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawUnit {
    /// SI units per raw unit.
    pub scale: f64,
    /// Reading of a zero signal, raw units.
    pub zero: Vector3<f64>,
}

impl RawUnit {
    /// Readings in SI units.
    pub const SI: Self = Self {
        scale: 1.0,
        zero: Vector3::new(0.0, 0.0, 0.0),
    };

    /// Returns true if the readings were in SI units already (scale of one).
    pub fn is_si(&self) -> bool {
        self.scale == 1.0
    }

    /// The reading near SI units.
    pub fn to_si(&self, raw: &Vector3<f64>) -> Vector3<f64> {
        (raw - self.zero) * self.scale
    }

    /// Factor from a parameter of a model near SI units to one of a model in raw units, by its
    /// place among the base parameters.
    pub fn factor(&self, place: usize) -> f64 {
        match place {
            0..9 => self.scale,
            9..BASE_PARAMETERS => self.scale.recip(),
            _ => 1.0,
        }
    }

    /// Returns the offset added to a parameter on its conversion to raw units, by its place among the base parameters.
    pub fn offset(&self, place: usize) -> f64 {
        match place {
            9..BASE_PARAMETERS => self.zero[place - 9],
            _ => 0.0,
        }
    }
}
