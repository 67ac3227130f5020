//! Stamps that scatter about an even clock.
//!
//! A sensor samples by an oscillator of its own; who stamps the samples rounds to a millisecond or is late
//! by chance. Over a turn, `Σ ω_k h_k` feels that scatter wherever the rate changes from sample to sample:
//! 0.3 ms at 100 samples per second are as much as a consumer grade's noise.

use std::ops::Range;

/// Samples on either side of one that its time is taken from: 1.3 s at 100 per second, longer than the
/// beat of most rates with a millisecond, shorter than the drift of an oscillator.
const REACH: usize = 64;

/// Scatter of the steps, in steps, below which stamps are exact and above which they are no clock.
const SCATTER: Range<f64> = 1e-4..0.3;

/// Share of what independent steps would add up to over [`REACH`] steps, in variance, above which they are
/// believed: the sensor then is read when the host has time, and the stamps say when.
const ADDS_UP: f64 = 0.5;

/// More steps than this at once are an interruption, after which the clock is looked for anew.
const INTERRUPTION: f64 = 5.0;

/// The stamps that an even clock would have given, a line through the neighbours of each; `None` where they
/// are exact, and where their scatter adds up from step to step as that of samples taken unevenly does.
pub(crate) fn evened(t: &[f64]) -> Option<Vec<f64>> {
    let step = super::stream::median_step(t).filter(|step| *step > 0.0)?;
    let runs = runs(t, step);
    let scatter = |reach: usize| -> Option<f64> {
        let squares = runs.iter().flat_map(|run| run.excesses(reach));
        let (sum, count) = squares.fold((0.0, 0), |(sum, n), e| (sum + e * e, n + 1));
        (count > 0).then(|| sum / f64::from(count))
    };
    let single = scatter(1)?;
    if !SCATTER.contains(&(single.sqrt() / step)) {
        return None;
    }
    let bounded = scatter(REACH)? < ADDS_UP * REACH as f64 * single;
    bounded.then(|| runs.iter().flat_map(Run::evened).collect())
}

/// Samples without an interruption.
struct Run<'a> {
    t: &'a [f64],
    /// Steps since the first sample, lost ones counted.
    ticks: Vec<f64>,
    /// Mean length of a step, s.
    step: f64,
}

/// The stamps cut at interruptions.
fn runs(t: &[f64], step: f64) -> Vec<Run<'_>> {
    t.chunk_by(|a, b| b - a <= INTERRUPTION * step)
        .map(|t| Run::new(t, step))
        .collect()
}

impl<'a> Run<'a> {
    fn new(t: &'a [f64], step: f64) -> Self {
        let mut ticks = Vec::with_capacity(t.len());
        let mut tick = 0.0;
        ticks.push(tick);
        for pair in t.windows(2) {
            tick += ((pair[1] - pair[0]) / step).round();
            ticks.push(tick);
        }
        let whole = t.last().zip(t.first()).map_or(0.0, |(b, a)| b - a);
        let step = if tick > 0.0 { whole / tick } else { step };
        Self { t, ticks, step }
    }

    /// Stamp less what an even clock says from the first one on.
    fn excess(&self, k: usize) -> f64 {
        self.t[k] - self.t[0] - self.ticks[k] * self.step
    }

    /// How much longer than an even clock's is each stretch of `reach` samples.
    fn excesses(&self, reach: usize) -> impl Iterator<Item = f64> {
        (reach..self.t.len()).map(move |k| self.excess(k) - self.excess(k - reach))
    }

    /// Every stamp from the line through its neighbours, by sums that move along.
    fn evened(&self) -> Vec<f64> {
        let n = self.t.len();
        let mut sums = Sums::default();
        let mut window = 0..0;
        (0..n)
            .map(|k| {
                sums.move_origin(self.ticks[k] - self.ticks[k.saturating_sub(1)]);
                let mut count = |j: usize, sign: f64| {
                    sums.add(self.ticks[j] - self.ticks[k], self.excess(j), sign);
                };
                let reached = k.saturating_sub(REACH)..(k + REACH + 1).min(n);
                (window.end..reached.end).for_each(|j| count(j, 1.0));
                (window.start..reached.start).for_each(|j| count(j, -1.0));
                window = reached;
                self.t[k] - self.excess(k) + sums.line_at_origin()
            })
            .collect()
    }
}

/// Sums for a line `y` over `x`; those of `x` are of whole numbers and exact.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
}

impl Sums {
    /// Takes a point in, or out by `sign` −1.
    fn add(&mut self, x: f64, y: f64, sign: f64) {
        self.count += sign;
        self.x += sign * x;
        self.y += sign * y;
        self.xx += sign * x * x;
        self.xy += sign * x * y;
    }

    /// The sums for `x − by`.
    fn move_origin(&mut self, by: f64) {
        self.xx += by * (by * self.count - 2.0 * self.x);
        self.xy -= by * self.y;
        self.x -= by * self.count;
    }

    /// The line at `x = 0`.
    fn line_at_origin(&self) -> f64 {
        let spread = self.count * self.xx - self.x * self.x;
        if spread > 0.0 {
            (self.xx * self.y - self.x * self.xy) / spread
        } else {
            self.y / self.count
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn worst(a: &[f64], b: &[f64]) -> f64 {
        let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
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
            // Of steps of 16.75 ms, four in a row are rounded to a mean off by up to an eighth of a millisecond.
            assert!(worst(&rounded, &truth) > 4.5e-4);
            assert!(
                worst(&found, &truth) < 2e-4,
                "{step}: {}",
                worst(&found, &truth)
            );
        }
    }

    #[test]
    fn stamps_late_by_chance_lose_nine_tenths_of_their_scatter() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let truth = even(10_000, 0.01);
        let mut late = || -> f64 { StandardNormal.sample(&mut random) };
        let stamps: Vec<f64> = truth.iter().map(|t| t + 5e-4 * late()).collect();
        let found = evened(&stamps).unwrap();
        let rms = |a: &[f64]| {
            let squares = a.iter().zip(&truth).map(|(a, b)| (a - b).powi(2));
            (squares.sum::<f64>() / truth.len() as f64).sqrt()
        };
        // A line through 129 points has 1/129 of their variance in the middle.
        assert!(rms(&found) < 0.1 * rms(&stamps), "{}", rms(&found));
    }

    #[test]
    fn exact_stamps_and_those_of_uneven_sampling_stay_as_they_are() {
        assert_eq!(evened(&even(1000, 0.01)), None);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(2);
        let mut t = 0.0;
        let uneven: Vec<f64> = (0..10_000)
            .map(|_| {
                let late: f64 = StandardNormal.sample(&mut random);
                t += 0.01 + 5e-4 * late;
                t
            })
            .collect();
        assert_eq!(evened(&uneven), None);
        for few in 0..3 {
            assert_eq!(evened(&uneven[..few]), None);
        }
    }
}
