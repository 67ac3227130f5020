//! An effect that is defined by text: what a user writes without compiling anything.

mod budget;
mod code;
mod defined;
mod emit;
mod fault;
mod formula;

pub use budget::EffectFault;
pub use code::{ErrorCode, error_code};
pub use emit::emit_effect;
pub use fault::{DefinitionError, DefinitionFault};
pub use formula::{Factor, Formula, Term};
use serde::{Deserialize, Serialize};

use crate::axis::Axis;
use crate::covariate::Covariate;
use crate::kinematics::Sensor;

/// An effect as its name, parameters and an expression per axis.
///
/// The expressions are over the names of [`Covariate`]s and of the parameters. Like every effect it
/// is an error in the sensor's unit at the true signal, and silent at its nominal parameters.
///
/// ```
/// use nalgebra::Vector3;
/// use stillpoint_sensor::{DefinedParam, Definition, Kinematics, Sensor};
///
/// let swirl = Definition {
///     name: "accel_swirl".into(),
///     x: "k * fy * fz".into(),
///     parameters: vec![DefinedParam::new("k", "1/(m/s^2)", 1e-4)],
///     ..Definition::silent(Sensor::Accelerometer)
/// };
/// let truth = Kinematics::at_rest(Vector3::new(0.0, 2.0, 5.0));
/// let error = swirl.effect()?.error_f64(&truth, &[0.1]);
/// assert_eq!(error, Vector3::new(1.0, 0.0, 0.0));
/// # Ok::<(), stillpoint_sensor::DefinitionError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// Unique name in snake case.
    pub name: String,
    /// The sensor that has it.
    pub sensor: Sensor,
    /// The equation as users read it; made of the expressions where it is empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub equation: String,
    /// Error of the x axis; 0 where it is empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub x: String,
    /// Error of the y axis.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub y: String,
    /// Error of the z axis.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub z: String,
    /// Its parameters, in order.
    pub parameters: Vec<DefinedParam>,
}

/// A parameter of a [`Definition`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DefinedParam {
    /// Name within the effect, in snake case.
    pub name: String,
    /// Unit.
    #[serde(default)]
    pub unit: String,
    /// Value of a perfect sensor, at which the effect is silent.
    #[serde(default)]
    pub nominal: f64,
    /// Size in a consumer-grade device: what a simulation draws from, and a discovery scales by.
    pub typical: f64,
}

impl DefinedParam {
    /// A parameter that is 0 in a perfect sensor.
    pub fn new(name: &str, unit: &str, typical: f64) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            nominal: 0.0,
            typical,
        }
    }
}

impl Definition {
    /// No name, no parameters, no error: to be filled in.
    pub fn silent(sensor: Sensor) -> Self {
        Self {
            name: String::new(),
            sensor,
            equation: String::new(),
            x: String::new(),
            y: String::new(),
            z: String::new(),
            parameters: Vec::new(),
        }
    }

    /// The expression of an axis.
    pub fn axis(&self, axis: Axis) -> &str {
        match axis {
            Axis::X => &self.x,
            Axis::Y => &self.y,
            Axis::Z => &self.z,
        }
    }

    /// The equation, made of the expressions where none is given.
    pub fn written_equation(&self) -> String {
        if !self.equation.is_empty() {
            return self.equation.clone();
        }
        let letter = self.sensor.letter();
        let written = Axis::ALL
            .iter()
            .filter(|axis| !self.axis(**axis).trim().is_empty());
        let written = written.map(|axis| format!("{letter}_{axis} += {}", self.axis(*axis)));
        written.collect::<Vec<_>>().join(", ")
    }

    fn check_names(&self) -> Result<(), DefinitionError> {
        use DefinitionFault as F;
        if !is_snake_case(&self.name) {
            let fault = F::NotSnakeCase(self.name.clone());
            return Err(DefinitionError::new("name", fault));
        }
        if self.parameters.is_empty() {
            return Err(DefinitionError::new("parameters", F::NoParameter));
        }
        for (k, p) in self.parameters.iter().enumerate() {
            let error = |name: &str, fault: F| {
                Err(DefinitionError::new(
                    format!("parameters.{k}.{name}"),
                    fault,
                ))
            };
            let taken = Covariate::all().any(|c| c.name() == p.name)
                || self.parameters[..k]
                    .iter()
                    .any(|other| other.name == p.name)
                || p.name == "pi"
                || p.name == "size"
                || crate::expression::FUNCTIONS.contains(&p.name.as_str());
            if taken {
                return error("name", F::NameTaken(p.name.clone()));
            }
            if !is_snake_case(&p.name) {
                return error("name", F::NotSnakeCase(p.name.clone()));
            }
            if !(p.typical > 0.0 && p.typical.is_finite()) {
                return error("typical", F::NotPositive(p.typical));
            }
            if !p.nominal.is_finite() {
                return error("nominal", F::NotFinite(p.nominal));
            }
        }
        Ok(())
    }
}

fn is_snake_case(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && !name.ends_with('_')
        && !name.contains("__")
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}
