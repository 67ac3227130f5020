//! The central directory of a zip archive: PKWARE, APPNOTE.TXT 6.3.10, sections 4.3.12 to 4.3.16.

use std::io::{Read, Seek, SeekFrom};

use findings::{Finding, Kind};

use crate::error::counted;
use crate::shown::shown;
use crate::{Error, Limits};

const END: &[u8] = b"PK\x05\x06";
const END_SIZE: usize = 22;
const LOCATOR: &[u8] = b"PK\x06\x07";
const LOCATOR_SIZE: u64 = 20;
const END64: &[u8] = b"PK\x06\x06";
const HEADER: &[u8] = b"PK\x01\x02";
/// The end record is followed by a comment of at most 64 KiB.
const COMMENT: u64 = 65_535;
/// Value of a 32-bit field whose number is in the Zip64 records instead.
const ELSEWHERE: u64 = 0xffff_ffff;

/// An entry as the directory describes it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packed {
    /// Byte at which its local header begins.
    pub at: u64,
    /// Size in the archive, bytes.
    pub packed_size: u64,
    /// Size when unpacked, bytes.
    pub size: u64,
    /// Check sum of the unpacked bytes.
    pub crc: u32,
    /// 0 stored, 8 deflate.
    pub method: u16,
}

/// Position of the directory, its size in bytes and its number of entries.
struct End {
    at: u64,
    size: u64,
    entries: u64,
}

/// A numbered, little-endian field of `bytes`; 0 behind their end.
fn number(bytes: &[u8], at: usize, length: usize) -> u64 {
    let field = bytes.get(at..at + length).unwrap_or_default();
    let digit = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
    field.iter().rev().fold(0, digit)
}

fn read_at(archive: &mut (impl Read + Seek), at: u64, length: u64) -> Result<Vec<u8>, Error> {
    archive.seek(SeekFrom::Start(at))?;
    let mut bytes = Vec::new();
    archive.take(length).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The files in `archive` by name, folders left out.
pub(super) fn directory(
    archive: &mut (impl Read + Seek),
    limits: Limits,
) -> Result<Vec<(String, Packed)>, Error> {
    let length = archive.seek(SeekFrom::End(0))?;
    let end = find_end(archive, length)?;
    if end.entries > limits.entries as u64 {
        return Err(limits.too_many_entries());
    }
    if end.at > length || end.size > length - end.at {
        return Err(truncated(length));
    }
    let bytes = read_at(archive, end.at, end.size)?;
    let mut files = Vec::new();
    let mut position = 0;
    for index in 1..=end.entries {
        let header = bytes.get(position..).unwrap_or_default();
        if header.len() < 46 || !header.starts_with(HEADER) {
            return Err(Error::at(
                end.at + position as u64,
                counted(Finding::of(Kind::ZIP_DIRECTORY_DAMAGED), "index", index),
            ));
        }
        let [name, extra, comment] = [28, 30, 32].map(|at| number(header, at, 2) as usize);
        let raw = header.get(46..46 + name).unwrap_or_default();
        let name_text = String::from_utf8_lossy(raw).into_owned();
        if number(header, 8, 2) & 1 == 1 {
            let found = Finding::of(Kind::ZIP_ENCRYPTED);
            return Err(Error::refused(found.detail("entry", shown(&name_text))));
        }
        let extra_fields = header.get(46 + name..46 + name + extra).unwrap_or_default();
        let packed = sizes(header, extra_fields);
        if !name_text.ends_with('/') && !is_hidden(&name_text) {
            files.push((name_text, packed));
        }
        position += 46 + name + extra + comment;
    }
    check(&files, end.at, limits)?;
    Ok(files)
}

/// Returns true for files that operating systems add to archives.
fn is_hidden(name: &str) -> bool {
    name.starts_with("__MACOSX/") || name.ends_with(".DS_Store")
}

fn sizes(header: &[u8], extra: &[u8]) -> Packed {
    let mut size = number(header, 24, 4);
    let mut packed_size = number(header, 20, 4);
    let mut at = number(header, 42, 4);
    // Zip64: the fields that do not fit stand in an extra field, in this order.
    let mut wide = extra_field(extra, 1).unwrap_or_default();
    for field in [&mut size, &mut packed_size, &mut at] {
        if *field == ELSEWHERE && wide.len() >= 8 {
            *field = number(wide, 0, 8);
            wide = &wide[8..];
        }
    }
    Packed {
        at,
        packed_size,
        size,
        crc: number(header, 16, 4) as u32,
        method: number(header, 10, 2) as u16,
    }
}

fn extra_field(mut extra: &[u8], wanted: u64) -> Option<&[u8]> {
    while extra.len() >= 4 {
        let length = number(extra, 2, 2) as usize;
        let content = extra.get(4..4 + length)?;
        if number(extra, 0, 2) == wanted {
            return Some(content);
        }
        extra = &extra[4 + length..];
    }
    None
}

fn find_end(archive: &mut (impl Read + Seek), length: u64) -> Result<End, Error> {
    let from = length.saturating_sub(COMMENT + END_SIZE as u64);
    let tail = read_at(archive, from, length - from)?;
    let last = tail.len().checked_sub(END_SIZE);
    let starts = (0..=last.ok_or_else(|| truncated(length))?).rev();
    let at = starts
        .into_iter()
        .find(|&at| tail[at..].starts_with(END))
        .ok_or_else(|| truncated(length))?;
    let record = &tail[at..];
    let end = End {
        entries: number(record, 10, 2),
        size: number(record, 12, 4),
        at: number(record, 16, 4),
    };
    let wide = end.entries == 0xffff || end.size == ELSEWHERE || end.at == ELSEWHERE;
    let Some(locator) = (from + at as u64)
        .checked_sub(LOCATOR_SIZE)
        .filter(|_| wide)
    else {
        return Ok(end);
    };
    let locator = read_at(archive, locator, LOCATOR_SIZE)?;
    if !locator.starts_with(LOCATOR) {
        return Ok(end);
    }
    let record = read_at(archive, number(&locator, 8, 8), 56)?;
    if !record.starts_with(END64) {
        return Err(truncated(length));
    }
    Ok(End {
        entries: number(&record, 32, 8),
        size: number(&record, 40, 8),
        at: number(&record, 48, 8),
    })
}

fn truncated(length: u64) -> Error {
    Error::at(length, Finding::of(Kind::ZIP_DIRECTORY_MISSING))
}

/// Refuses archives that claim more than they can hold.
fn check(files: &[(String, Packed)], end: u64, limits: Limits) -> Result<(), Error> {
    let mut spans: Vec<(u64, u64, &str)> = Vec::new();
    let mut total: u64 = 0;
    for (name, packed) in files {
        total = total.saturating_add(packed.size);
        let last = packed.at.saturating_add(packed.packed_size);
        if last > end {
            return Err(Error::at(
                packed.at,
                Finding::of(Kind::ZIP_ENTRY_BEYOND).detail("entry", shown(name)),
            ));
        }
        spans.push((packed.at, last, name));
    }
    if total > limits.bytes {
        return Err(limits.too_large("the archive"));
    }
    spans.sort_unstable();
    if let Some(pair) = spans.windows(2).find(|pair| pair[0].1 > pair[1].0) {
        let found = Finding::of(Kind::ZIP_ENTRIES_OVERLAP).detail("entry", shown(pair[0].2));
        return Err(Error::refused(found.detail("other", shown(pair[1].2))));
    }
    Ok(())
}
