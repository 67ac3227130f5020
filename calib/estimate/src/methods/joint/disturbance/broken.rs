//! Rests that a touch broke: what the detector of motion took for part of a turn.

use std::ops::Range;

use nalgebra::Vector3;
use recording::Stream;
use recording::intervals::Span;

use crate::methods::joint::noise::SensorNoise;

findings::tuning! {
    /// Length of a window, s.
    WINDOW: f64 = 0.2;

    /// A window with more than this many times the usual variance is not quiet.
    QUIET: f64 = 2.5;

    /// Standard deviations of a window's variance, as a cube root, that few samples may be off by chance.
    CHANCE: f64 = 3.29;

    /// Standard deviations that a window's mean rate may be off.
    OFF: f64 = 5.0;

    /// Windows that shake while the gyroscope rests, or that are quiet between two that are not, before
    /// something is said to have been touched: a hand that begins or ends a turn makes
    /// three at most.
    LEAST: usize = 4;

    /// The same of windows that shake with quiet on either side: no hand that turns the device.
    LEAST_ALONE: usize = 3;

    /// A rest that goes on behind a touch is in the attitude of the rest before or after it within this, rad; one in
    /// another attitude is a pause between two turns, too short for a static interval.
    SAME: f64 = 0.05;
}

/// Both sensors of a recording with their noise.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Accelerometer.
    pub force: (&'a Stream, &'a SensorNoise),
    /// Gyroscope.
    pub rate: (&'a Stream, &'a SensorNoise),
}

/// The rests on either side of a turn.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// The rate in the rest before.
    pub bias: Vector3<f64>,
    /// Variance of the accelerometer in the rest that shakes more, and of the gyroscope: on a table that
    /// vibrates that is how the device rests.
    pub variances: [Vector3<f64>; 2],
    /// Mean specific force of the rest before and of the rest after.
    pub forces: [Vector3<f64>; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Quiet,
    /// The accelerometer shakes, the gyroscope rests.
    Shakes,
    Turns,
}

/// The part of a turn in which the device rested and was touched, if there is one.
pub fn touched(pair: &Pair<'_>, turn: Span, beside: &Beside) -> Option<Span> {
    let count = turn.stretches(WINDOW.get());
    let window = |k: usize| Span {
        from: turn.from + k as f64 * WINDOW.get(),
        to: turn.from + (k + 1) as f64 * WINDOW.get(),
    };
    // Missing samples break a rest as well, and nobody touched the device for that.
    let has_samples = |k: usize| moments(pair.rate.0, window(k)).is_some();
    if !(0..count).all(has_samples) {
        return None;
    }
    let states: Vec<State> = (0..count).map(|k| state(pair, window(k), beside)).collect();
    let shaking = longest(&states, |s| s == State::Shakes);
    let alone = alone(&states);
    let (first, last) = ends(&states)?;
    let inner = longest(&states[first..=last], |s| s == State::Quiet);
    let span = |windows: Range<usize>| Span {
        from: window(windows.start).from,
        to: window(windows.end.max(1) - 1).to,
    };
    if shaking.len() >= LEAST.get() {
        Some(span(shaking))
    } else if alone.len() >= LEAST_ALONE.get() {
        Some(span(alone))
    } else {
        let rest = span(inner.start + first..inner.end + first);
        let (force, ..) = moments(pair.force.0, rest)?;
        let between = [(turn.from, rest.from), (rest.to, turn.to)];
        let mut neighbours = beside.forces.iter().zip(between);
        let goes_on = neighbours.any(|(other, (from, to))| {
            other.angle(&force) < SAME.get()
                && rotation(pair.rate.0, from, to, &beside.bias) < SAME.get()
        });
        (inner.len() >= LEAST.get() && goes_on).then_some(rest)
    }
}

/// Returns the angle by which the device turned, rad: gravity does not show a turn about the vertical.
fn rotation(rate: &Stream, from: f64, to: f64, bias: &Vector3<f64>) -> f64 {
    let samples = rate.between(from, to);
    let steps = rate.t[samples.clone()].windows(2).zip(samples);
    let angles = steps.map(|(t, k)| (rate.values[k] - bias) * (t[1] - t[0]));
    angles.sum::<Vector3<f64>>().norm()
}

fn state(pair: &Pair<'_>, window: Span, beside: &Beside) -> State {
    let Some((rate, rate_square, count)) = moments(pair.rate.0, window) else {
        return State::Turns;
    };
    let noise = pair.rate.1;
    // Coarse readings flip between two levels or stay on one, by where the mean of a rest lies between them.
    let usual = |noise: &SensorNoise, own: &Vector3<f64>| {
        let flips = noise.variance_of_flips();
        noise.white.map(|w| w * w).sup(own).sup(&flips)
    };
    let variance = usual(noise, &beside.variances[1]);
    let turns = (0..3).any(|i| {
        let limit = OFF.get() * noise.long_run[i] * (variance[i] / count).sqrt();
        (rate[i] - beside.bias[i]).abs() > limit
            || rate_square[i] > most(count, noise.freedom[i]) * variance[i]
    });
    if turns {
        return State::Turns;
    }
    let noise = pair.force.1;
    let variance = usual(noise, &beside.variances[0]);
    let quiet = |square: Vector3<f64>, count: f64| {
        (0..3).all(|i| square[i] <= most(count, noise.freedom[i]) * variance[i])
    };
    // Too few samples, as of an accelerometer that is slower than the gyroscope, show no shaking.
    match moments(pair.force.0, window) {
        Some((_, square, count)) if !quiet(square, count) => State::Shakes,
        _ => State::Quiet,
    }
}

/// The variance, over the usual, of a quiet window of `count` samples, a share `freedom` of them as good as
/// independent: [`QUIET`], or what one in two thousand windows has by chance where they are few (Wilson and
/// Hilferty 1931).
fn most(count: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * (freedom * (count - 1.0)).max(1.0));
    let by_chance = (1.0 - spread + CHANCE.get() * spread.sqrt()).powi(3);
    by_chance.max(QUIET.get())
}

/// Mean, variance and number of the samples in a window without the farthest of them: a spike is no touch.
fn moments(stream: &Stream, window: Span) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
    let values = &stream.values[stream.between(window.from, window.to)];
    let all = values.iter().sum::<Vector3<f64>>() / values.len() as f64;
    let off = |v: &Vector3<f64>| (v - all).norm_squared();
    let farthest = values.iter().map(off).enumerate();
    let (spike, _) = farthest.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let others = || values.iter().enumerate().filter(|(k, _)| *k != spike);
    let count = (values.len() - 1) as f64;
    let mean = others().map(|(_, v)| v).sum::<Vector3<f64>>() / count;
    let squares: Vector3<f64> = others().map(|(_, v)| (v - mean).map(|d| d * d)).sum();
    (values.len() > 3).then(|| (mean, squares / (count - 1.0), count))
}

/// The first and the last window of motion or shaking that lasts longer than one window; a single one is a
/// chance reading.
fn ends(states: &[State]) -> Option<(usize, usize)> {
    let lasts = |pair: &[State]| pair.iter().all(|s| *s != State::Quiet);
    let first = states.windows(2).position(lasts)?;
    let last = states.windows(2).rposition(lasts)? + 1;
    Some((first, last))
}

/// The longest run that shakes with no turning right before or after it.
fn alone(states: &[State]) -> Range<usize> {
    let turns = |k: Option<usize>| k.and_then(|k| states.get(k)) == Some(&State::Turns);
    let mut best = 0..0;
    let mut from = 0;
    for run in states.chunk_by(|a, b| a == b) {
        let range = from..from + run.len();
        from = range.end;
        let apart = !turns(range.start.checked_sub(1)) && !turns(Some(range.end));
        if run[0] == State::Shakes && apart && range.len() > best.len() {
            best = range;
        }
    }
    best
}

/// The longest run of states that pass.
fn longest(states: &[State], passes: impl Fn(State) -> bool) -> Range<usize> {
    let mut best = 0..0;
    let mut from = 0;
    for (k, state) in states.iter().enumerate() {
        if !passes(*state) {
            from = k + 1;
        } else if k + 1 - from > best.len() {
            best = from..k + 1;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use State::{Quiet, Shakes, Turns};

    use super::*;

    #[test]
    fn the_limit_of_few_samples_is_what_one_window_in_two_thousand_has() {
        use statrs::distribution::{ChiSquared, ContinuousCDF};
        for count in [4.0, 6.0, 12.0] {
            let law = ChiSquared::new(count - 1.0).unwrap();
            let exact = law.inverse_cdf(1.0 - 5e-4) / (count - 1.0);
            // The cube root of three squares is not quite normal so far out.
            assert!((most(count, 1.0) / exact - 1.0).abs() < 0.03, "{count}");
        }
        assert_eq!(most(50.0, 1.0), QUIET.get());
    }

    #[test]
    fn coarse_readings_that_flip_between_two_levels_neither_shake_nor_turn() {
        let step = 0.16;
        let noise = SensorNoise {
            white: Vector3::repeat(0.2 * step),
            long_run: Vector3::repeat(1.0),
            restless_long_run: Vector3::repeat(1.0),
            step: Vector3::repeat(step),
            rounding: Vector3::repeat(step * step / 12.0),
            freedom: Vector3::repeat(1.0),
            interval: 0.01,
        };
        let t: Vec<f64> = (0..40).map(|k| 0.01 * f64::from(k)).collect();
        let stream = |size: f64| Stream {
            t: t.clone(),
            values: (0..40)
                .map(|k| Vector3::repeat(size * f64::from(k % 2)))
                .collect(),
        };
        let (flips, level) = (stream(step), stream(0.0));
        let look = |force: &Stream| {
            let pair = Pair {
                force: (force, &noise),
                rate: (&flips, &noise),
            };
            let beside = Beside {
                bias: Vector3::zeros(),
                variances: [Vector3::zeros(); 2],
                forces: [Vector3::z() * 9.8; 2],
            };
            let window = Span { from: 0.1, to: 0.3 };
            state(&pair, window, &beside)
        };
        assert_eq!([look(&level), look(&flips)], [Quiet; 2]);
        assert_eq!(look(&stream(4.0 * step)), Shakes);
    }

    #[test]
    fn what_shakes_beside_a_turn_is_a_hand_and_what_shakes_apart_from_it_is_not() {
        let beside = [Quiet, Turns, Turns, Shakes, Shakes, Shakes, Quiet];
        assert_eq!(alone(&beside), 0..0);
        let apart = [Quiet, Turns, Quiet, Shakes, Shakes, Shakes];
        assert_eq!(alone(&apart), 3..6);
    }
    use simulate::{Simulation, Spec};

    /// Numbers that scatter like noise.
    fn noise(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// A device that rests for 5 s, turns about an axis for 2 s, pauses for 2.6 s, turns about x for 2 s and rests again.
    fn with_a_pause(first: Vector3<f64>, angle: f64) -> Option<Span> {
        let (mut force, mut rate) = (Stream::default(), Stream::default());
        let mut next = noise(7);
        let mut vector = |size: f64| Vector3::from_fn(|_, _| size * next());
        for k in 0..1700 {
            let t = 0.01 * f64::from(k);
            let bump = |from: f64| match (t - from) / 2.0 {
                s if (0.0..1.0).contains(&s) => 1.0 - (std::f64::consts::TAU * s).cos(),
                _ => 0.0,
            };
            let turned = if t < 10.0 { Vector3::z() } else { Vector3::y() };
            let moving = bump(5.0) + bump(9.6);
            force.t.push(t);
            force
                .values
                .push(turned * 9.8 + vector(0.01 + 0.3 * moving));
            rate.t.push(t);
            let turn = first * (0.5 * angle * bump(5.0)) + Vector3::x() * (0.8 * bump(9.6));
            rate.values.push(turn + vector(0.002));
        }
        let rest = Span { from: 0.0, to: 5.0 };
        let of = |stream: &Stream| {
            SensorNoise::measure(stream, &[stream.between(rest.from, rest.to)]).unwrap()
        };
        let (of_force, of_rate) = (of(&force), of(&rate));
        let pair = Pair {
            force: (&force, &of_force),
            rate: (&rate, &of_rate),
        };
        let beside = Beside {
            bias: Vector3::zeros(),
            variances: [Vector3::zeros(); 2],
            forces: [Vector3::z() * 9.8, Vector3::y() * 9.8],
        };
        let turn = Span {
            from: 5.0,
            to: 11.8,
        };
        touched(&pair, turn, &beside)
    }

    #[test]
    fn a_pause_after_a_turn_about_the_vertical_is_no_broken_rest() {
        assert_eq!(with_a_pause(Vector3::z(), 1.5), None);
        // A knock that turns it by little does break a rest.
        let found = with_a_pause(Vector3::z(), 0.02).unwrap();
        assert!(found.from > 6.5 && found.to < 9.9, "{found:?}");
    }

    #[test]
    fn a_touch_at_the_end_of_a_rest_is_seen_in_the_turn_and_a_turn_alone_is_not() {
        let simulation = Simulation::new(&Spec::hand_held(3)).unwrap();
        let mut recording = simulation.run().unwrap().recording;
        let rests = simulation.placements();
        let noise = |stream: &Stream| {
            let range = stream.between(rests[0].0 + 1.0, rests[0].1 - 1.0);
            SensorNoise::measure(stream, &[range]).unwrap()
        };
        let rate = recording.gyroscope.clone().unwrap();
        let mut force = recording.accelerometer.take().unwrap();
        let bias = rate.values[rate.between(rests[0].0, rests[0].1)]
            .iter()
            .sum::<Vector3<f64>>()
            / rate.between(rests[0].0, rests[0].1).len() as f64;
        let (of_force, of_rate) = (noise(&force), noise(&rate));
        let look = |force: &Stream, k: usize| {
            let pair = Pair {
                force: (force, &of_force),
                rate: (&rate, &of_rate),
            };
            let turn = Span {
                from: rests[k].1 - 2.0,
                to: rests[k + 1].0 + 0.5,
            };
            let variances = [Vector3::zeros(); 2];
            let mean = |(from, to): (f64, f64)| {
                let values = &force.values[force.between(from, to)];
                values.iter().sum::<Vector3<f64>>() / values.len() as f64
            };
            let beside = Beside {
                bias,
                variances,
                forces: [mean(rests[k]), mean(rests[k + 1])],
            };
            touched(&pair, turn, &beside)
        };
        assert!((0..rests.len() - 1).all(|k| look(&force, k).is_none()));
        for k in force.between(rests[4].1 - 1.5, rests[4].1 - 0.5) {
            let t = force.t[k];
            force.values[k].z += 0.3 * (31.4 * t).sin();
        }
        let found = look(&force, 4).unwrap();
        assert!(found.from > rests[4].1 - 1.8 && found.to < rests[4].1 - 0.1);
    }
}
