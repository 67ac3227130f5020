//! Words of requests that cannot be met.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry::error(Kind::Cancelled, "cancelled", "", Vec::new),
    Entry::error(Kind::SolverRefused, "{reason}", "", Vec::new),
];
