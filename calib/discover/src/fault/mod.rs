//! Faults of the recording itself.

pub(super) mod delay;
pub(super) mod integrity;
pub(super) mod mixed;
pub(super) mod undersampled;
