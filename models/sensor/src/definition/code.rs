//! The error of an effect in other languages.

use super::Definition;
use crate::axis::Axis;
use crate::covariate::Covariate;
use crate::effect::AnyEffect;
use crate::expression::{Expression, Language};

/// The error of an effect on one axis, as code.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorCode {
    /// An expression over the names of the covariates.
    pub text: String,
    /// Those that it looks at.
    pub covariates: Vec<Covariate>,
}

/// The error of `effect` with parameters `p` on `axis`, in `language`; `None` of an effect that is no formula.
///
/// # Examples
/// ```
/// use stillpoint_sensor::{Axis, Definition, DefinedParam, Sensor, error_code};
/// use stillpoint_sensor::expression::Language;
///
/// let swirl = Definition {
///     name: "accel_swirl".into(),
///     x: "k * fy * fz".into(),
///     parameters: vec![DefinedParam::new("k", "1/(m/s^2)", 1e-4)],
///     ..Definition::silent(Sensor::Accelerometer)
/// };
/// let code = error_code(&*swirl.effect()?, &[0.25], Axis::X, Language::Rust).unwrap();
/// assert_eq!(code.text, "0.25_f64 * fy * fz");
/// assert_eq!(code.covariates.len(), 2);
/// # Ok::<(), stillpoint_sensor::DefinitionError>(())
/// ```
pub fn error_code(
    effect: &dyn AnyEffect,
    p: &[f64],
    axis: Axis,
    language: Language,
) -> Option<ErrorCode> {
    let (covariates, expression) = parsed(effect, axis)?;
    let count = covariates.len();
    let variable = |k: usize| match covariates.get(k) {
        Some(covariate) => covariate.name(),
        None => match p.get(k - count).copied().unwrap_or(f64::NAN) {
            value if value < 0.0 => format!("({})", language.number(value)),
            value => language.number(value),
        },
    };
    let text = expression.code(language, &variable);
    let used = covariates.iter().enumerate();
    let used = used.filter(|(k, _)| expression.uses(*k));
    Some(ErrorCode {
        text,
        covariates: used.map(|(_, covariate)| *covariate).collect(),
    })
}

fn parsed(effect: &dyn AnyEffect, axis: Axis) -> Option<(Vec<Covariate>, Expression)> {
    let text = effect.formula(axis)?;
    let (covariates, names) = Definition::names(effect.params().iter().map(|p| &*p.name));
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    Some((covariates, Expression::parse(&text, &names).ok()?))
}
