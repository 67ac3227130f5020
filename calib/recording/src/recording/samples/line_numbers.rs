//! The line of every sample, as runs of lines that follow one another.

use super::memory::one_more;

/// Lines of samples, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct LineNumbers {
    /// `(index, line)` wherever the line is not one after the line before.
    runs: Vec<(usize, u64)>,
}

impl LineNumbers {
    /// Lines from 1 on.
    pub fn from_one() -> Self {
        Self { runs: vec![(0, 1)] }
    }

    /// Adds the line of sample `index`, the next one.
    pub fn push(&mut self, index: usize, line: u64) {
        let expected = self.runs.last().map(|&(i, l)| l + (index - i) as u64);
        if expected != Some(line) {
            self.runs.push((index, line));
        }
    }

    /// Room for one more.
    ///
    /// # Errors
    /// When memory is short.
    pub fn make_room(&mut self) -> Result<(), ()> {
        one_more(&mut self.runs)
    }

    /// The line of sample `index`; 0 where there is none.
    pub fn of(&self, index: usize) -> u64 {
        let after = self.runs.partition_point(|&(i, _)| i <= index);
        self.runs
            .get(after.wrapping_sub(1))
            .map_or(0, |&(i, line)| line + (index - i) as u64)
    }

    /// The sample on `line`, or the last one before it, of lines that ascend.
    pub fn index_at(&self, line: u64) -> usize {
        let after = self.runs.partition_point(|&(_, l)| l <= line);
        let Some(&(i, first)) = self.runs.get(after.wrapping_sub(1)) else {
            return 0;
        };
        let end = self.runs.get(after).map_or(usize::MAX, |&(i, _)| i - 1);
        (i + (line - first) as usize).min(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_samples_are_each_others() {
        let mut lines = LineNumbers::default();
        let written = [2, 3, 4, 9, 10, 20];
        written
            .iter()
            .enumerate()
            .for_each(|(i, line)| lines.push(i, *line));
        for (index, line) in written.into_iter().enumerate() {
            assert_eq!((lines.of(index), lines.index_at(line)), (line, index));
        }
        assert_eq!((lines.index_at(7), lines.index_at(15)), (2, 4));
    }
}
