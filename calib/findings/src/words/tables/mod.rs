//! Kinds of findings with their words, a file for each subject.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::entry::Entry;
use crate::kind::Kind;

/// A kind with its words.
type Row = (Kind, fn() -> Entry);

/// Declares kinds of findings, each with its name and its words.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $name:literal => $words:expr,)*) => {
        impl crate::kind::Kind {
            $($(#[$doc])* pub const $kind: Self = Self::of($name);)*
        }

        pub(in crate::words::tables) const KINDS: &[crate::words::tables::Row] =
            &[$((crate::kind::Kind::$kind, || $words),)*];
    };
}

mod discovery;
mod errors;
mod fits;
mod format;
mod import;
mod noise;
mod other;
mod reading;
mod stamps;
mod stretches;
mod units;

/// The kinds of each subject, in the order of the manual.
const SUBJECTS: &[&[Row]] = &[
    fits::fit::KINDS,
    reading::KINDS,
    stamps::KINDS,
    units::KINDS,
    format::KINDS,
    import::KINDS,
    noise::KINDS,
    fits::axes::KINDS,
    fits::clocks::KINDS,
    fits::device::KINDS,
    fits::intervals::KINDS,
    stretches::KINDS,
    fits::magnetic::KINDS,
    fits::part_way::KINDS,
    discovery::KINDS,
    errors::files::KINDS,
    errors::search::KINDS,
    errors::files::limits::KINDS,
    errors::files::damage::KINDS,
    errors::files::archives::KINDS,
    errors::files::logs::KINDS,
    errors::files::tables::KINDS,
    errors::files::outputs::KINDS,
    errors::files::exports::KINDS,
    errors::files::imports::KINDS,
    errors::files::live::KINDS,
    errors::files::batches::KINDS,
    errors::files::notes::KINDS,
    errors::recordings::columns::KINDS,
    errors::recordings::folders::KINDS,
    errors::recordings::foreign::KINDS,
    errors::recordings::intervals::KINDS,
    errors::recordings::opening::KINDS,
    errors::recordings::readings::KINDS,
    errors::recordings::rows::KINDS,
    errors::recordings::stamps::KINDS,
    errors::recordings::units::KINDS,
    errors::requests::effects::KINDS,
    errors::requests::scalars::KINDS,
    errors::requests::names::KINDS,
    errors::requests::expressions::KINDS,
    errors::requests::values::KINDS,
    errors::requests::placements::KINDS,
    errors::requests::fits::KINDS,
    errors::requests::calibrations::KINDS,
    errors::requests::doubts::KINDS,
    errors::requests::tracks::KINDS,
    other::KINDS,
];

/// The words of each kind by its name.
static WORDS: LazyLock<HashMap<&'static str, Row>> =
    LazyLock::new(|| rows().map(|row| (row.0.name(), *row)).collect());

fn rows() -> impl Iterator<Item = &'static Row> {
    SUBJECTS.iter().copied().flatten()
}

/// The entry of a kind.
pub(crate) fn entry(kind: Kind) -> Entry {
    let own = WORDS.get(kind.name());
    own.map_or_else(other::remark_of_its_own, |(_, words)| words())
}

impl Kind {
    /// Every kind, in the order of the manual.
    pub fn all() -> impl Iterator<Item = Self> {
        rows().map(|(kind, _)| *kind)
    }

    /// Kind of a name; [`Kind::REMARK`] of a name that this version does not know.
    pub fn named(name: &str) -> Self {
        WORDS.get(name).map_or(Self::REMARK, |(kind, _)| *kind)
    }

    /// Returns true if only an effect search produces this kind, and no calibration does.
    pub fn is_of_a_search(self) -> bool {
        discovery::KINDS.iter().any(|(kind, _)| *kind == self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_name_of_its_own() {
        assert_eq!(WORDS.len(), Kind::all().count());
        assert!(Kind::all().all(|kind| Kind::named(kind.name()) == kind));
    }
}
