//! Where does a calibration's time go? One simulated session of 30 placements at 100 Hz, stage by
//! stage, from samples in memory.

#![allow(missing_docs)]

use calib::calibrate::{Request, calibrate, gyroscope_data};
use calib::intervals::{Detector, segment};
use calib::methods::{
    AccelerometerRequest, GyroscopeRequest, choose_multiplier, fit_accelerometer, fit_gyroscope,
    static_means,
};
use calib::recording::{ReadOptions, Recording, to_csv};
use calib::residuals::Integrator;
use calib::simulate::{HandHeld, Motion, Session, Spec};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn session() -> Result<Session, calib::Error> {
    let mut spec = Spec::hand_held(1);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(30),
        ..HandHeld::default()
    });
    spec.run()
}

fn stages(criterion: &mut Criterion) {
    let Ok(mut session) = session() else { return };
    let gravity = session.truth.spec.gravity;
    let samples = session
        .recording
        .accelerometer
        .as_ref()
        .map_or(0, |s| s.len());
    let csv = std::env::temp_dir().join("stillpoint-bench.csv");
    if std::fs::write(&csv, to_csv(&mut session.recording)).is_err() {
        return;
    }
    let recordings = [session.recording];
    let detector = Detector::default();
    let request = Request {
        gravity,
        ..Request::default()
    };
    let mut group = criterion.benchmark_group("calibration");
    group.throughput(Throughput::Elements(samples as u64));
    group.bench_function("read", |b| {
        b.iter(|| Recording::read(&csv, &ReadOptions::default()));
    });
    group.bench_function("segment", |b| b.iter(|| segment(&recordings[0], &detector)));
    group.bench_function("choose multiplier", |b| {
        b.iter(|| choose_multiplier(&recordings[0], &detector, gravity));
    });
    if let Ok(choice) = choose_multiplier(&recordings[0], &detector, gravity) {
        let segmentation = &choice.segmentation;
        let force = AccelerometerRequest {
            recordings: vec![static_means(&recordings[0], segmentation)],
            names: vec![recordings[0].name.clone()],
            model: accelerometer::model(),
            gravity,
        };
        group.bench_function("accelerometer fit", |b| {
            b.iter(|| fit_accelerometer(&force));
        });
        if let Ok(fit) = fit_accelerometer(&force) {
            let data = gyroscope_data(&recordings[0], segmentation, &fit, &request);
            let rate = GyroscopeRequest {
                recordings: vec![data],
                model: gyroscope::model(),
                integrator: Integrator::Exponential,
            };
            group.bench_function("gyroscope fit", |b| b.iter(|| fit_gyroscope(&rate)));
        }
    }
    group.bench_function("calibrate", |b| {
        b.iter(|| calibrate(&recordings, &[], &request))
    });
    group.finish();
    let _ = std::fs::remove_file(&csv);
}

criterion_group!(benches, stages);
criterion_main!(benches);
