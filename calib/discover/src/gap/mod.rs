//! Misfit of the data to a model: by channel and place, and on intervals and recordings that the fit did not use.

pub(super) mod channel;
pub(super) mod held_out;
pub(super) mod localise;
pub(super) mod sequence;
pub(super) mod validation;
