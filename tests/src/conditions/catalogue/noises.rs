//! Noise that is not white or not normal, and readings that are coarse.

use calib::simulate::{Distribution, SensorSpec, Spec, Spikes};

use super::condition::{Condition, row};
use crate::conditions::Kind;

/// White noise of single samples at 100 Hz, m/s² and rad/s.
const SIGMA: [f64; 2] = [2e-2, 1e-3];

fn both(spec: &mut Spec, change: impl Fn(&mut SensorSpec, f64)) {
    change(&mut spec.accelerometer, SIGMA[0]);
    change(&mut spec.gyroscope, SIGMA[1]);
}

fn steps(spec: &mut Spec, sigmas: f64) {
    both(spec, |sensor, sigma| sensor.step = sigmas * sigma);
}

const VALUES: &[Kind] = &[Kind::Values, Kind::Misfit];

pub(super) const ROWS: &[Condition] = &[
    row("low-pass", "noise through a low pass of 20 Hz", |s| {
        both(s, |sensor, _| sensor.low_pass = Some(20.0));
    }),
    row("low-pass-5", "noise through a low pass of 5 Hz", |s| {
        both(s, |sensor, _| sensor.low_pass = Some(5.0));
    }),
    row(
        "correlated",
        "autoregressive noise, .9 from sample to sample",
        |s| {
            both(s, |sensor, _| sensor.correlation = 0.9);
        },
    ),
    row("laplace", "Laplace noise", |s| {
        both(s, |sensor, _| sensor.distribution = Distribution::Laplace);
    }),
    row(
        "spikes",
        "one sample in a thousand is off by 20 sigma",
        |s| {
            both(s, |sensor, sigma| {
                sensor.spikes = Some(Spikes {
                    share: 1e-3,
                    size: 20.0 * sigma,
                });
            });
        },
    )
    .right(&[Kind::Spikes, Kind::Values]),
    row("quantised-1", "steps of 1 sigma", |s| steps(s, 1.0)).right(VALUES),
    row("quantised-4", "steps of 4 sigma", |s| steps(s, 4.0)).right(VALUES),
    row("quantised-8", "steps of 8 sigma", |s| steps(s, 8.0)).right(VALUES),
    row(
        "dead-zone",
        "the gyroscope is silent below .02 rad/s",
        |s| {
            s.gyroscope.dead_zone = 0.02;
        },
    )
    .beyond_the_model()
    .right(VALUES),
];
