//! Words of what has no group of its own.

use crate::finding::Level;
use crate::kind::Kind;

use super::Entry;

/// A finding whose text is its own.
pub(super) const REMARK: Entry = Entry {
    kind: Kind::Remark,
    level: Level::Care,
    severity: 0.1,
    reason: "{text}",
    text: "{text}",
    remedies: Vec::new,
};

pub(super) const ENTRIES: &[Entry] = &[REMARK];
