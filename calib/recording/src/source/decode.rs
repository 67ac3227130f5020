//! Bytes to UTF-8 text: decompression, encodings, and the names of formats that are neither.

use std::io::{self, BufRead, BufReader, Cursor, Read};

use encoding_rs_io::DecodeReaderBytesBuilder;
use findings::{Finding, Findings, Kind};

use super::bounded::Bounded;
use super::encoding;
use super::place::in_file;
use crate::Error;
use crate::source::head::take_head;

/// A format that is recognised but not read: first bytes, finding, its name, the command that unpacks it or another detail.
type Signature = (&'static [u8], Kind, &'static str, Option<Named>);

/// A detail of a finding.
type Named = (&'static str, &'static str);

const GZIP: [&[u8]; 1] = [b"\x1f\x8b"];
const ZSTD: [&[u8]; 1] = [b"\x28\xb5\x2f\xfd"];

const SIGNATURES: &[Signature] = &[
    (
        b"\xfd7zXZ\0",
        PACKED,
        "an xz archive",
        Some(("command", "unxz FILE")),
    ),
    (
        b"BZh",
        PACKED,
        "a bzip2 archive",
        Some(("command", "bunzip2 FILE")),
    ),
    (
        b"\x04\x22\x4d\x18",
        PACKED,
        "an lz4 archive",
        Some(("command", "unlz4 FILE")),
    ),
    (b"7z\xbc\xaf\x27\x1c", PACKED, "a 7z archive", None),
    (b"Rar!", PACKED, "a rar archive", None),
    (b"PK\x03\x04", Kind::ZIP_WITHIN, "", None),
    (b"\xd0\xcf\x11\xe0", Kind::OLD_OFFICE, "", None),
    (b"\x1f\x8b", PACKED, "a gzip archive", IN_ARCHIVE),
    (b"\x28\xb5\x2f\xfd", PACKED, "a zstd archive", IN_ARCHIVE),
    (b"MATLAB 5.0 MAT-file", FOREIGN, "a MATLAB file", None),
    (b"#ROSBAG V", FOREIGN, "a ROS 1 bag", None),
    (b"\x89MCAP0\r\n", FOREIGN, "an MCAP file", None),
    (
        b"SQLite format 3\0",
        FOREIGN,
        "an SQLite database",
        Some(("perhaps", "a ROS 2 bag")),
    ),
    (b"ULog\x01\x12\x35", FOREIGN, "a PX4 log", None),
    (b"\xa3\x95", FOREIGN, "an ArduPilot log", None),
    (b"ARROW1", FOREIGN, "an Arrow file", None),
    (b"\x93NUMPY", FOREIGN, "a NumPy array", None),
    (b"%PDF-", FOREIGN, "a PDF document", None),
    (b"\x89PNG", FOREIGN, "a picture", None),
    (b"version https://git-lfs", Kind::GIT_POINTER, "", None),
    (b"<!DOCTYPE", Kind::HTML_PAGE, "", None),
    (b"<html", Kind::HTML_PAGE, "", None),
    (b"<?xml", FOREIGN, "an XML file", None),
    (b"H Product:Blackbox", Kind::BLACKBOX_LOG, "", None),
    // The last one, which an array of them is refused as.
    (
        b"{",
        FOREIGN,
        "a JSON file",
        Some(("example", "`pandas.read_json(FILE).to_csv(OUT)`")),
    ),
];

const PACKED: Kind = Kind::PACKED_FILE;
const FOREIGN: Kind = Kind::FOREIGN_FILE;
const IN_ARCHIVE: Option<Named> = Some(("within", "an archive"));

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

/// Decompressed content of a stream of bytes.
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
pub(crate) fn text(name: &str, unpacked: Unpacked) -> (Box<dyn Read + Send>, Findings) {
    let mut warnings = Findings::new();
    let Unpacked { head, reader, .. } = unpacked;
    let encoding = encoding::of(&head);
    if let Some(encoding) = encoding {
        warnings.push(
            Finding::of(Kind::TEXT_ENCODING)
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

/// Refuses what this program has written and is no recording: a document that begins with its schema.
pub(crate) fn refuse_own(name: &str, head: &[u8]) -> Result<(), Error> {
    let begin = String::from_utf8_lossy(&head[..head.len().min(BEGIN)]);
    let schema = begin
        .trim_start()
        .strip_prefix('{')
        .and_then(|text| text.trim_start().strip_prefix("\"schema\""))
        .and_then(|text| text.trim_start().strip_prefix(':'))
        .and_then(|text| text.trim_start().strip_prefix("\"stillpoint."));
    let what: Option<String> = schema.map(|text| {
        let name = text.chars().take_while(char::is_ascii_alphanumeric);
        name.collect()
    });
    match what {
        Some(what) => Err(in_file(
            name,
            Finding::of(Kind::OWN_DOCUMENT).detail("what", what),
        )),
        None => Ok(()),
    }
}

/// Bytes in which a document says its schema.
const BEGIN: usize = 256;

/// Refuses formats that are known but not read.
pub(crate) fn refuse_other_formats(name: &str, head: &[u8]) -> Result<(), Error> {
    if is_mat4(head) {
        return Err(in_file(name, Finding::of(Kind::OLD_MATLAB)));
    }
    if head.get(257..262) == Some(b"ustar") {
        let packed = Finding::of(PACKED)
            .detail("what", "a tar archive")
            .detail("command", "tar -xf FILE")
            .detail("result", "the folder");
        return Err(in_file(name, packed));
    }
    let known = SIGNATURES
        .iter()
        .find(|(magic, ..)| head.starts_with(magic))
        .or_else(|| SIGNATURES.last().filter(|_| is_array_of_objects(head)));
    let Some((_, kind, what, more)) = known else {
        return Ok(());
    };
    let found = Finding::of(*kind).detail("what", *what);
    let more = more.iter();
    let found = more.fold(found, |found, (of, value)| found.detail(of, *value));
    Err(in_file(name, found))
}

fn empty(name: &str) -> Error {
    if name == "<stdin>" {
        return Error::usage(Finding::of(Kind::EMPTY_INPUT));
    }
    in_file(name, Finding::of(Kind::EMPTY_FILE))
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
