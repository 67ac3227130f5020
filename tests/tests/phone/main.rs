//! The recordings of the phone, where they are at hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod calibration;
mod discovery;
mod online_bias;
mod reckon;
mod six_position;
