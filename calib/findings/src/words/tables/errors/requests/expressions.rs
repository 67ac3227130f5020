//! Words of effects that are written as expressions.

use crate::words::entry::error;

kinds! {
    /// An effect has no parameter.
    PARAMETERS_MISSING = "parameters_missing" => error(
        "[{key}: ]none found: an effect needs a parameter that switches it off at 0",
        "add one",
    ),
    /// An effect has no expression.
    EXPRESSION_MISSING = "expression_missing" => {
        error("[{key}: ]no axis has an expression", "write one of x, y, z")
    },
    /// The expressions of an effect take too many steps.
    EXPRESSION_COSTLY = "expression_costly" => error(
        "[{key}: ]the three expressions take {cost} steps, at most {most} may be: a function counts {call} and an operation 1 or 2",
        "write them with fewer, or as a compiled effect",
    ),
    /// An effect is not silent in a perfect sensor.
    NOT_SILENT = "not_silent" => error(
        "[{key}: ]is {value} at the nominal parameters in some motion, must be 0: an effect is silent in a perfect sensor",
        "multiply it by a parameter that is 0 in a perfect sensor",
    ),
    /// An effect is no number in some motion.
    NO_NUMBER_IN_MOTION = "no_number_in_motion" => error(
        "[{key}: ]is {value} in some motion with parameters of a typical size, where a number is needed",
        "write it so that it is a number in every motion, as without divisions by what may be zero",
    ),
    /// A factor of a formula is to the power of zero.
    POWER_OF_ZERO = "power_of_zero" => error("[{key}: ]{covariate} to the power of 0", "leave it out"),
    /// An expression is too long.
    EXPRESSION_LONG = "expression_long" => error(
        "[{key}: ][`{text}`, ]column {column}: longer than {most} characters",
        "shorten it",
    ),
    /// An expression is nested too deeply.
    EXPRESSION_DEEP = "expression_deep" => error(
        "[{key}: ][`{text}`, ]column {column}: brackets and signs stand more than {most} deep within each other",
        "write it with fewer brackets",
    ),
    /// A number of an expression cannot be read.
    EXPRESSION_NO_NUMBER = "expression_no_number" => error(
        "[{key}: ][`{text}`, ]column {column}: `{found}` is no number",
        "write it as in 1.5 or 2e-3",
    ),
    /// A character has no meaning in an expression.
    EXPRESSION_CHARACTER = "expression_character" => error(
        "[{key}: ][`{text}`, ]column {column}: `{found}` has no meaning here",
        "remove it",
    ),
    /// Something else stands where an expression needs an operator.
    OPERATOR_EXPECTED = "operator_expected" => error(
        "[{key}: ][`{text}`, ]column {column}: an operator expected, {found} found",
        "",
    ),
    /// Something else stands where an expression needs an operand.
    OPERAND_EXPECTED = "operand_expected" => error(
        "[{key}: ][`{text}`, ]column {column}: a number, a name or a bracket expected, {found} found",
        "",
    ),
    /// Something else stands where an expression needs a bracket.
    SIGN_EXPECTED = "sign_expected" => error(
        "[{key}: ][`{text}`, ]column {column}: `{expected}` expected, {found} found",
        "",
    ),
    /// An exponent is no constant.
    EXPONENT_VARIES = "exponent_varies" => error(
        "[{key}: ][`{text}`, ]column {column}: the exponent must be a constant",
        "write exp(y*ln(x)) for x to the power of y",
    ),
    /// An expression calls a function that there is not.
    FUNCTION_UNKNOWN = "function_unknown" => error(
        "[{key}: ][`{text}`, ]column {column}: there is no function `{found}`: {known}",
        "use one of these",
    ),
    /// An expression names a variable that there is not.
    VARIABLE_UNKNOWN = "variable_unknown" => error(
        "[{key}: ][`{text}`, ]column {column}: there is no `{found}`: the variables are {known}",
        "use one of these",
    ),
}
