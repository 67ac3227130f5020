//! What does reading a recording cost, as it may be written? Ten minutes at 100 Hz: full digits, the
//! digits of a phone, stamps since 1970, semicolons and decimal commas, and cells that need care.

#![allow(missing_docs)]

use std::fmt::Write as _;

use calib::recording::{ReadOptions, Recording, Stream, to_csv};
use calib::simulate::{HandHeld, Motion, Spec};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn recording() -> Result<Recording, calib::Error> {
    let mut spec = Spec::hand_held(1);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(30),
        ..HandHeld::default()
    });
    Ok(spec.run()?.recording)
}

/// The recording with six decimals and the given stamps.
fn six_decimals(recording: &Recording, stamp: impl Fn(f64) -> String) -> String {
    let empty = Stream::default();
    let accel = recording.accelerometer.as_ref().unwrap_or(&empty);
    let gyro = recording.gyroscope.as_ref().unwrap_or(&empty);
    let mut text = "t,ax,ay,az,gx,gy,gz\n".to_owned();
    for ((t, a), w) in accel.t.iter().zip(&accel.values).zip(&gyro.values) {
        let _ = writeln!(
            text,
            "{},{:.6},{:.6},{:.6},{:.6},{:.6},{:.6}",
            stamp(*t),
            a.x,
            a.y,
            a.z,
            w.x,
            w.y,
            w.z
        );
    }
    text
}

/// The same text, every cell in quotes.
fn quoted(text: &str) -> String {
    let line = |line: &str| format!("\"{}\"\n", line.replace(',', "\",\""));
    text.lines().map(line).collect()
}

fn spellings(criterion: &mut Criterion) {
    let Ok(mut recording) = recording() else {
        return;
    };
    let short = six_decimals(&recording, |t| format!("{t:.3}"));
    let epoch = |t: f64| (1_700_000_000_000_000_000 + (1e9 * t) as i64).to_string();
    let texts = [
        ("all digits", to_csv(&mut recording)),
        ("six decimals", short.clone()),
        ("nanoseconds since 1970", six_decimals(&recording, epoch)),
        ("decimal commas", short.replace(',', ";").replace('.', ",")),
        ("quoted, line by line", quoted(&short)),
    ];
    let file = std::env::temp_dir().join("stillpoint-bench-read.csv");
    let mut group = criterion.benchmark_group("read");
    for (name, text) in &texts {
        if std::fs::write(&file, text).is_err() {
            return;
        }
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(*name, |b| {
            b.iter(|| Recording::read(&file, &ReadOptions::default()));
        });
    }
    group.finish();
    let _ = std::fs::remove_file(&file);
}

criterion_group!(benches, spellings);
criterion_main!(benches);
