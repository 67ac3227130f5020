//! A gyroscope against the turns that the accelerometer saw: its unit, the scale of its axes, and how they lie.

use sensor::Sensor;

use super::Said;
use super::apart::RateFit;
use super::axes::SignedAxes;
use super::columns::Columns;
use super::scales::{Scales, cause, rounded};
use crate::calibrate::checks::determined::LOST;

/// An element of the gyroscope's matrix this far from that of aligned axes is no misalignment.
const TURNED: f64 = 0.26;

/// A scale this far from one on all axes of readings in SI units is a unit or a time base.
const COMMON_SCALE: f64 = 0.03;
/// The same to a factor of two, the commonest of wrong rates, and the sensor's own errors on top.
const COMMON_SCALES: std::ops::RangeInclusive<f64> = 0.45..=2.2;

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
    if fit.missed > LOST {
        said.gate(format!(
            "the gyroscope misses gravity by {:.1}° rms after the fit: is a sensor mounted or logged \
             with other axes, or the time stamps not those of the samples?",
            fit.missed.to_degrees()
        ));
    }
    of_axes(fit, columns, force, &mut said);
    if fit.missed <= LOST
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
            said.gate(
                "the gyroscope's matrix is that of no sensor (det T < 0, and no axis is flipped): the turns do not show its axes; \
                 turn the device about each of them between static intervals"
                    .to_owned(),
            );
            return;
        };
        let read = format!("; read it with {}", columns.turned(&axes));
        // With every sign changed it may as well be that both sensors are mirrored.
        let both = match axes.is_in_order() && axes.flipped().count() == 3 {
            true => format!(
                "; or both sensors are in left-handed axes, as --flip {},{} undoes",
                force.roles[0], columns.roles[0]
            ),
            false => String::new(),
        };
        said.gate(format!(
            "the gyroscope's axes are left-handed against the accelerometer's: {}{read}{both}",
            axes.in_words()
        ));
        return;
    }
    let Some(axes) = nearest.filter(|axes| !axes.is_unchanged() && fit.missed <= LOST) else {
        let off = near_si - nalgebra::Matrix3::from_diagonal(&near_si.diagonal());
        if fit.missed <= LOST && off.amax() > TURNED {
            said.warn(
                "the gyroscope's axes are turned against the accelerometer's by no right angle; the matrix T of the calibration turns them back"
                    .to_owned(),
            );
        }
        return;
    };
    let turned = format!(
        "the gyroscope's axes are turned against the accelerometer's: {}; the matrix T of the calibration turns them back",
        axes.in_words()
    );
    said.warn(match axes.is_half_turn() {
        false => turned,
        true => format!(
            "{turned}, as {} does. A mirrored accelerometer looks the same: if it is mounted as the gyroscope is, the corrected frame is \
             left-handed; then read it with {}",
            columns.turned(&axes),
            force.turned(&axes.opposite().inverse())
        ),
    });
}

/// Scales that are off on all axes, or on one.
fn of_scales(fit: &RateFit<'_>, columns: &Columns, scales: &Scales, said: &mut Said) {
    let si = columns.is_si(fit.force_is_si);
    if let Some((axis, factor)) = scales.odd() {
        let (times, undone) = cause(factor);
        let words = format!(
            "the gyroscope's {} reads {times} what the other two read of the same rate: it has another unit or range; read it with {}",
            columns.roles[axis],
            columns.scaled(&[(axis, undone)])
        );
        match si {
            true => said.gate(words),
            false => said.warn(words),
        }
        return;
    }
    let all = scales.all_off(COMMON_SCALE);
    let all = all.filter(|ratio| scales.tell(ratio.ln().abs()));
    if let Some(ratio) = all.filter(|ratio| si && COMMON_SCALES.contains(ratio)) {
        said.gate(format!(
            "the gyroscope's scale is {ratio:.3} on all axes: a wrong time base (nominal rate) or \
             unit rather than a sensor error; if its unit is wrong, read it with {}",
            columns.scaled(&[0, 1, 2].map(|axis| (axis, rounded(ratio))))
        ));
    }
}

/// The unit of readings that are not in rad/s.
fn unit(fit: &RateFit<'_>) -> Option<String> {
    let scale = fit.scale;
    if scale == 1.0 || (fit.force_is_si && (0.3..3.0).contains(&scale)) {
        return None;
    }
    Some(if (scale.to_degrees() - 1.0).abs() < 0.15 {
        "the gyroscope's readings look like degrees per second: T carries them to rad/s; read them with --gyro-unit deg/s".into()
    } else if (scale.to_radians() - 1.0).abs() < 0.15 {
        "the gyroscope's readings look like rad/s that were read as degrees per second: T carries them back; read them with --gyro-unit rad/s".into()
    } else {
        format!("the gyroscope's readings are raw counts: one is about {scale:.4e} rad/s")
    })
}
