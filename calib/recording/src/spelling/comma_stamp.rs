//! Stamps with a comma before the part of a second, in a text that commas separate: `13:05:10,000,0.1,..`.

use super::cells::{cells, lines, most, separator};
use super::respell::{Respell, Spelling};
use crate::header::look::Look;
use crate::header::names::{is_like_time, role_of};
use crate::recording::options::Role;
use crate::source::rewrite::rewritten;

/// A row has one cell more than the header has names: its stamp is in two.
pub(super) static COMMA_STAMP: Spelling = Spelling {
    spelling: "commas before decimals of seconds",
    read_as: "points",
    of_dates: false,
    change,
};

findings::tuning! {
    /// Rows that show that a cell counts within the second.
    FEWEST: usize = 10;
}

/// The two cells of a stamp.
#[derive(Clone, Copy, Debug)]
struct Stamps {
    column: usize,
    /// Cells of a row.
    width: usize,
    /// Digits of a part.
    digits: usize,
}

/// A stamp in two cells.
struct Stamp<'a> {
    whole: &'a str,
    part: &'a str,
}

fn is_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// True for what ends with a time of day to whole seconds.
fn is_clock(text: &str) -> bool {
    let last = text.rsplit(':').next().unwrap_or_default();
    text.matches(':').count() == 2 && last.len() == 2 && is_digits(last)
}

fn stamp(line: &str, column: usize) -> Option<Stamp<'_>> {
    let places = cells(line, ',');
    let [whole, part] = [column, column + 1].map(|at| places.get(at).cloned());
    let (whole, part) = (&line[whole?], &line[part?]);
    // In quotes it is one cell.
    let is_stamp = (is_clock(whole) || is_digits(whole)) && is_digits(part);
    is_stamp.then_some(Stamp { whole, part })
}

impl Stamps {
    /// Those of a text.
    fn of(look: &Look) -> Option<Self> {
        let lines = lines(look);
        if separator(&lines)? != ',' {
            return None;
        }
        let (width, _) = most(lines.iter().map(|line| cells(line, ',').len()))?;
        let rows = || lines.iter().filter(|line| cells(line, ',').len() == width);
        let names = lines.iter().find_map(|line| names(line, width));
        let first = rows().next()?;
        let clock = (0..width).find(|at| is_clock(&first[cells(first, ',')[*at].clone()]));
        let column = match names {
            Some(column) => column,
            // Rows without a header show a time of day, and numbers show nothing.
            None if role_of(first, None).is_none() && stamp(first, clock?).is_some() => clock?,
            None => return None,
        };
        let digits = stamp(first, column)?.part.len();
        let stamps = Self {
            column,
            width,
            digits,
        };
        stamps.hold(rows().copied()).then_some(stamps)
    }

    /// True if the second cell counts within the seconds of the first, in all rows, and from its start in the next second.
    fn hold<'a>(&self, rows: impl Iterator<Item = &'a str>) -> bool {
        let (mut before, mut count, mut turns) = (None::<Stamp<'_>>, 0, 0);
        for row in rows {
            let Some(stamp) = stamp(row, self.column).filter(|s| s.part.len() == self.digits)
            else {
                return false;
            };
            if let Some(before) = before {
                let same = before.whole == stamp.whole;
                let seconds = [before.whole, stamp.whole].map(|text| text.parse::<i64>().ok());
                let passed = match seconds {
                    [Some(before), Some(now)] => now.saturating_sub(before) == 1,
                    _ => true,
                };
                if (same && stamp.part < before.part)
                    || (!same && passed && stamp.part >= before.part)
                {
                    return false;
                }
                turns += usize::from(!same && passed);
            }
            before = Some(stamp);
            count += 1;
        }
        count >= FEWEST.get() && turns > 0
    }
}

/// The column of the time in a header with one name less than a row has cells.
fn names(line: &str, width: usize) -> Option<usize> {
    let places = cells(line, ',');
    if places.len() + 1 != width {
        return None;
    }
    let names = || places.iter().map(|at| &line[at.clone()]);
    let of_time = names().position(|name| role_of(name, None) == Some(Role::Time));
    of_time.or_else(|| names().position(is_like_time))
}

fn change(look: &Look) -> Option<Respell> {
    let stamps = Stamps::of(look)?;
    let Stamps {
        column,
        width,
        digits,
    } = stamps;
    Some(Box::new(move |text| {
        rewritten(text, move |line, out| {
            let text = std::str::from_utf8(line).unwrap_or_default();
            let places = cells(text, ',');
            let is_row = places.len() == width
                && stamp(text, column).is_some_and(|stamp| stamp.part.len() == digits);
            if !is_row {
                return out.extend_from_slice(line);
            }
            out.extend_from_slice(&line[..places[column].end]);
            out.push(b'.');
            out.extend_from_slice(&line[places[column + 1].start..]);
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::super::respell::respelt;
    use super::*;

    fn rows(begin: &str, count: u64) -> String {
        let row = |k: u64| {
            let ms = 850 + 10 * k;
            format!("{begin}{:02},{:03},0.5,-1\n", ms / 1000, ms % 1000)
        };
        (0..count).map(row).collect()
    }

    #[test]
    fn the_part_of_a_second_behind_a_comma_joins_its_second() {
        for (header, begin, last) in [
            ("time,ax,ay\n", "13:05:", "13:05:01.040,0.5,-1"),
            ("", "13:05:", "13:05:01.040,0.5,-1"),
            ("t,ax,ay\n", "17", "1701.040,0.5,-1"),
            (
                "Time,ax,ay\n",
                "2026-11-21 13:05:",
                "2026-11-21 13:05:01.040,0.5,-1",
            ),
        ] {
            let text = header.to_owned() + &rows(begin, 20);
            let read = respelt(&COMMA_STAMP, &text).unwrap();
            assert_eq!(read.lines().last(), Some(last));
            assert_eq!(read.lines().count(), text.lines().count());
        }
    }

    #[test]
    fn what_does_not_count_within_the_second_is_left_alone() {
        // A name for each cell, no turn of a second, and whole numbers that are none.
        for text in [
            "time,ms,ax,ay\n".to_owned() + &rows("13:05:", 20),
            "time,ax,ay\n".to_owned() + &rows("13:05:", 12),
            rows("17", 20),
            "t,ax,ay\n1,500,2\n".repeat(20),
        ] {
            assert_eq!(respelt(&COMMA_STAMP, &text), None, "{text}");
        }
    }
}
