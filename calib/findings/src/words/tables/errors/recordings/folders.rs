//! Words of folders, archives and logs of which the sensors are not clear.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::SensorUnused,
        "no file is known to hold the second sensor, and the table {table}, which is not used, may hold it[; {archive} is unpacked before its files are named]",
        "name the file that was recognised by itself",
        || vec![Remedy::FilePerSensor],
    ),
    Entry::error(
        Kind::NoEntry,
        "it has no file `{entry}`; found {listed}",
        "name one of these",
        Vec::new,
    ),
    Entry::error(
        Kind::NoRecordingInFolder,
        "this is {holder} without a recording: it has neither acc.csv (t,ax,ay,az) nor gyro.csv (t,gx,gy,gz) nor any other; found {listed}",
        "",
        || vec![Remedy::FilePerSensor],
    ),
    Entry::error(
        Kind::EntryOpen,
        "the program cannot tell which recording is meant: there are {count} recordings in it: {listed}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::FilesOfOneSensor,
        "the files {first} and {second} are of one sensor, and the program cannot tell which is meant",
        "",
        || vec![Remedy::FilePerSensor],
    ),
    Entry::error(
        Kind::EntryOfOneFile,
        "a file within a folder or an archive was chosen, and this is one file",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Entry,
            }]
        },
    ),
    Entry::error(
        Kind::TopicOfText,
        "a topic was chosen, as logs and bags have, and this file is a text",
        "",
        || {
            vec![Remedy::Omit {
                option: OptionName::Topic,
            }]
        },
    ),
    Entry::error(
        Kind::ColumnsOfLog,
        "columns were given, as tables of text have, and this file is none",
        "",
        || vec![Remedy::any_of([OptionName::Topic, OptionName::Instance])],
    ),
    Entry::error(
        Kind::InstanceNotNumber,
        "a sensor in this file is chosen by its number, and `{instance}` is none",
        "",
        || vec![Remedy::such_as(OptionName::Instance, "0")],
    ),
    Entry::error(
        Kind::PhyphoxLinear,
        "the file {file} is linear acceleration: phyphox has taken gravity off, and calibration needs it",
        "record again with the experiment \"Acceleration with g\", or add the sensor \"Accelerometer\" instead of \"Linear accelerometer\"",
        Vec::new,
    ),
    Entry::error(
        Kind::PhyphoxEmpty,
        "this phyphox export has no accelerometer with gravity and no gyroscope; found {listed}",
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
        "the file has no accelerometer and no gyroscope; it holds {listed}[ ({why})]",
        "record a log with both sensors, or name another file",
        Vec::new,
    ),
    Entry::error(
        Kind::LogSensorUnclear,
        "the file has no {sensor} that the program recognises, but {unclear} may be one and is not read",
        "rename it, or go on without this sensor and choose what is to be read",
        Vec::new,
    ),
    Entry::error(
        Kind::LogSensorsOpen,
        "the file has {count} {sensor}s, and the program cannot tell which is meant: {listed}",
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
