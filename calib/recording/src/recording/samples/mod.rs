//! The samples of one sensor while they are read: in order, each stamp once.

pub(crate) mod line_numbers;
pub(crate) mod memory;
pub(crate) mod packets;

use nalgebra::Vector3;

use self::line_numbers::LineNumbers;
use self::memory::one_more;

/// Result of adding a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pushed {
    /// Kept.
    Kept,
    /// Stamp and values had been there before, so the row says nothing new.
    Repeat,
    /// Kept beside the sample with the same stamp.
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
    /// Their lines.
    lines: LineNumbers,
    /// Rows left out as repeats: count, first line, last line.
    pub repeats: Repeats,
    /// Rows with the stamp of a sample, in the order of the samples.
    pub twins: Vec<Twin>,
}

/// A row with the stamp of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twin {
    /// The sample.
    pub of: usize,
    /// The values of the row.
    pub value: Vector3<f64>,
    /// Its line.
    pub line: u64,
    /// Its values are those of the sample: counted among the repeats.
    pub is_repeat: bool,
}

/// Rows that repeat earlier ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Repeats {
    /// Number of rows.
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
            lines: LineNumbers::from_one(),
            t,
            values,
            ..Self::default()
        }
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

    /// Adds a sample whatever its stamp; [`Samples::in_order`] or [`Samples::sort`] has to follow.
    pub fn append(&mut self, t: f64, value: Vector3<f64>, line: u64) {
        self.lines.push(self.t.len(), line);
        self.t.push(t);
        self.values.push(value);
    }

    /// Room for one more sample.
    ///
    /// # Errors
    /// When memory is short.
    pub fn make_room(&mut self) -> Result<(), ()> {
        one_more(&mut self.t)?;
        one_more(&mut self.values)?;
        one_more(&mut self.twins)?;
        self.lines.make_room()
    }

    fn settle(&mut self, t: f64, value: Vector3<f64>, line: u64, last: f64) -> Pushed {
        let at = self.t.partition_point(|&s| s < t);
        if self.t.get(at) == Some(&t) && self.values.get(at) == Some(&value) {
            self.repeat(line);
            if t == last {
                self.twins.push(Twin {
                    of: at,
                    value,
                    line,
                    is_repeat: true,
                });
            }
            return Pushed::Repeat;
        }
        if t < last {
            return Pushed::Backwards(last);
        }
        let of = self.t.len() - 1;
        self.twins.push(Twin {
            of,
            value,
            line,
            is_repeat: false,
        });
        Pushed::SameStamp
    }

    fn repeat(&mut self, line: u64) {
        if self.repeats.count == 0 {
            self.repeats.first = line;
        }
        self.repeats.count += 1;
        self.repeats.last = line;
    }

    /// Each stamp once, as [`Samples::push`] has it.
    ///
    /// # Errors
    /// The first sample that is earlier than one before it.
    pub fn in_order(self) -> Result<Self, Backwards> {
        if self.t.windows(2).all(|pair| pair[0] < pair[1]) {
            return Ok(self);
        }
        let mut ordered = Self {
            repeats: self.repeats,
            ..Self::with_room(self.t.len())
        };
        for (i, (&t, &value)) in self.t.iter().zip(&self.values).enumerate() {
            let line = self.line(i);
            if let Pushed::Backwards(last) = ordered.push(t, value, line) {
                return Err(Backwards { line, last, t });
            }
        }
        Ok(ordered)
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

    /// Rows with the stamp of a sample and other values.
    pub fn other_twins(&self) -> impl Iterator<Item = &Twin> {
        self.twins.iter().filter(|twin| !twin.is_repeat)
    }

    /// All rows, those that share a stamp apart.
    pub fn apart(&self) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let rows = self.t.len() + self.twins.len();
        let (mut t, mut values) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let mut twins = self.twins.iter().peekable();
        for (of, (&stamp, &value)) in self.t.iter().zip(&self.values).enumerate() {
            t.push(stamp);
            values.push(value);
            while let Some(twin) = twins.next_if(|twin| twin.of == of) {
                t.push(stamp);
                values.push(twin.value);
            }
        }
        (t, values)
    }

    /// The same, numbered from the line of the first on.
    pub fn beginning_at(mut self, line: u64) -> Self {
        self.lines = LineNumbers::default();
        self.lines.push(0, line);
        self
    }

    /// Every sample that has twins becomes the mean of all.
    pub fn merge_twins(&mut self) {
        let mut twins = std::mem::take(&mut self.twins);
        twins.retain(|twin| !twin.is_repeat);
        for rows in twins.chunk_by(|a, b| a.of == b.of) {
            let Some(mean) = self.values.get_mut(rows[0].of) else {
                continue;
            };
            for (count, twin) in (2..).zip(rows) {
                *mean += (twin.value - *mean) / f64::from(count);
            }
        }
    }

    /// The samples on lines of which `keeps` is true; for those that are not in order yet.
    pub fn on_lines(&self, keeps: impl Fn(u64) -> bool) -> Self {
        let mut kept = Self::default();
        for (i, (&t, &value)) in self.t.iter().zip(&self.values).enumerate() {
            let line = self.line(i);
            if keeps(line) {
                kept.append(t, value, line);
            }
        }
        kept
    }

    /// The line that sample `index` stands on.
    pub fn line(&self, index: usize) -> u64 {
        self.lines.of(index)
    }
}

/// A sample that is earlier than one before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Backwards {
    /// Its line.
    pub line: u64,
    /// The stamp before.
    pub last: f64,
    /// Its stamp.
    pub t: f64,
}
