//! Clocks: uneven sampling with right stamps, noisy stamps, rounding, other rates.

use calib::simulate::{Between, Clock, Resampled, Sampling, Spec};

use super::condition::{Condition, by_hand, row};
use crate::conditions::Kind;

/// Noise of stamps and of the sampling, s; rounding, s.
fn noise(spec: &mut Spec, jitter: f64, sampling_jitter: f64, resolution: f64) {
    for sensor in [&mut spec.accelerometer, &mut spec.gyroscope] {
        sensor.clock = Clock {
            jitter,
            sampling_jitter,
            resolution,
            ..sensor.clock.clone()
        };
    }
}

/// A sensor of `rate` Hz in a recording of 100 Hz.
fn resampled(spec: &mut Spec, rate: f64, by: Between) {
    let own = Some(Resampled { rate, by });
    spec.accelerometer.resampled = own;
    spec.gyroscope.resampled = own;
}

/// Rates that sensors have, samples per second.
const RATES: [f64; 5] = [25.0, 50.0, 104.0, 200.0, 400.0];

/// Clocks of their own for both sensors.
fn own_clocks(spec: &mut Spec) {
    let rate = |k: u64| RATES[(k % RATES.len() as u64) as usize];
    let clock = |rate: f64, phase: f64| Clock {
        rate: Some(rate),
        phase: phase / rate,
        jitter: 0.02 / rate,
        resolution: if rate <= 100.0 { 1e-3 } else { 1e-4 },
        ..Clock::default()
    };
    spec.accelerometer.clock = clock(rate(spec.seed), 0.3);
    spec.gyroscope.clock = clock(rate(spec.seed / RATES.len() as u64), 0.0);
}

const CLOCK: &[Kind] = &[Kind::Clock];
/// What a method shows that takes stamps which scatter for the times of the samples.
const MISFIT: &[Kind] = &[Kind::Misfit];
/// Single readings far from their neighbours are said to be knocks or transfer errors.
const KNOCKED: &[Kind] = &[Kind::Undersampled, Kind::Misfit, Kind::Spikes];
const UNDERSAMPLED: &[Kind] = &[Kind::Undersampled, Kind::Misfit];
const RESAMPLED: &[Kind] = &[Kind::Undersampled, Kind::Values, Kind::Clock, Kind::Misfit];

pub(super) const ROWS: &[Condition] = &[
    row(
        "jitter-2",
        "sampling jitter of 2 % of a step, stamps true",
        |s| {
            noise(s, 0.0, 2e-4, 0.0);
        },
    )
    .bounded()
    .right(CLOCK),
    row("jitter-2-tactical", "the same, tactical", |s| {
        noise(s, 0.0, 2e-4, 0.0)
    })
    .tactical()
    .bounded()
    .right(CLOCK),
    row("jitter-20", "sampling jitter of 20 %, stamps true", |s| {
        noise(s, 0.0, 2e-3, 0.0);
    })
    .bounded()
    .right(CLOCK),
    row("jitter-20-tactical", "the same, tactical", |s| {
        noise(s, 0.0, 2e-3, 0.0)
    })
    .tactical()
    .bounded()
    .right(CLOCK),
    row("jitter-2-25hz", "sampling jitter of 2 % at 25 Hz", |s| {
        s.rate = 25.0;
        noise(s, 0.0, 8e-4, 0.0);
    })
    .bounded()
    .right(CLOCK),
    row("stamps-0.5", "stamp noise of .5 ms, even clock", |s| {
        noise(s, 5e-4, 0.0, 0.0)
    })
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row("stamps-1", "stamp noise of 1 ms, even clock", |s| {
        noise(s, 1e-3, 0.0, 0.0)
    })
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row("stamps-1.5", "stamp noise of 1.5 ms, even clock", |s| {
        noise(s, 1.5e-3, 0.0, 0.0);
    })
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row("stamps-1-tactical", "stamp noise of 1 ms, tactical", |s| {
        noise(s, 1e-3, 0.0, 0.0)
    })
    .tactical()
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row("stamps-4", "stamp noise of 4 ms, even clock", |s| {
        noise(s, 4e-3, 0.0, 0.0)
    })
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row("rounding", "99.75 Hz, stamps rounded to 1 ms", |s| {
        s.rate = 99.75;
        noise(s, 0.0, 0.0, 1e-3);
    })
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row("rounding-tactical", "the same, tactical", |s| {
        s.rate = 99.75;
        noise(s, 0.0, 0.0, 1e-3);
    })
    .tactical()
    .bounded()
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row(
        "jitter-rounding",
        "sampling jitter of 5 %, rounded to 1 ms",
        |s| {
            noise(s, 0.0, 5e-4, 1e-3);
        },
    )
    .right(CLOCK)
    .right_by_stamps(MISFIT),
    row(
        "clocks",
        "25 to 400 Hz, own clocks, jitter, rounding",
        own_clocks,
    )
    .right(CLOCK),
    row(
        "two-clocks",
        "accelerometer late by 10 ms and 100 ppm fast",
        |s| {
            s.accelerometer.clock = Clock {
                rate: Some(104.0),
                offset: 0.01,
                rate_error: 1e-4,
                ..Clock::default()
            };
        },
    )
    .right(CLOCK),
    row("lost-samples", "1 % of the samples missing", |s| {
        s.accelerometer.clock.lost = 0.01;
        s.gyroscope.clock.lost = 0.01;
    })
    .right(&[Kind::Missing, Kind::Clock, Kind::Unused, Kind::Undersampled]),
    row("held", "sensors of 50 Hz held at 100 Hz", |s| {
        resampled(s, 50.0, Between::Hold)
    })
    .right(RESAMPLED),
    row(
        "interpolated",
        "sensors of 93 Hz interpolated to 100 Hz",
        |s| {
            resampled(s, 93.0, Between::Linear);
        },
    )
    .right(RESAMPLED),
    row("point", "samples at an instant, no knocks", |s| {
        s.sampling = Sampling::Point
    })
    .right(UNDERSAMPLED),
    row("knocks-point", "three knocks a turn, point samples", |s| {
        s.sampling = Sampling::Point;
        by_hand(s, |hand| hand.knocks = 3);
    })
    .right(KNOCKED),
    row("knocks-average", "three knocks a turn, averaged", |s| {
        by_hand(s, |hand| hand.knocks = 3);
    })
    .right(KNOCKED),
];
