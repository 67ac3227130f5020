//! The ends of a static interval, moved to where the gyroscope sees no turn yet.

use nalgebra::Vector3;

use super::spans::{Span, complement, union};
use super::stamps::Stamps;
use crate::averages::median;
use crate::recording::Stream;

findings::tuning! {
    /// Rotation that may remain at an end, rad (0.04°): that of a direction after a good turn.
    REMAINDER: f64 = 7e-4;

    /// Length of the stretches whose rotation by noise and tremor is taken as usual, s.
    STRETCH: f64 = 1.0;

    /// An end turns where it turns so many times as far as the stretches usually do.
    BEYOND_USUAL: f64 = 3.0;

    /// The limit of an end that was cut before, as a share of it.
    AGAIN: f64 = 0.5;

    /// A turn has begun at this share of the limit: what begins slowly turns far before it stands out.
    BEGUN: f64 = 0.25;

    /// Length at either end of an interval that is searched for a turn, s.
    REACH: f64 = 2.0;

    /// Length next to an end that the end is compared with, s. A bias that drifts for hours differs between both ends, and the limit
    /// bounds the cost for a long interval.
    NEAR: f64 = 60.0;

    /// A bias drifts steadily over as long, s. What begins to turn does so within less.
    DRIFTS: f64 = 20.0;
    /// It drifts by no more than this, rad/s² (20 °/h in a second): a gyroscope that warms up.
    FASTEST_DRIFT: f64 = 1e-4;

    /// Most looks at the ends of one interval.
    MOST_LOOKS: usize = 1000;

    /// Fewest samples whose middle can be told from their ends.
    FEWEST: usize = 12;

    /// Pieces whose median rate is that of the middle, whatever the ends do.
    PIECES: usize = 9;

    /// Rotation within one stretch that is a turn and no tremor, rad (2°) ...
    TURN: f64 = 0.035;
    /// ... where it is so many times what stretches usually turn by.
    TURN_BEYOND_USUAL: f64 = 10.0;

    /// Length of the stretches in which a slow turn is looked for, s.
    SLOW: f64 = 4.0;
    /// Rotation over them that is one, rad (1°).
    SLOW_TURN: f64 = 0.0175;

    /// Steps from one stretch to the next, as a share of it.
    PER_STRETCH: usize = 4;

    /// A device whose rate differs by so much from that of the interval's middle for half of the time is in motion, rad/s (3 °/s) ...
    MOVES: f64 = 0.052;
    /// ... and one whose rate differs by so much swings, as no hand at rest does, rad/s (6 °/s). Both of rates over ...
    SWINGS: f64 = 0.105;
    /// ... so long, s: a hand's tremor of 6 Hz and more has turned back within it.
    SMOOTH: f64 = 0.25;
}

/// A gyroscope with what is looked up for each interval.
#[derive(Clone, Debug)]
pub(super) struct Ends<'a> {
    stream: &'a Stream,
    stamps: Stamps<'a>,
    step: f64,
    /// SI units per raw unit, roughly.
    scale: f64,
}

impl<'a> Ends<'a> {
    /// Builds it for a gyroscope whose readings times `scale` are rad/s.
    pub fn of(stream: &'a Stream, scale: f64) -> Self {
        Self {
            stream,
            stamps: Stamps::of(&stream.t),
            step: stream.median_step().unwrap_or(0.0),
            scale,
        }
    }

    /// The interval without the turns at its ends: from where the integrated rate, less that of the
    /// interval's middle, stays within [`REMAINDER`] or three times what the middle's own stretches do.
    ///
    /// An end that was cut is looked at again, with half the limit: of a turn that begins over many seconds one reach is a
    /// part.
    pub fn trimmed(&self, span: Span) -> Span {
        let (mut span, mut shares) = (span, [1.0; 2]);
        for _ in 0..MOST_LOOKS.get() {
            if shares == [0.0; 2] {
                break;
            }
            let cut = self.cut(span, shares);
            let again = |moved: bool| if moved { AGAIN.get() } else { 0.0 };
            shares = [again(cut.from > span.from), again(cut.to < span.to)];
            span = cut;
        }
        span
    }

    /// The interval in pieces, without the turns in its middle: a slow and small one that the scatter of samples does not show
    /// beside a hand's tremor.
    pub fn without_turns(&self, span: Span) -> Vec<Span> {
        let samples = self.stamps.between(span.from, span.to);
        let (t, values) = (
            &self.stream.t[samples.clone()],
            &self.stream.values[samples],
        );
        let n = values.len();
        if n < FEWEST.get() || self.step <= 0.0 {
            return vec![span];
        }
        let factor = self.step * self.scale;
        let bias = middle_rate(values);
        let stretch = ((STRETCH.get() / self.step) as usize).clamp(3, n / 3);
        let usual = usual_turn(values, &bias, stretch);
        let limit = (TURN.get() / factor).max(TURN_BEYOND_USUAL.get() * usual);
        let mut turning = turning_stretches(t, values, &bias, stretch, limit);
        turning.extend(self.slow_turns(t, values));
        complement(span, &union(turning))
    }

    /// The stretches of four seconds in which the device turns by more than 1° beyond what the rate on both sides makes it: a bias that
    /// drifts does so on both. Two in a row, for one may end within a knock that turns back.
    fn slow_turns(&self, t: &[f64], values: &[Vector3<f64>]) -> Vec<Span> {
        let length = (SLOW.get() / self.step) as usize;
        let step = length / PER_STRETCH.get();
        if step == 0 || values.len() < 3 * length {
            return Vec::new();
        }
        let mean = |part: &[Vector3<f64>]| part.iter().sum::<Vector3<f64>>() / part.len() as f64;
        let firsts = (length..=values.len() - 2 * length).step_by(step);
        let turned: Vec<(usize, f64)> = firsts
            .map(|k| {
                let [before, within, after] =
                    [k - length, k, k + length].map(|from| mean(&values[from..from + length]));
                let excess = (within - (before + after) * 0.5).norm();
                (k, excess * length as f64 * self.step * self.scale)
            })
            .collect();
        let second = ((STRETCH.get() / self.step) as usize).clamp(3, length);
        let usual = usual_turn(values, &middle_rate(values), second) * self.step * self.scale;
        // White noise adds up with the root of time.
        let usual = usual * (length as f64 / second as f64).sqrt();
        let limit = SLOW_TURN.get().max(TURN_BEYOND_USUAL.get() * usual);
        let twice = turned
            .windows(2)
            .filter(|pair| pair.iter().all(|(_, angle)| *angle > limit));
        let spans = twice.map(|pair| Span {
            from: t[pair[0].0],
            to: t[pair[1].0 + length - 1],
        });
        spans.collect()
    }

    /// Returns true if the device moves for half of the interval: its rate, smoothed over a quarter of a second, differs from that of
    /// the middle by more than 3 °/s. No bias changes by as much.
    pub fn moves(&self, span: Span) -> bool {
        let values = &self.stream.values[self.stamps.between(span.from, span.to)];
        if values.len() < FEWEST.get() || self.step <= 0.0 {
            return false;
        }
        let bias = middle_rate(values);
        let stretch = ((SMOOTH.get() / self.step).round() as usize).clamp(3, values.len() / 3);
        let means = values.chunks_exact(stretch).map(|part| {
            let sum: Vector3<f64> = part.iter().sum();
            (sum / stretch as f64 - bias).norm() * self.scale
        });
        median(means).is_some_and(|usual| usual > MOVES.get())
    }

    /// Returns the parts of the interval in which the device swings: its rate, smoothed over a quarter of a second, differs from that
    /// of the middle by more than 6 °/s.
    pub fn swings(&self, span: Span) -> Vec<Span> {
        let samples = self.stamps.between(span.from, span.to);
        let (t, values) = (
            &self.stream.t[samples.clone()],
            &self.stream.values[samples],
        );
        if values.len() < FEWEST.get() || self.step <= 0.0 {
            return Vec::new();
        }
        let bias = middle_rate(values);
        let stretch = ((SMOOTH.get() / self.step).round() as usize).clamp(3, values.len() / 3);
        let limit = SWINGS.get() / self.scale * stretch as f64;
        turning_stretches(t, values, &bias, stretch, limit)
    }

    /// One reach of the ends without the turn in it, that turns by more than these shares of the limit; of a share of zero an
    /// end is left as it is.
    fn cut(&self, span: Span, shares: [f64; 2]) -> Span {
        let samples = self.stamps.between(span.from, span.to);
        let values = &self.stream.values[samples.clone()];
        let n = values.len();
        if n < FEWEST.get() || self.step <= 0.0 {
            return span;
        }
        let factor = self.step * self.scale;
        let reach = ((REACH.get() / self.step) as usize).min(n / 2);
        let near = ((NEAR.get() / self.step) as usize).clamp(FEWEST.get(), n);
        // From the middle of what is near to that of the reach, in samples.
        let away = 0.5 * (near as f64 - reach as f64);
        let turned = |share: f64,
                      near: &[Vector3<f64>],
                      away: f64,
                      end: &mut dyn ExactSizeIterator<Item = &Vector3<f64>>| {
            if share <= 0.0 {
                return 0;
            }
            let middle = middle_rate(near);
            let per_stretch = ((STRETCH.get() / self.step) as usize).clamp(3, near.len() / 3);
            let usual = usual_turn(near, &middle, per_stretch) * factor;
            let limit = REMAINDER.get().max(BEYOND_USUAL.get() * usual) / factor;
            turned(end, &(middle + self.drift(near) * away), share * limit)
        };
        let (first, last) = (&values[..near], &values[n - near..]);
        let after = turned(shares[0], first, -away, &mut values[..reach].iter().rev());
        let before = turned(shares[1], last, away, &mut values[n - reach..].iter());
        let t = &self.stream.t[samples];
        Span {
            from: if after > 0 { t[after] } else { span.from },
            to: if before > 0 { t[n - before] } else { span.to },
        }
    }
}

impl Ends<'_> {
    /// The steady change of the rate from one sample to the next: the median of the slopes between pieces, by axis. Zero of a short
    /// interval.
    fn drift(&self, values: &[Vector3<f64>]) -> Vector3<f64> {
        if (values.len() as f64) * self.step < DRIFTS.get() {
            return Vector3::zeros();
        }
        let (length, means) = pieces(values);
        let most = FASTEST_DRIFT.get() * self.step / self.scale;
        Vector3::from_fn(|axis, _| {
            let slope =
                |i: usize, k: usize| (means[k][axis] - means[i][axis]) / ((k - i) * length) as f64;
            let pairs = (0..means.len()).flat_map(|k| (0..k).map(move |i| (i, k)));
            let usual = median(pairs.map(|(i, k)| slope(i, k))).unwrap_or(0.0);
            usual.clamp(-most, most)
        })
    }
}

/// The stretches of so many samples over which the rate less the bias sums up to more than the limit, overlapping ones made
/// one.
fn turning_stretches(
    t: &[f64],
    values: &[Vector3<f64>],
    bias: &Vector3<f64>,
    stretch: usize,
    limit: f64,
) -> Vec<Span> {
    let mut sums = vec![Vector3::zeros()];
    let mut sum = Vector3::zeros();
    sums.extend(values.iter().map(|w| {
        sum += w - bias;
        sum
    }));
    let firsts = (0..values.len() - stretch).step_by((stretch / PER_STRETCH.get()).max(1));
    let turning = firsts.filter(|&k| (sums[k + stretch] - sums[k]).norm() > limit);
    let turning = turning.map(|k| Span {
        from: t[k],
        to: t[k + stretch],
    });
    union(turning.collect())
}

/// The length of the pieces of an interval in samples, and the mean rate in each.
fn pieces(values: &[Vector3<f64>]) -> (usize, Vec<Vector3<f64>>) {
    let length = values.len().div_ceil(PIECES.get());
    let means = values
        .chunks(length)
        .map(|piece| piece.iter().sum::<Vector3<f64>>() / piece.len() as f64);
    (length, means.collect())
}

/// The median over pieces of the mean rate, by axis.
fn middle_rate(values: &[Vector3<f64>]) -> Vector3<f64> {
    let (_, means) = pieces(values);
    Vector3::from_fn(|axis, _| median(means.iter().map(|m| m[axis])).unwrap_or(0.0))
}

/// The median over stretches of the farthest that the sum of the rate gets from its start.
fn usual_turn(values: &[Vector3<f64>], bias: &Vector3<f64>, length: usize) -> f64 {
    let farthest = |stretch: &[Vector3<f64>]| {
        let mut sum = Vector3::zeros();
        let squares = stretch.iter().map(|w| {
            sum += w - bias;
            sum.norm_squared()
        });
        squares.fold(0.0, f64::max).sqrt()
    };
    median(values.chunks_exact(length).map(farthest)).unwrap_or(0.0)
}

/// Number of the last samples that belong to a turn: those whose summed rate lies beyond the limit, those before them with
/// which the sum leaves a quarter of it, and as many again, for a turn that begins smoothly has begun before: of an angle
/// that grows with the cube of time a sixtieth of the limit is left then.
fn turned<'a>(
    values: impl ExactSizeIterator<Item = &'a Vector3<f64>>,
    bias: &Vector3<f64>,
    limit: f64,
) -> usize {
    let mut sum = Vector3::zeros();
    let (mut beyond, mut leaving) = (0, 0);
    let all = values.len();
    for value in values {
        sum += value - bias;
        let turned = sum.norm();
        beyond = if turned > limit { beyond + 1 } else { 0 };
        leaving = if turned > BEGUN.get() * limit {
            leaving + 1
        } else {
            0
        };
    }
    if beyond > 0 {
        all.min(leaving + (leaving - beyond))
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 100 Hz for ten seconds with a turn that begins at 9.5 s, and noise of `noise` rad/s.
    fn stream(noise: f64) -> Stream {
        let t: Vec<f64> = (0..1000).map(|k| 0.01 * f64::from(k)).collect();
        let mut state = 1u64;
        let mut jitter = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            ((state >> 40) as f64 / (1u64 << 23) as f64 - 1.0) * noise
        };
        let mut value = |t: f64| Vector3::new(0.02 + jitter(), jitter(), (t - 9.5).max(0.0));
        let values = t.iter().map(|&t| value(t)).collect();
        Stream { t, values }
    }

    #[test]
    fn a_turn_that_begins_is_cut_off_where_it_begins() {
        let whole = Span {
            from: 0.0,
            to: 10.0,
        };
        let stream = stream(1e-3);
        let cut = Ends::of(&stream, 1.0).trimmed(whole);
        // (t − 9.5)²/2 reaches 7e-4 at 9.537 s and a quarter of it at 9.519 s: it began as long before.
        assert_eq!(cut.from, 0.0);
        assert!((cut.to - 9.5).abs() < 0.03, "{cut:?}");
    }

    #[test]
    fn a_turn_that_begins_over_many_seconds_is_cut_off_whole() {
        let mut stream = stream(1e-3);
        // A quarter turn in 30 s with least jerk, from 5 s on: 0.04° after 1.1 s, 10° at the end of the stretch.
        let rate = |t: f64| {
            let s = ((t - 5.0) / 30.0).max(0.0);
            std::f64::consts::FRAC_PI_2 * 30.0 * s.powi(2) * (1.0 - s).powi(2) / 30.0
        };
        let turned = stream.t.iter().map(|&t| rate(t));
        stream
            .values
            .iter_mut()
            .zip(turned)
            .for_each(|(v, w)| v.z = w);
        let cut = Ends::of(&stream, 1.0).trimmed(Span {
            from: 0.0,
            to: 10.0,
        });
        let left: f64 = stream
            .t
            .iter()
            .filter(|t| **t < cut.to)
            .map(|&t| 0.01 * rate(t))
            .sum();
        assert!(cut.to > 4.0 && left < 2e-4, "{cut:?} {left}");
    }

    #[test]
    fn a_gyroscope_that_warms_up_rests_from_beginning_to_end_and_a_turn_behind_it_is_cut_off() {
        let mut stream = stream(1e-3);
        stream.t = (0..12_100).map(|k| 0.01 * f64::from(k)).collect();
        let values = stream.values.clone();
        let value = |t: f64, noise: &Vector3<f64>| {
            noise.xy().push(0.0) + Vector3::new(1e-5 * t, -2e-5 * t, (t - 120.5).max(0.0))
        };
        let noise = values[..900].iter().cycle();
        stream.values = stream
            .t
            .iter()
            .zip(noise)
            .map(|(&t, v)| value(t, v))
            .collect();
        let whole = Span {
            from: 0.0,
            to: 121.0,
        };
        let cut = Ends::of(&stream, 1.0).trimmed(whole);
        assert!(cut.from < 0.1 && (cut.to - 120.5).abs() < 0.1, "{cut:?}");
    }

    #[test]
    fn a_slow_turn_about_the_vertical_cuts_a_rest_and_a_drift_does_not() {
        let mut stream = stream(1e-3);
        stream.t = (0..3000).map(|k| 0.01 * f64::from(k)).collect();
        let noise = stream.values[..900].to_vec();
        let of = |rate: &dyn Fn(f64) -> f64| {
            let values = stream.t.iter().zip(noise.iter().cycle());
            let values = values.map(|(&t, v)| v + Vector3::z() * rate(t)).collect();
            let stream = Stream {
                t: stream.t.clone(),
                values,
            };
            let whole = Span {
                from: 0.0,
                to: 29.9,
            };
            Ends::of(&stream, 1.0).without_turns(whole)
        };
        let yaw = |t: f64| {
            if (12.0..18.0).contains(&t) {
                0.0175
            } else {
                0.0
            }
        };
        let pieces = of(&yaw);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        assert!(pieces[0].to < 13.0 && pieces[1].from > 17.0, "{pieces:?}");
        assert_eq!(of(&|t: f64| 1e-3 * t).len(), 1);
    }

    #[test]
    fn a_small_turn_in_the_middle_of_tremor_cuts_an_interval_in_two() {
        let quiet = Span { from: 0.0, to: 9.0 };
        let mut stream = stream(2e-2);
        let ends = |stream: &Stream| Ends::of(stream, 1.0).without_turns(quiet);
        assert_eq!(ends(&stream), [quiet]);
        // 6° within .5 s.
        for (t, w) in stream.t.iter().zip(&mut stream.values) {
            w.y += if (4.0..4.5).contains(t) { 0.2 } else { 0.0 };
        }
        let pieces = ends(&stream);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        assert!(pieces[0].to > 3.0 && pieces[0].to <= 4.0, "{pieces:?}");
        assert!(pieces[1].from < 5.5 && pieces[1].from >= 4.5, "{pieces:?}");
    }

    #[test]
    fn noise_and_a_constant_bias_leave_an_interval_whole() {
        let quiet = Span { from: 0.0, to: 9.0 };
        for noise in [0.0, 1e-3, 2e-2] {
            let stream = stream(noise);
            assert_eq!(Ends::of(&stream, 1.0).trimmed(quiet), quiet);
        }
    }

    #[test]
    fn counts_are_cut_as_radians_per_second_are() {
        let whole = Span {
            from: 0.0,
            to: 10.0,
        };
        let mut counts = stream(1e-3);
        counts.values.iter_mut().for_each(|v| *v *= 1000.0);
        let cut = Ends::of(&counts, 1e-3).trimmed(whole);
        assert_eq!(cut, Ends::of(&stream(1e-3), 1.0).trimmed(whole));
    }

    /// 100 Hz for `seconds` with this rate about z, and noise of 1e-3 rad/s.
    fn turning(seconds: f64, rate: impl Fn(f64) -> f64) -> Stream {
        let mut stream = stream(1e-3);
        let noise: Vec<f64> = stream.values.iter().map(|v| v.y).collect();
        stream.t = (0..(100.0 * seconds) as usize)
            .map(|k| 0.01 * k as f64)
            .collect();
        let value = |(k, &t): (usize, &f64)| {
            let noise = |place: usize| noise[(k * place) % noise.len()];
            Vector3::new(0.02 + noise(1), noise(3), rate(t) + noise(7))
        };
        stream.values = stream.t.iter().enumerate().map(value).collect();
        stream
    }

    #[test]
    fn a_device_that_swings_is_seen_and_a_hand_that_trembles_is_not() {
        let span = Span { from: 0.0, to: 9.0 };
        let swung = |rate: fn(f64) -> f64| {
            let found = Ends::of(&turning(9.0, rate), 1.0).swings(span);
            found.iter().map(Span::length).sum::<f64>()
        };
        assert!(swung(|t| wave(t, 1.0)) > 8.0);
        assert!(Ends::of(&turning(9.0, |t| 0.1 * wave(t, 0.7)), 1.0).moves(span));
        assert!(!Ends::of(&turning(9.0, |t| 0.05 * wave(t, 6.0)), 1.0).moves(span));
        assert_eq!(swung(|t| 0.05 * wave(t, 6.0)), 0.0);
        assert_eq!(swung(|t| 0.05 * wave(t, 12.0)), 0.0);
    }

    fn wave(t: f64, hertz: f64) -> f64 {
        (std::f64::consts::TAU * hertz * t).sin()
    }

    #[test]
    fn a_long_interval_with_a_bias_that_walks_stays_whole() {
        let whole = Span {
            from: 0.0,
            to: 4000.0,
        };
        // 0.2 °/s in the course of it, as while a device warms up.
        let stream = turning(4000.0, |t| 3.5e-3 * t / 4000.0);
        let cut = Ends::of(&stream, 1.0).trimmed(whole);
        assert!(cut.length() > 3990.0, "{cut:?}");
    }
}
