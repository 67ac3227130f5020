//! A proposed error: a sum of products of covariates, each with a coefficient to be estimated.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::axis::Axis;
use crate::covariate::{Covariate, Dimension};
use crate::definition::{DefinedParam, Definition, DefinitionError, DefinitionFault};
use crate::effect::EffectRef;
use crate::kinematics::Sensor;

/// `eᵢ = Σ cₖ Πⱼ xⱼ^nⱼ`: linear in its coefficients, silent where they are 0.
///
/// ```
/// use stillpoint_sensor::{Axis, Covariate, Formula, Sensor, Term};
///
/// let force = Covariate::SpecificForce;
/// let formula = Formula::new(
///     Sensor::Accelerometer,
///     vec![Term::new(Axis::X, &[(force(Axis::X), 1), (force(Axis::Y), 2)], 1e-5)],
/// );
/// assert_eq!(formula.to_string(), "A_x += x_fx_fy2 * fx * fy^2");
/// assert_eq!(formula.effect("accel_proposed")?.params()[0].unit, "1/(m/s^2)^2");
/// # Ok::<(), stillpoint_sensor::DefinitionError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Formula {
    /// The sensor that has the error.
    pub sensor: Sensor,
    /// Terms of the sum.
    pub terms: Vec<Term>,
}

/// One product on one axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Term {
    /// The axis that reads it.
    pub axis: Axis,
    /// Factors of the product; none for a bias.
    pub factors: Vec<Factor>,
    /// Size of the coefficient: the estimate that proposed it, or the scale from which a simulation draws.
    pub size: f64,
}

/// A covariate to a power.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Factor {
    /// Covariate of the factor.
    pub covariate: Covariate,
    /// The power, 1 or more.
    pub power: u32,
}

impl Term {
    /// On `axis`, the product of covariates to their powers, its coefficient about `size`.
    pub fn new(axis: Axis, factors: &[(Covariate, u32)], size: f64) -> Self {
        let factor = |&(covariate, power): &(Covariate, u32)| Factor { covariate, power };
        Self {
            axis,
            factors: factors.iter().map(factor).collect(),
            size,
        }
    }

    /// Name of the coefficient: the axis, then the factors, as in `x_fx_fy2`.
    pub fn name(&self) -> String {
        let mut name = self.axis.to_string();
        for factor in &self.factors {
            name += "_";
            name += &match factor.covariate {
                Covariate::Temperature => "temp".to_owned(),
                other => other.name().to_lowercase().replace(['(', ')'], ""),
            };
            if factor.power != 1 {
                name += &factor.power.to_string();
            }
        }
        if self.factors.is_empty() {
            name += "_bias";
        }
        name
    }

    /// Unit of the coefficient on `sensor`.
    pub fn unit(&self, sensor: Sensor) -> String {
        let mut net: Dimension = match sensor {
            Sensor::Accelerometer => [1, 0, 0, 0, 0, 0],
            Sensor::Gyroscope => [0, 1, 0, 0, 0, 0],
            Sensor::Magnetometer => [0, 0, 0, 0, 0, 1],
        };
        for factor in &self.factors {
            let own = factor.covariate.dimension();
            net.iter_mut()
                .zip(own)
                .for_each(|(sum, own)| *sum -= own * factor.power as i32);
        }
        unit(&net)
    }

    /// The product without its coefficient, as an expression; `1` of nothing.
    fn product(&self) -> String {
        if self.factors.is_empty() {
            return "1".to_owned();
        }
        let written = self.factors.iter().map(Factor::to_string);
        written.collect::<Vec<_>>().join(" * ")
    }
}

/// `m/s^2/K`, `1/(rad/s)^2`: first what is above the line, then what is below.
fn unit(net: &Dimension) -> String {
    let names = ["m/s^2", "rad/s", "rad/s^2", "s", "K", "uT"];
    let power = |name: &str, n: i32| match (n, name.contains('/')) {
        (1, _) => name.to_owned(),
        (_, true) => format!("({name})^{n}"),
        (_, false) => format!("{name}^{n}"),
    };
    let above = net.iter().zip(names).filter(|(n, _)| **n > 0);
    let above: Vec<String> = above.map(|(n, name)| power(name, *n)).collect();
    let below = net.iter().zip(names).filter(|(n, _)| **n < 0);
    let below = below.map(|(n, name)| match (*n, name.contains('/')) {
        (-1, true) => format!("/({name})"),
        (n, _) => format!("/{}", power(name, -n)),
    });
    let below: String = below.collect();
    match (above.is_empty(), below.is_empty()) {
        (true, true) => String::new(),
        (true, false) => format!("1{below}"),
        _ => above.join("*") + &below,
    }
}

impl Formula {
    /// A formula of these terms.
    pub fn new(sensor: Sensor, terms: Vec<Term>) -> Self {
        Self { sensor, terms }
    }

    /// The effect's text under this name: what an effect file holds.
    pub fn definition(&self, name: &str) -> Definition {
        let mut definition = Definition {
            name: name.to_owned(),
            ..Definition::silent(self.sensor)
        };
        for term in &self.terms {
            let parameter = term.name();
            let axis = match term.axis {
                Axis::X => &mut definition.x,
                Axis::Y => &mut definition.y,
                Axis::Z => &mut definition.z,
            };
            if !axis.is_empty() {
                *axis += " + ";
            }
            *axis += &parameter;
            if !term.factors.is_empty() {
                *axis += &format!(" * {}", term.product());
            }
            let unit = term.unit(self.sensor);
            let size = term.size.abs();
            definition
                .parameters
                .push(DefinedParam::new(&parameter, &unit, size));
        }
        definition
    }

    /// The effect of this name, to be fitted like any of the catalogue.
    ///
    /// # Errors
    /// [`DefinitionError`] for a name that is not snake case, for no terms, for two terms that are the
    /// same, for a power or a size of 0.
    pub fn effect(&self, name: &str) -> Result<EffectRef, DefinitionError> {
        for (k, term) in self.terms.iter().enumerate() {
            if let Some(zero) = term.factors.iter().find(|factor| factor.power == 0) {
                let fault = DefinitionFault::PowerOfZero(zero.covariate.name());
                return Err(DefinitionError::new(format!("terms.{k}"), fault));
            }
        }
        self.definition(name).effect()
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.definition("").written_equation())
    }
}

impl fmt::Display for Factor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.power {
            1 => write!(f, "{}", self.covariate),
            power => write!(f, "{}^{power}", self.covariate),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::Kinematics;
    use nalgebra::Vector3;

    fn unit_of(sensor: Sensor, factors: &[(Covariate, u32)]) -> String {
        Term::new(Axis::X, factors, 1.0).unit(sensor)
    }

    #[test]
    fn units_are_those_of_the_catalogue() {
        let (f, w) = (
            Covariate::SpecificForce(Axis::Y),
            Covariate::AngularRate(Axis::Z),
        );
        let (accel, gyro) = (Sensor::Accelerometer, Sensor::Gyroscope);
        assert_eq!(unit_of(accel, &[(f, 2)]), "1/(m/s^2)");
        assert_eq!(unit_of(accel, &[(f, 3)]), "1/(m/s^2)^2");
        assert_eq!(
            unit_of(accel, &[(Covariate::TemperatureChange, 1)]),
            "m/s^2/K"
        );
        assert_eq!(
            unit_of(accel, &[(Covariate::TemperatureChange, 1), (f, 1)]),
            "1/K"
        );
        assert_eq!(unit_of(gyro, &[(f, 1)]), "rad/s/(m/s^2)");
        assert_eq!(unit_of(gyro, &[(w, 3)]), "1/(rad/s)^2");
        assert_eq!(unit_of(gyro, &[(Covariate::Time, 2)]), "rad/s/s^2");
        assert_eq!(unit_of(accel, &[(f, 1)]), "");
    }

    #[test]
    fn a_formula_reads_and_evaluates_as_the_sum_of_its_terms() {
        let force = Covariate::SpecificForce;
        let formula = Formula::new(
            Sensor::Accelerometer,
            vec![
                Term::new(Axis::X, &[(force(Axis::X), 1), (force(Axis::Y), 2)], -1e-5),
                Term::new(Axis::Z, &[(Covariate::Time, 2)], 1e-7),
                Term::new(Axis::Z, &[(Covariate::Temperature, 1)], 1e-3),
                Term::new(Axis::Z, &[(Covariate::Time, 1)], 1e-3),
            ],
        );
        let written = "A_x += x_fx_fy2 * fx * fy^2, A_z += z_t2 * t^2 + z_temp * T + z_t * t";
        assert_eq!(formula.to_string(), written);
        let effect = formula.effect("accel_sum").unwrap();
        let truth = Kinematics {
            time: 3.0,
            temperature: 20.0,
            ..Kinematics::at_rest(Vector3::new(2.0, 5.0, 7.0))
        };
        let e = effect.error_f64(&truth, &[10.0, 100.0, 1.0, 0.0]);
        assert_eq!(e, Vector3::new(500.0, 0.0, 920.0));
        assert_eq!(effect.typical_of(0), 1e-5);
    }

    #[test]
    fn a_term_twice_and_a_power_of_zero_are_refused() {
        let term = |power| Term::new(Axis::X, &[(Covariate::Time, power)], 1.0);
        let of = |terms| Formula::new(Sensor::Gyroscope, terms).effect("gyro_odd");
        let refused = |terms| {
            let error = of(terms).unwrap_err();
            (error.key, error.fault)
        };
        let taken = DefinitionFault::NameTaken("x_t".into());
        let twice = refused(vec![term(1), term(1)]);
        assert_eq!(twice, ("parameters.1.name".into(), taken));
        let zero = DefinitionFault::PowerOfZero("t".into());
        assert_eq!(refused(vec![term(0)]), ("terms.0".into(), zero));
        assert!(of(vec![]).is_err());
    }
}
