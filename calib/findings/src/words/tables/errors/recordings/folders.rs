//! Words of folders, archives and logs of which the sensors are not clear.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::SensorUnused,
        "one sensor is missing, and {table} is a table that is not used and may hold it[; {archive} is unpacked before its files are named]",
        "name the one there is by itself",
        || vec![Remedy::FilePerSensor],
    ),
    Entry::error(
        Kind::NoEntry,
        "no entry `{entry}`; found {listed}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoRecordingInFolder,
        "{holder}, with neither acc.csv (t,ax,ay,az) nor gyro.csv (t,gx,gy,gz) nor any other recording; found {listed}",
        "",
        || vec![Remedy::FilePerSensor],
    ),
    Entry::error(
        Kind::EntryOpen,
        "{count} recordings in it: {listed}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::FilesOfOneSensor,
        "{first} and {second} are of one sensor",
        "",
        || vec![Remedy::FilePerSensor],
    ),
    Entry::error(
        Kind::EntryOfOneFile,
        "a file within is chosen of a folder or an archive, and this is one file",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Entry,
            }]
        },
    ),
    Entry::error(
        Kind::TopicOfText,
        "a topic is chosen within a log or a bag, and this is a text",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Topic,
            }]
        },
    ),
    Entry::error(
        Kind::ColumnsOfLog,
        "columns are given for tables of text, and this is none",
        "",
        || vec![Remedy::any_of([OptionName::Topic, OptionName::Instance])],
    ),
    Entry::error(
        Kind::InstanceNotNumber,
        "a sensor in this file is given by its number, and `{instance}` is none",
        "",
        || vec![Remedy::such_as(OptionName::Instance, "0")],
    ),
    Entry::error(
        Kind::PhyphoxLinear,
        "{file} is linear acceleration: phyphox has taken gravity off, and calibration needs it",
        "record again with the experiment \"Acceleration with g\", or add the sensor \"Accelerometer\" instead of \"Linear accelerometer\"",
        Vec::new,
    ),
    Entry::error(
        Kind::PhyphoxEmpty,
        "no accelerometer with gravity and no gyroscope in this phyphox export; found {listed}",
        "record both sensors, as \"Acceleration with g\" and \"Gyroscope\"",
        Vec::new,
    ),
    Entry::error(
        Kind::SensorLoggerLinear,
        "Accelerometer.csv of Sensor Logger is without gravity, and calibration needs it",
        "record again with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on, or add \"Gravity\"",
        Vec::new,
    ),
    Entry::error(
        Kind::LogWithoutSensor,
        "no accelerometer and no gyroscope in it; it holds {listed}[ ({why})]",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::LogSensorUnclear,
        "no {sensor} that is known as one, but {unclear} may be it and is not read",
        "rename it, or go on without it and name what is to be read",
        Vec::new,
    ),
    Entry::error(
        Kind::LogSensorsOpen,
        "{count} {sensor}s: {listed}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::LoggedSlowly,
        "{stream} is logged at {rate} only, too slow for a calibration[; {other} has {other_rate}, which PX4 has already corrected]",
        "set SDLOG_PROFILE to 769 (raw FIFO of both sensors) and record again",
        Vec::new,
    ),
];
