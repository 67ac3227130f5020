//! Words of files that are recognised and not read.

use crate::words::entry::error;

kinds! {
    /// A file is packed.
    PACKED_FILE = "packed_file" => error(
        "this is {what}[ in {within}]",
        "unpack it first[: {command}][, and name {result}]",
    ),
    /// A zip archive or workbook lies within a recording.
    ZIP_WITHIN = "zip_within" => error(
        "this is a zip archive or Excel workbook within a recording",
        "unpack it, or save the sheet as CSV, and name the folder or file",
    ),
    /// A file is an old document of an office.
    OLD_OFFICE = "old_office" => error(
        "this is an old Excel or Word document",
        "save the sheet as CSV",
    ),
    /// A file is of a format that is not read.
    FOREIGN_FILE = "foreign_file" => error(
        "this is {what}[ (perhaps {perhaps})]",
        "export the accelerometer and gyroscope as CSV with the header t,ax,ay,az,gx,gy,gz[, as {example} does of an array of rows]",
    ),
    /// A MATLAB file is of version 4.
    OLD_MATLAB = "old_matlab" => error(
        "this is a MATLAB file of version 4",
        "save it again in MATLAB with `save -v7`",
    ),
    /// A file is a pointer of git-lfs.
    GIT_POINTER = "git_pointer" => error(
        "this is a git-lfs pointer, not the data",
        "fetch the data: git lfs pull",
    ),
    /// A file is a page of the web.
    HTML_PAGE = "html_page" => error(
        "this is an HTML page, perhaps of a failed download",
        "download the file itself",
    ),
    /// A file is a Blackbox log.
    BLACKBOX_LOG = "blackbox_log" => error(
        "this is a Blackbox log of Betaflight or INAV",
        "decode it, `blackbox_decode FILE`, and name the .csv",
    ),
}
