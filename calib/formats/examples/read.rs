//! Reads a file and says what is in it, how long that took and how much memory: `read FILE [TIMES]`.

use std::error::Error;
use std::fs::File;
use std::io::Read;
use std::time::Instant;

use stillpoint_formats::{Limits, Wanted, recognise};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("read FILE [TIMES]")?;
    let times: usize = arguments.next().map_or(Ok(1), |times| times.parse())?;
    let mut head = Vec::new();
    File::open(&path)?.take(4096).read_to_end(&mut head)?;
    let format = recognise(&head).ok_or("of no known format")?;
    let (mut best, before) = (f64::INFINITY, peak());
    for run in 0..times {
        let began = Instant::now();
        let content = format.read_seekable(
            &mut File::open(&path)?,
            &Wanted::default(),
            Limits::default(),
        )?;
        best = best.min(began.elapsed().as_secs_f64());
        if run == 0 {
            let samples: usize = content
                .streams
                .iter()
                .map(|stream| stream.stamps.len())
                .sum();
            for stream in &content.streams {
                println!(
                    "{} {}: {:?}, {} samples, {:.2} Hz",
                    stream.source,
                    stream.instance,
                    stream.quantity,
                    stream.stamps.len(),
                    stream.rate()
                );
            }
            println!(
                "{}: {:.2} MB of columns, {:.2} MB of memory more than before",
                format.name,
                samples as f64 * 32e-6,
                peak() - before
            );
        }
    }
    println!("{:.2} ms, best of {times}", 1e3 * best);
    Ok(())
}

/// The most memory that the process has had, MB.
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) * 1.024e-3
}
