//! The rows of one mean or one turn, in the order in which a bias passes them.

use std::ops::Range;
use std::sync::Arc;

use super::rows::RowNoise;
use crate::methods::joint::blocks::groups::RowGroups;

/// The rows of a mean (3) or of a turn (2).
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// The rows.
    pub rows: Range<usize>,
    /// The recording: stations share noise with others of the same one only.
    pub line: usize,
    /// Side of the reference time (true after it), and signed distance from it, s: positive after, negative before.
    place: (bool, f64),
}

/// All rows, recording by recording and in each by time.
#[derive(Clone, Debug)]
pub struct Stations(Arc<[Station]>);

impl Stations {
    /// Builds the stations of all rows; those of the turns begin at row `first_turn`.
    pub fn new(noise: &RowNoise, first_turn: usize) -> Self {
        let count = noise.variance.len();
        let mut place = vec![(true, f64::MAX); count];
        for exposure in noise.exposures.iter().flatten() {
            let outwards = if exposure.after { 1.0 } else { -1.0 };
            place[exposure.rows.start] = (exposure.after, outwards * exposure.near);
        }
        let means = (0..first_turn).step_by(3).map(|row| row..row + 3);
        let turns = (first_turn..count).step_by(2).map(|row| row..row + 2);
        let station = |rows: Range<usize>| Station {
            line: noise.groups.of(rows.start),
            place: place[rows.start],
            rows,
        };
        Self::sorted(means.chain(turns).map(station).collect())
    }

    /// Every row by itself, in the order of the rows.
    pub fn single(groups: &RowGroups) -> Self {
        let station = |row: usize| Station {
            rows: row..row + 1,
            line: groups.of(row),
            place: (true, row as f64),
        };
        Self::sorted((0..groups.rows()).map(station).collect())
    }

    fn sorted(mut all: Vec<Station>) -> Self {
        all.sort_by(|a, b| {
            let by_side = (a.line, a.place.0).cmp(&(b.line, b.place.0));
            by_side.then(a.place.1.total_cmp(&b.place.1))
        });
        Self(all.into())
    }

    /// All of them.
    pub fn all(&self) -> &[Station] {
        &self.0
    }

    /// The places of the stations of every recording.
    pub fn lines(&self) -> Vec<Range<usize>> {
        let mut lines: Vec<Range<usize>> = Vec::new();
        for (k, station) in self.0.iter().enumerate() {
            match lines.last_mut() {
                Some(line) if self.0[line.start].line == station.line => line.end = k + 1,
                _ => lines.push(k..k + 1),
            }
        }
        lines
    }

    /// The station that begins with each row.
    pub fn of_first_row(&self, rows: usize) -> Vec<Option<usize>> {
        let mut of_row = vec![None; rows];
        for (k, station) in self.0.iter().enumerate() {
            of_row[station.rows.start] = Some(k);
        }
        of_row
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.0.iter().map(|station| station.rows.len()).sum()
    }
}
