//! Calibration, from the recording to the figures that are stated.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod accelerometer_step2;
mod coplanar_placements;
mod coverage_conditions;
mod headings;
mod invariances;
mod joint_estimate;
mod leave_one_out;
mod magnetometer;
mod mpu9150;
mod one_truth;
mod prior_of_a_type;
mod several_recordings;
mod small_standard_errors;
mod stories;
mod verdicts;
