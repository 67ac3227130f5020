//! Files of these formats, for tests: what the readers are given is written here.

mod db3;
mod logs;
mod matlab;
mod ros;
mod tables;
mod zip;

pub use db3::db3;
pub use logs::{ardupilot, ulog};
pub use matlab::{mat, matrices_of, structure_of};
pub use ros::{Packer, Ros, bag, mcap};
pub use tables::{SheetCell, hdf5, workbook};
pub use zip::{Packing, zip};

/// Stamps and samples: ns and three values.
pub type Rows = Vec<(i64, [f64; 3])>;

/// A stamp, ns, and the specific force and angular rate at it.
pub type ImuRow = (i64, [f64; 3], [f64; 3]);
