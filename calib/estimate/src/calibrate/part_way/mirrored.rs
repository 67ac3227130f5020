//! A sign, two columns or the unit of the rates that change part of the way: by which of them the turns meet gravity before and after.

use nalgebra::Matrix3;
use recording::averages::{median, quantile};
use sensor::Sensor;

use super::change::{Change, Kind, Place};
use super::turn_sums::Turning;

findings::tuning! {
    /// Fewest turns on either side.
    SIDE: usize = 4;
    /// A raw gyroscope meets gravity within this, rad ...
    MEETS: f64 = 0.15;
    /// ... and one of other axes misses it by more than this.
    MISSES: f64 = 0.35;

    /// A change leaves this share of the turns on either side, or nearly.
    PART: f64 = 0.25;
}

/// Ratios of the ranges and units that occur.
const RATIOS: [f64; 4] = [2.0, 4.0, 8.0, 180.0 / std::f64::consts::PI];

/// Another reading of one sensor's axes: reflected, or in another unit.
#[derive(Clone, Copy, Debug)]
struct Reflection {
    kind: Kind,
    matrix: Matrix3<f64>,
}

impl Reflection {
    /// The kind where what was read so is read as it is from some place on, instead of the reverse.
    fn backwards(self) -> Kind {
        match self.kind {
            Kind::Scale(sensor, axis, share) => {
                Kind::Scale(sensor, axis, (1.0 + share).recip() - 1.0)
            }
            other => other,
        }
    }
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
    // The length of a force says nothing of its direction.
    let is_rate = sensor == Sensor::Gyroscope;
    let factors = RATIOS.into_iter().flat_map(|ratio| [ratio, ratio.recip()]);
    let scaled = factors.filter(|_| is_rate).map(|factor| Reflection {
        kind: Kind::Scale(sensor, None, factor - 1.0),
        matrix: Matrix3::from_diagonal_element(factor.recip()),
    });
    flipped.chain(swapped).chain(scaled).collect()
}

/// The reflection or the unit from some turn on, or up to it, with which all turns meet gravity.
pub(super) fn change(turns: &[Turning<'_>], start: &Matrix3<f64>) -> Option<Change> {
    if turns.len() < 2 * SIDE.get() {
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
            for at in SIDE.get()..=turns.len() - SIDE.get() {
                let ways = [
                    (&plain, &other, reflection.kind),
                    (&other, &plain, reflection.backwards()),
                ];
                for (first, last, kind) in ways {
                    let met = most(&first[..at]).max(most(&last[at..]));
                    let sum: f64 = first[..at].iter().chain(&last[at..]).sum();
                    let changes = usual(&plain[..at]).max(usual(&plain[at..]));
                    let counts = met < MEETS.get() && changes > MISSES.get();
                    if counts && best.is_none_or(|(least, ..)| sum < least) {
                        best = Some((sum, at, kind));
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

/// The factor to rad/s, of those that occur, with which a part of the turns comes nearest to gravity.
pub(super) fn unit(turns: &[Turning<'_>], fitted: f64) -> f64 {
    let degree = 1f64.to_radians();
    let missed = |unit: f64| {
        let t = Matrix3::from_diagonal_element(unit);
        let misses: Vec<f64> = turns.iter().map(|turn| turn.missed(&t)).collect();
        quantile(&misses, PART.get()).unwrap_or(0.0)
    };
    let known = [fitted, 1.0, degree]
        .into_iter()
        .filter(|u| u.is_finite() && *u > 0.0);
    known
        .min_by(|a, b| missed(*a).total_cmp(&missed(*b)))
        .unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use findings::Kind as Found;
    use nalgebra::Matrix3;
    use recording::intervals::{Detector, segment};
    use simulate::{Motion, Spec};

    #[test]
    fn a_range_that_is_switched_part_of_the_way_is_one_and_no_step_of_the_bias() {
        let mut spec = Spec::hand_held(3);
        if let Motion::HandHeld(motion) = &mut spec.motion {
            motion.placements = Some(20);
        }
        for scale in ["gyro.s_x", "gyro.s_y", "gyro.s_z"] {
            spec.parameters.insert(scale.into(), 1.0);
        }
        let mut recording = spec.run().unwrap().recording;
        let rates = recording.gyroscope.as_mut().unwrap();
        let half = rates.values.len() / 2;
        rates.values.iter_mut().skip(half).for_each(|w| *w *= 2.0);
        let cut = segment(&recording, &Detector::default()).unwrap();
        let fitted = Some((Matrix3::identity(), 1.0));
        let found = super::super::changes_part_way(&recording, &cut, spec.gravity, fitted);
        let kinds: Vec<Found> = found.iter().map(|found| found.kind).collect();
        assert_eq!(kinds, [Found::SCALE_CHANGE], "{found:?}");
        let size = found[0].numbers.iter().find(|n| n.name == "size").unwrap();
        assert_eq!(size.value, Some(1.0));
    }
}
