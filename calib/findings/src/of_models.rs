//! Errors of the models as findings: their data are the models', their words are here.

use sensor::expression::{Expected, FUNCTIONS, ParseError, ParseFault};
use sensor::{DefinitionError, DefinitionFault, EffectFault, EffectRef};

use crate::finding::Finding;
use crate::kind::Kind;

impl From<ParseError> for Finding {
    fn from(error: ParseError) -> Self {
        use ParseFault as F;
        let of = |kind| Self::of(kind).detail("column", error.column.to_string());
        match error.fault {
            F::TooLong(most) => of(Kind::EXPRESSION_LONG).count("most", most),
            F::TooDeep(most) => of(Kind::EXPRESSION_DEEP).count("most", most),
            F::NoNumber(word) => of(Kind::EXPRESSION_NO_NUMBER).detail("found", word),
            F::NoMeaning(character) => {
                of(Kind::EXPRESSION_CHARACTER).detail("found", character.to_string())
            }
            F::Unexpected { expected, found } => {
                let own = match expected {
                    Expected::Operator => of(Kind::OPERATOR_EXPECTED),
                    Expected::Value => of(Kind::OPERAND_EXPECTED),
                    Expected::Sign(sign) => {
                        of(Kind::SIGN_EXPECTED).detail("expected", sign.to_string())
                    }
                };
                own.detail(
                    "found",
                    found.map_or("the end".into(), |f| format!("`{f}`")),
                )
            }
            F::ExponentVaries => of(Kind::EXPONENT_VARIES),
            F::NoFunction(name) => of(Kind::FUNCTION_UNKNOWN)
                .detail("found", name)
                .detail("known", FUNCTIONS.join(", ")),
            F::NoVariable { name, known } => of(Kind::VARIABLE_UNKNOWN)
                .detail("found", name)
                .detail("known", known.join(", ")),
            other => of(Kind::EXPRESSION_NO_NUMBER).detail("found", format!("{other:?}")),
        }
    }
}

impl From<DefinitionFault> for Finding {
    fn from(fault: DefinitionFault) -> Self {
        use DefinitionFault as F;
        let positive = "a positive size";
        match fault {
            F::NotSnakeCase(name) => Self::of(Kind::NAME_NOT_SNAKE_CASE).detail("name", name),
            F::NameTaken(name) => Self::of(Kind::NAME_TAKEN).detail("name", name),
            F::EffectTaken(name) => Self::of(Kind::EFFECT_TAKEN).detail("name", name),
            F::NoParameter => Self::of(Kind::PARAMETERS_MISSING),
            F::NotPositive(value) => out_of_range(value, positive),
            F::NotFinite(value) => out_of_range(value, "a number"),
            F::Unreadable { text, error } => Self::from(error).detail("text", text),
            F::NoExpression => Self::of(Kind::EXPRESSION_MISSING),
            F::Costly { cost, most, call } => Self::of(Kind::EXPRESSION_COSTLY)
                .detail("cost", cost.to_string())
                .detail("most", most.to_string())
                .detail("call", call.to_string()),
            F::NotSilent(value) => Self::of(Kind::NOT_SILENT).detail("value", value.to_string()),
            F::NoNumber(value) => {
                Self::of(Kind::NO_NUMBER_IN_MOTION).detail("value", value.to_string())
            }
            F::PowerOfZero(name) => Self::of(Kind::POWER_OF_ZERO).detail("covariate", name),
            other => Self::from(format!("{other:?}")),
        }
    }
}

fn out_of_range(value: f64, expected: &str) -> Finding {
    Finding::of(Kind::OUT_OF_RANGE)
        .detail("value", value.to_string())
        .detail("expected", expected)
}

impl From<DefinitionError> for Finding {
    fn from(error: DefinitionError) -> Self {
        Self::from(error.fault).detail("key", error.key)
    }
}

impl Finding {
    /// Builds the finding for a fault in an effect that a user wrote.
    pub fn of_effect(effect: &EffectRef, fault: &EffectFault) -> Self {
        let of = |kind| Self::of(kind).detail("effect", effect.name());
        match fault {
            EffectFault::NoNumber {
                force: [fx, fy, fz],
                rate: [wx, wy, wz],
                parameters,
            } => of(Kind::EFFECT_NO_NUMBER)
                .detail("force", format!("{fx:.3}, {fy:.3}, {fz:.3}"))
                .detail("rate", format!("{wx:.4}, {wy:.4}, {wz:.4}"))
                .detail("parameters", format!("{parameters:?}")),
            _ => of(Kind::EFFECT_COSTLY),
        }
    }
}

#[cfg(test)]
mod tests {
    use sensor::expression::Expression;
    use sensor::{DefinedParam, Definition, Sensor};

    use super::*;

    #[test]
    fn an_expression_that_cannot_be_read_is_said_with_its_column() {
        let refused = |text: &str| {
            let error = Expression::parse(text, &["x", "y"]).unwrap_err();
            Finding::from(error).to_string()
        };
        let value = "a number, a name or a bracket expected";
        for (text, said) in [
            (
                "x + q*y",
                "column 5: there is no `q`: the variables are x, y; use one of these".to_owned(),
            ),
            ("x + ", format!("column 5: {value}, the end found")),
            ("x * * y", format!("column 5: {value}, `*` found")),
            ("(x + y", "column 7: `)` expected, the end found".into()),
            ("x y", "column 3: an operator expected, `y` found".into()),
            (
                "x $ y",
                "column 3: `$` has no meaning here; remove it".into(),
            ),
            (
                "1.2.3",
                "column 1: `1.2.3` is no number; write it as in 1.5 or 2e-3".into(),
            ),
        ] {
            assert_eq!(refused(text), said);
        }
        assert!(refused("sinn(x)").starts_with("column 1: there is no function `sinn`: sin, "));
        assert!(refused("x^y").starts_with("column 3: the exponent must be a constant; write"));
        assert!(refused(&"(".repeat(5000)).contains("longer than 2000"));
        assert!(refused(&"(".repeat(900)).contains("more than 100 deep"));
    }

    #[test]
    fn an_entry_of_a_definition_is_named_with_what_is_wrong() {
        let refused = |change: fn(&mut Definition)| {
            let mut definition = Definition {
                name: "gyro_said_in_words".into(),
                x: "k * fy * wz^2".into(),
                parameters: vec![DefinedParam::new("k", "s/m*s", 1e-4)],
                ..Definition::silent(Sensor::Gyroscope)
            };
            change(&mut definition);
            let error = definition.effect().map(|_| ()).unwrap_err();
            Finding::from(error).to_string()
        };
        let starts = |change, start: &str| {
            let said = refused(change);
            assert!(said.starts_with(start), "{said}");
        };
        let unknown = "x: `k * fq`, column 5: there is no `fq`: the variables are fx, fy";
        starts(|d| d.x = "k * fq".into(), unknown);
        starts(
            |d| d.y = "1 + k".into(),
            "y: is 1 at the nominal parameters",
        );
        starts(|d| d.x = "k * sqrt(fy)".into(), "x: is NaN at");
        starts(
            |d| d.name = "Swirl".into(),
            "name: `Swirl` found, a name in snake case",
        );
        starts(
            |d| d.parameters[0].typical = 0.0,
            "parameters.0.typical: is 0, expected a positive size",
        );
        starts(|d| d.parameters.clear(), "parameters: none found");
    }
}
