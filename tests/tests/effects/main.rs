//! The catalogue of effects.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod catalogue;
mod names;
mod with_covariates;
