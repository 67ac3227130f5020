//! Static intervals picked by hand, from a table.

use std::path::Path;

use findings::{Finding, Kind};

use super::spans::Span;
use crate::error::Error;
use crate::read_text;
use crate::recording::{Recording, Stream};
use crate::shown::{figure, shown, shown_path};
use crate::source::place::at_line;

/// Unit of the start and stop in the table.
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
    let fail = |line: u64, found: Finding| at_line(&shown_path(path), line, found);
    let unreadable = |line: u64, error: &csv::Error| {
        let found = Finding::of(Kind::SECTIONS_UNREADABLE);
        fail(line, found.detail("reason", shown(&error.to_string())))
    };
    let text = read_text(path)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|e| unreadable(1, &e))?.clone();
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
                Finding::of(Kind::SECTIONS_COLUMNS).detail(
                    "columns",
                    shown(&header.iter().collect::<Vec<_>>().join(",")),
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
        let row = row.map_err(|e| unreadable(e.position().map_or(0, csv::Position::line), &e))?;
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
                    Finding::of(Kind::NUMBER_EXPECTED)
                        .detail("cell", shown(cell))
                        .count("column", k + 1),
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
                    Finding::of(Kind::SAMPLES_OUTSIDE)
                        .detail("from", figure(a))
                        .detail("to", figure(b))
                        .count("count", n),
                )
            })?,
        };
        if span.length() <= 0.0 || span.length().is_nan() {
            return Err(fail(
                line,
                Finding::of(Kind::INTERVAL_EMPTY)
                    .detail("from", figure(span.from))
                    .detail("to", figure(span.to)),
            ));
        }
        if let Some(before) = spans.last().filter(|s| s.to > span.from) {
            return Err(fail(
                line,
                Finding::of(Kind::INTERVALS_OVERLAP)
                    .detail("from", format!("{:.3}", span.from))
                    .detail("end", format!("{:.3}", before.to)),
            ));
        }
        spans.push(span);
    }
    if spans.is_empty() {
        let none = Finding::of(Kind::NO_INTERVALS);
        return Err(fail(1, none.detail("named", &recording.name)));
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
