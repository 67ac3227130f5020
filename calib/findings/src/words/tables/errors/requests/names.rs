//! Words of names that nothing has, or that something else has.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::{Entry, error, error_by};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::EffectUnknown => error_by(
            "[{key}: ]there is no such effect (source of error)[: {effect} is not in the list of known ones]",
            vec![Remedy::ListEffects],
        ),
        Kind::ParameterUnknown => error(
            "[{key}: ]there is no such parameter[: `{effect}` has {known}]",
            "correct the name",
        ),
        Kind::EffectTaken => error(
            "[{key}: ]`{name}` is another effect already",
            "choose another name",
        ),
        Kind::EffectNotLinear => error(
            "the effect {name} says that it is linear, and is not: its error goes with its own sensor's signal, or not evenly with its parameters",
            "leave its `LINEAR` out, which is always right",
        ),
        Kind::NameTaken => error(
            "[{key}: ]`{name}` means something else already",
            "choose another name",
        ),
        Kind::NameNotSnakeCase => error(
            "[{key}: ]`{name}` found, a name in snake case expected (lower case letters, digits and `_`)",
            "rename it",
        ),
        Kind::DefinitionOfOther => error(
            "[{key}: ]the definition of `{effect}` is that of `{other}`",
            "name both alike",
        ),
        _ => return None,
    })
}
