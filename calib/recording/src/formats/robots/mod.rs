//! Text formats of robots, drones and their tools.

pub(crate) mod adafruit;
pub(crate) mod ardupilot_text;
pub(crate) mod betaflight;
pub(crate) mod gyroflow;
pub(crate) mod kalibr;
mod labelled_numbers;
mod log_prefix;
pub(crate) mod novatel;
pub(crate) mod px4_text;
pub(crate) mod razor;
pub(crate) mod ros_text;
pub(crate) mod serial;
pub(crate) mod trackers;
pub(crate) mod vmu931;
