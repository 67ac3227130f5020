//! A zip archive that is never unpacked to the disk.

use findings::{Finding, Findings, Kind};
use std::io::Read;

use super::directory::{Packed, directory};
use super::entry::unpacked;
use crate::shown::shown;
use crate::store::Store;
use crate::{Error, Limits};

/// The entries of an archive, in the order of their names.
#[derive(Clone, Debug)]
pub(crate) struct Archive {
    store: Store,
    limits: Limits,
    /// Name and place of every entry that does not lie outside.
    pub entries: Vec<(String, Packed)>,
    /// Warnings about entries that were left out.
    pub warnings: Findings,
}

impl Archive {
    /// Reads the directory.
    ///
    /// # Errors
    /// A damaged directory with the byte, encryption, or an archive beyond the limits.
    pub fn open(store: Store, limits: Limits) -> Result<Self, Error> {
        let packed = directory(&mut store.open()?, limits)?;
        let mut warnings = Findings::new();
        let mut entries = Vec::new();
        for (name, packed) in packed {
            if is_outside(&name) {
                let outside = Finding::of(Kind::ENTRY_OUTSIDE);
                warnings.push(outside.detail("entry", shown(&name)));
                continue;
            }
            entries.push((name, packed));
        }
        entries.sort_by(|a, b| a.0.cmp(&b.0));
        Ok(Self {
            store,
            limits,
            entries,
            warnings,
        })
    }

    /// The content of an entry. Reading fails where it is damaged.
    ///
    /// # Errors
    /// More than the limits allow, or a way of packing that is not known.
    pub fn content(&self, name: &str, packed: &Packed) -> Result<Box<dyn Read + Send>, Error> {
        self.limits
            .check_unpacked(name, packed.packed_size, packed.size)?;
        unpacked(self.store.open()?, packed)
    }
}

/// True for names that lead out of the place where an archive is unpacked.
fn is_outside(name: &str) -> bool {
    let is_drive = name.as_bytes().get(1) == Some(&b':');
    name.starts_with(['/', '\\']) || is_drive || name.split(['/', '\\']).any(|part| part == "..")
}
