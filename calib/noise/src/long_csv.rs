//! Allan curves straight from a plain CSV file, however long it is.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use nalgebra::Vector3;
use recording::batches::{Batch, Batches, Stop};
use recording::cut::{is_cut, usual_tail};
use recording::intervals::Span;
use recording::pipeline::parse_all;
use recording::plain::{ACCEL, Block, GYRO, Plain, Row, STAMP};
use recording::{Stream, are_no_rates_at_rest, bursts, devices_in_turn};

use super::curves::{RecordingAccumulator, RecordingCurves, SensorAccumulator};

/// The columns of the plain CSV recording.
const COLUMNS: [&[u8]; 7] = [b"t", b"ax", b"ay", b"az", b"gx", b"gy", b"gz"];

/// Columns that may follow them.
const OTHERS: [&[u8]; 4] = [b"temp", b"mx", b"my", b"mz"];

/// Steps between seconds of a recording, s: others are of another unit, or count the rows.
const STEPS: std::ops::Range<f64> = 1e-4..1.0;

/// Rows from which it is seen whether two devices wrote them by turns.
const FIRST: usize = 10_000;

/// Bytes in which the header must be found, comments included.
const HEAD: u64 = 1 << 16;

/// The norm of gravity in m/s², give or take a poor sensor's errors: other units are not ours to
/// guess.
const GRAVITY: std::ops::Range<f64> = 7.0..13.0;

/// Reads a plain CSV recording (`t,ax,ay,az,gx,gy,gz…`) batch by batch into curves, without keeping
/// the samples: a day at 200 Hz needs hardly more memory than a minute. With `within` only that
/// stretch goes into the curves.
///
/// `None` for anything else: no regular file, other columns, a row with a missing or unreadable
/// number, time that does not ascend, a first reading that is no gravity in m/s². The reader of
/// recordings then says what is wrong, or knows the format.
pub fn curves_of_long_csv(path: &Path, within: Option<Span>) -> Option<RecordingCurves> {
    let Look { width, tail } = look(path)?;
    let plain = Plain::in_first_columns(width, COLUMNS.len());
    let mut batches = Batches::new(File::open(path).ok()?, u64::MAX);
    let mut feed = Feed {
        accumulator: RecordingAccumulator::default(),
        within,
        tail,
        last: f64::NEG_INFINITY,
        header_met: false,
        rows: Vec::new(),
        first: Vec::new(),
    };
    let fed = parse_all(&mut batches, &plain, |batch, blocks| {
        feed.take(batch, blocks).ok_or(())
    });
    feed.check_first()?;
    let whole = fed.is_ok() && matches!(batches.stop(), Stop::End);
    whole.then(|| feed.accumulator.finish())
}

/// Rows on their way into the curves.
struct Feed {
    accumulator: RecordingAccumulator,
    within: Option<Span>,
    /// Usual tail of the last column, from [`usual_tail`].
    tail: Option<usize>,
    /// Stamp of the last row, s.
    last: f64,
    header_met: bool,
    /// The rows of a batch.
    rows: Vec<Row>,
    /// The first rows of all.
    first: Vec<Row>,
}

impl Feed {
    /// Takes in a batch; `None` for a row that the reader of recordings has to look at.
    fn take(&mut self, batch: &Batch, blocks: &[Block]) -> Option<()> {
        self.rows.clear();
        for block in blocks {
            let mut taken = 0;
            for odd in &block.odd {
                self.rows.extend_from_slice(&block.rows[taken..odd.after]);
                taken = odd.after;
                let line = &batch.bytes[odd.line.clone()];
                if line.is_empty() || line.starts_with(b"#") {
                    continue;
                }
                if !std::mem::replace(&mut self.header_met, true) {
                    continue;
                }
                if batch.fault(&odd.line).is_some() {
                    return None;
                }
                let unended = odd.line.end == batch.bytes.len();
                if unended
                    && self
                        .tail
                        .is_some_and(|tail| is_cut(last_cell(line), b'.', tail))
                {
                    return None;
                }
                self.rows.push(numbers(line)?);
            }
            self.rows.extend_from_slice(&block.rows[taken..]);
        }
        self.check()?;
        let wanted = |t: f64| self.within.is_none_or(|span| span.from <= t && t < span.to);
        let push = |sensor: &mut SensorAccumulator, first: usize| {
            for row in self.rows.iter().filter(|row| wanted(row[STAMP])) {
                let value = Vector3::new(row[first], row[first + 1], row[first + 2]);
                sensor.push(row[STAMP], value);
            }
        };
        let RecordingAccumulator {
            accelerometer,
            gyroscope,
        } = &mut self.accumulator;
        rayon::join(|| push(accelerometer, ACCEL), || push(gyroscope, GYRO));
        Some(())
    }

    /// `None` where time does not ascend or the first reading of all is no gravity.
    fn check(&mut self) -> Option<()> {
        for row in &self.rows {
            if self.first.len() < FIRST {
                self.first.push(*row);
            }
            let first = self.last == f64::NEG_INFINITY;
            let force = Vector3::new(row[ACCEL], row[ACCEL + 1], row[ACCEL + 2]);
            if row[STAMP] <= self.last || (first && !GRAVITY.contains(&force.norm())) {
                return None;
            }
            self.last = row[STAMP];
        }
        Some(())
    }

    /// `None` where the first rows are in another unit of time or rate, of several devices by turns, or come in bursts.
    fn check_first(&self) -> Option<()> {
        let steps = self.first.windows(2).map(|w| w[1][STAMP] - w[0][STAMP]);
        let known = recording::averages::median(steps).is_none_or(|step| STEPS.contains(&step));
        let [accelerometer, gyroscope] = [ACCEL, GYRO].map(|at| Stream {
            t: self.first.iter().map(|row| row[STAMP]).collect(),
            values: self
                .first
                .iter()
                .map(|row| Vector3::new(row[at], row[at + 1], row[at + 2]))
                .collect(),
        });
        let mixed = [&accelerometer, &gyroscope]
            .iter()
            .any(|own| devices_in_turn(&own.values).is_some());
        let is_plain = known && !mixed && bursts(&gyroscope.t).is_none();
        (is_plain && !are_no_rates_at_rest(&gyroscope, &accelerometer)).then_some(())
    }
}

/// Layout found at the beginning of a file.
struct Look {
    /// Number of columns.
    width: usize,
    /// Usual tail of the last column, from [`usual_tail`], if the column is read.
    tail: Option<usize>,
}

/// The beginning of a regular file with the plain header, after comments.
fn look(path: &Path) -> Option<Look> {
    // Asked of the path: what is opened and left of a pipe is lost.
    if !std::fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let file = File::open(path).ok()?;
    let mut head = Vec::new();
    file.take(HEAD).read_to_end(&mut head).ok()?;
    let mut lines = head
        .split(|b| *b == b'\n')
        .filter(|line| !line.starts_with(b"#"));
    let names: Vec<&[u8]> = lines.next()?.trim_ascii().split(|b| *b == b',').collect();
    let rows: Vec<&[u8]> = lines.collect();
    let (_, rows) = rows.split_last()?;
    let tail = usual_tail(rows.iter().map(|row| last_cell(row)), b'.');
    // Of another column the reader finds out whether it tells devices apart.
    let others = names.get(COLUMNS.len()..)?;
    let known = others.iter().all(|name| OTHERS.contains(name));
    (names.starts_with(&COLUMNS) && known).then_some(Look {
        width: names.len(),
        tail: tail.filter(|_| names.len() == COLUMNS.len()),
    })
}

fn last_cell(row: &[u8]) -> &[u8] {
    let row = row.trim_ascii();
    let start = memchr::memrchr(b',', row).map_or(0, |at| at + 1);
    row[start..].trim_ascii()
}

/// The first seven fields as finite numbers.
fn numbers(line: &[u8]) -> Option<Row> {
    let mut row = Row::default();
    let mut fields = line.split(|b| *b == b',');
    for number in &mut row[..COLUMNS.len()] {
        *number = std::str::from_utf8(fields.next()?)
            .ok()?
            .trim()
            .parse()
            .ok()?;
        if !number.is_finite() {
            return None;
        }
    }
    Some(row)
}

#[cfg(test)]
mod tests {
    use recording::{Recording, Stream};

    use super::*;

    #[test]
    fn a_file_gives_the_curves_of_its_samples_and_anything_odd_is_left_to_the_reader() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rest.csv");
        let value = |k: usize, axis: usize| ((k * (axis + 3)) as f64).sin();
        let gravity = Vector3::new(0.0, 0.0, 9.8);
        let mut text = String::from("# at rest\nt,ax,ay,az,gx,gy,gz,temp\n");
        let mut recording = Recording {
            accelerometer: Some(Stream::default()),
            gyroscope: Some(Stream::default()),
            ..Recording::default()
        };
        for k in 0..1000 {
            let t = k as f64 * 0.5;
            let [a, g] = [0, 3].map(|n| Vector3::from_fn(|i, _| value(k, n + i)));
            let a = a + gravity;
            let row = [t, a.x, a.y, a.z, g.x, g.y, g.z, 25.0]
                .map(|v| v.to_string())
                .join(",");
            text.push_str(&row);
            text.push('\n');
            for (stream, v) in [
                (&mut recording.accelerometer, a),
                (&mut recording.gyroscope, g),
            ] {
                let stream = stream.as_mut().unwrap();
                stream.t.push(t);
                stream.values.push(v);
            }
        }
        std::fs::write(&path, &text).unwrap();
        let part = Span {
            from: 50.0,
            to: 200.0,
        };
        for within in [None, Some(part)] {
            assert_eq!(
                curves_of_long_csv(&path, within),
                Some(RecordingCurves::of(&recording, within))
            );
        }
        for odd in [
            "500,1,2,3,4,5\n",
            "500,1,2,3,4,5,x\n",
            "3,1,2,3,4,5,6\n",
            "500,1,2,3,4,5,inf\n",
        ] {
            std::fs::write(&path, format!("{text}{odd}")).unwrap();
            assert_eq!(curves_of_long_csv(&path, None), None, "{odd}");
        }
        for odd in [
            text.replace("gx,gy", "gy,gx"),
            "t,ax,ay,az,gx,gy,gz\n0,0,0,1,0,0,0\n".into(),
        ] {
            std::fs::write(&path, odd).unwrap();
            assert_eq!(curves_of_long_csv(&path, None), None);
        }
        assert_eq!(curves_of_long_csv(folder.path(), None), None);
        let row = |k: usize| {
            format!(
                "{:.2},0.10,0.20,9.80,0.01,0.02,{:.2}\n",
                0.5 * k as f64,
                value(k, 0)
            )
        };
        let fixed: String = (0..100).map(row).collect();
        for (last, is_whole) in [("100.00,0.10,0.20,9.80,0.01,0.02,0.5", false), ("", true)] {
            std::fs::write(&path, format!("t,ax,ay,az,gx,gy,gz\n{fixed}{last}")).unwrap();
            assert_eq!(
                curves_of_long_csv(&path, None).is_some(),
                is_whole,
                "{last}"
            );
        }
    }
}
