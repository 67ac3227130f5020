//! Words of effects that are written as expressions.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::ParametersMissing,
        "[{key}: ]none found: an effect needs a parameter that switches it off at 0",
        "add one",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionMissing,
        "[{key}: ]no axis has an expression",
        "write one of x, y, z",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionCostly,
        "[{key}: ]the three expressions take {cost} steps, at most {most} may be: a function counts {call} and an operation 1 or 2",
        "write them with fewer, or as a compiled effect",
        Vec::new,
    ),
    Entry::error(
        Kind::NotSilent,
        "[{key}: ]is {value} at the nominal parameters in some motion, must be 0: an effect is silent in a perfect sensor",
        "multiply it by a parameter that is 0 in a perfect sensor",
        Vec::new,
    ),
    Entry::error(
        Kind::NoNumberInMotion,
        "[{key}: ]is {value} in some motion with parameters of a typical size, where a number is needed",
        "write it so that it is a number in every motion, as without divisions by what may be zero",
        Vec::new,
    ),
    Entry::error(
        Kind::PowerOfZero,
        "[{key}: ]{covariate} to the power of 0",
        "leave it out",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionLong,
        "[{key}: ][`{text}`, ]column {column}: longer than {most} characters",
        "shorten it",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionDeep,
        "[{key}: ][`{text}`, ]column {column}: brackets and signs stand more than {most} deep within each other",
        "write it with fewer brackets",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionNoNumber,
        "[{key}: ][`{text}`, ]column {column}: `{found}` is no number",
        "write it as in 1.5 or 2e-3",
        Vec::new,
    ),
    Entry::error(
        Kind::ExpressionCharacter,
        "[{key}: ][`{text}`, ]column {column}: `{found}` has no meaning here",
        "remove it",
        Vec::new,
    ),
    Entry::error(
        Kind::OperatorExpected,
        "[{key}: ][`{text}`, ]column {column}: an operator expected, {found} found",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::OperandExpected,
        "[{key}: ][`{text}`, ]column {column}: a number, a name or a bracket expected, {found} found",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::SignExpected,
        "[{key}: ][`{text}`, ]column {column}: `{expected}` expected, {found} found",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ExponentVaries,
        "[{key}: ][`{text}`, ]column {column}: the exponent must be a constant",
        "write exp(y*ln(x)) for x to the power of y",
        Vec::new,
    ),
    Entry::error(
        Kind::FunctionUnknown,
        "[{key}: ][`{text}`, ]column {column}: there is no function `{found}`: {known}",
        "use one of these",
        Vec::new,
    ),
    Entry::error(
        Kind::VariableUnknown,
        "[{key}: ][`{text}`, ]column {column}: there is no `{found}`: the variables are {known}",
        "use one of these",
        Vec::new,
    ),
];
