//! A gyroscope that is another one from some turn on, and single turns that miss gravity where the others meet it.

use nalgebra::{DVector, Matrix3, Vector3};
use recording::averages::median;
use sensor::Sensor;

use super::change::{Change, Kind, Place};
use super::turn::Carried;
use super::turn_sums::{BASE, FLOOR, Sums, Turning, What, all_carried, left};
use super::turned;
use super::weigh::Explanation;

findings::tuning! {
    /// Fewest turns.
    FEWEST: usize = 8;
    /// Fewest on either side of a change.
    SIDE: usize = 3;
    /// Passes of the linear fit about the last one.
    PASSES: usize = 4;
    /// Passes of its weights.
    WEIGHINGS: usize = 8;
    /// A turn is alone if it misses by so many times what most do ...
    ALONE: f64 = 15.0;
    /// ... and by so much, rad, ...
    LEAST: f64 = 5e-3;
    /// ... and if at most one in so many does.
    ONE_IN: usize = 5;
}

/// Finds changes of the gyroscope over the turns; `start` is a first value of the matrix from the readings to rad/s.
pub(super) fn changes(turns: &[Turning<'_>], start: &Matrix3<f64>) -> Vec<Change> {
    if turns.len() < FEWEST.get() {
        return Vec::new();
    }
    let Some((t, carried)) = robust_fit(turns, *start, PASSES.get()) else {
        return Vec::new();
    };
    let n = turns.len();
    let whole = sums_of(&carried, &t, n, false, &[]);
    let Some(base) = whole.solution().map(|solution| whole.left(&solution)) else {
        return Vec::new();
    };
    let floor = FLOOR.get() * n as f64;
    let changed = change(turns, &carried, &t, base);
    let alone = alone(turns, &carried, &t, base);
    let criterion = |e: &Explanation| e.criterion(2 * n, floor);
    match (changed, alone) {
        (Some((one, by)), Some((_, other))) if criterion(&by) < criterion(&other) => vec![one],
        (Some((one, _)), None) => vec![one],
        (_, Some((several, _))) => several,
        (None, None) => Vec::new(),
    }
}

/// Single turns that miss gravity where the others meet it, and single static intervals that they miss.
fn alone(
    turns: &[Turning<'_>],
    carried: &[Carried],
    t: &Matrix3<f64>,
    base: f64,
) -> Option<(Vec<Change>, Explanation)> {
    let n = turns.len();
    let angles: Vec<f64> = carried.iter().map(Carried::angle).collect();
    let limit = (ALONE.get() * median(angles.iter().copied())?).max(LEAST.get());
    let outliers: Vec<usize> = (0..n).filter(|&k| angles[k] > limit).collect();
    if outliers.is_empty() || outliers.len() > (n / ONE_IN.get()).max(1) {
        return None;
    }
    let mut sums = Sums::new(BASE);
    for one in carried.iter().filter(|one| one.angle() <= limit) {
        sums.add(one, &[], 1.0);
    }
    let explanation = Explanation {
        left: sums.left(&sums.solution()?),
        parameters: 2 * outliers.len(),
    };
    let holds = explanation.holds(base, 2 * n - BASE, n);
    holds.then(|| (named(turns, carried, t, limit), explanation))
}

/// The turns that miss gravity by more than `limit`; two in a row that meet it together miss the static interval between them.
fn named(turns: &[Turning<'_>], carried: &[Carried], t: &Matrix3<f64>, limit: f64) -> Vec<Change> {
    let misses = |k: &usize| carried.get(*k).is_some_and(|one| one.angle() > limit);
    let mut named = Vec::new();
    let mut k = 0;
    while k < turns.len() {
        if misses(&k) {
            let place = turns[k].place;
            let rest = Some(k + 1).filter(misses).filter(|&next| {
                let both = carried[k].miss + turns[k].rates.rotation(t) * carried[next].miss;
                turns[next].place.after.0 == place.before.0 && both.norm() < limit
            });
            named.push(match rest {
                Some(next) => Change {
                    kind: Kind::Rest(carried[k].angle()),
                    place: Place {
                        after: place.before,
                        before: turns[next].place.after,
                    },
                },
                None => Change {
                    kind: Kind::Turn(carried[k].angle()),
                    place,
                },
            });
            k += usize::from(rest.is_some());
        }
        k += 1;
    }
    named
}

/// The matrix with which most turns meet gravity, by some passes from a first one, and gravity carried with it.
pub(super) fn robust_fit(
    turns: &[Turning<'_>],
    start: Matrix3<f64>,
    passes: usize,
) -> Option<(Matrix3<f64>, Vec<Carried>)> {
    let mut t = start;
    let mut carried = all_carried(turns, &t);
    for _ in 0..passes {
        t += robust_step(&carried)?;
        carried = all_carried(turns, &t);
    }
    Some((t, carried))
}

/// The step of the matrix that most turns agree on: weights `1 / (1 + (q / 3 s)²)`, `s` the median of the misses
/// (Cauchy's, Holland & Welsch 1977).
fn robust_step(carried: &[Carried]) -> Option<Matrix3<f64>> {
    let mut step = DVector::zeros(BASE);
    for _ in 0..WEIGHINGS.get() {
        let missed: Vec<f64> = carried.iter().map(|c| left(c, &step).norm()).collect();
        let scale = 3.0 * median(missed.iter().copied())?.max(1e-9);
        let mut sums = Sums::new(BASE);
        for (one, q) in carried.iter().zip(&missed) {
            sums.add(one, &[], 1.0 / (1.0 + (q / scale).powi(2)));
        }
        step = sums.solution()?;
    }
    Some(Matrix3::from_fn(|i, j| step[3 * i + j]))
}

/// A change from a turn on; the turn itself may be mixed and is then left out.
fn change(
    turns: &[Turning<'_>],
    carried: &[Carried],
    t: &Matrix3<f64>,
    base: f64,
) -> Option<(Change, Explanation)> {
    let n = turns.len();
    let places: Vec<(usize, bool)> = (SIDE.get()..=n.checked_sub(SIDE.get())?)
        .flat_map(|at| [false, true].map(|mixed| (at, mixed)))
        .filter(|&(at, mixed)| at + usize::from(mixed) + SIDE.get() <= n)
        .collect();
    let count = places.len() * What::ALL.len();
    // Against the base without a mixed turn: that one turn misses is no change of the others.
    let with_base = places.into_iter().filter_map(|(at, mixed)| {
        let without = || {
            let sums = sums_of(carried, t, at, true, &[]);
            Some((sums.left(&sums.solution()?), 2))
        };
        let (base, lost) = if mixed { without()? } else { (base, 0) };
        Some((at, mixed, base, lost))
    });
    let tries = with_base.flat_map(|place| What::ALL.map(|what| (place, what)));
    let holding = tries.filter_map(|((at, mixed, base, lost), what)| {
        let generators = what.generators();
        let sums = sums_of(carried, t, at, mixed, &generators);
        let solution = sums.solution()?;
        let mut explanation = Explanation {
            left: sums.left(&solution),
            parameters: generators.len(),
        };
        if !explanation.holds(base, 2 * n - BASE - lost, count) {
            return None;
        }
        explanation.parameters += lost;
        let place = Place {
            after: turns[at - usize::from(!mixed)].place.after,
            before: turns[at].place.before,
        };
        let kind = what.kind(&solution.as_slice()[BASE..]);
        Some((at, mixed, Change { kind, place }, explanation))
    });
    let mut holding: Vec<_> = holding.collect();
    let criterion = |e: &Explanation| e.criterion(2 * n, FLOOR.get() * n as f64);
    holding.sort_by(|a, b| criterion(&a.3).total_cmp(&criterion(&b.3)));
    let (at, mixed, first, explanation) = *holding.first()?;
    if !matches!(first.kind, Kind::Turned(..)) {
        return Some((first, explanation));
    }
    let rotation = turned::Rotation::of(turns, t, at, mixed);
    if let Some(rotation) = rotation.filter(|r| r.is_certain(carried)) {
        let kind = Kind::Turned(Sensor::Gyroscope, rotation.angle());
        return Some((Change { kind, ..first }, explanation));
    }
    let others = holding.into_iter();
    let mut others = others.filter(|found| !matches!(found.2.kind, Kind::Turned(..)));
    others.next().map(|found| (found.2, found.3))
}

/// The sums with a change by `generators` from turn `at` on.
fn sums_of(
    carried: &[Carried],
    t: &Matrix3<f64>,
    at: usize,
    mixed: bool,
    generators: &[Matrix3<f64>],
) -> Sums {
    let mut sums = Sums::new(BASE + generators.len());
    let moved: Vec<Matrix3<f64>> = generators.iter().map(|m| t * m).collect();
    for (k, one) in carried.iter().enumerate() {
        if mixed && k == at {
            continue;
        }
        let extra: Vec<Vector3<f64>> = if k >= at {
            moved.iter().map(|by| one.along(by)).collect()
        } else {
            vec![Vector3::zeros(); moved.len()]
        };
        sums.add(one, &extra, 1.0);
    }
    sums
}
