//! HDF5, which MATLAB 7.3 files are too: vectors of one length in a group are the columns of a table, a matrix of three
//! columns is a triad of them, records and other matrices are tables of their own.

mod bounds;
mod element;
mod found;
mod set;

use std::io::Write;
use std::sync::Arc;

use findings::{Finding, Kind};
use hdf5_reader::error::Error as Hdf5Error;
use hdf5_reader::filters::FILTER_SCALEOFFSET;
use hdf5_reader::filters::scaleoffset::decompress_with_limit;
use hdf5_reader::storage::FileStorage;
use hdf5_reader::{FilterRegistry, Hdf5File, OpenOptions};

use self::bounds::{FEWEST, damaged};
use self::found::Found;
use super::reader::{Listed, Reader};
use crate::error::counted;
use crate::shown::shown;
use crate::store::Store;
use crate::{Error, Limits};

/// HDF5 files. Links to other files are not followed.
pub(super) const READER: Reader = Reader { tables, write };

/// Bytes of chunks that are kept unpacked.
const CACHE: usize = 64 << 20;
/// Bytes that a read may always take.
const ALWAYS: u64 = 1 << 20;

fn tables(store: &Store, limits: Limits) -> Result<Listed, Error> {
    let mut found = Found::default();
    found.look(&open(store, limits)?, store.length()?, limits)?;
    if found.tables.is_empty() {
        let none = counted(Finding::of(Kind::NO_DATASET), "least", FEWEST);
        return Err(Error::refused(none.detail("listed", found.listed())));
    }
    Ok(Listed {
        names: found.tables.into_iter().map(|table| table.name).collect(),
        warnings: found.warnings,
    })
}

fn write(store: &Store, name: &str, limits: Limits, out: &mut dyn Write) -> Result<(), Error> {
    let file = open(store, limits)?;
    let mut found = Found::default();
    found.look(&file, store.length()?, limits)?;
    let table = found.tables.iter().find(|table| table.name == name);
    let table = table.ok_or_else(|| {
        let gone = Finding::of(Kind::TABLE_GONE).detail("table", shown(name));
        Error::refused(gone)
    })?;
    table.write(out)
}

/// The filters of the parser, which makes room for fill values of the scale-offset filter as large as the file says.
/// "HDF5 File Format Specification", version 3.0, IV.A.2.l: its fifth parameter is the size of a number.
fn filters(most: usize) -> FilterRegistry {
    let mut filters = FilterRegistry::new();
    filters.register(
        FILTER_SCALEOFFSET,
        Box::new(move |filter, data, _| {
            match filter.client_data.get(4).is_some_and(|size| *size <= 8) {
                true => decompress_with_limit(data, &filter.client_data, most),
                false => Err(Hdf5Error::FilterError("numbers beyond 8 bytes".to_owned())),
            }
        }),
    );
    filters
}

fn open(store: &Store, limits: Limits) -> Result<Hdf5File, Error> {
    // Memory grows with what there is: what was never written is read as well, as fill values.
    let most = store.length()?.saturating_mul(limits.ratio).max(ALWAYS);
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    let most = most.min(hdf5_reader::DEFAULT_MAX_CHUNK_BYTES);
    let options = OpenOptions::default()
        .with_chunk_cache_bytes(CACHE)
        .with_filter_registry(filters(most))
        .with_max_chunk_bytes(most)
        .with_max_read_bytes(most);
    match store {
        Store::File(path) => {
            let storage = FileStorage::open(path).map_err(damaged)?;
            Hdf5File::from_storage_with_options(Arc::new(storage), options)
        }
        Store::Memory(bytes) => Hdf5File::from_shared_bytes_with_options(bytes.clone(), options),
    }
    .map_err(damaged)
}
