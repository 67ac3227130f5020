//! Misfit of the data to a model: by channel and place, and on intervals that the fit did not use.

pub(super) mod channel;
pub(super) mod held_out;
pub(super) mod localise;
pub(super) mod sequence;
