//! How far the data are from a model: by channel, by place, on intervals and recordings that the fit did not see.

pub(super) mod channel;
pub(super) mod held_out;
pub(super) mod localise;
pub(super) mod sequence;
pub(super) mod validation;
