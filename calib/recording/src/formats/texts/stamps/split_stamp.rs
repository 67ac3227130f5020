//! Tables with the whole seconds in one column and the part of the second in another: `unix,ms,..`, `sec,nanosec,..`.

use std::io::Read;
use std::ops::Range;

use crate::formats::texts::places::{may_be_row, places, replaced, whole_rows, words};
use crate::formats::texts::text_format::TextFormat;
use crate::header::look::Look;
use crate::header::names::{compact, is_like_time, role_of, stated_unit, take_apart};
use crate::recording::options::Role;
use crate::rows::parts::Part;
use crate::source::rewrite::rewritten;
use crate::units::TimeUnit;

/// A table whose stamp is in two columns, of which one counts within the second.
pub(crate) static SPLIT_STAMP: TextFormat = TextFormat {
    name: "split_stamp",
    about: "a table with a column of whole seconds and one of the part of the second: `unix,ms,..`, `sec,nanosec,..`",
    parts,
};

/// Ends of the names of whole seconds that are not called a time.
const SECONDS: [&str; 6] = ["unix", "epoch", "sec", "secs", "second", "seconds"];

/// The name of the column of the part, so that it is no time of its own.
const PART: &str = "part";

/// The two columns of a stamp.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Columns {
    whole: usize,
    part: usize,
    /// Digits of a part with its leading zeros.
    digits: usize,
}

/// A stamp in two cells.
struct Stamp<'a> {
    /// Whole seconds, as a number or a time of day.
    whole: &'a str,
    part: u64,
    at: [Range<usize>; 2],
}

impl Columns {
    /// Those of a header.
    fn of(header: &str) -> Option<Self> {
        let names = words(header);
        let wholes: Vec<usize> = (0..names.len()).filter(|&at| is_whole(names[at])).collect();
        let mut parts = (0..names.len()).filter_map(|at| Some((at, digits(names[at])?)));
        let (part, digits) =
            parts.find(|(at, _)| wholes.first().is_some_and(|first| first < at))?;
        let before = || wholes.iter().copied().filter(|&at| at < part);
        // `header.stamp.secs` belongs to `header.stamp.nsecs`, and a time before both to neither.
        let alike =
            before().find(|&at| stem(names[at]).is_some_and(|own| Some(own) == stem(names[part])));
        Some(Self {
            whole: alike.or(before().next())?,
            part,
            digits,
        })
    }

    fn stamp<'a>(&self, line: &'a str) -> Option<Stamp<'a>> {
        let places = places(line);
        let at = [
            places.get(self.whole)?.clone(),
            places.get(self.part)?.clone(),
        ];
        let [whole, part] = at.clone().map(|at| &line[at]);
        let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let last = whole.rsplit(':').next().unwrap_or_default();
        let is_clock = whole.matches(':').count() == 2 && last.len() <= 2;
        if !(is_digits(whole) || (is_clock && is_digits(last))) || !is_digits(part) {
            return None;
        }
        let part = part.parse().ok()?;
        Some(Stamp { whole, part, at })
    }

    /// True if `stamp` may follow the one before it: a part counts within its second, and from its start in the next.
    fn may_follow(&self, before: &(String, u64), stamp: &Stamp<'_>) -> bool {
        let seconds = |text: &str| text.parse::<i64>().ok();
        let within = stamp.part < 10_u64.pow(self.digits as u32);
        let passed = seconds(stamp.whole).zip(seconds(&before.0));
        within
            && match passed.map(|(now, before)| now.saturating_sub(before)) {
                _ if before.0 == stamp.whole => stamp.part >= before.1,
                Some(passed) => passed > 1 || (passed == 1 && stamp.part < before.1),
                None => stamp.part < before.1,
            }
    }
}

/// The words before the last one of a name.
fn stem(name: &str) -> Option<&str> {
    let (stem, _) = name.rsplit_once(|c: char| !c.is_alphanumeric())?;
    Some(stem).filter(|stem| !stem.is_empty())
}

fn is_whole(name: &str) -> bool {
    let word = compact(&take_apart(name).0);
    let is_called = || SECONDS.iter().any(|end| word.ends_with(end));
    match stated_unit(name) {
        Some(unit) => unit == TimeUnit::Seconds,
        None => role_of(name, None) == Some(Role::Time) || is_like_time(name) || is_called(),
    }
}

/// The digits of a part of a second that is called so.
fn digits(name: &str) -> Option<usize> {
    let word = || take_apart(name).0.parse().ok();
    match stated_unit(name).or_else(word)? {
        TimeUnit::Milliseconds => Some(3),
        TimeUnit::Microseconds => Some(6),
        TimeUnit::Nanoseconds => Some(9),
        _ => None,
    }
}

fn parts(look: &Look) -> Option<Vec<Part>> {
    let mut lines = whole_rows(look).into_iter();
    let columns = Columns::of(lines.next()?)?;
    let (mut before, mut rows, mut others): (Option<(String, u64)>, usize, usize) = (None, 0, 0);
    for line in lines {
        let Some(stamp) = columns.stamp(line) else {
            others += 1;
            continue;
        };
        let follows = before.is_none_or(|before| columns.may_follow(&before, &stamp));
        if !follows {
            return None;
        }
        before = Some((stamp.whole.to_owned(), stamp.part));
        rows += 1;
    }
    // A row of units is none.
    (rows > 1 && others <= 1).then(|| {
        vec![Part {
            time_unit: Some(TimeUnit::Seconds),
            change: Some(change),
            ..Part::default()
        }]
    })
}

/// The rows with the stamp in the column of the seconds, and the header with another name for the part. A part that does not
/// count within the second makes no number, for the reader to refuse.
fn change(text: Box<dyn Read + Send>) -> Box<dyn Read + Send> {
    let mut columns: Option<Columns> = None;
    let mut before: Option<(String, u64)> = None;
    rewritten(text, move |line, out| {
        let text = std::str::from_utf8(line).unwrap_or_default();
        let Some(known) = columns else {
            columns = Columns::of(text).filter(|_| may_be_row(text));
            let name = columns.and_then(|columns| places(text).get(columns.part).cloned());
            let text = name.map(|name| replaced(text, &name, PART));
            return out.extend_from_slice(text.as_deref().map_or(line, str::as_bytes));
        };
        let Some(stamp) = known.stamp(text) else {
            return out.extend_from_slice(line);
        };
        let [at, other] = &stamp.at;
        let (whole, part, digits) = (stamp.whole, stamp.part, known.digits);
        let mut rest = places(text)
            .into_iter()
            .filter(|cell| cell != at && cell != other);
        let mark = match rest.any(|cell| text[cell].contains(',')) {
            true => ',',
            false => '.',
        };
        let follows = before
            .take()
            .is_none_or(|before| known.may_follow(&before, &stamp));
        let joined = match follows {
            true => format!("{whole}{mark}{part:0digits$}"),
            false => format!("{whole} and {part}"),
        };
        before = Some((whole.to_owned(), part));
        out.extend_from_slice(replaced(text, at, &joined).as_bytes());
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::rewrite::changed_by;

    fn changed(text: &'static str) -> Option<String> {
        parts(&Look::at(text.as_bytes()))?;
        Some(changed_by(change, text))
    }

    #[test]
    fn seconds_and_their_parts_become_one_cell() {
        for (text, expected) in [
            (
                "unix,ms,ax\n17,993,1\n18,3,1\n18,13,1\n",
                "unix,part,ax\n17.993,993,1\n18.003,3,1\n18.013,13,1\n",
            ),
            (
                "header.stamp.sec;header.stamp.nanosec;ax\n7;5;0,1\n7;900000000;0,1\n",
                "header.stamp.sec;part;ax\n7,000000005;5;0,1\n7,900000000;900000000;0,1\n",
            ),
            (
                "Time,header.stamp.secs,header.stamp.nsecs,ax\n7.3,7,5,1\n7.4,7,9,1\n",
                "Time,header.stamp.secs,part,ax\n7.3,7.000000005,5,1\n7.4,7.000000009,9,1\n",
            ),
            (
                "tv_sec,tv_usec,ax\n7,500000,1\n8,0,1\n",
                "tv_sec,part,ax\n7.500000,500000,1\n8.000000,0,1\n",
            ),
            (
                "time ax msec\n12:00:03 1 7\n12:00:03 1 98\n",
                "time ax part\n12:00:03.007 1 7\n12:00:03.098 1 98\n",
            ),
        ] {
            assert_eq!(changed(text).as_deref(), Some(expected));
        }
    }

    #[test]
    fn a_column_that_does_not_count_within_the_second_is_no_part_of_it() {
        // A counter that goes on, and one that begins anew at other times than the second does.
        assert_eq!(changed("unix,ms,ax\n17,500,1\n17,900,1\n18,1300,1\n"), None);
        assert_eq!(changed("unix,ms,ax\n17,500,1\n18,510,1\n18,520,1\n"), None);
        assert_eq!(changed("unix,ms,ax\n17,990,1\n17,0,1\n18,10,1\n"), None);
        assert_eq!(changed("unix,dt_ms,ax\n17,10,1\n18,10,1\n18,10,1\n"), None);
        assert_eq!(changed("time,ax,ay\n17,1,1\n18,2,1\n"), None);
    }
}
