//! Faults of the recording itself.

pub(super) mod delay;
mod disturbances;
pub(super) mod integrity;
pub(super) mod mixed;
pub(super) mod of_the_fit;
mod part_way;
