//! Output of the joint method in addition to the tables of parameters.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write as _;

use calib::calibration::Remainder;
use calib::methods::joint::{ComponentKind, JointFit};
use calib::truth::supposed;
use nalgebra::Vector3;
use sensor::Sensor;

use crate::show;

/// Time for a quarter or a full turn, s: what a bias adds to the heading grows with it.
pub const TURN_TIME: f64 = 3.0;

/// What a fit that knows the noise of each row weighs its residual by; the first screen has the plain one.
pub const BY_WEIGHTS: &str = " by the weights of the fit";

/// Levels of noise, and what the errors of the parameters make of readings and headings.
pub fn text(fit: &JointFit) -> String {
    let mut text = String::new();
    if !fit.chords.is_empty() {
        let missed = show::figures(fit.direction_rms().to_degrees(), 3);
        let _ = writeln!(
            text,
            "{} turns, gravity predicted to {missed}° rms{BY_WEIGHTS}",
            fit.chords.len()
        );
    }
    for misfit in fit.misfits() {
        let left = Remainder::of(&misfit);
        let _ = writeln!(
            text,
            "{}: {:.2} times the measured noise ({} rms, {:.0} degrees of freedom, {})",
            left.what(),
            misfit.ratio(),
            left.in_words(left.rms),
            left.degrees_of_freedom,
            show::probability(left.p_value)
        );
    }
    for level in fit.levels.iter().filter(|l| l.size > 0.0) {
        let _ = writeln!(text, "noise: {}", level_in_words(level.kind, level.size));
    }
    let force = fit.prediction(Sensor::Accelerometer);
    for (axis, name) in axes() {
        let truth = supposed(axis * fit.gravity, Vector3::zeros());
        let std = force.std_of_reading(&truth);
        let _ = writeln!(
            text,
            "error of the corrected reading with {name} up: {:.2} {:.2} {:.2} mm/s²",
            1e3 * std.x,
            1e3 * std.y,
            1e3 * std.z
        );
    }
    if fit.has_gyroscope() && !fit.chords.is_empty() {
        let rate = fit.prediction(Sensor::Gyroscope);
        for (axis, name) in axes() {
            let _ = writeln!(
                text,
                "heading error per turn about {name} in {TURN_TIME} s: {:.4}° in 90°, {:.4}° in 360°",
                rate.std_of_heading(&axis, FRAC_PI_2, TURN_TIME)
                    .to_degrees(),
                rate.std_of_heading(&axis, TAU, TURN_TIME).to_degrees()
            );
        }
    }
    text
}

fn axes() -> [(Vector3<f64>, &'static str); 3] {
    [
        (Vector3::x(), "x"),
        (Vector3::y(), "y"),
        (Vector3::z(), "z"),
    ]
}

fn level_in_words(kind: ComponentKind, size: f64) -> String {
    match kind {
        ComponentKind::AccelerometerWalk => {
            format!("the accelerometer's bias walks by {size:.1e} m/s²/√s")
        }
        ComponentKind::AccelerometerFlicker(axis) => {
            let axis = ["x", "y", "z"][axis % 3];
            format!("the accelerometer's bias flickers by {size:.1e} m/s² on {axis}")
        }
        ComponentKind::GyroscopeFlicker(axis) => {
            let axis = ["x", "y", "z"][axis % 3];
            format!("the gyroscope's bias flickers by {size:.1e} rad/s on {axis}")
        }
        ComponentKind::GyroscopeWalk => {
            format!("the gyroscope's bias walks by {size:.1e} rad/s/√s")
        }
        ComponentKind::ForceScatter => format!(
            "the accelerometer scatters by {:.2} mm/s² from rest to rest: more than its noise",
            1e3 * size
        ),
        ComponentKind::RateScatter => format!(
            "the gyroscope scatters by {size:.1e} rad/s from rest to rest: more than its noise"
        ),
        ComponentKind::ForceOfOrientation => format!(
            "what is missing of the accelerometer changes with the orientation by {:.2} mm/s² at one g",
            1e3 * size
        ),
        ComponentKind::RateOfOrientation => format!(
            "what is missing of the gyroscope changes with the orientation by {size:.1e} rad/s at one g"
        ),
        ComponentKind::EarthRotation => format!(
            "the earth's rotation is taken to be anywhere within {size:.1e} rad/s per component (--latitude says it)"
        ),
        ComponentKind::CommonRounding => {
            "the gyroscope reads in steps wider than its noise: rounding is the same in every rest"
                .into()
        }
        ComponentKind::TurnDoubt => format!(
            "the turns may scatter by {:.3}° beyond the gyroscope's noise, which is in the errors",
            size.to_degrees()
        ),
        ComponentKind::TurnScatter => format!(
            "the turns scatter by {:.3}°: more than the gyroscope's noise",
            size.to_degrees()
        ),
    }
}
