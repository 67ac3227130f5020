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

use crate::words::entry::error;

kinds! {
    /// A file cannot be read.
    UNREADABLE = "unreadable" => error(
        "cannot be read: {reason}",
        "check the name of the file, and that it is complete and may be read",
    ),
    /// A file cannot be written.
    UNWRITABLE = "unwritable" => error(
        "cannot be written: {reason}",
        "check the folder and the free space of the disk",
    ),
}
