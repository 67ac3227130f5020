//! Simulated sessions: what they hold and what the detector makes of them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod allan_noise_terms;
mod live_sessions;
mod recordings;
mod sessions;
