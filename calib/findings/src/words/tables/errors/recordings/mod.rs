//! Words of files that hold no recording that can be read.

pub(in super::super) mod columns;
pub(in super::super) mod folders;
pub(in super::super) mod foreign;
pub(in super::super) mod intervals;
pub(in super::super) mod opening;
pub(in super::super) mod readings;
pub(in super::super) mod rows;
pub(in super::super) mod stamps;
pub(in super::super) mod units;
