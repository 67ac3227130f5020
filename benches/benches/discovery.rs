//! What does a look for missing effects cost? One simulated session of 30 placements at 100 Hz: the joint
//! estimate, the tests of the whole catalogue, all of `discover`; with nothing hidden and with an effect.

#![allow(missing_docs)]

use calib::discover::{Extension, Request, Session, State, discover, families, rank};
use calib::simulate::{HandHeld, Motion, Spec};
use criterion::{Criterion, criterion_group, criterion_main};

fn spec() -> Spec {
    let mut spec = Spec::hand_held(1);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(30),
        ..HandHeld::default()
    });
    spec
}

fn discovery(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("discovery");
    group.sample_size(20);
    let hidden = spec().with_effect("gyro_g_sensitivity", 1.0);
    for (what, spec) in [("nothing hidden", spec()), ("g-sensitivity", hidden)] {
        let Ok(simulated) = spec.run() else { return };
        let recordings = [simulated.recording];
        let request = Request::new(spec.gravity);
        let Ok(session) = Session::new(&recordings, &request) else {
            return;
        };
        let Ok(base) = State::fit(&session, Extension::default()) else {
            return;
        };
        group.bench_function(format!("joint estimate, {what}"), |b| {
            b.iter(|| State::fit(&session, Extension::default()));
        });
        group.bench_function(format!("tests of the catalogue, {what}"), |b| {
            b.iter(|| {
                let families = families(&base, &request.candidates());
                rank(&base.projected, &families, base.levels())
            });
        });
        group.bench_function(format!("discover, {what}"), |b| {
            b.iter(|| discover(&recordings, &request));
        });
    }
    group.finish();
}

criterion_group!(benches, discovery);
criterion_main!(benches);
