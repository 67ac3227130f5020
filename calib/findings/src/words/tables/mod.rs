//! Entries of all kinds, a file for each subject.

mod axes;
mod clocks;
mod device;
mod errors;
mod fit;
mod format;
mod import;
mod intervals;
mod magnetic;
mod noise;
mod other;
mod part_way;
mod reading;
mod stamps;
mod units;

use super::entry::Entry;
use crate::kind::Kind;

/// Entries of all kinds.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    [
        fit::ENTRIES,
        reading::ENTRIES,
        stamps::ENTRIES,
        units::ENTRIES,
        format::ENTRIES,
        import::ENTRIES,
        noise::ENTRIES,
        axes::ENTRIES,
        clocks::ENTRIES,
        device::ENTRIES,
        intervals::ENTRIES,
        magnetic::ENTRIES,
        part_way::ENTRIES,
        errors::files::ENTRIES,
        errors::recordings::ENTRIES,
        errors::requests::effects::ENTRIES,
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

/// The entry of a kind.
pub fn entry(kind: Kind) -> &'static Entry {
    let own = entries().find(|entry| entry.kind == kind);
    own.unwrap_or(&other::REMARK)
}
