//! The disagreement of a model under the noise of the biases, and where that noise is known from.

pub(super) mod level;
pub(super) mod noise_file;
pub(super) mod projected;
pub(super) mod projected_columns;
pub(super) mod spectrum;
pub(super) mod walk_prior;
