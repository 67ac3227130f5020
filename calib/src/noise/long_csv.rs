//! Allan curves straight from a plain CSV file, however long it is.

use std::path::Path;

use csv::{ByteRecord, ReaderBuilder};
use nalgebra::Vector3;

use super::curves::{RecordingCurves, SensorAccumulator};

/// The columns of the plain CSV recording.
const COLUMNS: [&[u8]; 7] = [b"t", b"ax", b"ay", b"az", b"gx", b"gy", b"gz"];

/// Bytes read at a time.
const BUFFER: usize = 1 << 20;

/// Reads a plain CSV recording (`t,ax,ay,az,gx,gy,gz…`) row by row into curves, without keeping the
/// samples: a day at 200 Hz needs no more memory than a minute.
///
/// `None` for anything else: other columns, a row with a missing or unreadable number, time that
/// does not ascend. The reader of recordings then says what is wrong, or knows the format.
pub fn curves_of_long_csv(path: &Path) -> Option<RecordingCurves> {
    let mut reader = ReaderBuilder::new()
        .buffer_capacity(BUFFER)
        .comment(Some(b'#'))
        .flexible(true)
        .from_path(path)
        .ok()?;
    let header = reader.byte_headers().ok()?;
    if header.len() < COLUMNS.len() || !COLUMNS.iter().zip(header).all(|(c, h)| *c == h) {
        return None;
    }
    let mut accelerometer = SensorAccumulator::default();
    let mut gyroscope = SensorAccumulator::default();
    let mut last = f64::NEG_INFINITY;
    let mut row = ByteRecord::new();
    while reader.read_byte_record(&mut row).ok()? {
        let [t, ax, ay, az, gx, gy, gz] = numbers(&row)?;
        if t <= last {
            return None;
        }
        last = t;
        accelerometer.push(t, Vector3::new(ax, ay, az));
        gyroscope.push(t, Vector3::new(gx, gy, gz));
    }
    Some(RecordingCurves {
        accelerometer: accelerometer.finish(),
        gyroscope: gyroscope.finish(),
    })
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
        let mut text = String::from("# at rest\nt,ax,ay,az,gx,gy,gz,temp\n");
        let mut recording = Recording {
            accelerometer: Some(Stream::default()),
            gyroscope: Some(Stream::default()),
            ..Recording::default()
        };
        for k in 0..1000 {
            let t = k as f64 * 0.5;
            let [a, g] = [0, 3].map(|n| Vector3::from_fn(|i, _| value(k, n + i)));
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
        assert_eq!(
            curves_of_long_csv(&path),
            Some(RecordingCurves::of(&recording))
        );
        for odd in [
            "500,1,2,3,4,5\n",
            "500,1,2,3,4,5,x\n",
            "3,1,2,3,4,5,6\n",
            "500,1,2,3,4,5,inf\n",
        ] {
            std::fs::write(&path, format!("{text}{odd}")).unwrap();
            assert_eq!(curves_of_long_csv(&path), None, "{odd}");
        }
        std::fs::write(&path, text.replace("gx,gy", "gy,gx")).unwrap();
        assert_eq!(curves_of_long_csv(&path), None);
    }
}
