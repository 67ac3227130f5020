//! An error effect: an additive error in SI units at the true signal.

mod any_effect;
mod linear;
mod needs;

use nalgebra::{Matrix3, Vector3};
use solver::{Jet, Jet2, Scalar, lit};

use crate::axis::Axis;
use crate::kinematics::{Kinematics, Sensor};
use crate::param::Param;
use crate::quantity::Quantity;
pub use any_effect::{AnyEffect, EffectRef, ModelScalar, Nature};
pub use linear::is_linear_in_name_only;
pub use needs::{observed_needs, silent_at_rest};

/// An error that a sensor adds to the true signal: `raw = base⁻¹(truth + Σ effect(truth))`.
///
/// One file, its `pub mod` line and its place in the registry make a new effect. It must be silent at its nominal parameters.
/// The first five constants have to be given; the others say more of it where there is more to say.
///
/// # Examples
/// ```
/// use nalgebra::Vector3;
/// use solver::Scalar;
/// use stillpoint_sensor::{Effect, Kinematics, Param, Quantity, Sensor, params};
///
/// /// A bias that goes with the square of the temperature's derivative: `eᵢ = cᵢ (dT/dt)²`.
/// struct Squared;
///
/// impl Effect for Squared {
///     const NAME: &'static str = "gyro_temperature_rate_squared";
///     const SENSOR: Sensor = Sensor::Gyroscope;
///     const EQUATION: &'static str = "W_i += c_i (dT/dt)^2";
///     const PARAMS: &'static [Param] = &params("rad*s/K^2", ["x", "y", "z"]);
///     const TYPICAL: f64 = 0.5;
///     const LINEAR: bool = true;
///     const NEEDS: Option<&'static [Quantity]> = Some(&[Quantity::TemperatureRate]);
///
///     fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
///         Vector3::from_fn(|i, _| p[i] * truth.temperature_rate.powi(2))
///     }
/// }
///
/// let mut truth = Kinematics::at_rest(Vector3::zeros());
/// truth.temperature_rate = -0.5;
/// assert_eq!(Squared.error(&truth, &[4.0, 0.0, -8.0]), Vector3::new(1.0, 0.0, -2.0));
/// ```
pub trait Effect: Send + Sync + 'static {
    /// Unique name in snake case.
    const NAME: &'static str;
    /// The sensor that has it.
    const SENSOR: Sensor;
    /// The equation as users read it.
    const EQUATION: &'static str;
    /// Names, units and nominal values.
    const PARAMS: &'static [Param];
    /// Size of a coefficient in a consumer-grade device, in its unit: what a simulation draws from. It
    /// is meant for the parameters that are 0 in a perfect sensor.
    const TYPICAL: f64;
    /// The error on an axis as an expression over the names of [`Covariate`](crate::Covariate)s and of the parameters, where that is enough:
    /// `{i} * f{j}`, `{i}`, `{j}` and `{k}` standing for the letters of the axis, the next one and the one after. Code in other languages is
    /// made of it.
    const FORMULA: Option<&'static str> = None;
    /// True if the error is `F p`: linear in the parameters, with an `F` that does not depend on this sensor's own
    /// signal. Fits of such an effect are faster; `false` is always right, and a wrong `true` corrects readings wrongly.
    const LINEAR: bool = false;
    /// Quantities that the effect depends on. An effect is refused if one of them is not known,
    /// and the message names it. `None`: they are determined by trial ([`observed_needs`]).
    const NEEDS: Option<&'static [Quantity]> = None;
    /// True if no sensor has negative coefficients: what speaks for them speaks for something else.
    const POSITIVE: bool = false;
    /// Nature of the effect, for one that is not an error of the sensor.
    const NATURE: Nature = Nature::SensorError;
    /// The effect of lower order that comes with it: it stands for a reference, such as that of the temperature, which is
    /// nobody's to choose.
    const COMPANION: Option<&'static str> = None;
    /// The coefficient that is nothing by convention: the others are differences to it, and what is common to all does
    /// not show.
    const REFERENCE: Option<&'static str> = None;

    /// The error at `truth`, in the unit of the sensor's signal, for parameters `p` in the order
    /// of `PARAMS`.
    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D>;
}

impl<E: Effect> AnyEffect for E {
    fn name(&self) -> &str {
        E::NAME
    }
    fn sensor(&self) -> Sensor {
        E::SENSOR
    }
    fn equation(&self) -> String {
        E::EQUATION.to_owned()
    }
    fn formula(&self, axis: Axis) -> Option<String> {
        E::FORMULA.map(|formula| on_axis(formula, axis))
    }
    fn params(&self) -> &[Param] {
        E::PARAMS
    }
    fn typical(&self) -> f64 {
        E::TYPICAL
    }
    fn is_linear(&self) -> bool {
        E::LINEAR
    }
    fn needs(&self) -> Vec<Quantity> {
        E::NEEDS.map_or_else(|| observed_needs(self), <[Quantity]>::to_vec)
    }
    fn nature(&self) -> Nature {
        E::NATURE
    }
    fn companion(&self) -> Option<&'static str> {
        E::COMPANION
    }
    fn is_positive(&self) -> bool {
        E::POSITIVE
    }
    fn reference(&self) -> Option<&'static str> {
        E::REFERENCE
    }
    fn error_f64(&self, truth: &Kinematics<f64>, p: &[f64]) -> Vector3<f64> {
        self.error(truth, p)
    }
    fn error_jet(&self, truth: &Kinematics<Jet>, p: &[Jet]) -> Vector3<Jet> {
        self.error(truth, p)
    }
    fn error_jet2(&self, truth: &Kinematics<Jet2>, p: &[Jet2]) -> Vector3<Jet2> {
        self.error(truth, p)
    }
}

impl<E: Effect> From<&'static E> for EffectRef {
    fn from(effect: &'static E) -> Self {
        Self::from(effect as &'static dyn AnyEffect)
    }
}

/// A formula with the letters of an axis, the next one and the one after for `{i}`, `{j}` and `{k}`.
pub(crate) fn on_axis(formula: &str, axis: Axis) -> String {
    let (next, last) = (axis.following(), axis.following().following());
    let text = formula.replace("{i}", axis.letter());
    text.replace("{j}", next.letter())
        .replace("{k}", last.letter())
}

/// A 3 × 3 matrix from its nine elements, row by row.
///
/// # Examples
/// ```
/// let m = stillpoint_sensor::mat3(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
/// assert_eq!(m[(0, 2)], 3.0);
/// ```
pub fn mat3<D: Scalar>(p: &[D]) -> Matrix3<D> {
    Matrix3::from_fn(|i, j| p[3 * i + j])
}

/// A 3 × 3 matrix with a diagonal of 0 from its six other elements, row by row.
///
/// # Examples
/// ```
/// let m = stillpoint_sensor::off_diagonal(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
/// assert_eq!((m[(0, 0)], m[(0, 2)], m[(2, 1)]), (0.0, 2.0, 6.0));
/// ```
pub fn off_diagonal<D: Scalar>(p: &[D]) -> Matrix3<D> {
    let zero = lit(0.0);
    Matrix3::new(zero, p[0], p[1], p[2], zero, p[3], p[4], p[5], zero)
}
