//! Bytes to UTF-8 text: decompression, encodings, and the names of formats that are neither.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use encoding_rs_io::DecodeReaderBytesBuilder;

use super::bounded::Bounded;
use super::place::in_file;
use crate::Error;
use crate::source::head::take_head;

/// A format that is recognised but not read: first bytes, name, what to do.
type Signature = (&'static [u8], &'static str, &'static str);

const GZIP: [&[u8]; 1] = [b"\x1f\x8b"];
const ZSTD: [&[u8]; 1] = [b"\x28\xb5\x2f\xfd"];

const EXPORT: &str =
    "export the accelerometer and gyroscope as CSV with the header t,ax,ay,az,gx,gy,gz";
const SIGNATURES: &[Signature] = &[
    (b"\xfd7zXZ\0", "an xz archive", "unpack it first: unxz FILE"),
    (b"BZh", "a bzip2 archive", "unpack it first: bunzip2 FILE"),
    (
        b"\x04\x22\x4d\x18",
        "an lz4 archive",
        "unpack it first: unlz4 FILE",
    ),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive", "unpack it first"),
    (b"Rar!", "a rar archive", "unpack it first"),
    (
        b"PK\x03\x04",
        "a zip archive or Excel workbook within a recording",
        "unpack it, or save the sheet as CSV, and name the folder or file",
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "an old Excel or Word document",
        "save the sheet as CSV",
    ),
    (
        b"\x1f\x8b",
        "a gzip archive in an archive",
        "unpack it first: gunzip FILE",
    ),
    (
        b"\x28\xb5\x2f\xfd",
        "a zstd archive in an archive",
        "unpack it first: unzstd FILE",
    ),
    (b"MATLAB 5.0 MAT-file", "a MATLAB file", EXPORT),
    (b"#ROSBAG V", "a ROS 1 bag", EXPORT),
    (b"\x89MCAP0\r\n", "an MCAP file", EXPORT),
    (
        b"SQLite format 3\0",
        "an SQLite database (a ROS 2 bag?)",
        EXPORT,
    ),
    (b"ULog\x01\x12\x35", "a PX4 log", EXPORT),
    (b"\xa3\x95", "an ArduPilot log", EXPORT),
    (b"ARROW1", "an Arrow file", EXPORT),
    (b"\x93NUMPY", "a NumPy array", EXPORT),
    (b"%PDF-", "a PDF document", EXPORT),
    (b"\x89PNG", "a picture", EXPORT),
    (
        b"version https://git-lfs",
        "a git-lfs pointer, not the data",
        "fetch the data: git lfs pull",
    ),
    (
        b"<!DOCTYPE",
        "an HTML page, perhaps of a failed download",
        "download the file itself",
    ),
    (
        b"<html",
        "an HTML page, perhaps of a failed download",
        "download the file itself",
    ),
    (b"<?xml", "an XML file", EXPORT),
    (
        b"header:",
        "what `ros2 topic echo` prints",
        "record it as a table, `ros2 topic echo --csv TOPIC > imu.csv`, or as a bag",
    ),
    (
        b"FMT, 128,",
        "an ArduPilot log that was made a text",
        "name the .BIN that it was made of",
    ),
    (
        b"H Product:Blackbox",
        "a Blackbox log of Betaflight or INAV",
        "decode it, `blackbox_decode FILE`, and name the .csv",
    ),
    // The last one, which an array of them is refused as.
    (
        b"{",
        "a JSON file",
        "export the accelerometer and gyroscope as CSV with the header t,ax,ay,az,gx,gy,gz, as `pandas.read_json(FILE).to_csv(OUT)` does of an array of rows",
    ),
];

/// True for a MAT file of level 4, which has no signature: type, rows, columns, imaginary part, length of a name that ends
/// in NUL (MathWorks, "MAT-File Format", R2024, appendix).
fn is_mat4(head: &[u8]) -> bool {
    let number = |at: usize| {
        let bytes = head.get(4 * at..4 * at + 4)?.try_into().ok()?;
        Some(u32::from_le_bytes(bytes) as usize)
    };
    let [
        Some(kind),
        Some(rows),
        Some(columns),
        Some(imaginary),
        Some(length),
    ] = [0, 1, 2, 3, 4].map(number)
    else {
        return false;
    };
    let name = head.get(20..20 + length.min(64)).unwrap_or_default();
    let is_name = |text: &[u8]| !text.is_empty() && text.iter().all(u8::is_ascii_graphic);
    kind <= 52
        && rows.max(columns) < 1 << 30
        && imaginary <= 1
        && name.strip_suffix(b"\0").is_some_and(is_name)
}

/// True for JSON such as `[{"ax": 1}]`.
fn is_array_of_objects(head: &[u8]) -> bool {
    let objects = head.trim_ascii_start().strip_prefix(b"[");
    objects.is_some_and(|rest| rest.trim_ascii_start().starts_with(b"{"))
}

/// What a stream of bytes holds when it is decompressed.
pub(crate) struct Unpacked {
    /// Its beginning.
    pub head: Vec<u8>,
    /// All of it.
    pub reader: Box<dyn Read + Send>,
    /// It was compressed.
    pub packed: bool,
}

/// `reader` decompressed.
pub(crate) fn unpacked(name: &str, reader: Box<dyn Read + Send>) -> Result<Unpacked, Error> {
    let (head, reader) = look(name, reader)?;
    if head.is_empty() {
        return Err(empty(name));
    }
    let packed = GZIP
        .iter()
        .chain(&ZSTD)
        .any(|magic| head.starts_with(magic));
    let (head, reader) = look(name, decompressed(&head, reader))?;
    if head.is_empty() {
        return Err(empty(name));
    }
    Ok(Unpacked {
        head,
        reader,
        packed,
    })
}

/// The text in UTF-8 without byte order mark, and what was noticed.
pub(crate) fn text(name: &str, unpacked: Unpacked) -> (Box<dyn Read + Send>, findings::Findings) {
    let mut warnings = findings::Findings::new();
    let Unpacked { head, reader, .. } = unpacked;
    let encoding = match &head[..] {
        [0xff, 0xfe, ..] => Some(encoding_rs::UTF_16LE),
        [0xfe, 0xff, ..] => Some(encoding_rs::UTF_16BE),
        head => utf16_by_zeros(head),
    };
    if let Some(encoding) = encoding {
        warnings.push(
            findings::Finding::of(findings::Kind::TextEncoding)
                .in_recording(name)
                .detail("part", "the text")
                .detail("encoding", encoding.name()),
        );
    }
    // Without an encoding, bytes pass as they are, but for a UTF-8 byte order mark.
    let reader = DecodeReaderBytesBuilder::new()
        .encoding(encoding)
        .utf8_passthru(true)
        .strip_bom(true)
        .build(reader);
    (Box::new(reader), warnings)
}

/// Refuses formats that are known but not read.
pub(crate) fn refuse_other_formats(name: &str, head: &[u8]) -> Result<(), Error> {
    if is_mat4(head) {
        let words = "this is a MATLAB file of version 4; save it again in MATLAB with `save -v7`";
        return Err(in_file(name, words));
    }
    if head.get(257..262) == Some(b"ustar") {
        let words = "this is a tar archive; unpack it first: tar -xf FILE, and name the folder";
        return Err(in_file(name, words));
    }
    let known = SIGNATURES
        .iter()
        .find(|(magic, ..)| head.starts_with(magic))
        .or_else(|| SIGNATURES.last().filter(|_| is_array_of_objects(head)));
    known.map_or(Ok(()), |(_, what, advice)| {
        Err(in_file(name, format!("this is {what}; {advice}")))
    })
}

fn empty(name: &str) -> Error {
    if name == "<stdin>" {
        return Error::usage("standard input is empty: pipe a recording into it".to_owned());
    }
    in_file(name, "file is empty")
}

/// The first bytes, and a reader that still has them.
fn look(
    name: &str,
    mut reader: Box<dyn Read + Send>,
) -> Result<(Vec<u8>, Box<dyn Read + Send>), Error> {
    let head = take_head(name, &mut reader)?;
    let again = Cursor::new(head.clone()).chain(reader);
    Ok((head, Box::new(again)))
}

fn decompressed(head: &[u8], reader: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    if head.starts_with(GZIP[0]) {
        return Box::new(Bounded::of(reader, |packed| {
            Box::new(flate2::read::MultiGzDecoder::new(packed))
        }));
    }
    if head.starts_with(ZSTD[0]) {
        return Box::new(Bounded::of(reader, |packed| {
            Box::new(Zstd::Between(BufReader::new(packed)))
        }));
    }
    reader
}

/// UTF-16 without a byte order mark: text whose every second byte is zero.
fn utf16_by_zeros(head: &[u8]) -> Option<&'static encoding_rs::Encoding> {
    let pairs = head.len() / 2;
    let zeros = |offset: usize| {
        head.iter()
            .skip(offset)
            .step_by(2)
            .filter(|&&b| b == 0)
            .count()
    };
    let (even, odd) = (zeros(0), zeros(1));
    if pairs >= 4 && odd * 10 >= pairs * 9 && even * 10 < pairs {
        Some(encoding_rs::UTF_16LE)
    } else if pairs >= 4 && even * 10 >= pairs * 9 && odd * 10 < pairs {
        Some(encoding_rs::UTF_16BE)
    } else {
        None
    }
}

type Bytes = BufReader<Box<dyn Read + Send>>;

/// A zstd file, which can hold several frames one after the other.
enum Zstd {
    Between(Bytes),
    Within(Box<ruzstd::decoding::StreamingDecoder<Bytes, ruzstd::decoding::FrameDecoder>>),
    Ended,
}

impl Read for Zstd {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        loop {
            *self = match std::mem::replace(self, Self::Ended) {
                Self::Ended => return Ok(0),
                Self::Between(mut reader) => {
                    if reader.fill_buf()?.is_empty() {
                        return Ok(0);
                    }
                    let decoder = ruzstd::decoding::StreamingDecoder::new(reader);
                    Self::Within(Box::new(decoder.map_err(|error| {
                        io::Error::other(format!("damaged zstd archive: {error}"))
                    })?))
                }
                Self::Within(mut decoder) => {
                    let read = decoder.read(buffer)?;
                    if read > 0 {
                        *self = Self::Within(decoder);
                        return Ok(read);
                    }
                    Self::Between(decoder.into_inner())
                }
            }
        }
    }
}
