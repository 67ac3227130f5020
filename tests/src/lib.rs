//! Published test problems, shared by the tests and the benches.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod problems;
