//! A definition that has been read: an effect like those that are compiled.

use std::sync::Arc;

use nalgebra::Vector3;
use solver::{Jet, Jet2, Scalar};

use super::budget::{Budget, EffectFault};
use super::{DefinedParam, Definition, DefinitionError, DefinitionFault};
use crate::axis::Axis;
use crate::covariate::Covariate;
use crate::effect::{AnyEffect, EffectRef};
use crate::expression::Expression;
use crate::kinematics::{Kinematics, Sensor};
use crate::param::{Param, Role};
use crate::quantity::Quantity;

impl Definition {
    /// The effect that it defines.
    ///
    /// # Errors
    /// [`DefinitionError`] with the entry: a name that is not snake case or taken twice, an expression
    /// that cannot be read (with the column), a number that makes no sense, an effect that is not
    /// silent at its nominal parameters.
    pub fn effect(&self) -> Result<EffectRef, DefinitionError> {
        let defined: Arc<dyn AnyEffect> = Arc::new(self.read()?);
        Ok(defined.into())
    }

    /// The covariates, and all names of an expression: theirs and those of the parameters.
    pub(super) fn names<'a>(
        parameters: impl Iterator<Item = &'a str>,
    ) -> (Vec<Covariate>, Vec<String>) {
        let covariates: Vec<Covariate> = Covariate::all().collect();
        let own = covariates.iter().map(|c| c.name());
        let names = own.chain(parameters.map(str::to_owned)).collect();
        (covariates, names)
    }

    fn read(&self) -> Result<Defined, DefinitionError> {
        self.check_names()?;
        let (covariates, names) = Self::names(self.parameters.iter().map(|p| p.name.as_str()));
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut axes: [Option<Expression>; 3] = [None, None, None];
        for axis in Axis::ALL {
            let text = self.axis(axis);
            if !text.trim().is_empty() {
                let unreadable = |error| DefinitionFault::Unreadable {
                    text: text.to_owned(),
                    error,
                };
                let read = Expression::parse(text, &names)
                    .map_err(|e| DefinitionError::new(axis.letter(), unreadable(e)))?;
                axes[axis.index()] = Some(read);
            }
        }
        if axes.iter().all(Option::is_none) {
            return Err(DefinitionError::new("x", DefinitionFault::NoExpression));
        }
        let cost: u64 = axes.iter().flatten().map(Expression::cost).sum();
        if cost > COSTLIEST {
            let fault = DefinitionFault::Costly {
                cost,
                most: COSTLIEST,
                call: crate::expression::CALL,
            };
            let longest = Axis::ALL
                .into_iter()
                .max_by_key(|axis| axes[axis.index()].as_ref().map_or(0, Expression::cost));
            let key = longest.map_or("x", Axis::letter);
            return Err(DefinitionError::new(key, fault));
        }
        let params: Vec<Param> = self.parameters.iter().map(parameter).collect();
        let defined = Defined {
            definition: self.clone(),
            params,
            covariates,
            axes,
            budget: Budget::endless(cost),
        };
        defined.check_silent()?;
        Ok(defined)
    }
}

fn parameter(p: &DefinedParam) -> Param {
    // A text says the role of a parameter by its name.
    let role = match &*p.name {
        "tau" => Role::TimeConstant,
        "t0" => Role::Instant,
        _ => Role::Coefficient,
    };
    Param {
        name: p.name.clone().into(),
        unit: p.unit.clone().into(),
        ..Param::new("", "", p.nominal).sized(p.typical).in_role(role)
    }
}

/// A definition that has been read.
#[derive(Debug)]
struct Defined {
    definition: Definition,
    params: Vec<Param>,
    covariates: Vec<Covariate>,
    axes: [Option<Expression>; 3],
    budget: Budget,
}

/// Steps that the expressions of an effect may take together: a second for a hundred thousand readings and a dozen
/// evaluations of each with derivatives.
const COSTLIEST: u64 = 160;

impl Defined {
    fn error<D: Scalar>(&self, truth: &Kinematics<D>, p: &[D]) -> Vector3<D> {
        let count = self.covariates.len();
        let variable = |k: usize| match self.covariates.get(k) {
            Some(covariate) => covariate.value(truth),
            None => p[k - count],
        };
        if !self.budget.spend::<D>() {
            return Vector3::from_element(D::from(f64::NAN));
        }
        let error = Vector3::from_fn(|i, _| {
            let axis = self.axes[i].as_ref();
            axis.map_or_else(|| D::from(0.0), |axis| axis.eval(&variable))
        });
        if !error.iter().all(|e| e.re().is_finite()) {
            let parameters: Vec<f64> = p.iter().map(|p| p.re()).collect();
            self.budget.note_no_number(truth, &parameters);
        }
        error
    }

    /// Silent at the nominal parameters, and a number at the typical ones, in some motion or other.
    fn check_silent(&self) -> Result<(), DefinitionError> {
        let nominal: Vec<f64> = self.params.iter().map(|p| p.nominal).collect();
        let sized = |p: &DefinedParam| match p.nominal {
            0.0 => p.typical,
            nominal => nominal,
        };
        let typical: Vec<f64> = self.definition.parameters.iter().map(sized).collect();
        for truth in probes() {
            let (off, on) = (self.error(&truth, &nominal), self.error(&truth, &typical));
            for axis in Axis::ALL {
                let (off, on) = (off[axis.index()], on[axis.index()]);
                if off != 0.0 {
                    let fault = DefinitionFault::NotSilent(off);
                    return Err(DefinitionError::new(axis.letter(), fault));
                }
                if !on.is_finite() {
                    let fault = DefinitionFault::NoNumber(on);
                    return Err(DefinitionError::new(axis.letter(), fault));
                }
            }
        }
        Ok(())
    }
}

/// Rest and brisk motion, in both directions, at different temperatures.
fn probes() -> [Kinematics<f64>; 3] {
    let moving = |sign: f64| Kinematics {
        time: 100.0 - 50.0 * sign,
        temperature: 25.0 + 10.0 * sign,
        angular_acceleration: Vector3::new(5.0, -7.0, 3.0) * sign,
        last_change: Vector3::new(1.0, -1.0, 1.0) * sign,
        vibration: Vector3::new(0.1, 0.2, 0.3),
        ..Kinematics::new(
            Vector3::new(6.0, -5.0, 4.0) * sign,
            Vector3::new(-1.0, 2.0, 3.0) * sign,
        )
    };
    [
        Kinematics::at_rest(Vector3::new(0.0, 0.0, 9.8)),
        moving(1.0),
        moving(-1.0),
    ]
}

impl AnyEffect for Defined {
    fn name(&self) -> &str {
        &self.definition.name
    }
    fn sensor(&self) -> Sensor {
        self.definition.sensor
    }
    fn equation(&self) -> String {
        self.definition.written_equation()
    }
    fn formula(&self, axis: Axis) -> Option<String> {
        match self.definition.axis(axis).trim() {
            "" => Some("0".to_owned()),
            text => Some(text.to_owned()),
        }
    }
    fn params(&self) -> &[Param] {
        &self.params
    }
    fn typical(&self) -> f64 {
        self.definition
            .parameters
            .first()
            .map_or(0.0, |p| p.typical)
    }
    fn needs(&self) -> Vec<Quantity> {
        let expressions = || self.axes.iter().flatten();
        let used = self.covariates.iter().enumerate();
        let used = used.filter(|(k, _)| expressions().any(|axis| axis.uses(*k)));
        let mut needs: Vec<Quantity> = used.map(|(_, c)| Quantity::of(*c)).collect();
        needs.sort();
        needs.dedup();
        needs
    }
    fn definition(&self) -> Option<&Definition> {
        Some(&self.definition)
    }
    fn granted(&self, samples: usize) -> Option<EffectRef> {
        let defined: Arc<dyn AnyEffect> = Arc::new(Self {
            definition: self.definition.clone(),
            params: self.params.clone(),
            covariates: self.covariates.clone(),
            axes: self.axes.clone(),
            budget: self.budget.of(samples),
        });
        Some(defined.into())
    }
    fn fault(&self) -> Option<EffectFault> {
        self.budget.fault()
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

#[cfg(test)]
mod tests {
    use super::*;
    use solver::scalar::{derivatives, variable};

    fn swirl() -> Definition {
        Definition {
            name: "gyro_swirl".into(),
            x: "k * fy * wz^2".into(),
            z: "c * exp(-t/tau)".into(),
            parameters: vec![
                DefinedParam::new("k", "s/m*s", 1e-4),
                DefinedParam::new("c", "rad/s", 1e-3),
                DefinedParam {
                    nominal: 60.0,
                    ..DefinedParam::new("tau", "s", 30.0)
                },
            ],
            ..Definition::silent(Sensor::Gyroscope)
        }
    }

    fn refused(change: impl FnOnce(&mut Definition)) -> (String, DefinitionFault) {
        let mut definition = swirl();
        change(&mut definition);
        let error = definition.effect().unwrap_err();
        (error.key, error.fault)
    }

    #[test]
    fn a_defined_effect_is_what_its_expressions_say_over_every_scalar() {
        let effect = swirl().effect().unwrap();
        let truth = Kinematics {
            time: 60.0,
            ..Kinematics::new(Vector3::new(0.0, 2.0, 0.0), Vector3::new(0.0, 0.0, -3.0))
        };
        let e = effect.error_f64(&truth, &[0.1, 1.0, 60.0]);
        assert!((e - Vector3::new(1.8, 0.0, (-1.0_f64).exp())).norm() < 1e-15);
        let p = [0.1, 1.0, 60.0].map(solver::lit);
        let mut jets: Kinematics<Jet> = truth.cast();
        jets.angular_rate.z = variable(-3.0, 0);
        // d/dw of k f w² is 2 k f w.
        assert!((derivatives(&effect.error_jet(&jets, &p).x)[0] + 1.2).abs() < 1e-15);
        assert_eq!(effect.params()[2].nominal, 60.0);
        assert_eq!(effect.typical_of(1), 1e-3);
        let written = "W_x += k * fy * wz^2, W_z += c * exp(-t/tau)";
        assert_eq!(effect.equation(), written);
    }

    #[test]
    fn a_costly_expression_is_refused_and_spent_steps_are_said() {
        let nested = format!("k*{}fx{}", "sin(".repeat(40), ")".repeat(40));
        let (key, fault) = refused(|d| d.y = nested);
        assert_eq!(key, "y");
        assert!(
            matches!(fault, DefinitionFault::Costly { cost: 600..700, .. }),
            "{fault:?}"
        );
        let endless = swirl().effect().unwrap();
        let effect = endless.granted(1).unwrap();
        let truth = Kinematics::at_rest(Vector3::new(0.0, 2.0, 0.0));
        let p = [0.1, 1.0, 60.0];
        assert_eq!(effect.fault(), None);
        let evaluations = (0..1_000_000).take_while(|_| effect.error_f64(&truth, &p).x.is_finite());
        assert!((1000..100_000).contains(&evaluations.count()));
        assert_eq!(effect.fault(), Some(EffectFault::StepsSpent));
        assert_eq!(effect.granted(1).unwrap().fault(), None);
        assert_eq!(endless.fault(), None);
    }

    #[test]
    fn where_an_expression_is_no_number_is_remembered() {
        let mut own = swirl();
        own.x = "k * sqrt(8.5 - fx)".into();
        let effect = own.effect().unwrap().granted(100).unwrap();
        let at = |x: f64| {
            effect.error_f64(
                &Kinematics::at_rest(Vector3::new(x, 0.0, 0.0)),
                &[0.1, 1.0, 60.0],
            )
        };
        assert!(at(8.0).x.is_finite());
        assert_eq!(effect.fault(), None);
        assert!(at(9.0).x.is_nan());
        let fault = EffectFault::NoNumber {
            force: [9.0, 0.0, 0.0],
            rate: [0.0; 3],
            parameters: vec![0.1, 1.0, 60.0],
        };
        assert_eq!(effect.fault(), Some(fault));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_entry() {
        use DefinitionFault as F;
        let (key, fault) = refused(|d| d.x = "k * fq".into());
        let F::Unreadable { text, error } = fault else {
            panic!("{fault:?}");
        };
        assert_eq!(
            (key.as_str(), text.as_str(), error.column),
            ("x", "k * fq", 5)
        );
        let is = |change: fn(&mut Definition), key: &str, fault: F| {
            assert_eq!(refused(change), (key.to_owned(), fault));
        };
        is(|d| d.y = "1 + k".into(), "y", F::NotSilent(1.0));
        let (key, fault) = refused(|d| d.x = "k * sqrt(fy)".into());
        assert!(key == "x" && matches!(fault, F::NotSilent(v) if v.is_nan()));
        let name = |name: &str| name.to_owned();
        is(
            |d| d.name = "Swirl".into(),
            "name",
            F::NotSnakeCase(name("Swirl")),
        );
        let key = "parameters.1.name";
        is(
            |d| d.parameters[1].name = "fx".into(),
            key,
            F::NameTaken(name("fx")),
        );
        let key = "parameters.0.typical";
        is(|d| d.parameters[0].typical = 0.0, key, F::NotPositive(0.0));
        is(|d| d.parameters.clear(), "parameters", F::NoParameter);
        let silent = |d: &mut Definition| (d.x, d.z) = (String::new(), " ".into());
        is(silent, "x", F::NoExpression);
    }
}
