//! A sign or two columns that change part of the way: by which of them the turns meet gravity before and after.

use nalgebra::Matrix3;
use recording::averages::median;
use sensor::Sensor;

use super::change::{Change, Kind, Place};
use super::turn_sums::Turning;

/// Fewest turns on either side.
const SIDE: usize = 4;
/// A raw gyroscope meets gravity within this, rad ...
const MEETS: f64 = 0.15;
/// ... and one of other axes misses it by more than this.
const MISSES: f64 = 0.35;

/// A reflection of one sensor's axes.
#[derive(Clone, Copy, Debug)]
struct Reflection {
    kind: Kind,
    matrix: Matrix3<f64>,
}

fn reflections(sensor: Sensor) -> Vec<Reflection> {
    let flipped = (0..3).map(|axis| {
        let mut matrix = Matrix3::identity();
        matrix[(axis, axis)] = -1.0;
        let kind = Kind::Flipped(sensor, axis);
        Reflection { kind, matrix }
    });
    let swapped = [[0, 1], [1, 2], [0, 2]].map(|axes| {
        let mut matrix = Matrix3::identity();
        matrix.swap_rows(axes[0], axes[1]);
        let kind = Kind::Swapped(sensor, axes);
        Reflection { kind, matrix }
    });
    flipped.chain(swapped).collect()
}

/// The reflection from some turn on, or up to it, with which all turns meet gravity.
pub(super) fn change(turns: &[Turning<'_>], start: &Matrix3<f64>) -> Option<Change> {
    if turns.len() < 2 * SIDE {
        return None;
    }
    let miss = |rotation: &Matrix3<f64>, turn: &Turning<'_>, m: &Matrix3<f64>| {
        (rotation * (m * turn.after)).angle(&(m * turn.before))
    };
    let as_read: Vec<Matrix3<f64>> = turns.iter().map(|t| t.rates.rotation(start)).collect();
    let one = Matrix3::identity();
    let plain: Vec<f64> = as_read
        .iter()
        .zip(turns)
        .map(|(c, turn)| miss(c, turn, &one))
        .collect();
    let mut best: Option<(f64, usize, Kind)> = None;
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        for reflection in reflections(sensor) {
            let m = &reflection.matrix;
            let other: Vec<f64> = match sensor {
                Sensor::Accelerometer => {
                    let each = as_read.iter().zip(turns);
                    each.map(|(c, turn)| miss(c, turn, m)).collect()
                }
                Sensor::Gyroscope | Sensor::Magnetometer => {
                    let each = turns.iter();
                    each.map(|turn| miss(&turn.rates.rotation(&(start * m)), turn, &one))
                        .collect()
                }
            };
            let usual = |side: &[f64]| median(side.iter().copied()).unwrap_or(0.0);
            for at in SIDE..=turns.len() - SIDE {
                for (first, last) in [(&plain, &other), (&other, &plain)] {
                    let met = most(&first[..at]).max(most(&last[at..]));
                    let sum: f64 = first[..at].iter().chain(&last[at..]).sum();
                    let changes = usual(&plain[..at]).max(usual(&plain[at..]));
                    let counts = met < MEETS && changes > MISSES;
                    if counts && best.is_none_or(|(least, ..)| sum < least) {
                        best = Some((sum, at, reflection.kind));
                    }
                }
            }
        }
    }
    let (_, at, kind) = best?;
    // The turn at the change is a mixture: the change lies in it or beside it.
    let place = Place {
        after: turns[at - 1].place.after,
        before: turns[at].place.before,
    };
    Some(Change { kind, place })
}

/// Returns the second largest of the misses; the largest may be that of the turn with the change in it.
fn most(misses: &[f64]) -> f64 {
    let mut sorted = misses.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
        .get(sorted.len().saturating_sub(2))
        .copied()
        .unwrap_or(0.0)
}

/// The factor to rad/s, of those that occur, with which most turns come nearest to gravity.
pub(super) fn unit(turns: &[Turning<'_>], fitted: f64) -> f64 {
    let degree = 1f64.to_radians();
    let missed = |unit: f64| {
        let t = Matrix3::from_diagonal_element(unit);
        median(turns.iter().map(|turn| turn.missed(&t))).unwrap_or(0.0)
    };
    let known = [fitted, 1.0, degree]
        .into_iter()
        .filter(|u| u.is_finite() && *u > 0.0);
    known
        .min_by(|a, b| missed(*a).total_cmp(&missed(*b)))
        .unwrap_or(1.0)
}
