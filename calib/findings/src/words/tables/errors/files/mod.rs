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
use crate::words::entry::{Entry, error};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::Unreadable => error(
            "cannot be read: {reason}",
            "check the name of the file, and that it is complete and may be read",
        ),
        Kind::Unwritable => error(
            "cannot be written: {reason}",
            "check the folder and the free space of the disk",
        ),
        _ => return None,
    })
}
