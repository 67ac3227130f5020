//! An accelerometer against gravity: its unit, the scale of its axes, and gravity that was taken off.

use sensor::Sensor;

use super::Said;
use super::apart::ForceFit;
use super::columns::Columns;
use super::scales::{Scales, cause, rounded};
use crate::gravity::STANDARD_GRAVITY;

/// All axes off by so much, alike to this part of it, are the unit or gravity rather than the sensor ...
const ALL_OFF: f64 = 0.025;
const ALIKE: f64 = 0.4;
/// ... and by so much in any case ...
const ALL_FAR_OFF: f64 = 0.035;
/// ... and no sensor is off by as much.
const BEYOND: f64 = 0.05;
/// Counts per unit that differ from axis to axis by more than this are worth a word.
const COUNTS_APART: f64 = 0.1;
/// No accelerometer is biased by so much of gravity: half of it occurs.
const BIASED: f64 = 0.7;
/// Such a bias is gravity itself.
const GRAVITY: std::ops::Range<f64> = 0.9..1.1;

impl ForceFit<'_> {
    /// Gravity's word on it.
    pub fn said(&self) -> Said {
        said(self, &Columns::of(self.recordings, Sensor::Accelerometer))
    }
}

/// Gravity's word on an accelerometer.
pub(super) fn said(fit: &ForceFit<'_>, columns: &Columns) -> Said {
    let mut said = Said::default();
    let Some(scales) = Scales::of(&fit.base.t, &fit.std) else {
        return said;
    };
    let is_si = columns.is_si(fit.unit.is_si());
    let odd = scales.odd();
    if let Some((axis, factor)) = odd {
        let (times, undone) = cause(factor);
        let others: Vec<&str> = (0..3)
            .filter(|k| *k != axis)
            .map(|k| columns.roles[k])
            .collect();
        let words = format!(
            "the accelerometer's {} reads {times} what {} read of the same force: it has another unit or range; read it with {}",
            columns.roles[axis],
            others.join(" and "),
            columns.scaled(&[(axis, undone)])
        );
        match is_si {
            true => said.gate(words),
            false => said.warn(words),
        }
    }
    if !is_si {
        if odd.is_none() && scales.spread() > COUNTS_APART {
            let [x, y, z] = scales.each();
            said.warn(format!(
                "the accelerometer's axes read {x:.4}, {y:.4} and {z:.4} counts per m/s², which differ by {:.0} %: are all of one range?",
                100.0 * scales.spread()
            ));
        }
        said.warnings.extend(counts(fit));
        return said;
    }
    if odd.is_none() {
        of_all(fit, columns, &scales, &mut said);
    }
    for axis in 0..3 {
        let bias = fit.base.bias[axis] / scales.each()[axis];
        let share = bias.abs() / STANDARD_GRAVITY;
        if share < BIASED || !scales.tell(BIASED) {
            continue;
        }
        let (why, by) = match GRAVITY.contains(&share) {
            true if bias < 0.0 => ("gravity was taken off it", STANDARD_GRAVITY),
            true => ("gravity was added to it", -STANDARD_GRAVITY),
            false => ("a constant was added to it", rounded(-bias)),
        };
        said.gate(format!(
            "the accelerometer's {} has its zero at {bias:+.2} m/s², as no sensor has: {why}; read it with {}",
            columns.roles[axis],
            columns.shifted(axis, by)
        ));
    }
    said
}

/// A scale that is off on all axes.
fn of_all(fit: &ForceFit<'_>, columns: &Columns, scales: &Scales, said: &mut Said) {
    let common = scales.common();
    let off = (common - 1.0).abs();
    let alike = off > ALL_OFF && scales.spread() < ALIKE * off;
    let far = off > ALL_FAR_OFF && scales.spread() < off;
    if !(alike || far) || !scales.tell(off) {
        return;
    }
    let (_, undone) = cause(common);
    let reads = format!(
        "the accelerometer reads gravity as {:.3} m/s², {:.1} % {} than {:.3}, on all axes alike",
        common * fit.gravity,
        100.0 * off,
        if common > 1.0 { "more" } else { "less" },
        fit.gravity
    );
    let read = columns.scaled(&[0, 1, 2].map(|axis| (axis, undone)));
    match off > BEYOND {
        true => said.gate(format!(
            "{reads}: it has another unit or range, or --gravity is another; read it with {read}"
        )),
        false => said.warn(format!(
            "{reads}: T carries it back; if the factor to m/s² was wrong, read it with {read}"
        )),
    }
}

/// The size of counts.
fn counts(fit: &ForceFit<'_>) -> Option<String> {
    let unit = &fit.unit;
    (!unit.is_si()).then(|| {
        let scale = unit.scale;
        if (9.0..10.5).contains(&scale) {
            "the accelerometer's readings look like units of g: T carries them to m/s²; read them with --accel-unit g".into()
        } else {
            format!(
                "the accelerometer's readings are raw counts: one is about {scale:.4e} m/s², zero lies \
                 near {:.0}, {:.0}, {:.0}",
                unit.zero.x, unit.zero.y, unit.zero.z
            )
        }
    })
}
