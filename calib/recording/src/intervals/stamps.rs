//! Search for a time among many stamps.

use std::ops::Range;

use crate::recording::is_before;

/// Stamps between two that are looked at first.
const STRIDE: usize = 64;

/// Ascending stamps with an index that a processor's cache holds, however long the recording is: a
/// search in the stamps themselves waits for memory a dozen times.
#[derive(Clone, Debug)]
pub(super) struct Stamps<'a> {
    all: &'a [f64],
    /// Every 64th.
    index: Vec<f64>,
}

impl<'a> Stamps<'a> {
    /// Builds the index of stamps in ascending order, s.
    pub fn of(all: &'a [f64]) -> Self {
        let index = all.iter().step_by(STRIDE).copied().collect();
        Self { all, index }
    }

    /// The samples with `from <= t < to`, as [`Stream::between`](crate::recording::Stream::between).
    pub fn between(&self, from: f64, to: f64) -> Range<usize> {
        let start = self.first_at_or_after(from);
        start..self.first_at_or_after(to).max(start)
    }

    fn first_at_or_after(&self, time: f64) -> usize {
        let above = self.index.partition_point(|&t| is_before(t, time));
        let from = above.saturating_sub(1) * STRIDE;
        let until = self.all.len().min(above * STRIDE);
        let block = self.all.get(from..until).unwrap_or_default();
        from + block.partition_point(|&t| is_before(t, time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Stream;

    #[test]
    fn stretches_are_those_of_a_search_in_all_stamps() {
        for n in [0, 1, 63, 64, 65, 200] {
            let t: Vec<f64> = (0..n).map(f64::from).collect();
            let stream = Stream {
                t: t.clone(),
                values: Vec::new(),
            };
            let stamps = Stamps::of(&t);
            for k in -1..2 * n + 2 {
                let (from, to) = (0.5 * f64::from(k), 0.7 * f64::from(k) + 3.0);
                assert_eq!(stamps.between(from, to), stream.between(from, to));
            }
            assert_eq!(stamps.between(3.0, 1.0).len(), 0);
        }
    }
}
