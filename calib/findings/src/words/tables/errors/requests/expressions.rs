//! Words of effects that are written as expressions.

use crate::kind::Kind;
use crate::words::entry::{Entry, error};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::ParametersMissing => error(
            "[{key}: ]none found: an effect needs a parameter that switches it off at 0",
            "add one",
        ),
        Kind::ExpressionMissing => {
            error("[{key}: ]no axis has an expression", "write one of x, y, z")
        }
        Kind::ExpressionCostly => error(
            "[{key}: ]the three expressions take {cost} steps, at most {most} may be: a function counts {call} and an operation 1 or 2",
            "write them with fewer, or as a compiled effect",
        ),
        Kind::NotSilent => error(
            "[{key}: ]is {value} at the nominal parameters in some motion, must be 0: an effect is silent in a perfect sensor",
            "multiply it by a parameter that is 0 in a perfect sensor",
        ),
        Kind::NoNumberInMotion => error(
            "[{key}: ]is {value} in some motion with parameters of a typical size, where a number is needed",
            "write it so that it is a number in every motion, as without divisions by what may be zero",
        ),
        Kind::PowerOfZero => error("[{key}: ]{covariate} to the power of 0", "leave it out"),
        Kind::ExpressionLong => error(
            "[{key}: ][`{text}`, ]column {column}: longer than {most} characters",
            "shorten it",
        ),
        Kind::ExpressionDeep => error(
            "[{key}: ][`{text}`, ]column {column}: brackets and signs stand more than {most} deep within each other",
            "write it with fewer brackets",
        ),
        Kind::ExpressionNoNumber => error(
            "[{key}: ][`{text}`, ]column {column}: `{found}` is no number",
            "write it as in 1.5 or 2e-3",
        ),
        Kind::ExpressionCharacter => error(
            "[{key}: ][`{text}`, ]column {column}: `{found}` has no meaning here",
            "remove it",
        ),
        Kind::OperatorExpected => error(
            "[{key}: ][`{text}`, ]column {column}: an operator expected, {found} found",
            "",
        ),
        Kind::OperandExpected => error(
            "[{key}: ][`{text}`, ]column {column}: a number, a name or a bracket expected, {found} found",
            "",
        ),
        Kind::SignExpected => error(
            "[{key}: ][`{text}`, ]column {column}: `{expected}` expected, {found} found",
            "",
        ),
        Kind::ExponentVaries => error(
            "[{key}: ][`{text}`, ]column {column}: the exponent must be a constant",
            "write exp(y*ln(x)) for x to the power of y",
        ),
        Kind::FunctionUnknown => error(
            "[{key}: ][`{text}`, ]column {column}: there is no function `{found}`: {known}",
            "use one of these",
        ),
        Kind::VariableUnknown => error(
            "[{key}: ][`{text}`, ]column {column}: there is no `{found}`: the variables are {known}",
            "use one of these",
        ),
        _ => return None,
    })
}
