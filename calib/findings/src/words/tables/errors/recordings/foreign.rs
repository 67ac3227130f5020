//! Words of files that are recognised and not read.

use crate::kind::Kind;
use crate::words::entry::{Entry, error};

pub(in crate::words::tables) fn words(kind: Kind) -> Option<Entry> {
    Some(match kind {
        Kind::PackedFile => error(
            "this is {what}[ in {within}]",
            "unpack it first[: {command}][, and name {result}]",
        ),
        Kind::ZipWithin => error(
            "this is a zip archive or Excel workbook within a recording",
            "unpack it, or save the sheet as CSV, and name the folder or file",
        ),
        Kind::OldOffice => error(
            "this is an old Excel or Word document",
            "save the sheet as CSV",
        ),
        Kind::ForeignFile => error(
            "this is {what}[ (perhaps {perhaps})]",
            "export the accelerometer and gyroscope as CSV with the header t,ax,ay,az,gx,gy,gz[, as {example} does of an array of rows]",
        ),
        Kind::OldMatlab => error(
            "this is a MATLAB file of version 4",
            "save it again in MATLAB with `save -v7`",
        ),
        Kind::GitPointer => error(
            "this is a git-lfs pointer, not the data",
            "fetch the data: git lfs pull",
        ),
        Kind::HtmlPage => error(
            "this is an HTML page, perhaps of a failed download",
            "download the file itself",
        ),
        Kind::BlackboxLog => error(
            "this is a Blackbox log of Betaflight or INAV",
            "decode it, `blackbox_decode FILE`, and name the .csv",
        ),
        _ => return None,
    })
}
