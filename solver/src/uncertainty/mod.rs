//! Statements of the data about the parameters besides their values.

pub(crate) mod covariance;
pub(crate) mod observability;
pub(crate) mod profile;
