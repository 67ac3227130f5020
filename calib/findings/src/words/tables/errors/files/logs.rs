//! Words of errors: logs of flight controllers and robots, and MATLAB files.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::Entry;

pub(in crate::words::tables) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::BlackboxNotDecoded,
        "a Betaflight blackbox as it is on the flight controller, which is not decoded here",
        "export CSV in Blackbox Explorer",
        || {
            vec![Remedy::ConvertToCsv {
                by: "blackbox_decode --unit-acceleration g --unit-rotation deg/s FILE".into(),
            }]
        },
    ),
    Entry::error(
        Kind::MessageKindUnknown,
        "a message of the unknown kind {code}: the log is damaged from here on",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::MessageBigEndian,
        "a message in big-endian CDR (encapsulation 0x0000), which is not read",
        "record on a little-endian machine",
        Vec::new,
    ),
    Entry::error(
        Kind::MessageCompressed,
        "a message that is compressed by itself (compression_mode: message), which is not read",
        "let `ros2 bag convert` write them plain",
        Vec::new,
    ),
    Entry::error(
        Kind::EncapsulationUnknown,
        "a message of encapsulation {code}, where CDR (0x0001) is read",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PageSizeWrong,
        "pages of {bytes:byte}, as in no database: the file is damaged",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PageMissing,
        "page {page} of the database is missing",
        "",
        || vec![Remedy::CopyAgain],
    ),
    Entry::error(
        Kind::PageDamaged,
        "page {page} of the database is damaged ({part})",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::PagesInCircle,
        "page {page} of the database is damaged: its pages form a circle",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::NoBagTables,
        "an SQLite database without the tables `topics` and `messages` of a ROS 2 bag: it has {tables}",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::MatlabBigEndian,
        "a MATLAB file of a big-endian machine, which is not read",
        "save it again with today's MATLAB",
        Vec::new,
    ),
    Entry::error(
        Kind::ElementUnexpected,
        "a data element of type {type}, where a matrix was expected: the MATLAB file is damaged",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::TimetableTooEarly,
        "a timetable of the MATLAB file stands before the variable that it belongs to",
        "save the file again",
        Vec::new,
    ),
    Entry::error(
        Kind::RowTimesUnknown,
        "{variable}: its row times are neither datetime nor duration",
        "",
        Vec::new,
    ),
    Entry::error(
        Kind::ObjectNotRead,
        "the variable {variable} is an object of class {class}, which is not read from MATLAB 7.3",
        "save it with `save -v7`",
        Vec::new,
    ),
    Entry::error(
        Kind::LoggerWithoutGravity,
        "Accelerometer of Sensor Logger is without gravity, and calibration needs it",
        "record again with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on, or add \
         \"Gravity\"",
        || vec![Remedy::set_to(OptionName::Topic, "Gyroscope")],
    ),
];
