//! Recordings as plain CSV.

use std::fmt::Write as _;

use super::{Magnetometer, Recording, Stream};

/// The recording as one plain CSV table, numbers to their last digit.
///
/// Where the sensors have clocks of their own the gyroscope is interpolated to the stamps of the
/// accelerometer that lie within its own; a warning is added that says so.
pub fn to_csv(recording: &mut Recording) -> String {
    let mut names = String::from("t");
    let mut streams: Vec<Stream> = Vec::new();
    if let Some(stream) = &recording.accelerometer {
        names.push_str(",ax,ay,az");
        streams.push(stream.clone());
    }
    if let Some(stream) = &recording.gyroscope {
        names.push_str(",gx,gy,gz");
        streams.push(stream.clone());
    }
    if let [first, second] = streams.as_mut_slice()
        && first.t != second.t
    {
        recording.warnings.push(
            "the sensors have clocks of their own: the gyroscope is interpolated to the \
             accelerometer's stamps; `-o FOLDER` keeps both clocks"
                .into(),
        );
        *first = within(first, second);
        let values = first.t.iter().filter_map(|&t| second.at(t)).collect();
        *second = Stream {
            t: first.t.clone(),
            values,
        };
    }
    if recording.temperature.is_some() {
        names.push_str(",temp");
    }
    let field = recording.magnetometer.as_ref();
    if let Some(field) = field {
        names.push(',');
        names.push_str(&field_names(field));
    }
    if field.is_some_and(|field| {
        streams
            .first()
            .is_none_or(|first| first.t != field.stream.t)
    }) {
        let words = "the magnetometer has a clock of its own and is interpolated to the stamps of the others; \
                     `-o FOLDER` keeps it";
        recording.warnings.push(words.into());
    }
    let mut text = names + "\n";
    let stamps = streams.first().map_or(&[][..], |s| &s.t);
    for (k, t) in stamps.iter().enumerate() {
        let _ = write!(text, "{t}");
        for stream in &streams {
            for x in &stream.values[k] {
                let _ = write!(text, ",{x}");
            }
        }
        if let Some(celsius) = recording.temperature.as_ref().and_then(|c| c.at(*t)) {
            let _ = write!(text, ",{celsius}");
        }
        if let Some(field) = &recording.magnetometer {
            // Nothing where it was not on.
            let on = field.stream.t.first() <= Some(t) && Some(t) <= field.stream.t.last();
            match field.stream.at(*t).filter(|_| on) {
                Some(v) => _ = write!(text, ",{},{},{}", v.x, v.y, v.z),
                None => text.push_str(",,,"),
            }
        }
        text.push('\n');
    }
    text
}

/// The names of a magnetometer's columns, with its unit where it is known: `mx (gauss),my (gauss),mz (gauss)`.
pub fn field_names(field: &Magnetometer) -> String {
    let unit = field.unit.map(|unit| format!(" ({})", unit.name()));
    let unit = unit.unwrap_or_default();
    ["mx", "my", "mz"]
        .map(|name| format!("{name}{unit}"))
        .join(",")
}

/// One sensor as CSV with the given column names.
pub fn stream_to_csv(stream: &Stream, names: &str) -> String {
    let mut text = format!("{names}\n");
    for (t, v) in stream.t.iter().zip(&stream.values) {
        let _ = writeln!(text, "{t},{},{},{}", v.x, v.y, v.z);
    }
    text
}

/// The samples of `stream` within the time of `other`.
fn within(stream: &Stream, other: &Stream) -> Stream {
    let (Some(&from), Some(&to)) = (other.t.first(), other.t.last()) else {
        return Stream::default();
    };
    let range = stream.t.partition_point(|&t| t < from)..stream.t.partition_point(|&t| t <= to);
    Stream {
        t: stream.t[range.clone()].to_vec(),
        values: stream.values[range].to_vec(),
    }
}
