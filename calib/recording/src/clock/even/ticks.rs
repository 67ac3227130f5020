//! Number of steps between stamps, by a search over whole numbers.
//!
//! Rounding one step at a time miscounts as soon as two stamps scatter by half a step between them. Here
//! several counts are followed side by side, each with a phase and a period that track the stamps, and the
//! cheapest way from the first stamp to the last is kept (Viterbi 1967).

use super::scatter::{LAG, Scatter};

findings::tuning! {
    /// Counts followed side by side at most.
    COUNTS: usize = 24;

    /// Cost of a sample left out.
    LOST: f64 = 9.0;
    /// Most that a stamp's own scatter costs: a stamp that is late by chance is not a lost sample.
    MOST: f64 = 4.5;

    /// Counts dearer than the cheapest by this are given up.
    HOPELESS: f64 = 30.0;

    /// The most that correlated scatter makes of [`LOST`].
    CORRELATED: f64 = 50.0;

    /// Paths with one count and phases nearer than this, in steps, are one.
    ALIKE: f64 = 0.6;

    /// Scatter about the tracked clock, in steps, up to which the nearest whole number is right.
    CLEAR: f64 = 0.3;

    /// Sixteen steps scatter by so much more than one where samples are lost in one stretch of a hundred.
    CORRELATED_BY_LOSSES: f64 = 1.5;
}

/// Steps between the first stamp and each, lost ones counted, and the scatter; `None` where they are too few.
pub(crate) fn ticks(stamps: &[f64]) -> Option<(Vec<u32>, Scatter)> {
    if let Some(scatter) = Scatter::rounded(stamps) {
        return Some(((0..).take(stamps.len()).collect(), scatter));
    }
    let scatter = Scatter::of(stamps)?;
    if let Some(ticks) = Tracker::new(&scatter).nearest(stamps) {
        return Some((ticks, scatter));
    }
    if scatter.correlation < CORRELATED_BY_LOSSES.get() {
        return Some(searched(stamps, scatter).0);
    }
    let Some(unbroken) = Scatter::unbroken(stamps) else {
        return Some(searched(stamps, scatter).0);
    };
    if let Some(ticks) = Tracker::new(&unbroken).nearest(stamps) {
        return Some((ticks, unbroken));
    }
    let (first, cost) = searched(stamps, scatter);
    let (second, other) = searched(stamps, unbroken);
    Some(if other + LOST.get() < cost {
        second
    } else {
        first
    })
}

/// The ticks by a search, once more with the scatter that the first leaves, and their cost.
fn searched(stamps: &[f64], scatter: Scatter) -> ((Vec<u32>, Scatter), f64) {
    let tracker = Tracker::new(&scatter);
    let (ticks, _) = tracker.search(stamps);
    let own = tracker.innovation(stamps, &ticks) - scatter.adding;
    let again = Scatter {
        own: (own / (1.0 + tracker.gain)).max(0.1 * scatter.own),
        ..scatter
    };
    let tracker = Tracker::new(&again);
    let (ticks, cost) = tracker.search(stamps);
    // Costs are counted in standard deviations, so that those of a smaller one compare.
    let spread = 0.5 * tracker.variance.ln() * stamps.len() as f64;
    ((ticks, again), cost + spread)
}

/// A clock that follows stamps: `α`–`β` filter.
struct Tracker {
    period: f64,
    /// Share of a stamp's surprise that moves the phase, and the period.
    gain: f64,
    drift: f64,
    /// Variance of a surprise, s².
    variance: f64,
    lost: f64,
}

/// Phase and period of one count.
#[derive(Clone, Copy)]
struct State {
    phase: f64,
    period: f64,
}

/// One count on its way.
#[derive(Clone, Copy)]
struct Path {
    state: State,
    tick: u32,
    cost: f64,
    /// Its place among the steps taken.
    step: u32,
}

/// A step of a path: where it came from, and the tick.
#[derive(Clone, Copy)]
struct Step {
    before: u32,
    tick: u32,
}

impl Tracker {
    fn new(scatter: &Scatter) -> Self {
        let ratio = if scatter.own > 0.0 {
            scatter.adding / scatter.own
        } else {
            0.0
        };
        let gain = 0.5 * ((ratio * ratio + 4.0 * ratio).sqrt() - ratio);
        let gain = gain.max(3.0 / LAG.get() as f64);
        let floor = 1e-4 * scatter.period;
        Self {
            period: scatter.period,
            gain,
            drift: 6.0 / (LAG.get() * (LAG.get() + 1)) as f64,
            variance: (scatter.own * (1.0 + gain) + scatter.adding).max(floor * floor),
            lost: LOST.get() * scatter.correlation.clamp(1.0, CORRELATED.get()),
        }
    }

    /// Returns two initial states: the median phase of the first stamps, which lost samples among them shift, and the phase of the
    /// first stamp.
    fn begin(&self, stamps: &[f64]) -> [State; 2] {
        let first = stamps.iter().take(LAG.get()).enumerate();
        let mut phases: Vec<f64> = first.map(|(k, s)| s - k as f64 * self.period).collect();
        phases.sort_by(f64::total_cmp);
        [phases[phases.len() / 2], stamps[0]].map(|phase| State {
            phase,
            period: self.period,
        })
    }

    /// The state after a stamp that is `steps` on.
    fn follow(&self, state: &State, stamp: f64, steps: f64) -> (State, f64) {
        let expected = state.phase + steps * state.period;
        let surprise = stamp - expected;
        let most = 3.0 * self.variance.sqrt();
        let taken = surprise.clamp(-most, most);
        let next = State {
            phase: expected + self.gain * taken,
            period: state.period + self.drift * taken / steps,
        };
        (next, surprise)
    }

    /// The nearest whole numbers, where all are beyond doubt.
    fn nearest(&self, stamps: &[f64]) -> Option<Vec<u32>> {
        let [_, mut state] = self.begin(stamps);
        let mut ticks = Vec::with_capacity(stamps.len());
        let mut tick = 0;
        for (k, stamp) in stamps.iter().enumerate() {
            let steps = ((stamp - state.phase) / state.period).round().max(1.0);
            let steps = if k == 0 { 0.0 } else { steps };
            let surprise = if k == 0 {
                stamp - state.phase
            } else {
                let (next, surprise) = self.follow(&state, *stamp, steps);
                state = next;
                surprise
            };
            if surprise.abs() > CLEAR.get() * self.period {
                return None;
            }
            tick += steps as u32;
            ticks.push(tick);
        }
        Some(ticks)
    }

    /// The cheapest ticks and what they cost.
    fn search(&self, stamps: &[f64]) -> (Vec<u32>, f64) {
        let mut steps: Vec<Step> = vec![Step { before: 0, tick: 0 }];
        let begin = |state| Path {
            state,
            tick: 0,
            cost: 0.0,
            step: 0,
        };
        let mut paths: Vec<Path> = self.begin(stamps).into_iter().map(begin).collect();
        let mut next: Vec<Path> = Vec::new();
        for stamp in stamps.iter().skip(1) {
            next.clear();
            for path in &paths {
                self.spread(path, *stamp, &mut next);
            }
            next.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            let hopeless = next[0].cost + HOPELESS.get() + self.lost - LOST.get();
            paths.clear();
            for candidate in &next {
                if candidate.cost > hopeless || paths.len() == COUNTS.get() {
                    break;
                }
                if paths.iter().any(|p| self.is_same(p, candidate)) {
                    continue;
                }
                let place = steps.len() as u32;
                steps.push(Step {
                    before: candidate.step,
                    tick: candidate.tick,
                });
                paths.push(Path {
                    step: place,
                    ..*candidate
                });
            }
        }
        let mut ticks = vec![0; stamps.len()];
        let mut at = paths[0].step;
        for tick in ticks.iter_mut().rev() {
            *tick = steps[at as usize].tick;
            at = steps[at as usize].before;
        }
        (ticks, paths[0].cost)
    }

    /// Returns true if two paths have the same tick and nearly the same phase.
    fn is_same(&self, one: &Path, other: &Path) -> bool {
        let apart = (one.state.phase - other.state.phase).abs();
        one.tick == other.tick && apart < ALIKE.get() * self.period
    }

    /// The ways on from a path to the next stamp.
    fn spread(&self, path: &Path, stamp: f64, out: &mut Vec<Path>) {
        let away = (stamp - path.state.phase) / path.state.period;
        let far = away.floor().max(0.0) as u32;
        let mut add = |steps: u32| {
            let (state, surprise) = self.follow(&path.state, stamp, f64::from(steps));
            let own = (0.5 * surprise * surprise / self.variance).min(MOST.get());
            let lost = if steps > 1 { self.lost } else { 0.0 };
            out.push(Path {
                state,
                tick: path.tick + steps,
                cost: path.cost + own + lost,
                step: path.step,
            });
        };
        add(1);
        (far.max(2)..=far + 2).for_each(&mut add);
    }

    /// The mean square of the surprises along given ticks, those beyond three standard deviations left out.
    fn innovation(&self, stamps: &[f64], ticks: &[u32]) -> f64 {
        let [mut state, _] = self.begin(stamps);
        let (mut sum, mut count) = (0.0, 0.0);
        for (stamp, pair) in stamps.iter().skip(1).zip(ticks.windows(2)) {
            let (next, surprise) = self.follow(&state, *stamp, f64::from(pair[1] - pair[0]));
            state = next;
            if surprise * surprise < 9.0 * self.variance {
                sum += surprise * surprise;
                count += 1.0;
            }
        }
        if count > 0.0 {
            // What is cut off at three standard deviations is 2.7 % of the variance.
            sum / count / 0.973
        } else {
            self.variance
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Stamps on a wandering clock of unit period with lost samples, and their true ticks.
    fn recorded(seed: u64, noise: f64, gaps: usize) -> (Vec<f64>, Vec<u32>) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let count = 30_000;
        let mut places: Vec<usize> = (0..gaps)
            .map(|_| random.random_range(200..count - 200))
            .collect();
        places.sort_unstable();
        places.dedup_by(|a, b| *a - *b < 100);
        let (mut stamps, mut ticks) = (Vec::new(), Vec::new());
        let mut tick = 0;
        for k in 0..count {
            if k > 0 {
                tick += 1;
            }
            if places.binary_search(&k).is_ok() {
                tick += random.random_range(1..=50);
            }
            let ideal = f64::from(tick);
            let period = 600.0 * 60.0;
            // Rate off by 100 ppm at most, to and fro.
            let wander = 1e-4 * period / std::f64::consts::TAU
                * (std::f64::consts::TAU * ideal / period).sin();
            let own: f64 = StandardNormal.sample(&mut random);
            stamps.push(0.01 * (ideal + wander + noise * own));
            ticks.push(tick);
        }
        (stamps, ticks)
    }

    #[test]
    fn ticks_are_counted_through_noise_of_four_tenths_of_a_step() {
        for noise in [0.1, 0.2, 0.3, 0.4] {
            for seed in 0..3 {
                let (stamps, truth) = recorded(seed, noise, 20);
                let (found, _) = ticks(&stamps).unwrap();
                // Per stamp: the count of one lost a step early or late is right again at once.
                let wrong = found.iter().zip(&truth).filter(|(a, b)| a != b).count();
                assert!(wrong as f64 <= 1.2e-4 * 30_000.0, "{noise} {seed}: {wrong}");
                assert_eq!(found.last(), truth.last(), "{noise} {seed}");
            }
        }
    }

    #[test]
    fn stamps_rounded_to_a_millisecond_lose_no_sample() {
        for rate in [59.7, 99.75, 104.0, 200.3, 400.0, 416.7, 833.0, 952.0] {
            let rounded: Vec<f64> = (0..30_000)
                .map(|k| (f64::from(k) / rate * 1e3).round() / 1e3)
                .collect();
            let (found, _) = ticks(&rounded).unwrap();
            assert!(found.iter().zip(0..).all(|(a, b)| *a == b), "{rate}");
        }
    }

    #[test]
    fn many_lost_samples_are_counted() {
        let mut random = ChaCha8Rng::seed_from_u64(9);
        let (mut stamps, mut truth) = (Vec::new(), Vec::new());
        for tick in 0..20_000_u32 {
            let own: f64 = StandardNormal.sample(&mut random);
            if tick == 0 || random.random_range(0.0..1.0) > 0.03 {
                stamps.push(0.01 * (f64::from(tick) + 0.15 * own));
                truth.push(tick);
            }
        }
        let (found, _) = ticks(&stamps).unwrap();
        let wrong = found.iter().zip(&truth).filter(|(a, b)| a != b).count();
        // Single losses are found, if a sample or two early or late where noise hides the place.
        assert!(wrong < found.len() / 200, "{wrong}");
        assert_eq!(found.last(), truth.last());
    }
}
