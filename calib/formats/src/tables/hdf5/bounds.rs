//! What counts as a table, and what is said of damage.

use hdf5_reader::error::Error as Hdf5Error;

use crate::Error;

/// Fewer rows are settings, no readings.
pub(super) const FEWEST: u64 = 10;

/// More columns are a picture.
pub(super) const WIDEST: u64 = 64;

pub(super) fn damaged(error: Hdf5Error) -> Error {
    Error::refused(format!("the HDF5 file cannot be read: {error}"))
}
