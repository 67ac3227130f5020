//! Words of files that are not read or not written.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[
    Entry::error(Kind::Unreadable, "{reason}", "", Vec::new),
    Entry::error(
        Kind::Unwritable,
        "cannot be written: {reason}",
        "",
        Vec::new,
    ),
];
