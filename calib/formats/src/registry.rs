//! The formats: one file and one line in [`FORMATS`] each.

use crate::format::Format;

/// Every format.
pub static FORMATS: &[&dyn Format] = &[
    &crate::mat::Mat,
    &crate::ulog::Ulog,
    &crate::ardupilot::ArduPilot,
    &crate::ros::mcap::Mcap,
    &crate::ros::bag::Bag,
    &crate::ros::db3::Db3,
    &crate::blackbox::Blackbox,
    &crate::sensor_logger_json::SensorLoggerJson,
];

/// The format of a file that begins with `head`.
pub fn recognise(head: &[u8]) -> Option<&'static dyn Format> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.recognises(head))
}
