//! Words of names that nothing has, or that something else has.

use crate::remedy::Remedy;
use crate::words::entry::{error, error_by};

kinds! {
    /// There is no effect of this name.
    EFFECT_UNKNOWN = "effect_unknown" => error_by(
        "[{key}: ]there is no such effect (source of error)[: {effect} is not in the list of known ones]",
        vec![Remedy::ListEffects],
    ),
    /// There is no parameter of this name.
    PARAMETER_UNKNOWN = "parameter_unknown" => error(
        "[{key}: ]there is no such parameter[: `{effect}` has {known}]",
        "correct the name",
    ),
    /// The name of an effect is that of another.
    EFFECT_TAKEN = "effect_taken" => error(
        "[{key}: ]`{name}` is another effect already",
        "choose another name",
    ),
    /// An effect says that it is linear, and is not.
    EFFECT_NOT_LINEAR = "effect_not_linear" => error(
        "the effect {name} says that it is linear, and is not: its error goes with its own sensor's signal, or not evenly with its parameters",
        "leave its `LINEAR` out, which is always right",
    ),
    /// A name means something else already.
    NAME_TAKEN = "name_taken" => error(
        "[{key}: ]`{name}` means something else already",
        "choose another name",
    ),
    /// A name is not in snake case.
    NAME_NOT_SNAKE_CASE = "name_not_snake_case" => error(
        "[{key}: ]`{name}` found, a name in snake case expected (lower case letters, digits and `_`)",
        "rename it",
    ),
    /// The definition of an effect is that of another.
    DEFINITION_OF_OTHER = "definition_of_other" => error(
        "[{key}: ]the definition of `{effect}` is that of `{other}`",
        "name both alike",
    ),
}
