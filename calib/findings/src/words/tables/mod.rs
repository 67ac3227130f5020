//! Entries of all kinds, a file for each subject.

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

use super::entry::Entry;
use crate::kind::Kind;

/// The words of each subject; none of a kind of another.
const SUBJECTS: &[fn(Kind) -> Option<Entry>] = &[
    fits::fit::words,
    reading::words,
    stamps::words,
    units::words,
    format::words,
    import::words,
    noise::words,
    fits::axes::words,
    fits::clocks::words,
    fits::device::words,
    fits::intervals::words,
    stretches::words,
    fits::magnetic::words,
    fits::part_way::words,
    discovery::words,
    errors::files::words,
    errors::search::words,
    errors::files::limits::words,
    errors::files::damage::words,
    errors::files::archives::words,
    errors::files::logs::words,
    errors::files::tables::words,
    errors::files::outputs::words,
    errors::files::exports::words,
    errors::files::imports::words,
    errors::files::live::words,
    errors::files::batches::words,
    errors::files::notes::words,
    errors::recordings::columns::words,
    errors::recordings::folders::words,
    errors::recordings::foreign::words,
    errors::recordings::intervals::words,
    errors::recordings::opening::words,
    errors::recordings::readings::words,
    errors::recordings::rows::words,
    errors::recordings::stamps::words,
    errors::recordings::units::words,
    errors::requests::effects::words,
    errors::requests::scalars::words,
    errors::requests::names::words,
    errors::requests::expressions::words,
    errors::requests::values::words,
    errors::requests::placements::words,
    errors::requests::fits::words,
    errors::requests::calibrations::words,
    errors::requests::doubts::words,
    errors::requests::tracks::words,
    other::words,
];

/// The entry of a kind.
pub(crate) fn entry(kind: Kind) -> Entry {
    let own = SUBJECTS.iter().find_map(|words| words(kind));
    own.unwrap_or_else(other::remark_of_its_own)
}

impl Kind {
    /// Returns true if only an effect search produces this kind, and no calibration does.
    pub fn is_of_a_search(self) -> bool {
        discovery::words(self).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_of_exactly_one_subject_and_has_its_own_name() {
        for kind in Kind::ALL {
            let count = SUBJECTS.iter().filter(|words| words(*kind).is_some());
            assert_eq!(count.count(), 1, "{}", kind.name());
            assert_eq!(Kind::named(kind.name()), *kind);
        }
    }
}
