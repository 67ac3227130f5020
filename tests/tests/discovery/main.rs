//! Discovery: what is named, described, proposed and told apart.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod emitted_effect;
mod planned_ties;
mod real_devices;
mod stories;
