//! Words of errors: logs of flight controllers and robots, and MATLAB files.

use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{error, error_by, error_with};

kinds! {
    /// A blackbox of Betaflight is not decoded.
    BLACKBOX_NOT_DECODED = "blackbox_not_decoded" => error_with(
        "this is a Betaflight blackbox as the flight controller writes it, and the program does not decode it",
        "export CSV in Blackbox Explorer",
        vec![Remedy::ConvertToCsv {
            by: "blackbox_decode --unit-acceleration g --unit-rotation deg/s FILE".into(),
        }],
    ),
    /// A log has a message of a kind that the format does not have.
    MESSAGE_KIND_UNKNOWN = "message_kind_unknown" => error(
        "the log is damaged from this byte on: a message has the unknown kind {code}",
        "copy or export the file again",
    ),
    /// A message of ROS 2 is big-endian.
    MESSAGE_BIG_ENDIAN = "message_big_endian" => error(
        "the bytes of a message in the file are in an order (big-endian) that the program does not read",
        "record on a usual computer (x86 or ARM), or convert the recording to CSV on the one that made it",
    ),
    /// A message of ROS 2 is compressed by itself.
    MESSAGE_COMPRESSED = "message_compressed" => error(
        "a message of the bag that is compressed by itself (compression_mode: message) cannot be unpacked",
        "let `ros2 bag convert` write the messages uncompressed",
    ),
    /// A message of ROS 2 is in an encoding that is not read.
    ENCAPSULATION_UNKNOWN = "encapsulation_unknown" => error(
        "a message in the file is encoded in a way that the program does not read ({code}): it reads only the usual encoding of ROS 2 (CDR, 0x0001)",
        "record again with the default encoding of ROS 2, or convert the recording to CSV",
    ),
    /// A database states pages of an impossible size.
    PAGE_SIZE_WRONG = "page_size_wrong" => error(
        "the database is damaged: it announces pages of {bytes:byte}, as no database has",
        "copy or export the file again",
    ),
    /// A page of a database is missing.
    PAGE_MISSING = "page_missing" => error_by(
        "page {page} of the database is missing",
        vec![Remedy::CopyAgain],
    ),
    /// A page of a database is damaged.
    PAGE_DAMAGED = "page_damaged" => error(
        "page {page} of the database is damaged ({part})",
        "copy or export the file again",
    ),
    /// The pages of a database form a circle.
    PAGES_IN_CIRCLE = "pages_in_circle" => error(
        "page {page} of the database is damaged: its pages form a circle",
        "copy or export the file again",
    ),
    /// A database is no bag of ROS 2.
    NO_BAG_TABLES = "no_bag_tables" => error(
        "this SQLite database lacks the tables `topics` and `messages` of a ROS 2 bag: it has {tables}",
        "name the .db3 file of a ROS 2 bag",
    ),
    /// A MATLAB file was written by a big-endian machine.
    MATLAB_BIG_ENDIAN = "matlab_big_endian" => error(
        "this MATLAB file is of a big-endian machine, which the program does not read",
        "save it again with today's MATLAB",
    ),
    /// A MATLAB file has something else where a matrix is expected.
    ELEMENT_UNEXPECTED = "element_unexpected" => error(
        "the MATLAB file is damaged: it has a data element of type {type}, where a matrix was expected",
        "save the file again",
    ),
    /// A timetable stands before the variable that it belongs to.
    TIMETABLE_TOO_EARLY = "timetable_too_early" => error(
        "a timetable of the MATLAB file stands before the variable that it belongs to",
        "save the file again",
    ),
    /// The row times of a timetable are of an unknown kind.
    ROW_TIMES_UNKNOWN = "row_times_unknown" => error(
        "{variable}: its row times are neither datetime nor duration",
        "save the row times as datetime or duration",
    ),
    /// A variable named after a sensor is an object that is not read.
    OBJECT_NOT_READ = "object_not_read" => error(
        "the variable {variable} is an object of class {class}, which is not read from MATLAB 7.3",
        "save it with `save -v7`",
    ),
    /// The only accelerometer of Sensor Logger is without gravity.
    LOGGER_WITHOUT_GRAVITY = "logger_without_gravity" => error_with(
        "the Accelerometer of Sensor Logger is without gravity, and calibration needs it",
        "record again with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on, or add \"Gravity\"",
        vec![Remedy::set_to(OptionName::Topic, "Gyroscope")],
    ),
}
