//! What the stories share: published test problems, simulated noise, recordings of a phone.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod conditions;
pub mod coverage;
pub mod faults;
pub mod fuzz;
pub mod layouts;
pub mod leave_one_out;
pub mod live;
pub mod magnetic;
pub mod needed_data;
pub mod noise_source;
pub mod one_truth;
pub mod phone;
pub mod plan_next;
pub mod plan_study;
pub mod power;
pub mod prior_study;
pub mod problems;
pub mod rust_files;
pub mod tie_study;
pub mod tuning;
