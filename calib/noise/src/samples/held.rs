//! Readings that repeat the one before on all three axes.

use nalgebra::Vector3;
use recording::intervals::Span;

findings::tuning! {
    /// Longest runs that are kept.
    KEPT: usize = 4;

    /// A run of equal readings is no chance where it would be met once in so many recordings.
    NO_CHANCE: f64 = 1e-6;

    /// Shortest run that is named, samples.
    SHORTEST: usize = 5;

    /// Share of the samples that repeat by something other than chance from which it is said.
    SHARE: f64 = 0.02;

    /// The same repeat more often than chance by so many standard deviations of what chance gives.
    EVIDENT: f64 = 6.0;

    /// Rounds in which the share that is held settles.
    ROUNDS: usize = 30;
}

/// Readings that were held.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Held {
    /// Share of the samples that repeat the one before by more than chance.
    pub share: f64,
    /// The longest runs of equal readings, where they are no chance, longest first.
    pub stretches: Vec<Span>,
}

/// Counts equal neighbours.
#[derive(Clone, Debug, Default)]
pub(crate) struct Repeats {
    samples: usize,
    /// Neighbours that are equal on each axis, and on all.
    equal: [usize; 3],
    all: usize,
    last: Option<(f64, Vector3<f64>)>,
    run: Option<(f64, usize)>,
    longest: Vec<(usize, Span)>,
}

impl Repeats {
    /// The next sample.
    pub fn push(&mut self, t: f64, value: &Vector3<f64>) {
        self.samples += 1;
        let Some((before, last)) = self.last.replace((t, *value)) else {
            return;
        };
        for (count, (a, b)) in self.equal.iter_mut().zip(last.iter().zip(value.iter())) {
            *count += usize::from(a == b);
        }
        if last == *value {
            self.all += 1;
            let (_, length) = self.run.get_or_insert((before, 1));
            *length += 1;
        } else {
            self.close(before);
        }
    }

    fn close(&mut self, to: f64) {
        let Some((from, length)) = self.run.take() else {
            return;
        };
        self.longest.push((length, Span { from, to }));
        self.longest
            .sort_by_key(|(length, _)| std::cmp::Reverse(*length));
        self.longest.truncate(KEPT.get());
    }

    /// Returns the held readings that chance does not explain: an axis with a resolution coarser than its noise repeats
    /// by itself.
    pub fn held(mut self) -> Held {
        if let Some((t, _)) = self.last {
            self.close(t);
        }
        let pairs = self.samples.saturating_sub(1).max(1);
        if self.all == pairs {
            return Held::default();
        }
        // Neighbours that are equal within the runs to be judged say nothing of chance.
        let within: usize = self.longest.iter().map(|(length, _)| length - 1).sum();
        let (all, share) = (self.all - within, (pairs - within).max(1) as f64);
        let equal = self.equal.map(|n| (n - within) as f64 / share);
        let (_, chance) = held_and_chance(equal, all as f64 / share);
        let pairs = pairs as f64;
        let chance = chance.max(pairs.powi(-3));
        let (share, _) = held_and_chance(
            self.equal.map(|n| n as f64 / pairs),
            self.all as f64 / pairs,
        );
        // Of an axis that hardly ever changes, nearly all readings repeat by chance, and the few others tell little.
        let by_chance: f64 = self.equal.iter().map(|&n| n as f64 / pairs).product();
        let more = self.all as f64 / pairs - by_chance;
        let is_evident = more > EVIDENT.get() * (by_chance * (1.0 - by_chance) / pairs).sqrt();
        let is_no_chance = |length: usize| {
            length >= SHORTEST.get() && pairs * chance.powi(length as i32 - 1) < NO_CHANCE.get()
        };
        let stretches = self
            .longest
            .iter()
            .filter(|(length, _)| is_no_chance(*length));
        Held {
            stretches: stretches.map(|(_, span)| *span).collect(),
            share: if share > SHARE.get() && is_evident {
                share
            } else {
                0.0
            },
        }
    }
}

/// The share that is held, and the chance that all axes repeat where nothing is: `all = h + (1 − h) Π (equalᵢ − h)/(1 − h)`.
fn held_and_chance(equal: [f64; 3], all: f64) -> (f64, f64) {
    let (mut held, mut chance) = (0.0, 1.0);
    for _ in 0..ROUNDS.get() {
        let by_chance = equal.map(|q| ((q - held) / (1.0 - held)).clamp(0.0, 1.0));
        chance = by_chance.iter().product();
        held = ((all - chance) / (1.0 - chance).max(1e-9)).clamp(0.0, 1.0 - 1e-9);
    }
    (held, chance)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings with steps of `step` that spread by 1.
    fn held(step: f64, hold: impl Fn(usize) -> bool) -> Held {
        let mut repeats = Repeats::default();
        let mut value = Vector3::zeros();
        let mut state = 1_u64;
        for k in 0..20_000 {
            if !hold(k) {
                value = Vector3::from_fn(|_, _| {
                    state = state
                        .wrapping_mul(6_364_136_223_846_793_005)
                        .wrapping_add(1);
                    let uniform = (state >> 33) as f64 / f64::from(1_u32 << 31);
                    ((3.4 * uniform) / step).round() * step
                });
            }
            repeats.push(k as f64 * 0.01, &value);
        }
        repeats.held()
    }

    #[test]
    fn a_stretch_that_stands_still_is_found_with_its_time() {
        for step in [1e-3, 1.0] {
            let found = held(step, |k| (5000..5200).contains(&k));
            let [stretch] = found.stretches[..] else {
                panic!("{found:?}");
            };
            assert!((stretch.from - 49.99).abs() < 0.011 && (stretch.to - 51.99).abs() < 0.031);
        }
    }

    #[test]
    fn readings_that_are_coarser_than_their_noise_are_not_held() {
        for step in [1e-3, 0.5, 1.0, 4.0, 20.0] {
            assert_eq!(held(step, |_| false), Held::default(), "{step}");
        }
    }

    #[test]
    fn a_sensor_slower_than_the_rows_has_its_share() {
        let found = held(1e-3, |k| k % 2 == 1);
        assert!((found.share - 0.5).abs() < 0.01, "{found:?}");
        assert_eq!(found.stretches, []);
    }
}
