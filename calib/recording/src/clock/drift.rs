//! By how much the clock of a gyroscope runs faster than that of the accelerometer beside it, from their turns.
//!
//! ```text
//! rough offsets of the halves ─► per turn: gravity carried along by the gyroscope, against the force ─► offset δ ─► line
//!                                └───────────────────────── again about that line ◄───────────────────────────────┘
//! ```
//!
//! Within a turn the force is `f = p + δ ṗ + (e × p) s + c + ȧ × l + …`: `p` gravity carried along by the readings of the
//! gyroscope, `δ` how late its clock is, `e` what the turn is off at its end (`s` the share of the angle that is passed), `c`
//! the mean of the force, and `l` the arm from the centre of the turn. The scatter of `δ` from turn to turn is that of the
//! hand's own acceleration, and the error of the slope comes from it: nothing has to be assumed of rates or of noise.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::offset::{common, offsets_of_halves};
use super::robust_line::{Line, Offset, line_through, quantile};
use crate::recording::Stream;

findings::tuning! {
    /// Bins in which the two are compared, s.
    BIN: f64 = 0.04;
    /// Longest time that is looked at, s.
    LONGEST: f64 = 20_000.0;
    /// Seconds left out at either end.
    EDGE: f64 = 0.5;

    /// A turn is faster than so many times a rest ...
    FASTER: f64 = 6.0;
    /// ... and than this share of the fastest.
    SHARE: f64 = 0.05;
    /// Bins that a rest between two turns lasts.
    REST: usize = 12;
    /// Bins that a turn lasts at least.
    SHORTEST: usize = 8;
    /// Bins that a turn lasts at most.
    TURN: usize = 250;
    /// Bins that are taken on either side of a turn.
    BESIDE: usize = 4;
}

/// Unknowns of a turn: `δ`, `e`, `c`, `l`.
const UNKNOWNS: usize = 10;

findings::tuning! {
    /// A turn explains this share of what its force changes, or does not count.
    EXPLAINED: f64 = 0.75;

    /// A drift is so many times its standard error ...
    EVIDENT: f64 = 5.0;
    /// ... and no smaller than this.
    LEAST: f64 = 1e-4;
    /// A drift beyond this may not be seen from the halves.
    STEEP: f64 = 3e-3;
    /// Rounds at most.
    ROUNDS: usize = 6;
}

/// The drift of one clock against another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockDrift {
    /// Share by which the other clock runs faster.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
    /// Turns that it is from.
    pub turns: usize,
}

/// By which share the stamps of the gyroscope run faster than those of the accelerometer for the same motion; `None` where
/// they share their stamps, where the two do not move alike, and where the turns do not show it.
pub fn clock_drift(force: &Stream, rate: &Stream) -> Option<ClockDrift> {
    let found = measured(force, rate)?;
    let is_evident = found.value.abs() > (EVIDENT.get() * found.error).max(LEAST.get());
    is_evident.then_some(found)
}

/// The drift with its error, evident or not: from the start by which most turns are explained.
fn measured(force: &Stream, rate: &Stream) -> Option<ClockDrift> {
    if force.t == rate.t {
        return None;
    }
    let starts = [
        of_halves(force, rate),
        of_ends(force, rate),
        Some(as_stamped(force)),
    ];
    let found = starts
        .into_iter()
        .flatten()
        .filter_map(|line| refined(force, rate, line));
    found.max_by(|a, b| a.turns.cmp(&b.turns).then(b.error.total_cmp(&a.error)))
}

/// The line through the offsets of the two halves.
fn of_halves(force: &Stream, rate: &Stream) -> Option<Line> {
    let [(t0, first), (t1, second)] = offsets_of_halves(force, rate)?;
    Some(Line {
        slope: (second - first) / (t1 - t0),
        middle: t0,
        at_middle: first,
    })
}

/// The line by which the two begin and end together, where it is so steep that each half slips by much of a turn.
fn of_ends(force: &Stream, rate: &Stream) -> Option<Line> {
    let (from, to) = (*force.t.first()?, *force.t.last()?);
    let (begin, end) = (rate.t.first()? - from, rate.t.last()? - to);
    let slope = (end - begin) / (to - from);
    let line = Line {
        slope,
        middle: from,
        at_middle: begin,
    };
    (slope.abs() > STEEP.get()).then_some(line)
}

/// The line of stamps that need no change: where turns follow one another like clockwork, halves slip by whole turns.
fn as_stamped(force: &Stream) -> Line {
    Line {
        slope: 0.0,
        middle: force.t.first().copied().unwrap_or_default(),
        at_middle: 0.0,
    }
}

/// The line through the offsets that the turns show, begun with `line`.
fn refined(force: &Stream, rate: &Stream, mut line: Line) -> Option<ClockDrift> {
    let (from, to) = common(force, rate)?;
    let (from, to) = (
        from + EDGE.get(),
        (to - EDGE.get()).min(from + LONGEST.get()),
    );
    let count = ((to - from) / BIN.get()) as usize;
    let middle = 0.5 * (from + to);
    line = Line {
        middle,
        at_middle: line.at(middle),
        ..line
    };
    let edges: Vec<f64> = (0..=count).map(|k| from + k as f64 * BIN.get()).collect();
    let forces = binned(force, &edges)?;
    let mut found = None;
    for _ in 0..ROUNDS.get() {
        let late: Vec<f64> = edges.iter().map(|t| t + line.at(*t)).collect();
        let rates = still_is_zero(binned(rate, &late)?);
        let offsets = offsets(&forces, &rates, &edges)?;
        let (step, error) = line_through(&offsets, middle)?;
        line.slope += step.slope;
        line.at_middle += step.at_middle;
        found = Some(ClockDrift {
            value: line.slope,
            error,
            turns: offsets.len(),
        });
        if step.at_middle.abs() < 1e-4 && step.slope.abs() < 0.1 * error {
            break;
        }
    }
    found
}

/// Means over the bins of the readings, straight between them: no rate is favoured. `None` with fewer than two readings.
fn binned(stream: &Stream, edges: &[f64]) -> Option<Vec<Vector3<f64>>> {
    let (t, v) = (&stream.t, &stream.values);
    if t.len() < 2 {
        return None;
    }
    let mut sums = Vec::with_capacity(t.len());
    let mut sum = Vector3::zeros();
    sums.push(sum);
    for k in 1..t.len() {
        sum += (v[k] + v[k - 1]) * (0.5 * (t[k] - t[k - 1]));
        sums.push(sum);
    }
    let mut place = 0;
    let mut until = |time: f64| {
        while place + 2 < t.len() && t[place + 1] <= time {
            place += 1;
        }
        let (passed, step) = (time - t[place], t[place + 1] - t[place]);
        let slope = (v[place + 1] - v[place]) / step;
        sums[place] + v[place] * passed + slope * (0.5 * passed * passed)
    };
    let integrals: Vec<_> = edges.iter().map(|&edge| until(edge)).collect();
    let means = integrals.windows(2).zip(edges.windows(2));
    Some(means.map(|(i, e)| (i[1] - i[0]) / (e[1] - e[0])).collect())
}

/// The rates less their median: a device mostly rests.
fn still_is_zero(mut rates: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
    let median = Vector3::from_fn(|k, _| {
        let mut axis: Vec<f64> = rates.iter().map(|rate| rate[k]).collect();
        quantile(&mut axis, 0.5)
    });
    rates.iter_mut().for_each(|rate| *rate -= median);
    rates
}

fn offsets(forces: &[Vector3<f64>], rates: &[Vector3<f64>], edges: &[f64]) -> Option<Vec<Offset>> {
    let turns = turns(rates);
    let scale = to_the_frame_of_the_force(forces, rates, &turns)?;
    let rates: Vec<Vector3<f64>> = rates.iter().map(|rate| scale * rate).collect();
    let of = |turn: &std::ops::Range<usize>| {
        let from = turn.start.saturating_sub(BESIDE.get()).max(1);
        let to = (turn.end + BESIDE.get()).min(forces.len() - 1);
        let (value, error) = offset(forces, &rates, from..to)?;
        let t = 0.5 * (edges[from] + edges[to]);
        Some(Offset { t, value, error })
    };
    Some(turns.iter().filter_map(of).collect())
}

/// Stretches in which the device turns, in bins.
fn turns(rates: &[Vector3<f64>]) -> Vec<std::ops::Range<usize>> {
    let norms: Vec<f64> = rates.iter().map(|rate| rate.norm()).collect();
    let of = |share: f64| quantile(&mut norms.clone(), share);
    let least = (FASTER.get() * of(0.3)).max(SHARE.get() * of(0.995));
    let moving: Vec<usize> = (0..norms.len()).filter(|&k| norms[k] > least).collect();
    let runs = moving.chunk_by(|a, b| b - a <= REST.get());
    let runs = runs.filter_map(|run| Some(*run.first()?..*run.last()? + 1));
    runs.filter(|run| (SHORTEST.get()..=TURN.get()).contains(&run.len()))
        .collect()
}

/// `M` of `ḟ = f × M ω` over the turns: scale, axes and hand of the gyroscope, whatever they are.
fn to_the_frame_of_the_force(
    forces: &[Vector3<f64>],
    rates: &[Vector3<f64>],
    turns: &[std::ops::Range<usize>],
) -> Option<Matrix3<f64>> {
    let mut normal = SMatrix::<f64, 9, 9>::zeros();
    let mut right = SVector::<f64, 9>::zeros();
    for turn in turns {
        let (from, to) = (turn.start.max(2), turn.end.min(forces.len() - 2));
        for k in from..to {
            let change = (forces[k + 1] - forces[k - 1]) / (2.0 * BIN.get());
            // The mean over the bins that the difference is over.
            let weighted = [(k - 1, 0.25), (k, 0.5), (k + 1, 0.25)];
            let rows = SMatrix::<f64, 3, 9>::from_fn(|row, column| {
                let (axis, of) = (column / 3, column % 3);
                let terms = weighted.iter().map(|&(k, weight)| {
                    weight * rates[k][of] * forces[k].cross(&Vector3::ith(axis, 1.0))[row]
                });
                terms.sum()
            });
            normal += rows.transpose() * rows;
            right += rows.transpose() * change;
        }
    }
    let m = normal.cholesky()?.solve(&right);
    Some(Matrix3::from_fn(|i, j| m[3 * i + j]))
}

/// The offset in a turn and its error; `None` where the force is not that of gravity carried along.
fn offset(
    forces: &[Vector3<f64>],
    rates: &[Vector3<f64>],
    turn: std::ops::Range<usize>,
) -> Option<(f64, f64)> {
    let angles: Vec<f64> = turn.clone().map(|k| rates[k].norm()).collect();
    let whole: f64 = angles.iter().sum();
    let (mut gravity, mut passed) = (forces[turn.start], 0.0);
    let mut normal = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    let mut right = SVector::<f64, UNKNOWNS>::zeros();
    let (mut square, mut change, mut count) = (0.0, 0.0, 0.0);
    for (k, angle) in turn.clone().zip(&angles) {
        if k > turn.start {
            let turned = (rates[k - 1] + rates[k]) * (-0.5 * BIN.get());
            gravity = nalgebra::Rotation3::new(turned) * gravity;
        }
        passed += angle;
        let rate = rates[k];
        let speeding = (rates[k + 1] - rates[k - 1]) / (2.0 * BIN.get());
        let unit = |q: usize| Vector3::ith(q, 1.0);
        let rows = SMatrix::<f64, 3, UNKNOWNS>::from_fn(|row, column| {
            let q = column.wrapping_sub(1) % 3;
            let column = match column {
                0 => gravity.cross(&rate),
                1..=3 => unit(q).cross(&gravity) * (passed / whole),
                4..=6 => unit(q),
                _ => speeding.cross(&unit(q)) + rate.cross(&rate.cross(&unit(q))),
            };
            column[row]
        });
        let left = forces[k] - gravity;
        normal += rows.transpose() * rows;
        right += rows.transpose() * left;
        square += left.norm_squared();
        change += (forces[k] - forces[turn.start]).norm_squared();
        count += 3.0;
    }
    let inverse = normal.cholesky()?.inverse();
    let solution = inverse * right;
    let left = (square - right.dot(&solution)).max(0.0);
    let error = (inverse[(0, 0)] * left / f64::max(count - UNKNOWNS as f64, 1.0)).sqrt();
    let is_explained = left < (1.0 - EXPLAINED.get()) * change && error > 0.0;
    is_explained.then_some((solution[0], error))
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    /// Readings of a device that lies still and is turned by a hand, `turns` times: an accelerometer at one rate and a
    /// gyroscope at another, whose clock is late by `offset` and fast by `drift`.
    fn session(seed: u64, rates: [f64; 2], turns: usize, [offset, drift]: [f64; 2]) -> [Stream; 2] {
        const FINE: f64 = 1e-3;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut rate: Vec<Vector3<f64>> = vec![Vector3::zeros(); 12_000];
        for _ in 0..turns {
            let (length, rest) = (
                random.random_range(900..2000),
                random.random_range(3000..6000),
            );
            let axis = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0f64)).normalize();
            let other = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0f64));
            let angle = random.random_range(0.7..2.8) / (f64::from(length) * FINE);
            rate.extend((0..length).map(|k| {
                let at = std::f64::consts::PI * f64::from(k) / f64::from(length);
                (axis * 2.0 + other * (2.0 * at).sin()) * (angle * at.sin().powi(2))
            }));
            rate.extend((0..rest).map(|_| Vector3::zeros()));
        }
        let arm = Vector3::new(0.05, -0.03, 0.08);
        let (mut gravity, mut hand) = (Vector3::new(0.0, 0.0, 9.8), Vector3::zeros());
        let mut force = Vec::with_capacity(rate.len());
        for (k, w) in rate.iter().enumerate() {
            gravity = nalgebra::Rotation3::new(w * -FINE) * gravity;
            // Some 0.3 m/s² at a few hertz, while the hand moves.
            let push = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0f64));
            hand += (push * if w.norm() > 0.0 { 1.5 } else { 0.0 } - hand) * 0.02;
            let next = rate.get(k + 1).copied().unwrap_or_default();
            force.push(gravity + hand + ((next - w) / FINE).cross(&arm) + w.cross(&w.cross(&arm)));
        }
        let fine: Vec<f64> = (0..rate.len()).map(|k| k as f64 * FINE).collect();
        let sampled =
            |values: Vec<Vector3<f64>>, step: f64, noise: f64, random: &mut ChaCha8Rng| {
                let fine = Stream {
                    t: fine.clone(),
                    values,
                };
                let (from, to) = (random.random_range(0.0..step), fine.t[fine.len() - 1]);
                let count = ((to - from) / step) as usize;
                let t: Vec<f64> = (0..count).map(|k| from + k as f64 * step).collect();
                let mut values: Vec<_> = t.iter().filter_map(|t| fine.at(*t)).collect();
                for value in &mut values {
                    *value += Vector3::from_fn(|_, _| random.random_range(-noise..noise));
                }
                Stream { t, values }
            };
        let force = sampled(force, rates[0].recip(), 0.03, &mut random);
        let mut rate = sampled(rate, rates[1].recip(), 0.003, &mut random);
        rate.t
            .iter_mut()
            .for_each(|t| *t = *t * (1.0 + drift) + offset);
        [force, rate]
    }

    #[test]
    fn exact_clocks_of_any_two_rates_do_not_drift() {
        for (seed, rates) in [
            [1600.0, 200.0],
            [100.0, 99.75],
            [25.0, 100.0],
            [208.0, 52.0],
        ]
        .into_iter()
        .enumerate()
        {
            let [force, rate] = session(seed as u64, rates, 14, [0.0; 2]);
            assert_eq!(clock_drift(&force, &rate), None, "{rates:?}");
            let found = measured(&force, &rate).unwrap();
            assert!(
                found.value.abs() < 4.0 * found.error,
                "{rates:?}: {found:?}"
            );
        }
    }

    #[test]
    fn a_drift_is_found_within_its_error_in_any_frame_and_unit() {
        for (seed, drift) in [3e-4, -5e-4, 4e-3, 0.02, -0.03].into_iter().enumerate() {
            let [force, mut rate] = session(seed as u64, [100.0, 200.0], 30, [0.1, drift]);
            // Counts of a gyroscope whose x and y are swapped.
            rate.values
                .iter_mut()
                .for_each(|w| *w = Vector3::new(w.y, w.x, w.z) * 900.0);
            let found = clock_drift(&force, &rate).unwrap();
            assert!(
                (found.value - drift).abs() < 4.0 * found.error,
                "{drift}: {found:?}"
            );
            assert!(found.error < 6e-5, "{found:?}");
        }
    }

    #[test]
    fn turns_like_clockwork_slip_by_no_whole_turn() {
        let (mut force, mut rate) = (Stream::default(), Stream::default());
        let mut attitude = nalgebra::Rotation3::identity();
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for turn in 0..20 {
            let at = f64::from(turn);
            let axis = Vector3::new(at.cos(), at.sin(), (2.0 * at).cos()).normalize();
            let angle = 1.0 + 0.2 * (3.0 * at).sin();
            for k in 0..240 {
                let phase = (f64::from(k - 160) / 80.0).max(0.0);
                let speed = angle / 1.6 * (1.0 - (std::f64::consts::TAU * phase).cos());
                attitude = nalgebra::Rotation3::new(axis * (-speed * 0.02)) * attitude;
                let noise = Vector3::from_fn(|_, _| random.random_range(-0.02..0.02f64));
                let t = f64::from(240 * turn + k) * 0.02;
                force.t.push(t);
                force.values.push(attitude * Vector3::z() * 9.8 + noise);
                rate.t.push(t + 3e-6);
                rate.values.push(axis * speed + 0.1 * noise);
            }
        }
        assert_eq!(clock_drift(&force, &rate), None);
    }
}
