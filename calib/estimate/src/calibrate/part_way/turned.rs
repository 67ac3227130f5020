//! A rotation of the gyroscope's axes from some turn on, against a few turns that miss.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::turn::Carried;
use super::turn_sums::{BASE, FLOOR, Sums, Turning, What, left};
use super::weigh::Explanation;

findings::tuning! {
    /// Fewest turns on either side.
    SIDE: usize = 5;
    /// Passes of the fit.
    PASSES: usize = 6;
    /// So many turns may be left out instead.
    OUTLYING: usize = 3;
    /// The rotation explains the turns so much better than leaving some out does, by the criterion ...
    MUCH: f64 = 20.0;
    /// ... and about no axis it is less certain than this share of its angle, one standard deviation.
    KNOWN: f64 = 0.2;
}

/// A fit of a matrix and of a rotation of the readings from some turn on.
#[derive(Clone, Debug)]
pub(super) struct Rotation {
    rotation: Rotation3<f64>,
    /// Sum of the squared misses.
    left: f64,
    /// Standard error of the rotation about the axis that is known least, rad.
    std: f64,
    mixed: bool,
}

impl Rotation {
    /// The fit with a rotation from turn `at` on, which itself is left out where it is mixed; `None` of too few turns.
    pub fn of(turns: &[Turning<'_>], start: &Matrix3<f64>, at: usize, mixed: bool) -> Option<Self> {
        let behind = turns.len().checked_sub(at + usize::from(mixed))?;
        if at.min(behind) < SIDE.get() {
            return None;
        }
        let mut t = *start;
        let mut rotation = Rotation3::identity();
        for _ in 0..PASSES.get() {
            let sums = sums(turns, &t, &rotation, at, mixed);
            let step = sums.solution()?;
            t += Matrix3::from_fn(|i, j| step[3 * i + j]);
            rotation *= Rotation3::new(Vector3::new(step[BASE], step[BASE + 1], step[BASE + 2]));
        }
        let sums = sums(turns, &t, &rotation, at, mixed);
        let left = sums.squares;
        let used = turns.len() - usize::from(mixed);
        let spare = (2 * used).checked_sub(BASE + 3).filter(|s| *s > 0)?;
        let inverse = sums.normal.cholesky()?.inverse();
        let variance = inverse.view((BASE, BASE), (3, 3)).into_owned();
        let largest = variance.symmetric_eigenvalues().max();
        Some(Self {
            rotation,
            left,
            std: (largest * left / spare as f64).sqrt(),
            mixed,
        })
    }

    /// The angle, rad.
    pub fn angle(&self) -> f64 {
        self.rotation.angle()
    }

    /// Returns true if turns about several axes determine the rotation, and it explains them much better than leaving a few of them
    /// out; they are `carried` without a rotation.
    pub fn is_certain(&self, carried: &[Carried]) -> bool {
        let rows = 2 * carried.len();
        let floor = FLOOR.get() * carried.len() as f64;
        let own = Explanation {
            left: self.left,
            parameters: 3 + 2 * usize::from(self.mixed),
        };
        let limit = own.criterion(rows, floor) + MUCH.get();
        let rivals = without_outlying(carried);
        let is_best = rivals.iter().all(|e| e.criterion(rows, floor) > limit);
        is_best && self.std < KNOWN.get() * self.angle()
    }
}

/// The sums with a rotation of the readings from turn `at` on, the matrix being `t`.
fn sums(
    turns: &[Turning<'_>],
    t: &Matrix3<f64>,
    rotation: &Rotation3<f64>,
    at: usize,
    mixed: bool,
) -> Sums {
    let generators = What::Turned.generators();
    let mut sums = Sums::new(BASE + generators.len());
    for (k, turn) in turns.iter().enumerate() {
        if mixed && k == at {
            continue;
        }
        if k < at {
            let own = turn.rates.carry(t, &turn.before, &turn.after);
            sums.add(&own, &[Vector3::zeros(); 3], 1.0);
            continue;
        }
        let moved = t * rotation.matrix();
        let own = turn.rates.carry(&moved, &turn.before, &turn.after);
        let extra: Vec<Vector3<f64>> = generators.iter().map(|m| own.along(&(moved * m))).collect();
        // d(T R)/dT_ij: row j of R in row i.
        let of_t = |e: usize| {
            let mut by = Matrix3::zeros();
            by.set_row(e / 3, &rotation.matrix().row(e % 3));
            own.along(&by)
        };
        let through = Carried {
            miss: own.miss,
            slopes: std::array::from_fn(of_t),
        };
        sums.add(&through, &extra, 1.0);
    }
    sums
}

/// The matrix alone, with ever more of the turns left out that miss most.
fn without_outlying(carried: &[Carried]) -> Vec<Explanation> {
    let mut kept: Vec<&Carried> = carried.iter().collect();
    let mut all = Vec::new();
    for out in 0..=OUTLYING.get() {
        let mut sums = Sums::new(BASE);
        kept.iter().for_each(|one| sums.add(one, &[], 1.0));
        let Some(solution) = sums.solution() else {
            break;
        };
        all.push(Explanation {
            left: sums.left(&solution),
            parameters: 2 * out,
        });
        let missed = |one: &Carried| left(one, &solution).norm();
        let worst = kept.iter().enumerate();
        let worst = worst.max_by(|a, b| missed(a.1).total_cmp(&missed(b.1)));
        let Some((worst, _)) = worst else { break };
        kept.remove(worst);
    }
    all
}

#[cfg(test)]
mod tests {
    use recording::Stream;

    use super::super::change::Place;
    use super::super::turn::Rates;
    use super::super::turn_sums::all_carried;
    use super::*;

    const COUNT: usize = 20;

    /// Rates of turns about different axes, one second each.
    fn stream(of: impl Fn(usize) -> Vector3<f64>) -> Stream {
        let rate = |k: usize| {
            let turn = k / 100;
            let phase = std::f64::consts::PI * (k % 100) as f64 / 100.0;
            let axis = Vector3::new(
                (1.3 * turn as f64).sin(),
                (2.1 * turn as f64 + 1.0).cos(),
                (0.7 * turn as f64 + 2.0).sin(),
            );
            of(turn) + axis * (3.0 * phase.sin().powi(2))
        };
        Stream {
            t: (0..100 * COUNT).map(|k| 0.01 * k as f64).collect(),
            values: (0..100 * COUNT).map(rate).collect(),
        }
    }

    /// The turns of a stream whose true rates are another's.
    fn turnings<'a>(stream: &'a Stream, truth: &'a Stream) -> Vec<Turning<'a>> {
        let rates = |stream: &'a Stream, k: usize| Rates {
            stream,
            samples: 100 * k..100 * (k + 1),
            bias: Vector3::zeros(),
        };
        let of = |k: usize| {
            let before = Vector3::new(0.3, -0.5, 0.8 + 0.1 * k as f64).normalize();
            let turn = rates(truth, k).rotation(&Matrix3::identity());
            let tilt = 1e-4 * Vector3::new((9.0 * k as f64).sin(), (5.0 * k as f64).cos(), 0.3);
            Turning {
                rates: rates(stream, k),
                before,
                after: (turn.transpose() * before + tilt).normalize(),
                place: Place {
                    after: (k, k as f64),
                    before: (k + 1, k as f64 + 1.0),
                },
            }
        };
        (0..COUNT).map(of).collect()
    }

    fn certain(stream: &Stream, truth: &Stream, at: usize) -> Option<f64> {
        let turns = turnings(stream, truth);
        let t = Matrix3::identity();
        let rotation = Rotation::of(&turns, &t, at, false)?;
        let carried = all_carried(&turns, &t);
        rotation
            .is_certain(&carried)
            .then(|| rotation.angle().to_degrees())
    }

    #[test]
    fn axes_that_turned_by_twenty_degrees_from_turn_eight_on_are_found() {
        let truth = stream(|_| Vector3::zeros());
        let turned = Rotation3::new(Vector3::new(0.2, -0.2, 0.2));
        let mut read = truth.clone();
        let later = read.values[800..].iter_mut();
        later.for_each(|v| *v = turned.inverse() * *v);
        let found = certain(&read, &truth, 8).unwrap();
        assert!((found - turned.angle().to_degrees()).abs() < 0.1, "{found}");
        assert_eq!(certain(&read, &truth, 4), None);
    }

    #[test]
    fn three_turns_that_miss_are_no_rotation() {
        let truth = stream(|_| Vector3::zeros());
        let spoilt = |turn: usize| match turn {
            9 | 11 | 12 => Vector3::new(0.3, 0.2, -0.2),
            _ => Vector3::zeros(),
        };
        let read = stream(spoilt);
        assert_eq!(certain(&read, &truth, 8), None);
        assert_eq!(certain(&truth, &truth, 8), None);
    }
}
