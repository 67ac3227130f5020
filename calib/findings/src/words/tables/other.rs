//! Words of what has no group of its own.

use crate::kind::Kind;
use crate::level::Level;

use crate::words::entry::Entry;

/// A finding whose text is its own.
pub(super) const REMARK: Entry = Entry {
    kind: Kind::Remark,
    level: Level::Care,
    severity: 0.1,
    reason: "{text}",
    text: "{text}",
    advice: "",
    remedies: Vec::new,
};

pub(super) const ENTRIES: &[Entry] = &[REMARK];
