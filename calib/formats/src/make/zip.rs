//! Zip archives.

use std::io::Write;

use flate2::{Compression, Crc};

/// Compression of an archive's entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    /// Not compressed.
    Stored,
    /// By deflate.
    Deflated,
}

/// A zip archive of these entries.
pub fn zip(entries: &[(&str, &[u8], Packing)]) -> Vec<u8> {
    let mut archive = Vec::new();
    let mut directory = Vec::new();
    for (name, content, packing) in entries {
        let at = archive.len() as u32;
        let packed = match packing {
            Packing::Stored => content.to_vec(),
            Packing::Deflated => {
                let mut encoder =
                    flate2::write::DeflateEncoder::new(Vec::new(), Compression::default());
                // Writing to memory does not fail.
                let _ = encoder.write_all(content);
                encoder.finish().unwrap_or_default()
            }
        };
        let mut crc = Crc::new();
        crc.update(content);
        let mut common = Vec::new();
        let method = if *packing == Packing::Stored { 0u16 } else { 8 };
        common.extend([20u16, 0, method, 0, 0].map(u16::to_le_bytes).concat());
        let sizes = [crc.sum(), packed.len() as u32, content.len() as u32];
        common.extend(sizes.map(u32::to_le_bytes).concat());
        common.extend([name.len() as u16, 0].map(u16::to_le_bytes).concat());
        archive.extend(b"PK\x03\x04");
        archive.extend(&common);
        archive.extend(name.as_bytes());
        archive.extend(packed);
        directory.extend(b"PK\x01\x02\x14\0");
        directory.extend(&common);
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let count = (entries.len() as u16).to_le_bytes();
    let place = [directory.len() as u32, archive.len() as u32].map(u32::to_le_bytes);
    archive.extend(directory);
    archive.extend(b"PK\x05\x06\0\0\0\0");
    archive.extend([count, count].concat());
    archive.extend(place.concat());
    archive.extend([0, 0]);
    archive
}
