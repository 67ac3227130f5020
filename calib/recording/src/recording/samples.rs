//! The samples of one sensor while they are read: in order, each stamp once.

use nalgebra::Vector3;

use super::memory::one_more;

/// What became of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pushed {
    /// Kept.
    Kept,
    /// Stamp and values had been there before, so the row says nothing new.
    Repeat,
    /// Merged into the sample with the same stamp.
    SameStamp,
    /// Earlier than the last stamp, which is given.
    Backwards(f64),
}

/// Columns of one sensor in the file's units.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Samples {
    /// Stamps.
    pub t: Vec<f64>,
    /// Values.
    pub values: Vec<Vector3<f64>>,
    /// `(index, line)` wherever the line is not one after the line of the sample before.
    lines: Vec<(usize, u64)>,
    /// Samples merged into the last one, itself included.
    merged_into_last: usize,
    /// Rows left out as repeats: count, first line, last line.
    pub repeats: Repeats,
    /// Rows merged with another of the same stamp.
    pub merged: usize,
    /// Rows with the stamp of the sample at this place that are no samples of their own, and whether they are in its mean.
    pub extra: Vec<(usize, Vector3<f64>, bool)>,
}

/// Rows that repeat earlier ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Repeats {
    /// How many.
    pub count: usize,
    /// Line of the first.
    pub first: u64,
    /// Line of the last.
    pub last: u64,
}

impl Samples {
    /// Samples in order, numbered from 1.
    pub fn of(t: Vec<f64>, values: Vec<Vector3<f64>>) -> Self {
        Self {
            lines: vec![(0, 1)],
            t,
            values,
            merged_into_last: 1,
            ..Self::default()
        }
    }

    /// The same, numbered from the line of the first on.
    pub fn beginning_at(mut self, line: u64) -> Self {
        self.lines = vec![(0, line)];
        self
    }

    /// All rows, those that share a stamp apart.
    pub fn unmerged(&self) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let rows = self.t.len() + self.extra.len();
        let (mut t, mut values) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let mut extra = self.extra.chunk_by(|a, b| a.0 == b.0).peekable();
        for (k, (&stamp, &mean)) in self.t.iter().zip(&self.values).enumerate() {
            let own = extra.next_if(|own| own[0].0 == k).unwrap_or_default();
            let others = own.iter().filter(|row| row.2);
            let (sum, count) =
                others.fold((Vector3::zeros(), 1.0), |(s, n), row| (s + row.1, n + 1.0));
            t.push(stamp);
            values.push(mean * count - sum);
            t.extend(own.iter().map(|_| stamp));
            values.extend(own.iter().map(|row| row.1));
        }
        (t, values)
    }

    /// None yet, with memory for `count`.
    pub fn with_room(count: usize) -> Self {
        Self {
            t: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
            ..Self::default()
        }
    }

    /// Adds a sample; stamps that do not increase are looked into.
    pub fn push(&mut self, t: f64, value: Vector3<f64>, line: u64) -> Pushed {
        match self.t.last() {
            Some(&last) if t <= last => self.settle(t, value, line, last),
            _ => {
                self.append(t, value, line);
                Pushed::Kept
            }
        }
    }

    /// Adds a sample whatever its stamp; [`Samples::sort`] has to follow.
    pub fn append(&mut self, t: f64, value: Vector3<f64>, line: u64) {
        let expected = self
            .lines
            .last()
            .map(|&(i, l)| l + (self.t.len() - i) as u64);
        if expected != Some(line) {
            self.lines.push((self.t.len(), line));
        }
        self.t.push(t);
        self.values.push(value);
        self.merged_into_last = 1;
    }

    /// Room for one more sample.
    ///
    /// # Errors
    /// When memory is short.
    pub fn make_room(&mut self) -> Result<(), ()> {
        one_more(&mut self.t)?;
        one_more(&mut self.values)?;
        one_more(&mut self.extra)?;
        one_more(&mut self.lines)
    }

    fn settle(&mut self, t: f64, value: Vector3<f64>, line: u64, last: f64) -> Pushed {
        let at = self.t.partition_point(|&s| s < t);
        if self.t.get(at) == Some(&t) && self.values.get(at) == Some(&value) {
            self.repeat(line);
            if t == last {
                self.extra.push((at, value, false));
            }
            return Pushed::Repeat;
        }
        if t < last {
            return Pushed::Backwards(last);
        }
        self.merge(value);
        Pushed::SameStamp
    }

    fn repeat(&mut self, line: u64) {
        if self.repeats.count == 0 {
            self.repeats.first = line;
        }
        self.repeats.count += 1;
        self.repeats.last = line;
    }

    /// The last sample becomes the mean of all with its stamp.
    fn merge(&mut self, value: Vector3<f64>) {
        self.merged += 1;
        self.merged_into_last += 1;
        self.extra.push((self.t.len() - 1, value, true));
        if let Some(mean) = self.values.last_mut() {
            *mean += (value - *mean) / self.merged_into_last as f64;
        }
    }

    /// Sorts by stamp, then treats equal stamps as [`Samples::push`] does.
    pub fn sort(self) -> Self {
        let mut order: Vec<usize> = (0..self.t.len()).collect();
        order.sort_by(|&a, &b| self.t[a].total_cmp(&self.t[b]));
        let mut sorted = Self {
            repeats: self.repeats,
            ..Self::default()
        };
        for i in order {
            sorted.push(self.t[i], self.values[i], self.line(i));
        }
        sorted
    }

    /// The line that sample `index` stands on.
    pub fn line(&self, index: usize) -> u64 {
        let after = self.lines.partition_point(|&(i, _)| i <= index);
        self.lines
            .get(after.wrapping_sub(1))
            .map_or(0, |&(i, line)| line + (index - i) as u64)
    }
}
