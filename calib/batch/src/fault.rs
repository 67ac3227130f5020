//! Why parts do not make a whole.

use std::path::PathBuf;

use calib::recording::shown::shown_path;
use findings::{Finding, Kind, Remedy};

use crate::part::Identity;
use crate::shard::Shard;

/// Why a part cannot be merged.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fault {
    /// No part, a half-written one, a damaged one.
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Its damage.
        found: Box<Finding>,
    },
    /// The part belongs to another run: other devices, options, version or number of shards.
    Foreign {
        /// The file.
        path: PathBuf,
        /// Its run.
        found: Identity,
        /// Identity of the run that most parts belong to.
        expected: Identity,
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

impl Fault {
    /// The finding, with the part's file as its place.
    pub(crate) fn finding(&self) -> Finding {
        match self {
            Self::Unreadable { path, found } => (**found).clone().in_file(shown_path(path)),
            Self::Foreign {
                path,
                found,
                expected,
            } => Finding::of(Kind::PART_FOREIGN)
                .in_file(shown_path(path))
                .detail("found", &found.manifest)
                .count("devices", found.devices)
                .count("shards", found.shards)
                .detail("program", &found.program)
                .detail("expected", &expected.manifest)
                .count("expected_devices", expected.devices)
                .count("expected_shards", expected.shards)
                .detail("expected_program", &expected.program),
            Self::Missing { shard } => {
                let part = format!("{}/{}", shard.k, shard.n);
                let missing = Finding::of(Kind::BATCH_PART_MISSING).detail("part", &part);
                missing.only_remedies([Remedy::RunShard { shard: Some(part) }])
            }
            Self::Lacks { index } => Finding::of(Kind::DEVICE_IN_NO_PART).count("index", index + 1),
        }
    }
}
