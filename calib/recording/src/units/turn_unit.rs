//! The unit of a gyroscope from the turns between rests, where gravity says how far they went.

use nalgebra::{Rotation3, Unit, Vector3};

use super::rests::{rests, sphere};
use crate::averages::median;
use crate::recording::Stream;
use crate::units::GyroUnit;

/// Units that are told apart.
const UNITS: [GyroUnit; 3] = [
    GyroUnit::RadiansPerSecond,
    GyroUnit::DegreesPerSecond,
    GyroUnit::MilliDegreesPerSecond,
];

findings::tuning! {
    /// Turns that tilt less say little, rad.
    TILT: f64 = 0.4;
    /// Longer turns gather too much error, s.
    LONGEST: f64 = 60.0;
    /// Samples looked at: an hour's, at 100 Hz.
    LOOKED_AT: usize = 360_000;
    /// Turns that tell a unit.
    FEWEST: usize = 3;
    /// Turns looked at.
    TURNS: usize = 60;
    /// The right unit predicts gravity to this, rad, and the others miss it by three times as much.
    WITHIN: f64 = 0.2;
}

/// Factors between a stated unit, or the time's, and the right one that are looked for.
const FACTORS: std::ops::RangeInclusive<i32> = -24..=24;

findings::tuning! {
    /// A stated unit is wrong where it misses gravity by as much, rad.
    MISSED: f64 = 0.6;
}

/// No sensor's own scale is off by as much.
const OWN: std::ops::Range<f64> = 0.6..1.7;

/// The unit in which the turns of `gyro` are those that `accel` saw; `None` where they do not tell. The scale of
/// `accel` plays no part.
pub(crate) fn turn_unit(accel: &Stream, gyro: &Stream) -> Option<GyroUnit> {
    let scales = UNITS.map(GyroUnit::scale);
    let usual = misses(accel, gyro, &scales)?.into_iter().zip(UNITS);
    let mut medians: Vec<(f64, GyroUnit)> = usual.collect();
    medians.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (best, unit) = medians[0];
    (best < WITHIN.get() && medians[1].0 > 3.0 * best.max(0.05)).then_some(unit)
}

/// A change of the unit from turn to turn.
pub(crate) struct UnitChange {
    /// The unit of the turns before, and of those after.
    pub units: [GyroUnit; 2],
    /// The end of the last turn in the first and the begin of the first in the second, s.
    pub between: [f64; 2],
}

/// Returns the change of the unit within a recording, where the first turns are in one and all others in another.
pub(crate) fn unit_change(accel: &Stream, gyro: &Stream) -> Option<UnitChange> {
    // Noise and turns in the larger unit would hide the rests in it: the accelerometer shows them.
    let turns = turns(accel, gyro, &UNITS.map(GyroUnit::scale), Rests::OfForce)?;
    let told = |turn: &Turn| {
        let mut errors: Vec<(f64, GyroUnit)> = turn.errors.iter().copied().zip(UNITS).collect();
        errors.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_told = errors[0].0 < WITHIN.get() && errors[1].0 > 3.0 * errors[0].0.max(0.05);
        is_told.then_some((errors[0].1, [turn.from, turn.to]))
    };
    let told: Vec<(GyroUnit, [f64; 2])> = turns.iter().filter_map(told).collect();
    let (first, last) = (told.first()?.0, told.last()?.0);
    let at = told.iter().position(|(unit, _)| *unit != first)?;
    let enough = at >= FEWEST.get() && told.len() - at >= FEWEST.get();
    let is_one = told[at..].iter().all(|(unit, _)| *unit == last);
    (enough && is_one).then(|| UnitChange {
        units: [first, last],
        between: [told[at - 1].1[1], told[at].1[0]],
    })
}

/// Estimates the factor by which the turns that `accel` saw exceed those of `gyro` in `unit`, if it shows that the unit is wrong, or
/// the time's; `None` if the unit may be right.
pub(crate) fn wrong_by(accel: &Stream, gyro: &Stream, unit: GyroUnit) -> Option<f64> {
    let missed = *misses(accel, gyro, &[unit.scale()])?.first()?;
    if missed < MISSED.get() {
        return None;
    }
    // A quarter of a factor of two apart.
    let factors: Vec<f64> = FACTORS.map(|k| f64::from(k) / 4.0).map(f64::exp2).collect();
    let scales: Vec<f64> = factors.iter().map(|factor| factor * unit.scale()).collect();
    let all = misses(accel, gyro, &scales)?.into_iter().zip(factors);
    let (least, factor) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (least < 2.0 * WITHIN.get() && !OWN.contains(&factor)).then_some(factor)
}

/// By how much the turns of `gyro` usually miss the gravity that `accel` saw, rad, at each scale; `None` of too few.
fn misses(accel: &Stream, gyro: &Stream, scales: &[f64]) -> Option<Vec<f64>> {
    let turns = turns(accel, gyro, scales, Rests::OfBoth)?;
    let at = |scale: usize| {
        median(
            turns
                .iter()
                .map(|turn| turn.errors[scale])
                .collect::<Vec<f64>>(),
        )
    };
    (0..scales.len()).map(at).collect()
}

/// A turn between rests.
struct Turn {
    /// Its begin and end, s.
    from: f64,
    to: f64,
    /// By how much the gyroscope misses gravity, rad, at each scale.
    errors: Vec<f64>,
}

/// The sensors that rest between turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rests {
    OfBoth,
    OfForce,
}

/// The turns that tilt gravity, as `accel` saw it; `None` of too few.
fn turns(accel: &Stream, gyro: &Stream, scales: &[f64], of: Rests) -> Option<Vec<Turn>> {
    let count = gyro.len().min(LOOKED_AT.get());
    let matched: Option<Vec<Vector3<f64>>> = gyro.t[..count].iter().map(|&t| accel.at(t)).collect();
    let matched = matched?;
    let rates = &gyro.values[..count];
    let mut rests = match of {
        Rests::OfBoth => rests(&matched, rates),
        Rests::OfForce => rests(&matched, &matched),
    };
    for rest in &mut rests {
        let own = &rates[rest.from..rest.to];
        rest.means[1] = own.iter().sum::<Vector3<f64>>() / own.len().max(1) as f64;
    }
    let means: Vec<Vector3<f64>> = rests.iter().map(|rest| rest.means[0]).collect();
    let centre = sphere(&means).map_or(Vector3::zeros(), |(centre, _)| centre);
    let mut turns = Vec::new();
    for pair in rests.windows(2) {
        let [up, then] = [0, 1].map(|k| (pair[k].means[0] - centre).normalize());
        let (from, to) = (pair[0].to, pair[1].from);
        let time = gyro.t[to] - gyro.t[from - 1];
        if up.angle(&then) < TILT.get() || time > LONGEST.get() || turns.len() == TURNS.get() {
            continue;
        }
        let error = |scale: &f64| {
            let turned = turn(gyro, from - 1..to + 1, &pair[0].means[1], *scale) * up;
            turned.angle(&then)
        };
        turns.push(Turn {
            from: gyro.t[from - 1],
            to: gyro.t[to],
            errors: scales.iter().map(error).collect(),
        });
    }
    (turns.len() >= FEWEST.get()).then_some(turns)
}

/// Computes the rotation of a fixed direction in the frame of a device that turns at `scale (gyro - bias)`.
fn turn(
    gyro: &Stream,
    range: std::ops::Range<usize>,
    bias: &Vector3<f64>,
    scale: f64,
) -> Rotation3<f64> {
    let mut turn = Rotation3::identity();
    for at in range.start..range.end.min(gyro.len()).saturating_sub(1) {
        let step = gyro.t[at + 1] - gyro.t[at];
        let rate = ((gyro.values[at] + gyro.values[at + 1]) / 2.0 - bias) * scale;
        if let Some(axis) = Unit::try_new(rate, 0.0) {
            turn = Rotation3::from_axis_angle(&axis, -rate.norm() * step) * turn;
        }
    }
    turn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_is_that_in_which_turns_are_those_of_gravity() {
        for unit in UNITS {
            let (mut accel, mut gyro) = (Stream::default(), Stream::default());
            let mut attitude = Rotation3::identity();
            for place in 0..12 {
                let axis = Unit::new_normalize(Vector3::new(1.0, f64::from(place % 3) - 1.0, 0.3));
                for k in 0..400 {
                    // Slow turns: their numbers in deg/s are possible in rad/s.
                    let speed = if k < 200 { 0.0 } else { 0.6 };
                    let t = f64::from(place * 400 + k) * 0.01;
                    let noise =
                        Vector3::from_fn(|i, _| 1e-3 * (f64::from(k * 5) + 2.0 * i as f64).sin());
                    attitude = Rotation3::from_axis_angle(&axis, -speed * 0.01) * attitude;
                    accel.t.push(t);
                    gyro.t.push(t);
                    accel.values.push(
                        attitude * Vector3::z() * 1024.0 + noise * 100.0 + Vector3::x() * 300.0,
                    );
                    gyro.values.push(
                        (axis.into_inner() * speed + noise + Vector3::y() * 0.02) / unit.scale(),
                    );
                }
            }
            assert_eq!(turn_unit(&accel, &gyro), Some(unit));
            assert!(unit_change(&accel, &gyro).is_none());
            let other = UNITS[(UNITS.iter().position(|u| *u == unit).unwrap() + 1) % 3];
            let mut changed = gyro.clone();
            for value in &mut changed.values[2400..] {
                *value *= unit.scale() / other.scale();
            }
            let change = unit_change(&accel, &changed).unwrap();
            assert_eq!(change.units, [unit, other]);
            assert!(change.between[0] <= 24.5 && change.between[1] >= 23.5);
            assert_eq!(wrong_by(&accel, &gyro, unit), None);
            // Ticks of 0.22 µs read as microseconds.
            gyro.t.iter_mut().for_each(|t| *t *= 4.5);
            accel.t.clone_from(&gyro.t);
            // Turns that are all alike are as well so many more whole ones: the factor is not looked at.
            assert!(wrong_by(&accel, &gyro, unit).is_some());
        }
    }
}
