//! Faults of the recording itself.

pub(super) mod integrity;
pub(super) mod time_offset;
