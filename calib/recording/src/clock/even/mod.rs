//! The even clock behind stamps that scatter.
//!
//! A sensor samples by an oscillator of its own; who stamps the samples rounds to a millisecond or is late
//! by chance. Over a turn, `Σ ω_k h_k` feels that scatter wherever the rate changes from sample to sample:
//! 0.3 ms at 100 samples per second are as much as a consumer grade's noise. Where the sampling itself is
//! uneven the stamps are right and the even clock is not: which of them holds is fitted with the gyroscope.
//!
//! ```text
//! stamps ─ scatter: period, own, adding ─► ticks: whole steps ─► line: ±15 s of them ─► even clock
//! ```

mod bursts;
mod line;
mod losses;
mod scatter;
mod ticks;
mod usual_step;

pub use bursts::{Bursts, bursts};
use line::lines;
use scatter::{EXACT, Scatter};
pub(crate) use usual_step::usual_step;

findings::tuning! {
    /// Samples on either side of one that its time is taken from, s: longer than the beat of most rates with a
    /// millisecond, shorter than the drift of an oscillator.
    REACH: f64 = 15.0;

    /// Own scatter, in steps, beyond which ticks cannot be counted.
    COUNTED: f64 = 0.45;

    /// Share of a stamp's own variance that steps may add before a clock that follows them is a choice.
    ADDS: f64 = 0.02;

    /// More steps than this at once are an interruption, after which the clock is looked for anew.
    INTERRUPTION: f64 = 50.0;
}

/// An even clock for every stamp.
#[derive(Clone, Debug, PartialEq)]
pub struct EvenClock {
    /// The stamps that it would have given, s.
    pub even: Vec<f64>,
    /// Those of a clock that follows what adds up from step to step, where something does, s.
    pub following: Option<Vec<f64>>,
    /// Median step, s.
    pub step: f64,
    /// Root mean square of stamps less the even clock, s.
    pub scatter: f64,
    /// Steps that passed while the clock was followed.
    pub ticks: u64,
    /// Places where steps passed without a sample.
    pub gaps: usize,
    /// Steps without a sample.
    pub lost: u64,
}

/// Regularity of stamps, with the even clock behind them.
#[derive(Clone, Debug, PartialEq)]
pub enum Stamps {
    /// Even by themselves, or too few to tell.
    Exact,
    /// They scatter about an even clock.
    Scattered(EvenClock),
    /// They scatter by so much that steps cannot be counted.
    Uncountable {
        /// Root mean square of the scatter, in steps.
        share: f64,
        /// Mean step without interruptions, s.
        step: f64,
    },
}

/// Looks for the even clock behind stamps.
pub fn even_clock(t: &[f64]) -> Stamps {
    let Some(step) = crate::recording::stream::median_step(t).filter(|step| *step > 0.0) else {
        return Stamps::Exact;
    };
    let runs: Vec<&[f64]> = t
        .chunk_by(|a, b| b - a <= INTERRUPTION.get() * step)
        .collect();
    let is_even = |run: &&[f64]| is_exact(run, step) && Scatter::rounded(run).is_none();
    if runs.iter().all(is_even) {
        return Stamps::Exact;
    }
    let mut clock = EvenClock {
        even: Vec::with_capacity(t.len()),
        following: None,
        step,
        scatter: 0.0,
        ticks: 0,
        gaps: 0,
        lost: 0,
    };
    let mut worst: f64 = 0.0;
    for run in runs {
        let share = clock.append(run);
        worst = worst.max(share);
    }
    if worst > COUNTED.get() {
        return Stamps::Uncountable {
            share: worst,
            step: mean_step(t, step),
        };
    }
    let squares = t.iter().zip(&clock.even).map(|(s, e)| (s - e).powi(2));
    clock.scatter = (squares.sum::<f64>() / t.len() as f64).sqrt();
    if clock.scatter < EXACT.get() * step {
        return Stamps::Exact;
    }
    Stamps::Scattered(clock)
}

/// Mean step of stamps without interruptions: steps of stamps that come two at a time have no usual one.
fn mean_step(t: &[f64], usual: f64) -> f64 {
    let steps = t.windows(2).map(|pair| pair[1] - pair[0]);
    let steps = steps.filter(|step| *step <= INTERRUPTION.get() * usual);
    let (sum, count) = steps.fold((0.0, 0.0), |(s, n), step| (s + step, n + 1.0));
    sum / f64::max(count, 1.0)
}

/// Returns true if neighbouring stamps are whole multiples of `step`, s, apart.
fn is_exact(run: &[f64], step: f64) -> bool {
    let near = |pair: &[f64]| {
        let steps = (pair[1] - pair[0]) / step;
        (steps - steps.round()).abs() < EXACT.get() * steps.max(1.0)
    };
    run.windows(2).all(near)
}

impl EvenClock {
    /// Adds stamps without an interruption; their own scatter in steps.
    fn append(&mut self, run: &[f64]) -> f64 {
        let from = self.even.len();
        let Some((ticks, scatter)) = ticks::ticks(run) else {
            self.even.extend_from_slice(run);
            if let Some(following) = &mut self.following {
                following.extend_from_slice(run);
            }
            return 0.0;
        };
        let last = ticks.last().copied().unwrap_or(0);
        let jumps = ticks
            .windows(2)
            .map(|pair| u64::from(pair[1] - pair[0] - 1));
        self.ticks += u64::from(last);
        self.gaps += jumps.clone().filter(|&lost| lost > 0).count();
        self.lost += jumps.sum::<u64>();
        let whole = run[run.len() - 1] - run[0];
        let step = if last > 0 {
            whole / f64::from(last)
        } else {
            scatter.period
        };
        let steady = |k: usize| run[0] + f64::from(ticks[k]) * step;
        let excess: Vec<f64> = (0..run.len()).map(|k| run[k] - steady(k)).collect();
        let line = lines(&ticks, &excess, REACH.get() / step);
        self.even
            .extend((0..run.len()).map(|k| steady(k) + line[k]));
        if scatter.adding > ADDS.get() * scatter.own {
            let ratio = scatter.adding / scatter.own.max(f64::MIN_POSITIVE);
            let gain = 0.5 * ((ratio * ratio + 4.0 * ratio).sqrt() - ratio);
            let left: Vec<f64> = excess.iter().zip(&line).map(|(e, l)| e - l).collect();
            let smooth = followed(&ticks, &left, gain.min(1.0));
            let following = self
                .following
                .get_or_insert_with(|| self.even[..from].to_vec());
            following.extend(self.even[from..].iter().zip(&smooth).map(|(e, s)| e + s));
        } else if let Some(following) = &mut self.following {
            following.extend_from_slice(&self.even[from..]);
        }
        scatter.own.sqrt() / scatter.period
    }
}

/// Means of neighbours with weights that fall by `1 − gain` from tick to tick, to both sides.
fn followed(ticks: &[u32], values: &[f64], gain: f64) -> Vec<f64> {
    let n = values.len();
    let pass = |order: &mut dyn Iterator<Item = usize>| {
        let (mut sums, mut before) = (vec![(0.0, 0.0); n], None);
        let mut sum = (0.0, 0.0);
        for k in order {
            let away = before.map_or(0, |b: usize| ticks[b].abs_diff(ticks[k]));
            let kept = (1.0 - gain).powi(away as i32);
            sum = (sum.0 * kept + values[k], sum.1 * kept + 1.0);
            sums[k] = sum;
            before = Some(k);
        }
        sums
    };
    let forward = pass(&mut (0..n));
    let backward = pass(&mut (0..n).rev());
    let mean = |k: usize| {
        let ((a, m), (b, n)) = (forward[k], backward[k]);
        (a + b - values[k]) / (m + n - 1.0)
    };
    (0..n).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    fn worst(a: &[f64], b: &[f64]) -> f64 {
        let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
    }

    fn evened(t: &[f64]) -> Option<Vec<f64>> {
        match even_clock(t) {
            Stamps::Scattered(clock) => Some(clock.even),
            _ => None,
        }
    }

    fn even(n: u32, step: f64) -> Vec<f64> {
        (0..n).map(|k| 3.0 + step * f64::from(k)).collect()
    }

    #[test]
    fn stamps_rounded_to_a_millisecond_are_those_of_the_clock_again() {
        for step in [0.01003, 1.0 / 104.0, 1.0 / 59.7] {
            let mut truth = even(20_000, step);
            // Three samples lost, an interruption of two seconds.
            truth.drain(700..703);
            truth.iter_mut().skip(9000).for_each(|t| *t += 2.0);
            let rounded: Vec<f64> = truth.iter().map(|t| (t * 1e3).round() / 1e3).collect();
            let found = evened(&rounded).unwrap();
            assert!(worst(&rounded, &truth) > 4.5e-4);
            // At the ends of a line through 15 s of stamps their phase in the beat is half averaged.
            assert!(
                worst(&found, &truth) < 1e-4,
                "{step}: {}",
                worst(&found, &truth)
            );
        }
    }

    #[test]
    fn stamps_rounded_to_their_own_step_lose_no_sample() {
        for (step, by) in [(0.01003, 0.01), (0.0201, 0.02)] {
            let truth = even(15_000, step);
            let rounded: Vec<f64> = truth.iter().map(|t| (t / by).round() * by).collect();
            let Stamps::Scattered(clock) = even_clock(&rounded) else {
                panic!("rounded stamps are no exact ones");
            };
            assert_eq!((clock.gaps, clock.lost), (0, 0), "{step}");
            assert!(
                worst(&clock.even, &truth) < 0.1 * by,
                "{}",
                worst(&clock.even, &truth)
            );
            // Samples that are lost leave the even clock, and are counted.
            let mut lossy = even(15_000, by);
            for k in 1..12 {
                lossy.remove(100 * k * k);
            }
            assert_eq!(even_clock(&lossy), Stamps::Exact, "{step}");
        }
    }

    #[test]
    fn stamps_late_by_chance_lose_most_of_their_scatter() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let truth = even(10_000, 0.01);
        let mut late = || -> f64 { StandardNormal.sample(&mut random) };
        let stamps: Vec<f64> = truth.iter().map(|t| t + 2e-3 * late()).collect();
        let found = evened(&stamps).unwrap();
        let rms = |a: &[f64]| {
            let squares = a.iter().zip(&truth).map(|(a, b)| (a - b).powi(2));
            (squares.sum::<f64>() / truth.len() as f64).sqrt()
        };
        // A line through 3001 points has 1/3001 of their variance in the middle, four times that at the ends.
        assert!(rms(&found) < 0.03 * rms(&stamps), "{}", rms(&found));
    }

    #[test]
    fn exact_stamps_are_exact_and_those_of_uneven_steps_have_a_clock_that_follows() {
        assert_eq!(even_clock(&even(1000, 0.01)), Stamps::Exact);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(2);
        let mut t = 0.0;
        let uneven: Vec<f64> = (0..10_000)
            .map(|_| {
                let late: f64 = StandardNormal.sample(&mut random);
                t += 0.01 + 5e-4 * late;
                t
            })
            .collect();
        let Stamps::Scattered(clock) = even_clock(&uneven) else {
            panic!("steps that scatter by 5 % are no exact ones");
        };
        let following = clock.following.unwrap();
        let rms = |a: &[f64]| {
            let squares = a.iter().zip(&uneven).map(|(a, b)| (a - b).powi(2));
            (squares.sum::<f64>() / uneven.len() as f64).sqrt()
        };
        assert!(rms(&following) < 0.2 * rms(&clock.even));
        for few in 0..3 {
            assert_eq!(evened(&uneven[..few]), None);
        }
    }

    #[test]
    fn samples_without_a_stamp_are_counted() {
        let mut stamps: Vec<f64> = even(5000, 0.01)
            .iter()
            .map(|t| (t * 400.0).round() / 400.0 + 1e-3 * (t * 1e4).sin())
            .collect();
        stamps.drain(1000..1003);
        stamps.drain(3000..3001);
        let Stamps::Scattered(clock) = even_clock(&stamps) else {
            panic!("stamps that scatter by a millisecond are no exact ones");
        };
        assert_eq!((clock.gaps, clock.lost, clock.ticks), (2, 4, 4999));
    }
}
