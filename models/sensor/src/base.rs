//! The base model of a triad: scale factor, misalignment, bias.

use nalgebra::{Matrix3, Vector3};
use solver::Scalar;

use crate::kinematics::Sensor;

/// Number of base parameters of a triad.
pub const BASE_PARAMETERS: usize = 12;

/// Row and column of `T` for each of the first nine base parameters.
///
/// The published order `Sx Sy Sz ayz azy axz azx axy ayx bx by bz` (Liu et al. 2021).
pub const PLACES: [(usize, usize); 9] = [
    (0, 0),
    (1, 1),
    (2, 2),
    (0, 1),
    (0, 2),
    (1, 0),
    (1, 2),
    (2, 0),
    (2, 1),
];

/// `corrected = T (raw − b)`; `T` is 3 × 3 (corrected unit per raw unit), `b` in raw units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Base<D> {
    /// Scale factors on the diagonal, misalignments beside it.
    pub t: Matrix3<D>,
    /// Bias, in raw units.
    pub bias: Vector3<D>,
}

impl<D: Scalar> Base<D> {
    /// From the twelve parameters in the order of [`PLACES`], then the bias.
    pub fn from_parameters(p: &[D]) -> Self {
        let mut t = Matrix3::from_element(p[0]);
        for (k, place) in PLACES.iter().enumerate() {
            t[*place] = p[k];
        }
        Self {
            t,
            bias: Vector3::new(p[9], p[10], p[11]),
        }
    }

    /// `T (raw − b)`.
    pub fn correct(&self, raw: &Vector3<D>) -> Vector3<D> {
        self.t * (raw - self.bias)
    }

    /// `T⁻¹ signal + b`, or `None` where `T` is singular.
    pub fn distort(&self, signal: &Vector3<D>) -> Option<Vector3<D>> {
        Some(inverse(&self.t)? * signal + self.bias)
    }
}

impl Base<f64> {
    /// The perfect sensor.
    pub fn identity() -> Self {
        Self {
            t: Matrix3::identity(),
            bias: Vector3::zeros(),
        }
    }

    /// Units of the signal per unit of the reading, all axes together: `|det T|^(1/3)`.
    pub fn scale(&self) -> f64 {
        self.t.determinant().abs().cbrt()
    }

    /// The twelve parameters in the order of [`PLACES`], then the bias.
    pub fn parameters(&self) -> [f64; BASE_PARAMETERS] {
        let mut p = [0.0; BASE_PARAMETERS];
        for (k, place) in PLACES.iter().enumerate() {
            p[k] = self.t[*place];
        }
        p[9..].copy_from_slice(self.bias.as_slice());
        p
    }
}

/// The names of the twelve parameters: `accel.s_x`, `accel.alpha_yz`, `gyro.beta_yz`, `gyro.b_x` …
pub fn base_names(sensor: Sensor) -> [String; BASE_PARAMETERS] {
    let angle = sensor.misalignment();
    [
        "s_x", "s_y", "s_z", "yz", "zy", "xz", "zx", "xy", "yx", "b_x", "b_y", "b_z",
    ]
    .map(|name| match name.len() {
        2 => format!("{}.{angle}_{name}", sensor.prefix()),
        _ => format!("{}.{name}", sensor.prefix()),
    })
}

/// Part of a base model that a parameter belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BasePart {
    /// An element of the diagonal of `T`.
    ScaleFactor,
    /// Another element of `T`.
    Misalignment,
    /// A component of the bias.
    Bias,
}

/// The sensor and the part of its base model that a name says, of one recording (`gyro.b_x[desk]`) too; `None` of the parameters of effects.
///
/// # Examples
/// ```
/// use stillpoint_sensor::{BasePart, Sensor, base_part};
///
/// assert_eq!(base_part("gyro.b_x[desk]"), Some((Sensor::Gyroscope, BasePart::Bias)));
/// assert_eq!(base_part("my_effect.b_x"), None);
/// ```
pub fn base_part(name: &str) -> Option<(Sensor, BasePart)> {
    let (owner, parameter) = name.split_once('.')?;
    let mut sensors = Sensor::ALL.into_iter();
    let sensor = sensors.find(|sensor| sensor.prefix() == owner)?;
    let part = match parameter.split_once('_')?.0 {
        "s" => BasePart::ScaleFactor,
        "b" => BasePart::Bias,
        angle if angle == sensor.misalignment() => BasePart::Misalignment,
        _ => return None,
    };
    Some((sensor, part))
}

impl BasePart {
    /// Returns true if a name is that of a parameter of this part, whichever sensor's.
    pub fn has(self, name: &str) -> bool {
        base_part(name).is_some_and(|(_, part)| part == self)
    }
}

/// Returns true if a name is that of a bias of a base model.
pub fn is_bias(name: &str) -> bool {
    BasePart::Bias.has(name)
}

/// The inverse of a 3 × 3 matrix by its adjugate, over any scalar; `None` where it is singular.
pub fn inverse<D: Scalar>(m: &Matrix3<D>) -> Option<Matrix3<D>> {
    let cofactor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]
    };
    let determinant =
        m[(0, 0)] * cofactor(0, 0) + m[(0, 1)] * cofactor(0, 1) + m[(0, 2)] * cofactor(0, 2);
    (determinant.re() != 0.0).then(|| {
        let factor = determinant.recip();
        Matrix3::from_fn(|i, j| cofactor(j, i) * factor)
    })
}
