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

/// Entries of all kinds.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    [
        fits::fit::ENTRIES,
        reading::ENTRIES,
        stamps::ENTRIES,
        units::ENTRIES,
        format::ENTRIES,
        import::ENTRIES,
        noise::ENTRIES,
        fits::axes::ENTRIES,
        fits::clocks::ENTRIES,
        fits::device::ENTRIES,
        fits::intervals::ENTRIES,
        stretches::ENTRIES,
        fits::magnetic::ENTRIES,
        fits::part_way::ENTRIES,
        discovery::ENTRIES,
        errors::files::ENTRIES,
        errors::search::ENTRIES,
        errors::files::limits::ENTRIES,
        errors::files::damage::ENTRIES,
        errors::files::archives::ENTRIES,
        errors::files::logs::ENTRIES,
        errors::files::tables::ENTRIES,
        errors::files::outputs::ENTRIES,
        errors::files::exports::ENTRIES,
        errors::files::imports::ENTRIES,
        errors::files::live::ENTRIES,
        errors::files::batches::ENTRIES,
        errors::files::notes::ENTRIES,
        errors::recordings::columns::ENTRIES,
        errors::recordings::folders::ENTRIES,
        errors::recordings::foreign::ENTRIES,
        errors::recordings::intervals::ENTRIES,
        errors::recordings::opening::ENTRIES,
        errors::recordings::readings::ENTRIES,
        errors::recordings::rows::ENTRIES,
        errors::recordings::stamps::ENTRIES,
        errors::recordings::units::ENTRIES,
        errors::requests::effects::ENTRIES,
        errors::requests::scalars::ENTRIES,
        errors::requests::names::ENTRIES,
        errors::requests::expressions::ENTRIES,
        errors::requests::values::ENTRIES,
        errors::requests::placements::ENTRIES,
        errors::requests::fits::ENTRIES,
        errors::requests::calibrations::ENTRIES,
        errors::requests::doubts::ENTRIES,
        errors::requests::tracks::ENTRIES,
        other::ENTRIES,
    ]
    .into_iter()
    .flatten()
}

impl Kind {
    /// Returns true if only an effect search produces this kind, and no calibration does.
    pub fn is_of_a_search(self) -> bool {
        discovery::ENTRIES.iter().any(|entry| entry.kind == self)
    }
}

/// The entry of a kind.
pub fn entry(kind: Kind) -> &'static Entry {
    let own = entries().find(|entry| entry.kind == kind);
    own.unwrap_or(&other::REMARK)
}
