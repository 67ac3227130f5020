//! The clocks that the turns of the recordings go by.

use super::SourceClock;
use super::windows::means_over_windows;
use crate::methods::joint::data::Data;

impl Data {
    /// The recordings whose clock has a share to be chosen.
    pub(crate) fn with_scatter(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self
            .turns
            .iter()
            .filter(|turn| !turn.clocks.is_empty())
            .map(|turn| turn.recording)
            .collect();
        all.dedup();
        all
    }

    /// Returns the number of even clocks that fit the stamps of a recording.
    pub(crate) fn bases(&self, recording: usize) -> usize {
        let own = self.turns.iter().find(|turn| turn.recording == recording);
        own.map_or(0, |turn| turn.clocks.len())
    }

    /// Returns the clocks of all recordings as they stand now.
    pub fn decided_clocks(&self) -> Vec<SourceClock> {
        self.sources.iter().map(|source| source.clock).collect()
    }

    /// Lets the turns go by the clocks that were decided before.
    pub(crate) fn go_by(&mut self, decided: &[SourceClock]) {
        for (k, clock) in decided.iter().enumerate().take(self.sources.len()) {
            self.set_clock(k, clock.base, clock.share);
            self.sources[k].clock = *clock;
        }
    }

    /// Lets the turns of a recording go by the clock `base` and a share of the scatter about it.
    pub(crate) fn set_clock(&mut self, recording: usize, base: usize, share: f64) {
        let own = &mut self.sources[recording].clock;
        (own.share, own.base) = (share, base);
        for turn in self.turns.iter_mut().filter(|t| t.recording == recording) {
            let Some(clock) = turn.clocks.get(base) else {
                continue;
            };
            let mixed = |a: &[f64], b: &[f64]| -> Vec<f64> {
                a.iter().zip(b).map(|(a, b)| a + share * b).collect()
            };
            turn.t = mixed(&clock.even, &clock.scatter);
            turn.lengths = mixed(&clock.lengths, &clock.slack);
            turn.readings = means_over_windows(&turn.t, &turn.samples);
        }
        self.set_timing(recording, share * (1.0 - share));
    }

    /// Lets the times of the samples have this part of the mean square scatter of the stamps for their variance.
    pub(crate) fn set_timing(&mut self, recording: usize, part: f64) {
        let turns = self.turns.iter().filter(|t| t.recording == recording);
        let base = self.sources[recording].clock.base;
        let clocks = turns.filter_map(|turn| turn.clocks.get(base));
        let (sum, count) = clocks.fold((0.0, 0.0), |(sum, count), clock| {
            let square: f64 = clock.scatter.iter().map(|d| d * d).sum();
            (sum + square, count + clock.scatter.len() as f64)
        });
        self.sources[recording].clock.timing = part * sum / f64::max(count, 1.0);
    }
}
