//! Words of requests that cannot be met, by their subject.

pub(in super::super) mod calibrations;
pub(in super::super) mod doubts;
pub(in super::super) mod effects;
pub(in super::super) mod expressions;
pub(in super::super) mod fits;
pub(in super::super) mod names;
pub(in super::super) mod placements;
pub(in super::super) mod scalars;
pub(in super::super) mod tracks;
pub(in super::super) mod values;
