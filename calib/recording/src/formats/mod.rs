//! The formats that recordings come in: one file and one line in [`FORMATS`] each.

mod beside;
mod bundle;
mod csv;
mod folder;
pub(crate) mod format;
mod imu_tk;
pub(crate) mod known_texts;
mod log_streams;
mod measured;
mod phones;
pub(crate) mod robots;
mod serial_logs;
mod tables;
mod texts;

pub use file_formats::catches_panics;
use findings::{Finding, Kind};
pub use log_streams::{LogContents, LogStream};
use phones::{androsensor, phyphox, physics_toolbox, sensor_logger, sensorlog, sensorstream};
use robots::{
    ardupilot_log, betaflight, gyroflow, kalibr, novatel, px4_text, razor, ros_text, trackers,
    vmu931,
};
use serial_logs::{adafruit, axis_lines, headings, serial, tagged_rows};
use texts::{
    axis_rows, brackets, clock_columns, clock_text, date_and_time, documents, fields, labview,
    long, per_axis, split_stamp, start_and_rate, tagged, two_headers, unpadded, wide,
};

pub use crate::formats::format::Format;
pub use crate::source::Source;

/// Every format.
pub static FORMATS: &[&dyn Format] = &[
    &tables::Tables("json", recognise),
    &tables::Tables("npy", recognise),
    &tables::Tables("parquet", recognise),
    &tables::Tables("hdf5", recognise),
    &tables::Tables("xlsx", recognise),
    &phyphox::Phyphox,
    &sensor_logger::SensorLogger,
    &folder::Folder,
    &measured::Measured("mat"),
    &measured::Measured("ulog"),
    &measured::Measured("ardupilot"),
    &measured::Measured("mcap"),
    &measured::Measured("bag"),
    &measured::Measured("db3"),
    &measured::Measured("sensor_logger_json"),
    &measured::Measured("blackbox"),
    &bundle::Bundle(recognise),
    &physics_toolbox::PHYSICS_TOOLBOX,
    &sensorlog::SENSORLOG,
    &androsensor::ANDROSENSOR,
    &sensorstream::SENSORSTREAM,
    &ros_text::ROSTOPIC,
    &ros_text::ROS2_TOPIC,
    &kalibr::KALIBR,
    &px4_text::SENSOR_COMBINED,
    &trackers::XSENS,
    &trackers::SHIMMER,
    &ardupilot_log::ARDUPILOT_LOG,
    &betaflight::BETAFLIGHT,
    &razor::RAZOR,
    &vmu931::VMU931,
    &gyroflow::GYROFLOW,
    &novatel::NOVATEL,
    &tagged::GET_SENSOR_DATA,
    &tagged::GNSS_LOGGER,
    &tagged::VECTORNAV,
    &labview::LABVIEW,
    &per_axis::PER_AXIS,
    &wide::WIDE,
    &two_headers::TWO_HEADERS,
    &long::LONG,
    &axis_rows::AXIS_ROWS,
    &fields::FIELDS,
    &documents::DOCUMENTS,
    &adafruit::ADAFRUIT,
    &headings::HEADINGS,
    &serial::SERIAL,
    &axis_lines::AXIS_LINES,
    &tagged_rows::TAGGED_ROWS,
    &start_and_rate::START_AND_RATE,
    &clock_columns::CLOCK_COLUMNS,
    &split_stamp::SPLIT_STAMP,
    &unpadded::UNPADDED,
    &clock_text::TIME_OF_DAY,
    &brackets::BRACKETS,
    &date_and_time::DATE_AND_TIME,
    &imu_tk::ImuTk,
    &csv::Csv,
];

/// The format called `name`.
///
/// # Errors
/// The names there are.
pub fn by_name(name: &str) -> Result<&'static dyn Format, Box<Finding>> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.name() == name)
        .ok_or_else(|| {
            let names: Vec<_> = FORMATS.iter().map(|format| format.name()).collect();
            let found = Finding::of(Kind::NO_FORMAT).detail("format", crate::shown::shown(name));
            Box::new(found.detail("known", names.join(", ")))
        })
}

/// The format of `source`.
pub(crate) fn recognise(source: &Source) -> Option<&'static dyn Format> {
    FORMATS
        .iter()
        .copied()
        .find(|format| format.recognises(source))
}
