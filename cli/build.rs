//! Packs the font of the pictures, of which the program would otherwise carry twice as many bytes.

use std::io::Write;
use std::path::Path;
use std::{env, fs, io};

use flate2::Compression;
use flate2::write::ZlibEncoder;

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let folder = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::best());
    packed.write_all(dejavu::sans::regular())?;
    fs::write(Path::new(&folder).join("font.zlib"), packed.finish()?)
}
