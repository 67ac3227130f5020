//! Words of errors: logs of flight controllers and robots, and MATLAB files.

use crate::kind::Kind;
use crate::remedy::{OptionName, Remedy};
use crate::words::entry::{Entry, error, error_by, error_with};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::BlackboxNotDecoded => error_with(
            "this is a Betaflight blackbox as the flight controller writes it, and the program does not decode it",
            "export CSV in Blackbox Explorer",
            vec![Remedy::ConvertToCsv {
                by: "blackbox_decode --unit-acceleration g --unit-rotation deg/s FILE".into(),
            }],
        ),
        Kind::MessageKindUnknown => error(
            "the log is damaged from this byte on: a message has the unknown kind {code}",
            "copy or export the file again",
        ),
        Kind::MessageBigEndian => error(
            "the bytes of a message in the file are in an order (big-endian) that the program does not read",
            "record on a usual computer (x86 or ARM), or convert the recording to CSV on the one that made it",
        ),
        Kind::MessageCompressed => error(
            "a message of the bag that is compressed by itself (compression_mode: message) cannot be unpacked",
            "let `ros2 bag convert` write the messages uncompressed",
        ),
        Kind::EncapsulationUnknown => error(
            "a message in the file is encoded in a way that the program does not read ({code}): it reads only the usual encoding of ROS 2 (CDR, 0x0001)",
            "record again with the default encoding of ROS 2, or convert the recording to CSV",
        ),
        Kind::PageSizeWrong => error(
            "the database is damaged: it announces pages of {bytes:byte}, as no database has",
            "copy or export the file again",
        ),
        Kind::PageMissing => error_by(
            "page {page} of the database is missing",
            vec![Remedy::CopyAgain],
        ),
        Kind::PageDamaged => error(
            "page {page} of the database is damaged ({part})",
            "copy or export the file again",
        ),
        Kind::PagesInCircle => error(
            "page {page} of the database is damaged: its pages form a circle",
            "copy or export the file again",
        ),
        Kind::NoBagTables => error(
            "this SQLite database lacks the tables `topics` and `messages` of a ROS 2 bag: it has {tables}",
            "name the .db3 file of a ROS 2 bag",
        ),
        Kind::MatlabBigEndian => error(
            "this MATLAB file is of a big-endian machine, which the program does not read",
            "save it again with today's MATLAB",
        ),
        Kind::ElementUnexpected => error(
            "the MATLAB file is damaged: it has a data element of type {type}, where a matrix was expected",
            "save the file again",
        ),
        Kind::TimetableTooEarly => error(
            "a timetable of the MATLAB file stands before the variable that it belongs to",
            "save the file again",
        ),
        Kind::RowTimesUnknown => error(
            "{variable}: its row times are neither datetime nor duration",
            "save the row times as datetime or duration",
        ),
        Kind::ObjectNotRead => error(
            "the variable {variable} is an object of class {class}, which is not read from MATLAB 7.3",
            "save it with `save -v7`",
        ),
        Kind::LoggerWithoutGravity => error_with(
            "the Accelerometer of Sensor Logger is without gravity, and calibration needs it",
            "record again with \"Total Acceleration\" or \"Accelerometer (Uncalibrated)\" switched on, or add \"Gravity\"",
            vec![Remedy::set_to(OptionName::Topic, "Gyroscope")],
        ),
        _ => return None,
    })
}
