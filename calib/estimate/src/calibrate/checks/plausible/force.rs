//! An accelerometer against gravity: its unit, the scale of its axes, and gravity that was taken off.

use findings::{Finding, Kind, OptionName, Remedy};
use sensor::Sensor;

use super::Said;
use super::apart::ForceFit;
use super::columns::Columns;
use super::odd_axis::say_odd_axis;
use super::scales::{Scales, rounded, undone};
use super::ticked::ticked;
use crate::gravity::STANDARD_GRAVITY;

findings::tuning! {
    /// All axes off by so much are the unit or gravity rather than the sensor ...
    ALL_OFF: f64 = 0.025;
    /// ... where they are alike to this part of it, ...
    ALIKE: f64 = 0.4;
    /// ... and by so much in any case ...
    ALL_FAR_OFF: f64 = 0.035;
    /// ... and no sensor is off by as much.
    BEYOND: f64 = 0.05;
    /// Counts per unit that differ from axis to axis by more than this are worth a word.
    COUNTS_APART: f64 = 0.1;
    /// No accelerometer is biased by so much of gravity: half of it occurs.
    BIASED: f64 = 0.7;
}
/// Such a bias is gravity itself.
const GRAVITY: std::ops::Range<f64> = 0.9..1.1;

impl ForceFit<'_> {
    /// Gravity's word on it.
    pub fn said(&self) -> Said {
        let mut said = said(self, &Columns::of(self.recordings, Sensor::Accelerometer));
        if let Some(found) = ticked(self.recordings) {
            said.warn(found);
        }
        said
    }
}

/// Gravity's word on an accelerometer.
pub(super) fn said(fit: &ForceFit<'_>, columns: &Columns) -> Said {
    let mut said = Said::default();
    let Some(scales) = Scales::of(&fit.base.t, &fit.std) else {
        return said;
    };
    let is_si = columns.is_si(fit.unit.is_si());
    let has_odd = say_odd_axis(Sensor::Accelerometer, &scales, columns, is_si, &mut said);
    if !is_si {
        if !has_odd && scales.spread() > COUNTS_APART.get() {
            let [x, y, z] = scales.each();
            said.warn(
                Finding::of(Kind::COUNTS_DIFFER)
                    .of_sensor(Sensor::Accelerometer)
                    .number("x", x, "1")
                    .number("y", y, "1")
                    .number("z", z, "1")
                    .number("share", scales.spread(), "share"),
            );
        }
        said.warnings.extend(counts(fit));
        return said;
    }
    if !has_odd {
        of_all(fit, columns, &scales, &mut said);
    }
    for axis in 0..3 {
        let bias = fit.base.bias[axis] / scales.each()[axis];
        let share = bias.abs() / STANDARD_GRAVITY;
        if share < BIASED.get() || !scales.tell(BIASED.get()) {
            continue;
        }
        let (why, by) = match GRAVITY.contains(&share) {
            true if bias < 0.0 => ("without", STANDARD_GRAVITY),
            true => ("with", -STANDARD_GRAVITY),
            false => ("moved", rounded(-bias)),
        };
        said.gate(
            Finding::of(Kind::ZERO_OFF)
                .of_sensor(Sensor::Accelerometer)
                .detail("axis", columns.roles[axis])
                .number("bias", bias, "m/s^2")
                .detail(why, columns.roles[axis])
                .only_remedies([columns.shifted(axis, by)]),
        );
    }
    said
}

/// A scale that is off on all axes.
fn of_all(fit: &ForceFit<'_>, columns: &Columns, scales: &Scales, said: &mut Said) {
    let common = scales.common();
    let off = (common - 1.0).abs();
    let alike = off > ALL_OFF.get() && scales.spread() < ALIKE.get() * off;
    let far = off > ALL_FAR_OFF.get() && scales.spread() < off;
    if !(alike || far) || !scales.tell(off) {
        return;
    }
    let read = columns.scaled(&[0, 1, 2].map(|axis| (axis, undone(common))));
    let found = Finding::of(Kind::SCALE_OFF)
        .of_sensor(Sensor::Accelerometer)
        .number("reads", common * fit.gravity, "m/s^2")
        .number("share", off, "share")
        .detail("more", if common > 1.0 { "more" } else { "less" })
        .number("gravity", fit.gravity, "m/s^2")
        .affects("corrected_reading", off * fit.gravity, "m/s^2");
    match off > BEYOND.get() {
        true => said.gate(
            found
                .detail("beyond", "it")
                .only_remedies([read, Remedy::set(OptionName::Gravity)]),
        ),
        false => said.warn(found.detail("carried", "it").only_remedies([read])),
    }
}

/// The size of counts.
fn counts(fit: &ForceFit<'_>) -> Option<Finding> {
    let unit = &fit.unit;
    (!unit.is_si()).then(|| {
        let of = |kind| Finding::of(kind).of_sensor(Sensor::Accelerometer);
        if (9.0..10.5).contains(&unit.scale) {
            return of(Kind::READINGS_IN_G);
        }
        let zero = unit.zero;
        of(Kind::RAW_COUNTS)
            .number("scale", unit.scale, "m/s^2")
            .detail(
                "zero",
                format!("{:.0}, {:.0}, {:.0}", zero.x, zero.y, zero.z),
            )
    })
}
