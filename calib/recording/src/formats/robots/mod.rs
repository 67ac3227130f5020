//! Text formats of robots, drones and their tools.

pub(crate) mod ardupilot_log;
pub(crate) mod ardupilot_text;
pub(crate) mod betaflight;
pub(crate) mod gyroflow;
pub(crate) mod kalibr;
pub(crate) mod novatel;
pub(crate) mod px4_text;
pub(crate) mod razor;
pub(crate) mod ros_text;
pub(crate) mod trackers;
pub(crate) mod vmu931;
