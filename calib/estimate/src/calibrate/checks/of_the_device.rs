//! Readings that are not a device's own: forces in axes of the room, angles in place of rates.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::intervals::{Segmentation, Turn};
use recording::{Error, Recording};
use sensor::Sensor;

use crate::residuals::{Integrator, attitude_of};

findings::tuning! {
    /// Turns that have to say the same.
    TURNS: usize = 4;
    /// Gravity's direction should change by so much in each of them, rad (30°) ...
    TURNED: f64 = 0.52;
    /// ... and in none it does by more than this share.
    FOLLOWED: f64 = 0.15;

    /// Rests that have to say the same.
    RESTS: usize = 6;
    /// No gyroscope's bias is another by so much from rest to rest, rad/s.
    ANGLE: f64 = 0.5;
    /// The sine of an angle goes with a component of gravity to within this share of its variance.
    APART: f64 = 0.02;
}

/// Refuses forces in axes of the room (gravity points the same way however the device is turned), and angles in the columns of the
/// rates (they are others in each placement, as gravity is).
///
/// # Errors
/// The first such recording, with what to export.
pub fn readings_of_the_device<'a>(
    cut: impl IntoIterator<Item = (&'a Recording, &'a Segmentation)>,
) -> Result<(), Error> {
    for (recording, segmentation) in cut {
        // Of counts nobody knows yet how far they turn.
        if recording.is_in_counts(Sensor::Gyroscope) {
            continue;
        }
        let found =
            angles_for_rates(segmentation).or_else(|| axes_of_the_room(recording, segmentation));
        if let Some(found) = found {
            return Err(Error::input(found.in_recording(&recording.name)));
        }
    }
    Ok(())
}

/// Gravity at rest points one way, and the gyroscope says that the device was turned over.
fn axes_of_the_room(recording: &Recording, segmentation: &Segmentation) -> Option<Finding> {
    let stream = recording.gyroscope.as_ref()?;
    let turned = |turn: &Turn| -> Option<[f64; 2]> {
        let before = segmentation.statics.get(turn.from)?;
        let after = segmentation.statics.get(turn.from + 1)?;
        let (up, bias) = (before.accelerometer?.mean, before.gyroscope?.mean);
        let (t, rates) = (
            &stream.t[turn.samples.clone()],
            &stream.values[turn.samples.clone()],
        );
        let attitude = attitude_of(Integrator::Exponential, t, |k| rates[k] - bias);
        Some([
            up.angle(&attitude.into_body(&up)),
            up.angle(&after.accelerometer?.mean),
        ])
    };
    let all: Vec<[f64; 2]> = segmentation
        .turns
        .iter()
        .filter(|turn| turn.fault.is_none())
        .filter_map(turned)
        .collect();
    let over: Vec<_> = all
        .iter()
        .filter(|[told, _]| *told > TURNED.get())
        .collect();
    let stays = over
        .iter()
        .all(|[told, read]| *read < FOLLOWED.get() * told);
    (over.len() >= TURNS.get() && stays).then(|| {
        let most = over.iter().map(|turn| turn[0]).fold(0.0, f64::max);
        Finding::of(Kind::AXES_OF_THE_ROOM)
            .count("turns", over.len())
            .number("angle", most, "rad")
    })
}

/// A column of the gyroscope at rest is the angle of an axis of the device to the vertical.
fn angles_for_rates(segmentation: &Segmentation) -> Option<Finding> {
    let rests = segmentation.statics.iter();
    let rests =
        rests.filter_map(|rest| Some((rest.accelerometer?.mean.normalize(), rest.gyroscope?.mean)));
    let rests: Vec<(Vector3<f64>, Vector3<f64>)> = rests.collect();
    let sines = |axis: usize| rests.iter().map(move |(_, rate)| rate[axis].sin());
    let ups = |axis: usize| rests.iter().map(move |(up, _)| up[axis]);
    let range = |axis: usize| {
        let rates = rests.iter().map(|(_, rate)| rate[axis]);
        rates.clone().fold(f64::MIN, f64::max) - rates.fold(f64::MAX, f64::min)
    };
    let is_angle = |axis: usize| {
        range(axis) > ANGLE.get()
            && (0..3).any(|of| correlation(sines(axis), ups(of)).abs() > 1.0 - APART.get())
    };
    (rests.len() >= RESTS.get() && (0..3).any(is_angle)).then(|| {
        let widest = (0..3).map(range).fold(0.0, f64::max);
        Finding::of(Kind::ANGLES_FOR_RATES).number("range", widest, "rad/s")
    })
}

/// The correlation of two series; 0 where one does not change.
fn correlation(
    one: impl Iterator<Item = f64> + Clone,
    other: impl Iterator<Item = f64> + Clone,
) -> f64 {
    let mean = |values: &mut dyn Iterator<Item = f64>| {
        let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
        sum / f64::max(count, 1.0)
    };
    let (a, b) = (mean(&mut one.clone()), mean(&mut other.clone()));
    let sums = one.zip(other).map(|(x, y)| (x - a, y - b));
    let sums = sums.fold([0.0; 3], |[xx, yy, xy], (x, y)| {
        [xx + x * x, yy + y * y, xy + x * y]
    });
    match sums[0] * sums[1] > 0.0 {
        true => sums[2] / (sums[0] * sums[1]).sqrt(),
        false => 0.0,
    }
}
