//! Bags of ROS 1 and ROS 2: three containers of the same messages.

pub(crate) mod bag;
pub(crate) mod db3;
pub(crate) mod imu;
mod json;
pub(crate) mod mcap;
mod sqlite;
