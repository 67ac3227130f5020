//! The library's own rate on recordings of a device each, in one process:
//! `RAYON_NUM_THREADS=1 cargo run -p stillpoint-imu --example rate FOLDER...` calibrates all that is in the folders, and prints
//! devices, seconds of the clock and bytes of the calibrations. `tests/batch_rate.py` holds a batch and a shell loop against it.

use std::path::PathBuf;
use std::time::Instant;

use stillpoint::{Recording, Request, calibrate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for folder in std::env::args().skip(1) {
        let members = std::fs::read_dir(folder)?;
        paths.extend(members.flatten().map(|entry| entry.path()));
    }
    paths.sort();
    let begin = Instant::now();
    let mut bytes = 0;
    for path in &paths {
        let recording = Recording::from_file(path)?;
        bytes += calibrate(&[recording], &Request::default())?
            .to_json()?
            .len();
    }
    let seconds = begin.elapsed().as_secs_f64();
    println!("{} {seconds:.6} {bytes}", paths.len());
    Ok(())
}
