//! Samples that are missing: short losses are bridged, longer ones are gaps.
//!
//! ```text
//! stamps ──► usual step ──► ticks between neighbours ──► bridge (up to 32 samples) or gap
//! ```

use std::collections::VecDeque;

use nalgebra::Vector3;

/// Samples looked at before the sampling interval is known.
const HEAD: usize = 256;

findings::tuning! {
    /// Steps that the sampling interval is taken over: stamps that come in packets have no usual single step.
    LAG: usize = 16;

    /// Steps are whole multiples of the sampling interval to within this share of it ...
    WHOLE: f64 = 0.1;
    /// ... for this share of them.
    MOSTLY: f64 = 0.95;

    /// Samples looked ahead: one that is late is told from one that follows a loss by those after it.
    AHEAD: usize = 16;

    /// Longest loss that is bridged, samples.
    BRIDGED: u64 = 32;
}

/// Element of a stream: a sample, a bridged sample or an interruption.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Piece {
    /// A sample that was read.
    Read(Vector3<f64>),
    /// One in place of a sample that is missing.
    Bridge(Vector3<f64>),
    /// Samples are missing here, too many to be bridged.
    Gap,
}

/// Finds what is missing in a stream of samples whose stamps ascend.
///
/// A sample may be late by chance, so that ticks are counted between lower envelopes, `min_j (t_{k+j} − j τ₀)` over the
/// samples that follow. A loss is bridged by the straight line between the means of as many samples on either side:
/// white noise then grows by no more than 1.5 times the share that is missing, and the sum over long times goes on.
#[derive(Debug, Default)]
pub(crate) struct Regular {
    step: Option<f64>,
    queue: VecDeque<(f64, Vector3<f64>)>,
    past: VecDeque<Vector3<f64>>,
    /// Stamp of the last sample handed on, and its lower envelope.
    last: Option<(f64, f64)>,
    /// First stamp since a gap, and ticks since then.
    begin: Option<f64>,
    ticks: u64,
    /// Time and ticks of the stretches before.
    before: (f64, u64),
}

impl Regular {
    /// The next sample; what is known of earlier ones goes to `out`.
    pub fn push(&mut self, t: f64, value: Vector3<f64>, out: &mut impl FnMut(Piece)) {
        self.queue.push_back((t, value));
        if self.step.is_none() && self.queue.len() == HEAD {
            self.step = Some(self.usual_step());
        }
        while self.step.is_some() && self.queue.len() > AHEAD.get() {
            self.next(out);
        }
    }

    /// Hands on what is left; the sampling interval, the mean step without gaps. `None` with fewer than two samples.
    pub fn finish(&mut self, out: &mut impl FnMut(Piece)) -> Option<f64> {
        if self.step.is_none() {
            self.step = Some(self.usual_step());
        }
        while !self.queue.is_empty() {
            self.next(out);
        }
        self.close();
        let (time, ticks) = self.before;
        (ticks > 0).then(|| time / ticks as f64)
    }

    /// The median of single steps where nearly all steps are whole multiples of it, however many samples are missing; else that of the
    /// steps over sixteen samples.
    fn usual_step(&self) -> f64 {
        let t: Vec<f64> = self.queue.iter().map(|(t, _)| *t).collect();
        let single = median_step(&t, 1);
        let is_whole = |step: f64| (step / single - (step / single).round()).abs() < WHOLE.get();
        let whole = t.windows(2).filter(|w| is_whole(w[1] - w[0])).count();
        let lag = if t.len() > 4 * LAG.get() {
            LAG.get()
        } else {
            1
        };
        match whole as f64 > MOSTLY.get() * t.len().saturating_sub(1) as f64 {
            true => single,
            false => median_step(&t, lag),
        }
    }

    /// Hands on the first sample of the queue, after what is missing before it.
    fn next(&mut self, out: &mut impl FnMut(Piece)) {
        let step = self.step.unwrap_or(f64::INFINITY);
        let ahead = self.queue.iter().take(AHEAD.get()).zip(0..);
        let envelope = ahead
            .map(|((t, _), j)| if j == 0 { *t } else { t - f64::from(j) * step })
            .fold(f64::INFINITY, f64::min);
        let passed = self
            .last
            .map(|(_, last)| ((envelope - last) / step).round());
        let missing = passed.map_or(0.0, |ticks| (ticks - 1.0).max(0.0)) as u64;
        // With few samples left a late one looks like one that follows a loss.
        let is_known = self.queue.len() >= AHEAD.get() || missing > BRIDGED.get();
        let missing = if is_known { missing } else { 0 };
        if missing > BRIDGED.get() {
            self.close();
            self.past.clear();
            out(Piece::Gap);
        } else if missing > 0 {
            self.bridge(missing, out);
        }
        let Some((t, value)) = self.queue.pop_front() else {
            return;
        };
        if self.begin.is_some() {
            self.ticks += missing + 1;
        } else {
            self.begin = Some(t);
        }
        self.last = Some((t, envelope));
        self.past.push_back(value);
        if self.past.len() > AHEAD.get() {
            self.past.pop_front();
        }
        out(Piece::Read(value));
    }

    fn bridge(&self, missing: u64, out: &mut impl FnMut(Piece)) {
        let count = missing as usize;
        let before = mean(self.past.iter().rev().take(count));
        let after = mean(
            self.queue
                .iter()
                .take(count.min(AHEAD.get()))
                .map(|(_, v)| v),
        );
        for k in 1..=missing {
            let along = k as f64 / (missing + 1) as f64;
            out(Piece::Bridge(before + (after - before) * along));
        }
    }

    /// Ends a stretch without gaps.
    fn close(&mut self) {
        if let (Some(begin), Some((last, _))) = (self.begin.take(), self.last) {
            self.before.0 += last - begin;
            self.before.1 += self.ticks;
        }
        self.ticks = 0;
    }
}

/// The median of the steps over `lag` samples, by the sample; infinite of fewer.
fn median_step(t: &[f64], lag: usize) -> f64 {
    let mut steps: Vec<f64> = t.windows(lag + 1).map(|w| w[lag] - w[0]).collect();
    if steps.is_empty() {
        return f64::INFINITY;
    }
    let middle = steps.len() / 2;
    *steps.select_nth_unstable_by(middle, f64::total_cmp).1 / lag as f64
}

fn mean<'a>(values: impl Iterator<Item = &'a Vector3<f64>>) -> Vector3<f64> {
    let (sum, count) = values.fold((Vector3::zeros(), 0.0), |(s, n), v| (s + v, n + 1.0));
    sum / f64::max(count, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(t: &[f64]) -> (Vec<Piece>, Option<f64>) {
        let mut regular = Regular::default();
        let mut all = Vec::new();
        for &t in t {
            regular.push(t, Vector3::repeat(t), &mut |piece| all.push(piece));
        }
        let step = regular.finish(&mut |piece| all.push(piece));
        (all, step)
    }

    fn bridges(pieces: &[Piece]) -> Vec<f64> {
        let of = |piece: &Piece| match piece {
            Piece::Bridge(value) => Some(value.x),
            _ => None,
        };
        pieces.iter().filter_map(of).collect()
    }

    #[test]
    fn lost_samples_are_bridged_at_their_places() {
        let lost = [40, 300, 301, 302, 700];
        let t = (0..1000)
            .filter(|k| !lost.contains(k))
            .map(|k| f64::from(k) * 0.01);
        let (found, step) = pieces(&t.collect::<Vec<_>>());
        let bridged = bridges(&found);
        assert_eq!(found.len(), 1000);
        for (k, value) in lost.into_iter().zip(bridged) {
            assert!((value - f64::from(k) * 0.01).abs() < 0.011, "{k}: {value}");
        }
        assert!((step.unwrap() - 0.01).abs() < 1e-12);
    }

    #[test]
    fn the_sampling_interval_is_known_where_every_fifth_sample_is_lost() {
        let is_kept = |k: &u32| (k * 7919 + k * k * 31) % 101 >= 20;
        let t = (0..4000).filter(is_kept).map(|k| f64::from(k) * 0.01);
        let (found, step) = pieces(&t.collect::<Vec<_>>());
        assert!(found.len() >= 3990, "{}", found.len());
        // Those of the last few are not counted.
        assert!((step.unwrap() / 0.01 - 1.0).abs() < 3e-3, "{step:?}");
    }

    #[test]
    fn late_samples_and_packets_are_not_lost_ones() {
        let late: Vec<f64> = (0..1000)
            .map(|k| f64::from(k) * 0.01 + if k % 37 == 5 { 0.018 } else { 0.0 })
            .scan(0.0, |last: &mut f64, t| {
                *last = t.max(*last + 1e-5);
                Some(*last)
            })
            .collect();
        // 50 Hz, read every 32 ms.
        let read: Vec<f64> = (0..1000)
            .map(|k| (f64::from(k) * 0.02 / 0.032).ceil() * 0.032 + f64::from(k) * 1e-7)
            .collect();
        for (t, step) in [(late, 0.01), (read, 0.02)] {
            let (found, mean) = pieces(&t);
            assert_eq!(found.len(), 1000);
            assert!((mean.unwrap() / step - 1.0).abs() < 2e-3, "{mean:?}");
        }
    }

    #[test]
    fn a_longer_loss_is_a_gap_that_has_no_part_in_the_sampling_interval() {
        let mut t: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.01).collect();
        t[500..].iter_mut().for_each(|t| *t += 60.0);
        let (found, step) = pieces(&t);
        assert_eq!(found.iter().filter(|p| **p == Piece::Gap).count(), 1);
        assert_eq!(found.len(), 1001);
        assert!((step.unwrap() - 0.01).abs() < 1e-12);
    }
}
