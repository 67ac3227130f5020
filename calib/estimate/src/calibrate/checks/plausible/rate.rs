//! A gyroscope against the turns that the accelerometer saw: its unit, the scale of its axes, and how they lie.

use findings::{Finding, Kind, OptionName, Remedy};
use recording::Recording;
use sensor::Sensor;

use super::Said;
use super::apart::RateFit;
use super::axes::SignedAxes;
use super::columns::Columns;
use super::odd_axis::say_odd_axis;
use super::scales::{Scales, rounded};
use super::ticked::{TICKS, clock_of_ticks};
use crate::calibrate::checks::determined::LOST;

findings::tuning! {
    /// An element of the gyroscope's matrix this far from that of aligned axes is no misalignment.
    TURNED: f64 = 0.26;

    /// A scale this far from one on all axes of readings in SI units is a unit or a time base.
    COMMON_SCALE: f64 = 0.03;

    /// A gyroscope's own scale beside them, all axes together; one axis has twice that.
    TICKS_OFF: f64 = 0.008;
}

/// The same to a factor of two, the commonest of wrong rates, and the sensor's own errors on top.
const COMMON_SCALES: std::ops::RangeInclusive<f64> = 0.45..=2.2;

/// A finding of the gyroscope.
fn of(kind: Kind) -> Finding {
    Finding::of(kind).of_sensor(Sensor::Gyroscope)
}

impl RateFit<'_> {
    /// The turns' word on it.
    pub fn said(&self) -> Said {
        let own = Columns::of(self.recordings, Sensor::Gyroscope);
        let force = Columns::of(self.recordings, Sensor::Accelerometer);
        said(self, &own, &force)
    }
}

/// The turns' word on a gyroscope.
pub(super) fn said(fit: &RateFit<'_>, columns: &Columns, force: &Columns) -> Said {
    let mut said = Said::default();
    if fit.missed > LOST.get() {
        said.gate(of(Kind::GRAVITY_MISSED).number("missed", fit.missed, "rad"));
    }
    of_axes(fit, columns, force, &mut said);
    if fit.missed <= LOST.get()
        && let Some(scales) = Scales::of(&fit.base.t, &fit.std)
    {
        of_scales(fit, columns, &scales, &mut said);
    }
    said.warnings.extend(unit(fit));
    said
}

/// Axes that lie otherwise than the accelerometer's.
fn of_axes(fit: &RateFit<'_>, columns: &Columns, force: &Columns, said: &mut Said) {
    let near_si = fit.near_si();
    let nearest = SignedAxes::nearest(&near_si);
    if near_si.determinant() < 0.0 {
        let Some(axes) = nearest.filter(SignedAxes::is_mirror) else {
            said.gate(of(Kind::AXES_NOT_SHOWN));
            return;
        };
        let found = of(Kind::LEFT_HANDED).detail("axes", axes.in_words());
        // With every sign changed it may as well be that both sensors are mirrored.
        let both = format!("{},{}", force.roles[0], columns.roles[0]);
        let both = Remedy::set_to(OptionName::Flip, both);
        let is_either = axes.is_in_order() && axes.flipped().count() == 3;
        let read = columns.turned(&axes);
        said.gate(match is_either {
            true => found.only_remedies([read, both]),
            false => found.only_remedies([read]),
        });
        return;
    }
    let Some(axes) = nearest.filter(|axes| !axes.is_unchanged() && fit.missed <= LOST.get()) else {
        let off = near_si - nalgebra::Matrix3::from_diagonal(&near_si.diagonal());
        if fit.missed <= LOST.get() && off.amax() > TURNED.get() {
            said.warn(of(Kind::AXES_TURNED).detail("angle", "right angle"));
        }
        return;
    };
    let turned = of(Kind::AXES_TURNED).detail("axes", axes.in_words());
    said.warn(match axes.is_half_turn() {
        false => turned,
        true => turned
            .detail("other", Sensor::Accelerometer.name())
            // The likelier first: one slip in the accelerometer's columns is two in the gyroscope's.
            .only_remedies([
                force.turned(&axes.opposite().inverse()),
                columns.turned(&axes),
            ]),
    });
}

/// Scales that are off on all axes, or on one.
fn of_scales(fit: &RateFit<'_>, columns: &Columns, scales: &Scales, said: &mut Said) {
    let si = columns.is_si(fit.force_is_si);
    if say_odd_axis(Sensor::Gyroscope, scales, columns, si, said) {
        return;
    }
    if let Some(found) = ticks(fit, scales).filter(|_| si) {
        said.warn(found);
        return;
    }
    let all = scales.all_off(COMMON_SCALE.get());
    let all = all.filter(|ratio| scales.tell(ratio.ln().abs()));
    if let Some(ratio) = all.filter(|ratio| si && COMMON_SCALES.contains(ratio)) {
        let read = columns.scaled(&[0, 1, 2].map(|axis| (axis, rounded(ratio))));
        said.gate(
            of(Kind::GYROSCOPE_SCALE_OFF)
                .detail("ratio", format!("{ratio:.3}"))
                .only_remedies([Remedy::set(OptionName::Rate), read]),
        );
    }
}

/// Stamps of which nobody says that they are milliseconds, and in which every axis reads as much too much as it would were they
/// 1024 in a second.
fn ticks(fit: &RateFit<'_>, scales: &Scales) -> Option<Finding> {
    let is_guess = |found: &Finding| {
        found.kind == Kind::TIME_UNIT_TOLD
            && found.word("unit") == Some("ms")
            && found.value("year").is_none()
    };
    let guessed = |recording: &&&Recording| recording.warnings.iter().any(is_guess);
    let recording = fit.recordings.iter().find(guessed)?;
    let ratio = scales.common().recip();
    let near = |scale: f64, within: f64| (scale * TICKS.get() / 1000.0 - 1.0).abs() < within;
    let are_near = near(ratio, TICKS_OFF.get())
        && scales
            .each()
            .iter()
            .all(|s| near(s.recip(), 2.0 * TICKS_OFF.get()));
    let found = clock_of_ticks(recording, Sensor::Gyroscope)?.of_sensor(Sensor::Gyroscope);
    (are_near && scales.tell((TICKS.get() / 1000.0).ln()))
        .then(|| found.detail("ratio", format!("{ratio:.3}")))
}

/// The unit of readings that are not in rad/s.
fn unit(fit: &RateFit<'_>) -> Option<Finding> {
    let scale = fit.scale;
    if scale == 1.0 || (fit.force_is_si && (0.3..3.0).contains(&scale)) {
        return None;
    }
    let unit = |unit: &'static str| Remedy::set_to(OptionName::GyroUnit, unit);
    Some(if (scale.to_degrees() - 1.0).abs() < 0.15 {
        of(Kind::READINGS_IN_DEGREES)
            .detail("unit", "degrees per second")
            .only_remedies([unit("deg/s")])
    } else if (scale.to_radians() - 1.0).abs() < 0.15 {
        of(Kind::READINGS_IN_DEGREES)
            .detail("unit", "rad/s")
            .detail("read", "degrees per second")
            .only_remedies([unit("rad/s")])
    } else {
        of(Kind::RAW_COUNTS).number("scale", scale, "rad/s")
    })
}
