//! What does an Allan deviation cost next to reading? A quarter of an hour at rest at 200 Hz, six
//! channels: the sums alone, the file read into memory, and the file streamed into the sums.

#![allow(missing_docs)]

use calib::noise::{AllanCurve, RecordingCurves, curves_of_long_csv};
use calib::recording::{ReadOptions, Recording, Stream, to_csv};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use nalgebra::Vector3;

const SAMPLES: u32 = 200 * 900;

/// Readings about `mean` whose last digits wander.
fn stream(mean: Vector3<f64>) -> Stream {
    let reading = |k: u32| {
        let noise = |axis: u32| 1e-3 * f64::from((k * 7919 + axis * 104_729) % 10_007) / 10_007.0;
        mean + Vector3::new(noise(0), noise(1), noise(2))
    };
    Stream {
        t: (0..SAMPLES).map(|k| f64::from(k) * 0.005).collect(),
        values: (0..SAMPLES).map(reading).collect(),
    }
}

fn curves(criterion: &mut Criterion) {
    let mut recording = Recording {
        accelerometer: Some(stream(Vector3::new(0.1, -0.2, 9.8))),
        gyroscope: Some(stream(Vector3::new(0.01, 0.02, -0.01))),
        ..Recording::default()
    };
    let csv = std::env::temp_dir().join("stillpoint-bench-allan.csv");
    if std::fs::write(&csv, to_csv(&mut recording)).is_err() {
        return;
    }
    let channel: Vec<f64> = stream(Vector3::zeros())
        .values
        .iter()
        .map(|v| v.x)
        .collect();
    let mut group = criterion.benchmark_group("allan");
    group.throughput(Throughput::Elements(u64::from(SAMPLES)));
    group.sample_size(20);
    group.bench_function("one channel", |b| {
        b.iter(|| AllanCurve::of(channel.iter().copied(), 0.005));
    });
    group.bench_function("six channels", |b| {
        b.iter(|| RecordingCurves::of(&recording, None));
    });
    group.bench_function("read", |b| {
        b.iter(|| Recording::read(&csv, &ReadOptions::default()));
    });
    group.bench_function("read into six channels", |b| {
        b.iter(|| curves_of_long_csv(&csv, None));
    });
    group.finish();
    let _ = std::fs::remove_file(&csv);
}

criterion_group!(benches, curves);
criterion_main!(benches);
