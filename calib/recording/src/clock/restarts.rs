//! Clocks that begin again: a reboot, a power cycle, two logs in one file. What follows is another recording.

use crate::clock::wraps::usual_step;
use crate::rows::table::Table;

findings::tuning! {
    /// Rows that make a recording of their own.
    FEWEST: usize = 20;
    /// Steps that time goes back by rows that are out of order.
    SHUFFLED: f64 = 50.0;
    /// Steps by which a clock is set back; two rows may change places.
    SET_BACK: f64 = 5.0;
    /// Steps without a row before a header: ten seconds at 100 Hz.
    PAUSE: f64 = 1000.0;
    /// More often no device begins again in one file.
    MOST: usize = 100;
}

/// One recording of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Session {
    /// Its first line.
    pub first: u64,
    /// Its last line.
    pub last: u64,
    /// Its rows.
    pub rows: usize,
    /// Its first and last stamp, as they are written.
    pub from: f64,
    /// See `from`.
    pub to: f64,
}

/// The recordings in `table`, one where its clock never begins again.
pub(crate) fn sessions(table: &Table) -> Vec<Session> {
    let goes_on = table.ascends() || table.repeats();
    if goes_on && table.headers.is_empty() {
        return Vec::new();
    }
    let rows = table.stamped_lines();
    let restarts = match goes_on {
        true => begun_again(&rows, &table.headers),
        false => restarts(&rows),
    };
    if restarts.is_empty() && goes_on {
        return Vec::new();
    }
    let starts = [0].into_iter().chain(restarts.iter().copied());
    let ends = restarts.iter().copied().chain([rows.len()]);
    let session = |(start, end): (usize, usize)| {
        let part = &rows[start..end];
        Some(Session {
            first: part.first()?.0,
            last: part.last()?.0,
            rows: part.len(),
            from: part.first()?.1,
            to: part.last()?.1,
        })
    };
    starts.zip(ends).filter_map(session).collect()
}

/// The rows at which the clock begins again; none where some stamps are out of order in another way.
fn restarts(rows: &[(u64, f64)]) -> Vec<usize> {
    let Some(usual) = usual_step(rows) else {
        return Vec::new();
    };
    let t = |at: usize| rows[at].1;
    let mut found: Vec<usize> = Vec::new();
    let mut start = 0;
    let mut latest = t(0);
    for at in 1..rows.len() {
        let back = latest - t(at);
        let to_the_start = back > 2.0 * usual
            && (t(at) <= t(start) + 2.0 * usual
                || (t(at) <= t(start) + SHUFFLED.get() * usual
                    && goes_on(&rows[at..], latest, usual)));
        let set_back = || {
            back > SET_BACK.get() * usual
                && covers(&rows[start..at], t(at), usual)
                && goes_on(&rows[at..], latest, usual)
        };
        if t(at) < t(at - 1) && (back > SHUFFLED.get() * usual || to_the_start || set_back()) {
            if at - start < FEWEST.get() || found.len() == MOST.get() {
                return Vec::new();
            }
            found.push(at);
            (start, latest) = (at, t(at));
            continue;
        }
        // Back where the last one ended: rows that were written late.
        if let Some(&last) = found.last()
            && last == start
        {
            let ended = t(last - 1);
            let lands = |stamp: f64| (stamp - ended).abs() <= SHUFFLED.get() * usual;
            if t(at) - t(at - 1) > SHUFFLED.get() * usual && t(at - 1) < ended && lands(t(at)) {
                return Vec::new();
            }
        }
        latest = latest.max(t(at));
    }
    match rows.len() - start < FEWEST.get() {
        true => Vec::new(),
        false => found,
    }
}

/// The rows below a header that comes again long after the row before it: the logger was started once more.
fn begun_again(rows: &[(u64, f64)], headers: &[u64]) -> Vec<usize> {
    let Some(usual) = usual_step(rows) else {
        return Vec::new();
    };
    let is_late = |at: &usize| *at > 0 && rows[*at].1 - rows[at - 1].1 > PAUSE.get() * usual;
    let below = headers
        .iter()
        .map(|line| rows.partition_point(|(row, _)| row < line));
    let found: Vec<usize> = below
        .filter(|at| *at < rows.len())
        .filter(is_late)
        .collect();
    let starts = [0].into_iter().chain(found.iter().copied());
    let ends = found.iter().copied().chain([rows.len()]);
    let are_whole = starts
        .zip(ends)
        .all(|(start, end)| end >= start + FEWEST.get());
    match are_whole {
        true => found,
        false => Vec::new(),
    }
}

/// Returns true if rows stand at every step from the time `from` on: those that follow from there were not written late.
fn covers(rows: &[(u64, f64)], from: f64, usual: f64) -> bool {
    let last = rows
        .iter()
        .rev()
        .take_while(|(_, t)| *t > from - 1.5 * usual);
    let stamps: Vec<f64> = last.map(|(_, t)| *t).collect();
    let are_even = stamps
        .windows(2)
        .all(|pair| (0.0..2.5 * usual).contains(&(pair[0] - pair[1])));
    are_even
        && stamps
            .last()
            .is_some_and(|first| *first < from + 1.5 * usual)
}

/// Returns true if the rows ascend without a jump up to the time `latest`. Rows that were written late leave a jump behind them.
fn goes_on(rows: &[(u64, f64)], latest: f64, usual: f64) -> bool {
    rows.windows(2)
        .take_while(|pair| pair[0].1 <= latest)
        .all(|pair| (0.0..=2.5 * usual).contains(&(pair[1].1 - pair[0].1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(parts: &[(usize, f64)]) -> Vec<(u64, f64)> {
        let stamps = parts
            .iter()
            .flat_map(|(count, from)| (0..*count).map(move |k| from + 0.01 * k as f64));
        (2..).zip(stamps).collect()
    }

    #[test]
    fn a_clock_that_begins_again_makes_two_recordings() {
        assert_eq!(restarts(&rows(&[(1000, 0.0), (1000, 0.0)])), [1000]);
        assert_eq!(
            restarts(&rows(&[(1000, 50.0), (1000, 3.0), (40, 0.0)])),
            [1000, 2000]
        );
        // A first boot of a third of a second.
        assert_eq!(restarts(&rows(&[(30, 0.0), (1000, 0.0)])), [30]);
        // The clock was set back by a third of a second.
        assert_eq!(restarts(&rows(&[(1000, 0.0), (1000, 9.66)])), [1000]);
        // The second took longer until its first row.
        assert_eq!(restarts(&rows(&[(40, 0.0), (1000, 0.3)])), [40]);
    }

    #[test]
    fn a_header_after_a_pause_begins_another_recording() {
        let both = rows(&[(1000, 0.0), (1000, 100.0)]);
        assert_eq!(begun_again(&both, &[1002]), [1000]);
        // Within a recording, and a pause without a header.
        assert!(begun_again(&both, &[300]).is_empty() && begun_again(&both, &[]).is_empty());
    }

    #[test]
    fn rows_that_are_out_of_order_make_no_recording() {
        // One row that came late.
        assert!(restarts(&rows(&[(1000, 0.0), (1, 9.5), (1000, 10.0)])).is_empty());
        // Rows that came late soon after the start.
        assert!(restarts(&rows(&[(40, 0.0), (5, 0.3), (1000, 0.4)])).is_empty());
        // Two seconds that came late.
        assert!(restarts(&rows(&[(1000, 0.0), (200, 7.0), (1000, 10.0)])).is_empty());
        // Two rows that changed places, four seconds apart.
        let mut swapped = rows(&[(2000, 0.0)]);
        let (a, b) = (swapped[1000].1, swapped[1400].1);
        (swapped[1000].1, swapped[1400].1) = (b, a);
        assert!(restarts(&swapped).is_empty());
    }
}
