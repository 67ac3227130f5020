//! Why parts do not make a whole.

use std::path::PathBuf;

use crate::shard::Shard;

/// Why a part cannot be merged.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// No part, a half-written one, a damaged one.
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// Of another run: other devices, options, version or number of shards.
    Foreign {
        /// The file.
        path: PathBuf,
        /// Its hash.
        found: String,
        /// That of most parts.
        expected: String,
    },
    /// No file is of this shard.
    Missing {
        /// The shard.
        shard: Shard,
    },
    /// Devices that a complete part should have.
    Lacks {
        /// Its place in the manifest.
        index: usize,
    },
}
