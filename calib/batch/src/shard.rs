//! A part of the work.

use serde::{Deserialize, Serialize};

use crate::error::Error;

/// The `k`-th of `n` parts of the work, `k` from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// From 1.
    pub k: usize,
    /// Number of shards.
    pub n: usize,
}

impl Default for Shard {
    fn default() -> Self {
        Self { k: 1, n: 1 }
    }
}

impl Shard {
    /// Returns true if the shard has the device at this place of the manifest. Neighbours go to different shards, so
    /// that long and short recordings spread.
    pub fn has(self, index: usize) -> bool {
        index % self.n == self.k - 1
    }
}

impl std::str::FromStr for Shard {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let parts = text
            .split_once('/')
            .and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((k, n)) if (1..=n).contains(&k) => Ok(Self { k, n }),
            _ => Err(Error::Shard(text.to_owned())),
        }
    }
}
