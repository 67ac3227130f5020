//! Text in UTF-16, read as UTF-8.

use std::io::{self, Read};

/// Which byte of two comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Utf16 {
    Little,
    Big,
}

/// Bytes asked from the reader at a time.
const CHUNK: usize = 8 << 10;
/// Units of two that are the first half of a character.
const FIRST_HALVES: std::ops::Range<u16> = 0xd800..0xdc00;

impl Utf16 {
    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Little => "UTF-16LE",
            Self::Big => "UTF-16BE",
        }
    }

    fn unit(self, bytes: [u8; 2]) -> u16 {
        match self {
            Self::Little => u16::from_le_bytes(bytes),
            Self::Big => u16::from_be_bytes(bytes),
        }
    }
}

/// Bytes of UTF-16 as UTF-8; half a character becomes U+FFFD.
pub(super) struct FromUtf16<R> {
    reader: R,
    order: Utf16,
    /// Bytes that are not decoded yet: fewer than two units between two chunks.
    bytes: Vec<u8>,
    /// What is decoded, and how much of it is read.
    text: String,
    read: usize,
}

impl<R: Read> FromUtf16<R> {
    pub fn new(reader: R, order: Utf16) -> Self {
        Self {
            reader,
            order,
            bytes: Vec::new(),
            text: String::new(),
            read: 0,
        }
    }

    /// Decodes the next chunk; false at the end.
    fn advance(&mut self) -> io::Result<bool> {
        let mut chunk = [0; CHUNK];
        let length = self.reader.read(&mut chunk)?;
        self.bytes.extend_from_slice(&chunk[..length]);
        self.text.clear();
        self.read = 0;
        let ended = length == 0;
        let (pairs, odd) = self.bytes.as_chunks::<2>();
        let mut units: Vec<u16> = pairs.iter().map(|pair| self.order.unit(*pair)).collect();
        if !ended {
            // The second half of a character may be in the next chunk.
            units.pop_if(|unit| FIRST_HALVES.contains(unit));
        }
        let characters = char::decode_utf16(units.iter().copied());
        self.text
            .extend(characters.map(|one| one.unwrap_or(char::REPLACEMENT_CHARACTER)));
        if ended && !odd.is_empty() {
            self.text.push(char::REPLACEMENT_CHARACTER);
        }
        match ended {
            true => self.bytes.clear(),
            false => drop(self.bytes.drain(..2 * units.len())),
        }
        Ok(!ended || !self.text.is_empty())
    }
}

impl<R: Read> Read for FromUtf16<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.read == self.text.len() {
            if buffer.is_empty() || !self.advance()? {
                return Ok(0);
            }
        }
        let left = &self.text.as_bytes()[self.read..];
        let length = left.len().min(buffer.len());
        buffer[..length].copy_from_slice(&left[..length]);
        self.read += length;
        Ok(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hands out a few bytes at a time, so that characters are cut everywhere.
    struct Few<'a>(&'a [u8], usize);

    impl Read for Few<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let length = self.1.min(self.0.len()).min(buffer.len());
            buffer[..length].copy_from_slice(&self.0[..length]);
            self.0 = &self.0[length..];
            Ok(length)
        }
    }

    fn decoded(bytes: &[u8], order: Utf16, few: usize) -> String {
        let mut text = String::new();
        let mut reader = FromUtf16::new(Few(bytes, few), order);
        reader.read_to_string(&mut text).unwrap();
        text
    }

    #[test]
    fn characters_of_one_two_and_four_bytes_come_back_however_they_are_cut() {
        let text = "t;ax (m/s²)\n0,5;−9,81 👋\n";
        let units: Vec<u16> = text.encode_utf16().collect();
        let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
        let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
        for few in [1, 2, 3, 5, 1000] {
            assert_eq!(decoded(&little, Utf16::Little, few), text);
            assert_eq!(decoded(&big, Utf16::Big, few), text);
        }
    }

    #[test]
    fn half_a_character_is_marked_and_nothing_is_lost_behind_it() {
        for few in [1, 1000] {
            // A first half before a letter, then one at the end, then half a unit.
            let bytes = [0x3d, 0xd8, 0x61, 0, 0x3d, 0xd8, 0x62];
            assert_eq!(
                decoded(&bytes, Utf16::Little, few),
                "\u{fffd}a\u{fffd}\u{fffd}"
            );
        }
    }
}
