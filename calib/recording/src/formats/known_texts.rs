//! Texts whose program is known by their first lines.

use sensor::Sensor;

use super::phones::{androsensor, physics_toolbox, sensorlog};
use super::robots::{kalibr, px4_text, ros_text, trackers};
use super::texts::{
    TextFormat, brackets, clock_columns, clock_text, date_and_time, split_stamp, start_and_rate,
    two_headers, unpadded,
};
use crate::header::look::Look;
use crate::rows::parts::Part;

/// Tables whose names say less than their program means.
static TEXTS: [&TextFormat; 16] = [
    &physics_toolbox::PHYSICS_TOOLBOX,
    &sensorlog::SENSORLOG,
    &androsensor::ANDROSENSOR,
    &ros_text::ROSTOPIC,
    &kalibr::KALIBR,
    &px4_text::SENSOR_COMBINED,
    &trackers::XSENS,
    &trackers::SHIMMER,
    &start_and_rate::START_AND_RATE,
    &clock_columns::CLOCK_COLUMNS,
    &split_stamp::SPLIT_STAMP,
    &two_headers::TWO_HEADERS,
    &unpadded::UNPADDED,
    &clock_text::TIME_OF_DAY,
    &brackets::BRACKETS,
    &date_and_time::DATE_AND_TIME,
];

/// Returns the part of a text with `sensor`: by the rules of its program, else by the names of its columns.
pub(crate) fn part_of(look: &Look, sensor: Sensor) -> Part {
    let mut parts = TEXTS.iter().filter_map(|text| (text.parts)(look)).flatten();
    let known = parts.find(|part| part.may_hold(sensor));
    known.unwrap_or_default().narrowed(sensor)
}

/// Returns which of accelerometer and gyroscope a text has by the rules of its program; `None` for tables that are read by names.
pub(crate) fn known_sensors(look: &Look) -> Option<[bool; 2]> {
    let mut texts = TEXTS.iter().filter_map(|text| (text.parts)(look));
    let parts = texts.find(|parts| parts.iter().any(|part| !part.columns.is_empty()))?;
    let has = |sensor| parts.iter().any(|part: &Part| part.has(sensor));
    Some([has(Sensor::Accelerometer), has(Sensor::Gyroscope)])
}
