//! Words of files that are recognised and not read.

use crate::kind::Kind;
use crate::words::entry::Entry;

pub(in super::super::super) const ENTRIES: &[Entry] = &[
    Entry::error(
        Kind::PackedFile,
        "this is {what}[ in {within}]",
        "unpack it first[: {command}][, and name {result}]",
        Vec::new,
    ),
    Entry::error(
        Kind::ZipWithin,
        "this is a zip archive or Excel workbook within a recording",
        "unpack it, or save the sheet as CSV, and name the folder or file",
        Vec::new,
    ),
    Entry::error(
        Kind::OldOffice,
        "this is an old Excel or Word document",
        "save the sheet as CSV",
        Vec::new,
    ),
    Entry::error(
        Kind::ForeignFile,
        "this is {what}[ (perhaps {perhaps})]",
        "export the accelerometer and gyroscope as CSV with the header t,ax,ay,az,gx,gy,gz[, as {example} does of an array of rows]",
        Vec::new,
    ),
    Entry::error(
        Kind::OldMatlab,
        "this is a MATLAB file of version 4",
        "save it again in MATLAB with `save -v7`",
        Vec::new,
    ),
    Entry::error(
        Kind::GitPointer,
        "this is a git-lfs pointer, not the data",
        "fetch the data: git lfs pull",
        Vec::new,
    ),
    Entry::error(
        Kind::HtmlPage,
        "this is an HTML page, perhaps of a failed download",
        "download the file itself",
        Vec::new,
    ),
    Entry::error(
        Kind::RosEcho,
        "this is what `ros2 topic echo` prints",
        "record it as a table, which it prints with the option csv, or as a bag",
        Vec::new,
    ),
    Entry::error(
        Kind::ArdupilotText,
        "this is an ArduPilot log that was made a text",
        "name the .BIN that it was made of",
        Vec::new,
    ),
    Entry::error(
        Kind::BlackboxLog,
        "this is a Blackbox log of Betaflight or INAV",
        "decode it, `blackbox_decode FILE`, and name the .csv",
        Vec::new,
    ),
];
