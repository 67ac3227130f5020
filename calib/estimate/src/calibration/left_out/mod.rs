//! Effects that a calibration leaves out, and what they do to its standard errors.

mod effect;
mod enlarged;

pub use effect::LeftOut;
pub use enlarged::Enlarged;
