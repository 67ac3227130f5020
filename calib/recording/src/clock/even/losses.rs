//! Samples lost between bursts: a loss is where the stamps stay behind for good.
//!
//! The last sample of a burst is late by its way to the host. A burst that was late once is on time again with the next: what
//! counts is the level over several bursts, after a place less before it.
//!
//! ```text
//! late  ▁▂▁▁█▁▂▁▁▁▂▁▁▅▅▆▅▅█▅▅▆▅▅     █ late once      ▅ behind by a step from here on: a sample is lost
//! ```

use std::collections::VecDeque;

use crate::order_statistic::nth_smallest;

/// Bursts on either side that a level is taken over, fewest first; together they hold so many samples and more.
const WIDTHS: [usize; 6] = [2, 4, 8, 16, 32, 64];

findings::tuning! {
    /// Samples that the bursts on either side hold together, at least.
    SAMPLES: f64 = 16.0;

    /// Standard deviation of the rises and falls between two levels, in steps, that tells one step from none.
    CLEAR: f64 = 0.12;
    /// Largest of the falls, in steps, that do.
    FALLS: f64 = 0.4;

    /// A rise of less than this share of a step is chance.
    LEAST: f64 = 0.5;
    /// A rise of fewer standard deviations is chance.
    DEVIATIONS: f64 = 5.0;
    /// A rise no larger than the falls times this is chance: stamps that fall back were not behind for good.
    OVER_FALLS: f64 = 1.2;

    /// Places that suffice for the scatter of the rises.
    ENOUGH: usize = 4096;
}

/// Width of the central 80 % of a normal variable, in standard deviations.
const CENTRAL: f64 = 2.563;

/// Steps without a sample before each burst, from how late (s) the last sample of each is; `period` is the step, s, and `size`
/// the usual number of samples in a burst.
pub(super) fn lost_before(late: &[f64], period: f64, size: f64) -> Vec<u32> {
    let mut lost = vec![0; late.len()];
    let Some(best) = Rises::clearest(late, period, size) else {
        return lost;
    };
    // Rises that were counted, with the place where they were found.
    let mut counted: Vec<(usize, u32)> = Vec::new();
    let levels = best.level.of_all(late, best.width);
    // Of fewer bursts near an end nothing is told.
    let half = best.width / 2;
    for at in half..(late.len() + 1).saturating_sub(half) {
        // From the end of the window before on, and with as many after it, the levels are at hand.
        let before = at.checked_sub(best.width).map(|from| levels[from]);
        let rise = match before.zip(levels.get(at)) {
            Some((before, after)) => after - before - best.usual,
            None => best.at(late, at),
        };
        let is_loss = rise > best.least(late.len(), at, period) && best.stays(late, at, period);
        if !is_loss {
            continue;
        }
        let steps = (rise / period).round().max(1.0) as u32;
        let recent = counted.iter().rev();
        let recent = recent.take_while(|(found, _)| found + best.width > at);
        let more = steps.saturating_sub(recent.map(|(_, steps)| steps).sum());
        if more > 0 {
            counted.push((at, more));
            lost[best.place(at, late.len())] += more;
        }
    }
    lost
}

/// The standard deviation of values, by their central 80 %; `None` of none.
pub(super) fn spread(values: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let last = values.clone().count().checked_sub(1)?;
    let low = nth_smallest(values.clone(), last / 10)?;
    let high = nth_smallest(values, last - last / 10)?;
    Some((high - low) / CENTRAL)
}

/// The burst that stands for several: the least late one where lateness is one-sided, else the middle one.
#[derive(Clone, Copy, Debug)]
enum Level {
    Least,
    Median,
}

impl Level {
    fn of(self, late: &[f64]) -> f64 {
        let rank = match self {
            Self::Least => 0,
            Self::Median => late.len() / 2,
        };
        nth_smallest(late.iter().copied(), rank).unwrap_or(0.0)
    }

    /// The levels of `width` bursts, from each on.
    fn of_all(self, late: &[f64], width: usize) -> Vec<f64> {
        match self {
            Self::Least => sliding_least(late, width),
            Self::Median => late.windows(width).map(|window| self.of(window)).collect(),
        }
    }
}

/// The least of `width` values, from each on.
fn sliding_least(values: &[f64], width: usize) -> Vec<f64> {
    let mut least = Vec::with_capacity(values.len());
    // Places whose values may still be the least, in the order of both.
    let mut candidates: VecDeque<usize> = VecDeque::new();
    for (at, value) in values.iter().enumerate() {
        while candidates
            .back()
            .is_some_and(|&last| values[last] >= *value)
        {
            candidates.pop_back();
        }
        candidates.push_back(at);
        let Some(from) = (at + 1).checked_sub(width) else {
            continue;
        };
        while candidates.front().is_some_and(|&first| first < from) {
            candidates.pop_front();
        }
        least.extend(candidates.front().map(|&first| values[first]));
    }
    least
}

/// The rise of a level from before a place to after it.
#[derive(Clone, Copy, Debug)]
struct Rises {
    width: usize,
    level: Level,
    /// The usual rise, s: the error of the step over the bursts between.
    usual: f64,
    /// Standard deviation, s.
    scatter: f64,
    /// The largest fall, s, those about a single place left out.
    fall: f64,
    /// The largest usual step from burst to burst (95th percentile), s: near an end, where levels are of fewer bursts, a rise is
    /// larger by it.
    jump: f64,
}

impl Rises {
    /// The narrowest that tell one step from none, or else those that scatter least; `None` of too few bursts.
    fn clearest(late: &[f64], period: f64, size: f64) -> Option<Self> {
        let mut best: Option<Self> = None;
        let enough =
            |width: &usize| *width as f64 * size >= SAMPLES.get() && 4 * width <= late.len();
        for width in WIDTHS.into_iter().filter(enough) {
            for level in [Level::Least, Level::Median] {
                let other = Self::over(late, width, level)?;
                best = match best {
                    Some(best) if best.chance() <= other.chance() => Some(best),
                    _ => Some(other),
                };
            }
            let is_clear = |best: Self| {
                best.scatter < CLEAR.get() * period && best.fall < FALLS.get() * period
            };
            if best.is_some_and(is_clear) {
                break;
            }
        }
        best
    }

    fn over(late: &[f64], width: usize, level: Level) -> Option<Self> {
        let raw = Self {
            width,
            level,
            usual: 0.0,
            scatter: 0.0,
            fall: 0.0,
            jump: 0.0,
        };
        let places = width..late.len().checked_sub(width)?;
        let stride = (places.len() / ENOUGH.get()).max(1);
        let one_place = (2 * width / stride).min(places.len() / stride / 10);
        let all: Vec<f64> = places.step_by(stride).map(|at| raw.at(late, at)).collect();
        let all = || all.iter().copied();
        let usual = nth_smallest(all(), all().count() / 2)?;
        let jumps = late.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        Some(Self {
            usual,
            scatter: spread(all())?,
            fall: usual - nth_smallest(all(), one_place)?,
            jump: nth_smallest(jumps, (late.len() - 1) * 19 / 20)?,
            ..raw
        })
    }

    /// A rise that chance may make, s.
    fn chance(&self) -> f64 {
        (DEVIATIONS.get() * self.scatter).max(OVER_FALLS.get() * self.fall)
    }

    /// The rise at a burst, s.
    fn at(&self, late: &[f64], at: usize) -> f64 {
        self.over_width(late, at, self.width)
    }

    /// Returns true if the rise is also one over twice as many bursts: several that are late by chance are on time again then.
    fn stays(&self, late: &[f64], at: usize, period: f64) -> bool {
        self.over_width(late, at, 2 * self.width) > LEAST.get() * period
    }

    fn over_width(&self, late: &[f64], at: usize, width: usize) -> f64 {
        let before = &late[at.saturating_sub(width)..at];
        let after = &late[at..late.len().min(at + width)];
        let between = 0.5 * (before.len() + after.len()) as f64;
        let usual = self.usual * between / self.width as f64;
        self.level.of(after) - self.level.of(before) - usual
    }

    /// The least rise that is a loss, s.
    fn least(&self, count: usize, at: usize, period: f64) -> f64 {
        let usual = self.chance().max(LEAST.get() * period);
        let is_near_an_end = at < self.width || at + self.width > count;
        usual + if is_near_an_end { self.jump } else { 0.0 }
    }

    /// The first burst behind what is lost, of a rise that begins at a place: the smallest of those after it rises when the last
    /// one before it is passed, the median half a width earlier.
    fn place(&self, at: usize, count: usize) -> usize {
        match self.level {
            Level::Least => at,
            Level::Median => (at + self.width / 2).min(count - 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, Exp1, StandardNormal};

    use super::*;

    const STEP: f64 = 0.039;

    /// The largest error of the count in twenty runs.
    fn lost(lateness: impl Fn(&mut rand_chacha::ChaCha8Rng) -> f64, at: &[(usize, u32)]) -> u32 {
        let mut worst = 0;
        for seed in 0..20 {
            let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
            let mut late: Vec<f64> = (0..500).map(|_| lateness(&mut random)).collect();
            for &(from, steps) in at {
                let behind = STEP * f64::from(steps);
                late[from..].iter_mut().for_each(|late| *late += behind);
            }
            let found = lost_before(&late, STEP, 10.0);
            let whole: u32 = at.iter().map(|(_, steps)| steps).sum();
            worst = worst.max(found.iter().sum::<u32>().abs_diff(whole));
        }
        worst
    }

    #[test]
    fn packets_that_are_late_by_chance_lose_no_sample() {
        let normal = |share: f64| {
            move |random: &mut rand_chacha::ChaCha8Rng| -> f64 {
                let late: f64 = StandardNormal.sample(random);
                share * STEP * late
            }
        };
        let one_sided = |share: f64| {
            move |random: &mut rand_chacha::ChaCha8Rng| -> f64 {
                let late: f64 = Exp1.sample(random);
                share * STEP * late
            }
        };
        for share in [0.05, 0.3, 0.8, 1.5] {
            assert_eq!(lost(normal(share), &[]), 0, "{share}");
            assert_eq!(lost(one_sided(share), &[]), 0, "{share}");
        }
        // Packets of ten samples that never came are found in any of them, to one sample where the stamps scatter by as much.
        let packets = [(200, 10), (350, 20)];
        for share in [0.05, 0.3, 0.8] {
            assert!(lost(normal(share), &packets) <= 1, "{share}");
            assert!(lost(one_sided(share), &packets) <= 1, "{share}");
        }
        assert_eq!(lost(normal(0.1), &packets), 0);
        // Single samples where the scatter is less.
        let single = [(100, 1), (300, 1)];
        assert_eq!(lost(normal(0.1), &single), 0);
        assert_eq!(lost(one_sided(0.1), &single), 0);
    }

    #[test]
    fn the_least_of_a_window_slides_along() {
        let values: Vec<f64> = (0..300)
            .map(|k| f64::from((k * k * 31 + 7 * k) % 101))
            .collect();
        for width in [1, 2, 16, 300] {
            let slow: Vec<f64> = values.windows(width).map(|w| Level::Least.of(w)).collect();
            assert_eq!(sliding_least(&values, width), slow, "{width}");
        }
    }

    #[test]
    fn stamps_that_stay_behind_tell_the_place_of_a_loss() {
        let mut late: Vec<f64> = (0..200)
            .map(|k| 1e-3 * f64::from((k * 31) % 17) / 17.0)
            .collect();
        late[60] += 5.0 * STEP;
        late[120..].iter_mut().for_each(|late| *late += STEP);
        let found = lost_before(&late, STEP, 10.0);
        assert_eq!(found[120], 1);
        assert_eq!(found.iter().sum::<u32>(), 1);
    }
}
