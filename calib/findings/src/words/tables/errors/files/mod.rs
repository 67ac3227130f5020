//! Words of files that are not read or not written.

pub(in crate::words::tables) mod archives;
pub(in crate::words::tables) mod batches;
pub(in crate::words::tables) mod damage;
pub(in crate::words::tables) mod exports;
pub(in crate::words::tables) mod imports;
pub(in crate::words::tables) mod limits;
pub(in crate::words::tables) mod live;
pub(in crate::words::tables) mod logs;
pub(in crate::words::tables) mod notes;
pub(in crate::words::tables) mod outputs;
pub(in crate::words::tables) mod tables;

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::Unreadable,
        "cannot be read: {reason}",
        "check the name of the file, and that it is complete and may be read",
        Vec::new,
    ),
    Entry::error(
        Kind::Unwritable,
        "cannot be written: {reason}",
        "check the folder and the free space of the disk",
        Vec::new,
    ),
];
