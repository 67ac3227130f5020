//! What the stories share.

pub mod noise_source;
pub mod phone;
