//! The formats: one file and one line in [`FORMATS`] each.

use crate::format::Format;

/// Every format.
pub static FORMATS: &[&Format] = &[
    &crate::mat::MAT,
    &crate::ulog::ULOG,
    &crate::ardupilot::ARDUPILOT,
    &crate::ros::mcap::MCAP,
    &crate::ros::bag::BAG,
    &crate::ros::db3::DB3,
    &crate::blackbox::BLACKBOX,
    &crate::sensor_logger_json::SENSOR_LOGGER_JSON,
];

/// The format of a file that begins with `head`.
pub fn recognise(head: &[u8]) -> Option<&'static Format> {
    FORMATS.iter().copied().find(|format| (format.begins)(head))
}
