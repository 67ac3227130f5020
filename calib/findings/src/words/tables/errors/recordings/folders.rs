//! Words of folders, archives and logs of which the sensors are not clear.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::SensorUnused => error_with(
            "the program found the file of one sensor only. The table {table} may hold the other sensor[; {archive} has to be unpacked before its files can be named]",
            "name the found file alone to go without the other sensor",
            vec![Remedy::FilePerSensor],
        ),
        Kind::NoEntry => error(
            "the folder or archive has no file `{entry}`; it holds {listed}",
            "name one of these files, or add the one that is missing",
        ),
        Kind::NoRecordingInFolder => error_by(
            "this is {holder} without a recording: it has neither acc.csv (t,ax,ay,az) nor gyro.csv (t,gx,gy,gz) nor any other; found {listed}",
            vec![Remedy::FilePerSensor],
        ),
        Kind::EntryOpen => error_by(
            "the folder or archive holds {count:recording}, and the program cannot tell which is meant: {listed}",
            vec![Remedy::such_as(OptionName::Entry, "session1.csv")],
        ),
        Kind::FilesOfOneSensor => error_by(
            "the files {first} and {second} are of one sensor, and the program cannot tell which is meant",
            vec![Remedy::FilePerSensor],
        ),
        Kind::EntryOfOneFile => error_by(
            "a file within a folder or an archive was chosen, and this is one file",
            vec![Remedy::Omit {
                option: OptionName::Entry,
            }],
        ),
        Kind::TopicOfText => error_by(
            "a topic was chosen, as logs and bags have, and this file is a text",
            vec![Remedy::Omit {
                option: OptionName::Topic,
            }],
        ),
        Kind::ColumnsOfLog => error_by(
            "columns were given, but this file is a log. It has named streams of messages (topics) and no columns",
            vec![
                Remedy::Omit {
                    option: OptionName::Columns,
                },
                Remedy::any_of([OptionName::Topic, OptionName::Instance]),
            ],
        ),
        Kind::InstanceNotNumber => error_by(
            "a sensor in this file is chosen by its number, and `{instance}` is none",
            vec![Remedy::such_as(OptionName::Instance, "0")],
        ),
        Kind::PhyphoxLinear => error(
            "the file {file} is linear acceleration: phyphox has taken gravity off, and calibration needs it",
            "record again with the experiment \"Acceleration with g\", or add the sensor \"Accelerometer\" instead of \"Linear accelerometer\"",
        ),
        Kind::PhyphoxEmpty => error(
            "this phyphox export has no accelerometer with gravity and no gyroscope; found {listed}",
            "record both sensors, as \"Acceleration with g\" and \"Gyroscope\"",
        ),
        Kind::SensorLoggerLinear => error(
            "Accelerometer.csv of Sensor Logger is without gravity, and calibration needs it",
            "record again with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on, or add \"Gravity\"",
        ),
        Kind::LogWithoutSensor => error(
            "the file has no accelerometer and no gyroscope; it holds {listed}[ ({why})]",
            "record a log with both sensors, or name another file",
        ),
        Kind::LogSensorUnclear => error_with(
            "the program recognises no {sensor} in the file, but {unclear} may be one. If a topic is named, the program reads it without the {sensor}",
            "rename it after its sensor if it is the {sensor}; if it is not, record the {sensor} too",
            vec![Remedy::set(OptionName::Topic)],
        ),
        Kind::LogSensorsOpen => error_by(
            "the file has {count} {sensor}s, and the program cannot tell which is meant: {listed}",
            vec![Remedy::examples([
                (OptionName::Topic, "/imu"),
                (OptionName::Instance, "0"),
            ])],
        ),
        Kind::LoggedSlowly => error(
            "{stream} is logged at {rate} only, too slow for a calibration[; {other} has {other_rate}, which PX4 has already corrected]",
            "set SDLOG_PROFILE to 769 (raw FIFO of both sensors) and record again",
        ),
        _ => return None,
    })
}
