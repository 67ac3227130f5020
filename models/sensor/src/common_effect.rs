//! An effect that sensors of several kinds have alike.

use nalgebra::Vector3;
use solver::{Jet, Jet2, Scalar};

use crate::axis::Axis;
use crate::effect::{AnyEffect, on_axis};
use crate::kinematics::{Kinematics, Sensor};
use crate::param::{Param, axes};
use crate::quantity::Quantity;

/// An [`Effect`](crate::Effect) without its sensor: an error of the same form on the signal of any.
///
/// One file in `effects/` makes one; a line in the registry of each sensor that has it gives name, unit and size there ([`Sensor::has`]).
/// In its texts `{S}` stands for the letter of the readings and `{s}` for that of the true signal.
pub trait CommonEffect: Send + Sync + 'static {
    /// The equation as users read it. One that names `{s}` needs the sensor's own signal.
    const EQUATION: &'static str;
    /// As [`Effect::FORMULA`](crate::Effect::FORMULA).
    const FORMULA: Option<&'static str> = None;
    /// As [`Effect::LINEAR`](crate::Effect::LINEAR).
    const LINEAR: bool = false;
    /// The quantities that it depends on beside the sensor's own signal.
    const NEEDS: &'static [Quantity] = &[];

    /// The error at `truth`, of which `signal` is what the sensor measures, for parameters `p` in their order.
    fn error<D: Scalar>(signal: &Vector3<D>, truth: &Kinematics<D>, p: &[D]) -> Vector3<D>;
}

/// A [`CommonEffect`] on a sensor, with `N` parameters.
#[derive(Clone, Debug)]
pub struct On<E, const N: usize> {
    /// The form of the error.
    pub effect: E,
    /// The sensor that has it.
    pub sensor: Sensor,
    /// Unique name in snake case.
    pub name: &'static str,
    /// Names, units and nominal values.
    pub params: [Param; N],
    /// As [`Effect::TYPICAL`](crate::Effect::TYPICAL).
    pub typical: f64,
    /// As [`Effect::COMPANION`](crate::Effect::COMPANION).
    pub companion: Option<&'static str>,
}

impl Sensor {
    /// The effect on this sensor, with a parameter of that unit for each axis.
    pub const fn has<E>(
        self,
        effect: E,
        name: &'static str,
        unit: &'static str,
        typical: f64,
    ) -> On<E, 3> {
        self.has_with(effect, name, axes(unit), typical)
    }

    /// The effect on this sensor, with these parameters.
    pub const fn has_with<E, const N: usize>(
        self,
        effect: E,
        name: &'static str,
        params: [Param; N],
        typical: f64,
    ) -> On<E, N> {
        On {
            effect,
            sensor: self,
            name,
            params,
            typical,
            companion: None,
        }
    }
}

impl<E: CommonEffect, const N: usize> On<E, N> {
    /// The same with the effect of lower order that comes with it.
    #[must_use]
    pub const fn with_companion(mut self, name: &'static str) -> Self {
        self.companion = Some(name);
        self
    }

    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        E::error(&truth.signal(self.sensor), truth, p)
    }
}

impl<E: CommonEffect, const N: usize> AnyEffect for On<E, N> {
    fn name(&self) -> &str {
        self.name
    }
    fn sensor(&self) -> Sensor {
        self.sensor
    }
    fn equation(&self) -> String {
        let (reading, signal) = (self.sensor.letter(), self.sensor.signal_letter());
        E::EQUATION.replace("{S}", reading).replace("{s}", signal)
    }
    fn formula(&self, axis: Axis) -> Option<String> {
        // Expressions have no name for a magnetic field.
        let named = self.sensor != Sensor::Magnetometer;
        let formula = E::FORMULA.filter(|_| named)?;
        Some(on_axis(formula, axis).replace("{s}", self.sensor.signal_letter()))
    }
    fn params(&self) -> &[Param] {
        &self.params
    }
    fn typical(&self) -> f64 {
        self.typical
    }
    fn is_linear(&self) -> bool {
        E::LINEAR
    }
    fn needs(&self) -> Vec<Quantity> {
        let own = E::EQUATION.contains("{s}");
        let own = own.then(|| Quantity::signal_of(self.sensor));
        own.into_iter().chain(E::NEEDS.iter().copied()).collect()
    }
    fn companion(&self) -> Option<&'static str> {
        self.companion
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
