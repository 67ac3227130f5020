//! Static intervals picked by hand, from a table.

use std::path::Path;

use super::spans::Span;
use crate::error::Error;
use crate::read_text;
use crate::recording::{Recording, Stream};
use crate::shown::shown_path;

/// How the table gives its rows.
enum Unit {
    /// First and last accelerometer sample, counted from 1, both inside.
    Samples,
    /// Start and end, s.
    Seconds,
}

/// Reads a CSV table of static intervals for `recording`: columns `t0,t1` in seconds, or
/// `start…,stop…` as accelerometer samples counted from 1, both inside. With a column `recording`
/// only the rows with the recording's own name count.
///
/// # Errors
/// An unreadable table, or rows that do not fit the recording; the message names file and line.
pub fn read_sections(path: &Path, recording: &Recording) -> Result<Vec<Span>, Error> {
    let fail =
        |line: u64, what: String| Error::input(format!("{}:{line}: {what}", shown_path(path)));
    let text = read_text(path)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = reader
        .headers()
        .map_err(|e| fail(1, e.to_string()))?
        .clone();
    let find = |names: &[&str]| {
        header
            .iter()
            .position(|h| names.iter().any(|n| h.to_lowercase().starts_with(n)))
    };
    let (from, to, unit) = match (
        find(&["t0"]),
        find(&["t1"]),
        find(&["start"]),
        find(&["stop", "end"]),
    ) {
        (Some(a), Some(b), _, _) => (a, b, Unit::Seconds),
        (_, _, Some(a), Some(b)) => (a, b, Unit::Samples),
        _ => {
            return Err(fail(
                1,
                format!(
                    "columns {} found; t0,t1 (seconds) or start,stop (sample numbers) expected",
                    header.iter().collect::<Vec<_>>().join(",")
                ),
            ));
        }
    };
    let named = find(&["recording"]);
    let own = Path::new(&recording.name)
        .file_name()
        .map(|n| n.to_string_lossy().into_owned());
    let stream = recording.accelerometer.as_ref();
    let mut spans: Vec<Span> = Vec::new();
    for row in reader.records() {
        let row =
            row.map_err(|e| fail(e.position().map_or(0, csv::Position::line), e.to_string()))?;
        let line = row.position().map_or(0, csv::Position::line);
        if let (Some(k), Some(own)) = (named, &own)
            && row.get(k) != Some(own.as_str())
        {
            continue;
        }
        let number = |k: usize| {
            let cell = row.get(k).unwrap_or("");
            cell.parse::<f64>().map_err(|_| {
                fail(
                    line,
                    format!("column {}: number expected, \"{cell}\" found", k + 1),
                )
            })
        };
        let (a, b) = (number(from)?, number(to)?);
        let span = match unit {
            Unit::Seconds => Span { from: a, to: b },
            Unit::Samples => of_samples(stream, a, b).ok_or_else(|| {
                let n = stream.map_or(0, Stream::len);
                fail(
                    line,
                    format!("samples {a} to {b} found, within 1 to {n} expected"),
                )
            })?,
        };
        if span.length() <= 0.0 || span.length().is_nan() {
            return Err(fail(
                line,
                format!("the interval {} to {} is empty", span.from, span.to),
            ));
        }
        if let Some(before) = spans.last().filter(|s| s.to > span.from) {
            return Err(fail(
                line,
                format!(
                    "starts at {:.3} s, before the end of the one above ({:.3} s)",
                    span.from, before.to
                ),
            ));
        }
        spans.push(span);
    }
    if spans.is_empty() {
        return Err(fail(1, format!("no interval for {}", recording.name)));
    }
    Ok(spans)
}

/// The span that holds samples `first` to `last`, counted from 1.
fn of_samples(stream: Option<&Stream>, first: f64, last: f64) -> Option<Span> {
    let t = &stream?.t;
    let place = |number: f64| (number >= 1.0 && number.fract() == 0.0).then(|| number as usize - 1);
    let (a, b) = (place(first)?, place(last)?);
    let (from, end) = (*t.get(a)?, *t.get(b)?);
    let step = match t.get(b + 1) {
        Some(next) => next - end,
        None => end - *t.get(b.checked_sub(1)?)?,
    };
    Some(Span {
        from,
        to: end + 0.5 * step,
    })
}
