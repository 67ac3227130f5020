//! Readings that repeat where a sensor would not: an axis that is stuck, a sensor that has stopped, memory that was never written,
//! rows that are frozen, reads that failed.

pub(crate) mod erased_tail;
pub(crate) mod failed_reads;
pub(crate) mod frozen;
pub(crate) mod stale;
pub(crate) mod stopped;
pub(crate) mod stuck;
