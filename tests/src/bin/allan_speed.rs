//! What the Allan deviation of a long file costs, next to reading the file alone.
//!
//! ```text
//! cargo run --release -p stillpoint-tests --bin allan_speed -- day.csv
//! ```
//!
//! Reads a plain CSV recording three times: bytes only, rows parsed to numbers only, and streamed
//! into the curves of six channels. Prints seconds, and the peak memory of the process where the
//! system tells (Linux).

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::time::Instant;

use calib::noise::curves_of_long_csv;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args()
        .nth(1)
        .ok_or("name a plain CSV recording")?;
    let path = Path::new(&path);
    timed("bytes", || bytes(path))?;
    timed("rows parsed", || rows(path))?;
    let samples = timed("six Allan curves", || {
        let curves = curves_of_long_csv(path, None).ok_or("no plain CSV recording")?;
        Ok(curves.gyroscope.map_or(0, |sensor| sensor.axes[0].samples))
    })?;
    println!("{samples} samples of six channels");
    if let Ok(status) = std::fs::read_to_string("/proc/self/status") {
        status
            .lines()
            .filter(|line| line.starts_with("VmHWM"))
            .for_each(|line| println!("{line}"));
    }
    Ok(())
}

fn timed<T>(
    what: &str,
    work: impl FnOnce() -> Result<T, Box<dyn std::error::Error>>,
) -> Result<T, Box<dyn std::error::Error>> {
    let start = Instant::now();
    let result = work()?;
    println!("{what}: {:.2} s", start.elapsed().as_secs_f64());
    Ok(result)
}

fn bytes(path: &Path) -> Result<usize, Box<dyn std::error::Error>> {
    let mut file = std::fs::File::open(path)?;
    let mut buffer = vec![0; 1 << 20];
    let mut total = 0;
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(total),
            n => total += n,
        }
    }
}

/// The sum of all numbers, so that none of them can be left out.
fn rows(path: &Path) -> Result<f64, Box<dyn std::error::Error>> {
    let mut sum = 0.0;
    for line in BufReader::with_capacity(1 << 20, std::fs::File::open(path)?)
        .lines()
        .skip(1)
    {
        for field in line?.split(',') {
            sum += field.parse::<f64>()?;
        }
    }
    Ok(sum)
}
