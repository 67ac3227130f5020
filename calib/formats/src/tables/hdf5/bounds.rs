//! Bounds of what counts as a table, and damage.

use hdf5_reader::error::Error as Hdf5Error;

use crate::Error;
use crate::error::unreadable;

/// Fewer rows are settings, no readings.
pub(super) const FEWEST: u64 = 10;

/// More columns are a picture.
pub(super) const WIDEST: u64 = 64;

pub(super) fn damaged(error: Hdf5Error) -> Error {
    unreadable("HDF5 file", &error)
}
