//! Words of files that hold no recording that can be read.

use crate::words::entry::Entry;

pub(in super::super) const ENTRIES: &[Entry] = &[];
