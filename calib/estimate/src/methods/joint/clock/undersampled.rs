//! Turns in which the rate jumps between samples, and by how much they miss.

use recording::intervals::Span;

use super::sampling::Share;
use crate::methods::joint::fit::JointFit;

findings::tuning! {
    /// Log-likelihood over the noise of the readings that makes a name of a share that the turns tell from a scatter that is the
    /// same for all.
    BEATS_NOISE: f64 = 5.0;

    /// Log-likelihood over the noise that has to remain without the turn that gains most: a single turn that is off is an
    /// outlier.
    OF_MORE_THAN_ONE: f64 = 2.0;

    /// No more than the whole jump can be missing: a share that ends there makes up for something else.
    LIMIT: f64 = 0.99;

    /// A turn with this share of the variance of the worst is shown.
    SHOWN: f64 = 0.1;
}

/// Rotation missing between the samples of one recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Undersampled {
    /// Place of the recording.
    pub recording: usize,
    /// The share that is missing.
    pub share: Share,
    /// True if the turns miss by more than the noise of the readings, and more than one of them does.
    pub is_evident: bool,
    /// Error of a turn that it explains: root mean square over all turns, rad.
    pub rms: f64,
    /// The turns that it makes most of: the static interval before, when, and how much, rad; worst first.
    pub turns: Vec<(usize, Span, f64)>,
}

impl JointFit {
    /// The recordings that miss something between samples.
    pub fn undersampled(&self) -> Vec<Undersampled> {
        let shares = self.data.sources.iter().map(|s| s.clock.sampling);
        let found: Vec<(usize, Share)> = shares
            .enumerate()
            .filter(|(_, share)| share.value > 0.0)
            .collect();
        if found.is_empty() {
            return Vec::new();
        }
        let by_share = self.rows().noise(self.parameters.values()).by_share;
        let of = |(recording, share): (usize, Share)| {
            let turns = self.data.turns.iter().zip(&by_share);
            let mut turns: Vec<(usize, Span, f64)> = turns
                .filter(|(turn, _)| turn.recording == recording)
                .map(|(turn, c)| {
                    (
                        turn.turn,
                        turn.span,
                        share.value * c.trace().max(0.0).sqrt(),
                    )
                })
                .collect();
            let square: f64 = turns.iter().map(|t| t.2 * t.2).sum();
            let rms = (square / turns.len().max(1) as f64).sqrt();
            turns.sort_by(|a, b| b.2.total_cmp(&a.2));
            let worst = turns.first().map_or(0.0, |t| t.2);
            turns.retain(|t| t.2 * t.2 > SHOWN.get() * worst * worst);
            Undersampled {
                recording,
                share,
                is_evident: is_evident(&share),
                rms,
                turns,
            }
        };
        found.into_iter().map(of).collect()
    }
}

fn is_evident(share: &Share) -> bool {
    share.value < LIMIT.get()
        && share.over_noise > BEATS_NOISE.get()
        && share.over_noise_without_one > OF_MORE_THAN_ONE.get()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_takes_more_than_one_turn_and_less_than_the_whole_jump() {
        let share = |value: f64, over_noise: f64, over_noise_without_one: f64| Share {
            value,
            over_noise,
            over_noise_without_one,
            ..Share::default()
        };
        // A phone that was laid down ten times by hand; a turn that lost samples; a turn beside a gyroscope at its range.
        assert!(is_evident(&share(0.25, 6.7, 2.2)));
        assert!(!is_evident(&share(0.6, 366.0, 0.0)));
        assert!(!is_evident(&share(1.0, 7.0, 3.6)));
    }
}
