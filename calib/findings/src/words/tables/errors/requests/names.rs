//! Words of names that nothing has, or that something else has.

use crate::kind::Kind;
use crate::remedy::Remedy;
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::EffectUnknown,
        "[{key}: ]there is no such effect (source of error)[: {effect} is not in the list of known ones]",
        "",
        || vec![Remedy::ListEffects],
    ),
    Entry::error(
        Kind::ParameterUnknown,
        "[{key}: ]there is no such parameter[: `{effect}` has {known}]",
        "correct the name",
        Vec::new,
    ),
    Entry::error(
        Kind::EffectTaken,
        "[{key}: ]`{name}` is another effect already",
        "choose another name",
        Vec::new,
    ),
    Entry::error(
        Kind::NameTaken,
        "[{key}: ]`{name}` means something else already",
        "choose another name",
        Vec::new,
    ),
    Entry::error(
        Kind::NameNotSnakeCase,
        "[{key}: ]`{name}` found, a name in snake case expected (lower case letters, digits and `_`)",
        "rename it",
        Vec::new,
    ),
    Entry::error(
        Kind::DefinitionOfOther,
        "[{key}: ]the definition of `{effect}` is that of `{other}`",
        "name both alike",
        Vec::new,
    ),
];
