//! Words of folders, archives and logs of which the sensors are not clear.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A sensor is missing, and a table beside may hold it.
    SENSOR_UNUSED = "sensor_unused" => error_with(
        "the program found the file of one sensor only. The table {table} may hold the other sensor[; {archive} has to be unpacked before its files can be named]",
        "name the found file alone to go without the other sensor",
        vec![Remedy::FilePerSensor],
    ),
    /// A folder or archive lacks a file.
    NO_ENTRY = "no_entry" => error(
        "the folder or archive has no file `{entry}`; it holds {listed}",
        "name one of these files, or add the one that is missing",
    ),
    /// A folder or archive holds no recording.
    NO_RECORDING_IN_FOLDER = "no_recording_in_folder" => error_by(
        "this is {holder} without a recording: it has neither acc.csv (t,ax,ay,az) nor gyro.csv (t,gx,gy,gz) nor any other; found {listed}",
        vec![Remedy::FilePerSensor],
    ),
    /// A folder or archive holds several recordings.
    ENTRY_OPEN = "entry_open" => error_by(
        "the folder or archive holds {count:recording}, and the program cannot tell which is meant: {listed}",
        vec![Remedy::such_as(OptionName::Entry, "session1.csv")],
    ),
    /// Two files are of one sensor.
    FILES_OF_ONE_SENSOR = "files_of_one_sensor" => error_by(
        "the files {first} and {second} are of one sensor, and the program cannot tell which is meant",
        vec![Remedy::FilePerSensor],
    ),
    /// A file within was asked for of one file.
    ENTRY_OF_ONE_FILE = "entry_of_one_file" => error_by(
        "a file within a folder or an archive was chosen, and this is one file",
        vec![Remedy::Omit {
            option: OptionName::Entry,
        }],
    ),
    /// A topic was asked for of a text.
    TOPIC_OF_TEXT = "topic_of_text" => error_by(
        "a topic was chosen, as logs and bags have, and this file is a text",
        vec![Remedy::Omit {
            option: OptionName::Topic,
        }],
    ),
    /// Columns were given for a log.
    COLUMNS_OF_LOG = "columns_of_log" => error_by(
        "columns were given, but this file is a log. It has named streams of messages (topics) and no columns",
        vec![
            Remedy::Omit {
                option: OptionName::Columns,
            },
            Remedy::any_of([OptionName::Topic, OptionName::Instance]),
        ],
    ),
    /// A sensor of a log was not given by its number.
    INSTANCE_NOT_NUMBER = "instance_not_number" => error_by(
        "a sensor in this file is chosen by its number, and `{instance}` is none",
        vec![Remedy::such_as(OptionName::Instance, "0")],
    ),
    /// phyphox has taken gravity off.
    PHYPHOX_LINEAR = "phyphox_linear" => error(
        "the file {file} is linear acceleration: phyphox has taken gravity off, and calibration needs it",
        "record again with the experiment \"Acceleration with g\", or add the sensor \"Accelerometer\" instead of \"Linear accelerometer\"",
    ),
    /// An export of phyphox has no sensor.
    PHYPHOX_EMPTY = "phyphox_empty" => error(
        "this phyphox export has no accelerometer with gravity and no gyroscope; found {listed}",
        "record both sensors, as \"Acceleration with g\" and \"Gyroscope\"",
    ),
    /// Sensor Logger has taken gravity off.
    SENSOR_LOGGER_LINEAR = "sensor_logger_linear" => error(
        "Accelerometer.csv of Sensor Logger is without gravity, and calibration needs it",
        "record again with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on, or add \"Gravity\"",
    ),
    /// A log holds no sensor.
    LOG_WITHOUT_SENSOR = "log_without_sensor" => error(
        "the file has no accelerometer and no gyroscope; it holds {listed}[ ({why})]",
        "record a log with both sensors, or name another file",
    ),
    /// A log may hold a sensor under another name.
    LOG_SENSOR_UNCLEAR = "log_sensor_unclear" => error_with(
        "the program recognises no {sensor} in the file, but {unclear} may be one. If a topic is named, the program reads it without the {sensor}",
        "rename it after its sensor if it is the {sensor}; if it is not, record the {sensor} too",
        vec![Remedy::set(OptionName::Topic)],
    ),
    /// A log holds several sensors of a kind.
    LOG_SENSORS_OPEN = "log_sensors_open" => error_by(
        "the file has {count} {sensor}s, and the program cannot tell which is meant: {listed}",
        vec![Remedy::examples([
            (OptionName::Topic, "/imu"),
            (OptionName::Instance, "0"),
        ])],
    ),
    /// A sensor is logged too slowly.
    LOGGED_SLOWLY = "logged_slowly" => error(
        "{stream} is logged at {rate} only, too slow for a calibration[; {other} has {other_rate}, which PX4 has already corrected]",
        "set SDLOG_PROFILE to 769 (raw FIFO of both sensors) and record again",
    ),
}
