//! What the stories share.

pub mod noise_source;
