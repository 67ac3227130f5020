//! Allan curves straight from a plain CSV file, however long it is.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use csv::{ByteRecord, ReaderBuilder};
use nalgebra::Vector3;

use super::curves::{RecordingAccumulator, RecordingCurves};
use crate::intervals::Span;

/// The columns of the plain CSV recording.
const COLUMNS: [&[u8]; 7] = [b"t", b"ax", b"ay", b"az", b"gx", b"gy", b"gz"];

/// Bytes read at a time.
const BUFFER: usize = 1 << 20;

/// Bytes in which the header must be found, comments included.
const HEAD: u64 = 1 << 16;

/// The modulus of gravity in m/s², give or take a poor sensor's errors: other units are not ours to
/// guess.
const GRAVITY: std::ops::Range<f64> = 7.0..13.0;

/// Reads a plain CSV recording (`t,ax,ay,az,gx,gy,gz…`) row by row into curves, without keeping the
/// samples: a day at 200 Hz needs hardly more memory than a minute. With `within` only that stretch
/// goes into the curves.
///
/// `None` for anything else: no regular file, other columns, a row with a missing or unreadable
/// number, time that does not ascend, a first reading that is no gravity in m/s². The reader of
/// recordings then says what is wrong, or knows the format.
pub fn curves_of_long_csv(path: &Path, within: Option<Span>) -> Option<RecordingCurves> {
    if !begins_with_header(path)? {
        return None;
    }
    let mut reader = ReaderBuilder::new()
        .buffer_capacity(BUFFER)
        .comment(Some(b'#'))
        .flexible(true)
        .from_path(path)
        .ok()?;
    let mut accumulator = RecordingAccumulator::default();
    let wanted = |t: f64| within.is_none_or(|span| span.from <= t && t < span.to);
    let mut last = f64::NEG_INFINITY;
    let mut row = ByteRecord::new();
    while reader.read_byte_record(&mut row).ok()? {
        let [t, ax, ay, az, gx, gy, gz] = numbers(&row)?;
        let first = last == f64::NEG_INFINITY;
        if t <= last || (first && !GRAVITY.contains(&(ax * ax + ay * ay + az * az).sqrt())) {
            return None;
        }
        last = t;
        if wanted(t) {
            accumulator.accelerometer.push(t, Vector3::new(ax, ay, az));
            accumulator.gyroscope.push(t, Vector3::new(gx, gy, gz));
        }
    }
    Some(accumulator.finish())
}

/// Whether a regular file begins with the plain header, after comments.
fn begins_with_header(path: &Path) -> Option<bool> {
    let file = File::open(path).ok()?;
    if !file.metadata().ok()?.is_file() {
        return None;
    }
    let mut head = Vec::new();
    file.take(HEAD).read_to_end(&mut head).ok()?;
    let header = head
        .split(|b| *b == b'\n')
        .find(|line| !line.starts_with(b"#"))?;
    let mut names = header.trim_ascii().split(|b| *b == b',');
    Some(COLUMNS.iter().all(|column| names.next() == Some(column)))
}

/// The first seven fields as finite numbers.
fn numbers(row: &ByteRecord) -> Option<[f64; 7]> {
    let mut numbers = [0.0_f64; 7];
    for (k, number) in numbers.iter_mut().enumerate() {
        *number = std::str::from_utf8(row.get(k)?).ok()?.trim().parse().ok()?;
        if !number.is_finite() {
            return None;
        }
    }
    Some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Recording, Stream};

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
    }
}
