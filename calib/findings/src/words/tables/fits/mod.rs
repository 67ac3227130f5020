//! Words of what a fit, its intervals and its sensors show.

pub(super) mod axes;
pub(super) mod clocks;
pub(super) mod device;
pub(super) mod fit;
pub(super) mod intervals;
pub(super) mod magnetic;
pub(super) mod part_way;
