//! Stamps of samples that arrive in bursts, coarser than the rate: they say when the host read the samples.
//!
//! ```text
//! stamps ─ last sample of each burst, which waited least ─► losses: behind for good ─► line: ±15 to 120 s ─► even clock
//! ```

use super::line::lines;
use super::losses::{lost_before, spread};
use crate::recording::stream::Gap;

findings::tuning! {
    /// A step shorter than this share of the mean is within a burst.
    WITHIN: f64 = 0.2;

    /// Share of such steps from which stamps come in bursts, whatever the other steps are.
    MANY: f64 = 0.4;

    /// The same where hardly any step is of a length between: samples arrive together or one after the other.
    SOME: f64 = 0.02;
    /// A step that is shorter than this share of the mean, and not within a burst, is of a length between.
    BETWEEN: f64 = 0.7;
    /// Share of steps of a length between that is hardly any.
    FEWER: f64 = 0.1;

    /// Parts of the stamps that all have such steps, and others.
    PARTS: usize = 4;
    /// Share of the usual number of them that each part has at least.
    EVERYWHERE: f64 = 0.25;

    /// Seconds on either side that a sample's time is taken from, at least.
    REACH: f64 = 15.0;
    /// The same at most.
    FARTHEST: f64 = 120.0;

    /// Error of the rate over a turn of a second that is sought by reaching farther: bursts that scatter by `σ` and are `B` apart
    /// make one of `σ √B / reach`, √s.
    SLOPE: f64 = 1e-4;

    /// An interruption: this many mean steps, beyond a whole burst.
    INTERRUPTION: f64 = 20.0;

    /// Steps that the period is looked for over.
    LAG: usize = 512;

    /// The step is found again with the samples that were lost, so many times at most.
    PASSES: usize = 3;

    /// Bursts that arrive late by more than the longest usual step, as a share: more, and no even clock is behind.
    LATER: f64 = 0.02;

    /// More steps than this between neighbours on the even clock: a sample is missing.
    MISSING: f64 = 1.5;
}

/// Samples that arrive together, and the even clock behind them.
#[derive(Clone, Debug, PartialEq)]
pub struct Bursts {
    /// Samples of a burst, on average.
    pub size: f64,
    /// The even clock, s.
    pub even: Vec<f64>,
    /// Its mean step, s.
    pub step: f64,
    /// Steps without a sample.
    pub lost: u64,
}

impl Bursts {
    /// True if samples are missing in an interruption of the stamps: a stall of the host delays samples and loses none.
    pub fn loses_samples(&self, gap: &Gap) -> bool {
        let pair = self.even.get(gap.after).zip(self.even.get(gap.after + 1));
        pair.is_none_or(|(before, after)| after - before > MISSING.get() * self.step)
    }
}

/// The even clock behind stamps that come in bursts, or several with one stamp; `None` where they do not.
pub fn bursts(t: &[f64]) -> Option<Bursts> {
    let arrivals = Arrivals::of(t)?;
    let Arrivals { size, period, .. } = arrivals;
    let runs = arrivals.runs(t);
    // Over a burst its error adds up: the usual time over many steps is that of whole bursts.
    let step_of_all = mean_step(&runs, period).unwrap_or(period);
    let mut even = Vec::with_capacity(t.len());
    let (mut time, mut passed, mut lost) = (0.0, 0_u64, 0);
    let (mut read, mut late) = (0, 0);
    let longest = longest_usual_step(t, period) * step_of_all;
    for run in runs {
        let lasts = lasts(run, period);
        // The last burst may be cut: its last sample is none.
        let whole = &lasts[..lasts.len().saturating_sub(1).max(1)];
        let (ticks, step) = ticks(run, &lasts, step_of_all);
        let clock = clock(run, whole, &ticks, step);
        let is_late = |&&k: &&usize| (run[k] - clock[k]).abs() > longest;
        late += whole.iter().filter(is_late).count();
        read += whole.len();
        time += clock[clock.len() - 1] - clock[0];
        even.extend(clock);
        let last = ticks.last().copied().unwrap_or(0);
        passed += u64::from(last);
        lost += u64::from(last + 1) - run.len() as u64;
    }
    let increases = even.windows(2).all(|pair| pair[0] < pair[1]);
    let is_found = increases && passed > 0;
    let is_behind = (late as f64) < LATER.get() * read as f64;
    (is_found && (arrivals.are_many() || is_behind)).then(|| Bursts {
        size,
        even,
        step: time / passed as f64,
        lost,
    })
}

/// The time over the samples where so many arrive together that the median step is one within a burst, or of a wait for the
/// next; `None` for other stamps. In the unit of the stamps.
pub(crate) fn step_of_bursts(t: &[f64]) -> Option<f64> {
    let arrivals = Arrivals::of(t).filter(Arrivals::are_many)?;
    let period = arrivals.period;
    // Stamps whose unit changes on the way have all their short steps in one part.
    let steps: Vec<f64> = t.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let is_short = |step: &&f64| **step < WITHIN.get() * period;
    let has_many = |part: &[f64]| {
        let short = part.iter().filter(is_short).count();
        (MANY.get()..1.0).contains(&(short as f64 / part.len() as f64))
    };
    if !steps.chunks_exact(steps.len() / PARTS.get()).all(has_many) {
        return None;
    }
    Some(mean_step(&arrivals.runs(t), period).unwrap_or(period))
}

/// The arrivals of samples, some of them together.
#[derive(Clone, Copy, Debug)]
struct Arrivals {
    /// The usual time over many steps, per step.
    period: f64,
    /// Share of the steps that are within a burst.
    share: f64,
    /// Samples of a burst, on average.
    size: f64,
}

impl Arrivals {
    /// Looks at stamps, in any unit; `None` where they do not come in bursts.
    fn of(t: &[f64]) -> Option<Self> {
        let whole = t.last()? - t.first()?;
        let least = t.windows(2).map(|pair| pair[1] - pair[0]);
        let least = least.fold(f64::INFINITY, f64::min);
        if t.len() < 100 || least >= WITHIN.get() * whole / (t.len() - 1) as f64 {
            return None;
        }
        let period = period(t)?;
        let steps = t.windows(2).map(|pair| (pair[1] - pair[0]) / period);
        let count = steps.clone().filter(|step| *step < WITHIN.get()).count();
        let between = steps
            .filter(|step| (WITHIN.get()..BETWEEN.get()).contains(step))
            .count() as f64;
        let all = t.len() - 1;
        let found = Self {
            period,
            share: count as f64 / all as f64,
            size: all as f64 / (all - count).max(1) as f64,
        };
        let together = found.share > SOME.get() && between < FEWER.get() * count as f64;
        // A unit or a rate that changes on the way has all its short steps in one part.
        let steps: Vec<f64> = t.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let has_some = |part: &[f64]| {
            let short = part
                .iter()
                .filter(|step| **step < WITHIN.get() * period)
                .count();
            short < part.len() && short as f64 > EVERYWHERE.get() * found.share * part.len() as f64
        };
        if !steps.chunks_exact(steps.len() / PARTS.get()).all(has_some) {
            return None;
        }
        (found.are_many() || together).then_some(found)
    }

    fn are_many(&self) -> bool {
        self.share >= MANY.get()
    }

    /// The stamps between interruptions.
    fn runs<'a>(&self, t: &'a [f64]) -> Vec<&'a [f64]> {
        let most = (INTERRUPTION.get() + 2.0 * self.size) * self.period;
        t.chunk_by(|a, b| b - a <= most).collect()
    }
}

/// The usual time over many steps, per step.
fn period(t: &[f64]) -> Option<f64> {
    let lag = LAG.get().min(t.len() / 4);
    let over = t.windows(lag + 1).map(|w| w[lag] - w[0]);
    let middle = t.len().saturating_sub(lag) / 2;
    let usual = crate::order_statistic::nth_smallest(over, middle)?;
    Some(usual / lag as f64).filter(|period| *period > 0.0)
}

/// The mean step within runs, from the beginning of a burst to that of another.
fn mean_step(runs: &[&[f64]], period: f64) -> Option<f64> {
    let begins = |run: &[f64], k: &usize| run[*k] - run[k - 1] >= WITHIN.get() * period;
    let (mut time, mut steps) = (0.0, 0);
    for run in runs {
        let first = (1..run.len()).find(|k| begins(run, k));
        let last = (1..run.len()).rfind(|k| begins(run, k));
        if let Some((first, last)) = first.zip(last) {
            time += run[last] - run[first];
            steps += last - first;
        }
    }
    (steps > 0 && time > 0.0).then(|| time / steps as f64)
}

/// The last sample of each burst. It waited least: the others were taken before it, however long a stall of the host held them.
fn lasts(run: &[f64], period: f64) -> Vec<usize> {
    let ends = |k: &usize| {
        run.get(k + 1)
            .is_none_or(|next| next - run[*k] >= WITHIN.get() * period)
    };
    (0..run.len()).filter(ends).collect()
}

/// Steps between the first sample and each, and the step.
fn ticks(run: &[f64], lasts: &[usize], usual: f64) -> (Vec<u32>, f64) {
    let mut step = usual;
    let mut lost = vec![0; lasts.len()];
    for _ in 0..PASSES.get() {
        let late: Vec<f64> = lasts.iter().map(|&k| run[k] - k as f64 * step).collect();
        let [first, .., end, _] = lasts else {
            break;
        };
        let between = lasts.len() - 1;
        let size = (end - first) as f64 / (between - 1).max(1) as f64;
        let mut found = lost_before(&late[..between], step, size);
        found.push(0);
        let missing: u32 = found[1..between].iter().sum();
        step = (run[*end] - run[*first]) / ((end - first) as f64 + f64::from(missing));
        let is_settled = found == lost;
        lost = found;
        if is_settled {
            break;
        }
    }
    let mut ticks = Vec::with_capacity(run.len());
    let mut missing = 0;
    for (last, lost) in lasts.iter().zip(lost) {
        missing += lost;
        ticks.extend((ticks.len()..=*last).map(|k| k as u32 + missing));
    }
    (ticks, step)
}

/// The even clock behind the last samples of the bursts, at every sample.
fn clock(run: &[f64], lasts: &[usize], ticks: &[u32], step: f64) -> Vec<f64> {
    let steady = |tick: u32| run[0] + f64::from(tick) * step;
    let places: Vec<u32> = lasts.iter().map(|&k| ticks[k]).collect();
    let late: Vec<f64> = lasts.iter().map(|&k| run[k] - steady(ticks[k])).collect();
    let mut line = lines(&places, &late, REACH.get() / step);
    // The middle of more bursts scatters less from one to the next.
    let scatter = spread(late.iter().zip(&line).map(|(late, line)| late - line)).unwrap_or(0.0);
    let wait = (run[run.len() - 1] - run[0]) / lasts.len() as f64;
    let reach = (scatter * wait.sqrt() / SLOPE.get()).clamp(REACH.get(), FARTHEST.get());
    if reach > REACH.get() {
        line = lines(&places, &late, reach / step);
    }
    let mut after = 0;
    let at = |k: usize| {
        while after + 1 < places.len() && places[after] < ticks[k] {
            after += 1;
        }
        let before = after.saturating_sub(1);
        let passed = f64::from(ticks[k].saturating_sub(places[before]));
        let between = f64::from((places[after] - places[before]).max(1));
        let share = (passed / between).min(1.0);
        steady(ticks[k]) + line[before] + share * (line[after] - line[before])
    };
    (0..run.len()).map(at).collect()
}

/// The longest step but one in twenty, in usual ones.
fn longest_usual_step(t: &[f64], usual: f64) -> f64 {
    let steps = t.windows(2).map(|pair| (pair[1] - pair[0]) / usual);
    let longest = crate::order_statistic::nth_smallest(steps, (t.len() - 1) * 19 / 20);
    longest.unwrap_or(0.0).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arrival of even samples of `rate` at a host that reads every `poll` s, with a number of samples lost.
    fn arrived(rate: f64, poll: f64, lost: &[usize]) -> (Vec<f64>, Vec<f64>) {
        let truth = (0..20_000_usize).filter(|k| !lost.contains(k));
        let truth: Vec<f64> = truth.map(|k| k as f64 / rate).collect();
        let read = truth.iter().enumerate().map(|(k, t)| {
            let jitter = 2e-2 * poll * (k as f64 * 0.7).sin().abs();
            (t / poll).ceil() * poll + jitter
        });
        let mut read: Vec<f64> = read.collect();
        for k in 1..read.len() {
            read[k] = read[k].max(read[k - 1]);
        }
        (truth, read)
    }

    /// By how much the even clock scatters about the truth, s.
    fn scatter(found: &Bursts, truth: &[f64]) -> f64 {
        let late: Vec<f64> = found.even.iter().zip(truth).map(|(a, b)| a - b).collect();
        let mean = late.iter().sum::<f64>() / late.len() as f64;
        let worst = late.iter().map(|l| (l - mean).abs());
        worst.fold(0.0, f64::max)
    }

    #[test]
    fn samples_that_arrive_by_tens_are_on_an_even_clock_again() {
        let truth: Vec<f64> = (0..20_000).map(|k| f64::from(k) * 0.01).collect();
        let arrived: Vec<f64> = (0..20_000)
            .map(|k| truth[k - k % 10 + 9] + 1e-4 * (k % 10) as f64)
            .collect();
        let found = bursts(&arrived).unwrap();
        assert!((found.size - 10.0).abs() < 0.1);
        // A burst is stamped when its last sample is taken: all are late by the same, some 50 ms.
        assert!(scatter(&found, &truth) < 2e-3);
        assert_eq!(bursts(&truth), None);
    }

    #[test]
    fn stamps_coarser_than_the_rate_have_their_even_clock_behind_them() {
        for (rate, poll) in [
            (50.0, 0.032),
            (100.0, 0.016),
            (200.0, 0.016),
            (104.0, 0.02),
            (119.0, 0.01),
        ] {
            let (truth, read) = arrived(rate, poll, &[]);
            let found = bursts(&read).unwrap();
            assert!(
                (found.step * rate - 1.0).abs() < 2e-5,
                "{rate} Hz: {}",
                found.step
            );
            assert!(scatter(&found, &truth) < 0.2 * poll, "{rate} Hz");
            assert_eq!(found.lost, 0);
        }
    }

    #[test]
    fn a_hundred_samples_with_the_stamp_of_a_second_are_on_an_even_clock() {
        let truth: Vec<f64> = (0..12_000).map(|k| f64::from(k) / 104.3).collect();
        let stamps: Vec<f64> = truth.iter().map(|t| t.floor()).collect();
        let found = bursts(&stamps).unwrap();
        // The last second is cut, and has no part in it.
        assert!(scatter(&found, &truth) < 0.7 / 104.3);
        assert!((found.step * 104.3 - 1.0).abs() < 1e-4, "{}", found.step);
        assert_eq!(found.lost, 0);
    }

    #[test]
    fn samples_that_a_stalled_host_reads_at_once_are_on_their_even_clock() {
        // A host that reads every 16 ms, and is held up for 30 to 120 ms now and then.
        for shortest in [0.0, 1e-7, 5e-5, 3e-4] {
            let truth: Vec<f64> = (0..17_000).map(|k| f64::from(k) * 0.01).collect();
            let mut stamps: Vec<f64> = Vec::with_capacity(truth.len());
            for (k, t) in truth.iter().enumerate() {
                let chance = (k.wrapping_mul(2_654_435_761) >> 7) % 1000;
                let stall = if chance < 5 {
                    0.03 + 0.018 * chance as f64
                } else {
                    0.0
                };
                let read = (t / 0.016).ceil() * 0.016 + 5e-7 * chance as f64 + stall;
                stamps.push(stamps.last().map_or(read, |last| read.max(last + shortest)));
            }
            let found = bursts(&stamps).unwrap();
            assert_eq!(found.lost, 0, "{shortest}");
            let stream = crate::recording::Stream {
                values: vec![nalgebra::Vector3::zeros(); stamps.len()],
                t: stamps,
            };
            let gaps = stream.gaps();
            assert!(gaps.len() > 10 && !gaps.iter().any(|gap| found.loses_samples(gap)));
            assert!(
                (found.step * 100.0 - 1.0).abs() < 2e-5,
                "{shortest}: {}",
                found.step
            );
            // Half a wait of the host at the ends of the line.
            assert!(scatter(&found, &truth) < 2e-3, "{shortest}");
        }
    }

    #[test]
    fn packets_that_are_late_by_as_much_as_a_step_have_their_rate() {
        use rand::SeedableRng;
        use rand_distr::{Distribution, StandardNormal};
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let late: Vec<f64> = (0..600)
            .map(|_| {
                let late: f64 = StandardNormal.sample(&mut random);
                0.03 * late
            })
            .collect();
        let truth: Vec<f64> = (0..6000).map(|k| f64::from(k) / 25.5).collect();
        let stamps: Vec<f64> = (0..6000)
            .map(|k| truth[k - k % 10 + 9] + late[k / 10])
            .collect();
        let found = bursts(&stamps).unwrap();
        assert_eq!(found.lost, 0);
        assert!((found.step * 25.5 - 1.0).abs() < 5e-4, "{}", found.step);
        assert!(
            scatter(&found, &truth) < 0.015,
            "{}",
            scatter(&found, &truth)
        );
    }

    #[test]
    fn samples_lost_on_the_way_are_counted() {
        let (truth, read) = arrived(50.0, 0.032, &[2000, 5000, 5001, 9000]);
        let found = bursts(&read).unwrap();
        assert_eq!(found.lost, 4);
        // Of two samples with one stamp nothing tells which was lost: the other is at the time of either, 20 ms apart.
        assert!(scatter(&found, &truth) < 0.021);
        let mean = found.even.iter().sum::<f64>() - truth.iter().sum::<f64>();
        let mean = mean / truth.len() as f64;
        let pairs = found.even.iter().zip(&truth);
        let off = pairs.filter(|(even, truth)| (*even - *truth - mean).abs() > 2e-3);
        assert!(off.count() <= 3, "one beside each loss");
    }

    #[test]
    fn a_rate_or_a_unit_that_changes_on_the_way_makes_no_bursts() {
        for later in [0.1, 0.5, 10.0] {
            let changing = (0..8000_u32).map(|k| match k.checked_sub(4000) {
                None => 0.01 * f64::from(k),
                Some(slow) => 40.0 + later * f64::from(slow),
            });
            assert_eq!(bursts(&changing.collect::<Vec<f64>>()), None, "{later}");
        }
    }

    #[test]
    fn stamps_that_scatter_by_chance_are_no_bursts() {
        let scattered = |share: f64| -> Vec<f64> {
            let by_chance =
                |k: u32| f64::from(k.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24) - 0.5;
            (0..5000)
                .map(|k| 0.01 * (f64::from(k) + share * by_chance(k)))
                .collect()
        };
        for share in [0.05, 0.5, 0.9] {
            assert_eq!(bursts(&scattered(share)), None, "{share}");
        }
    }
}
