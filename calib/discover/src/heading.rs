//! Columns of what depends on the heading: nobody knows it from one recording to the next, nor after a turn that is not used.

use faer::Mat;

use super::state::State;

/// The first `count` columns (`m × k`) in the rows of every stretch through which the heading can be followed, as columns of
/// their own: first those of the first stretch and all others (`k`), then those of the other stretches, `count` each.
pub fn by_heading(state: &State, columns: Mat<f64>, count: usize) -> Mat<f64> {
    let rests = &state.fit.data.rests;
    let heading = |row: usize| rests[state.fit.rest_of_row[row]].heading;
    let headings = rests.last().map_or(1, |rest| rest.heading + 1);
    let k = columns.ncols();
    let count = count.min(k);
    if headings < 2 || count == 0 {
        return columns;
    }
    Mat::from_fn(columns.nrows(), k + count * (headings - 1), |i, j| {
        let (of, column) = match j.checked_sub(k) {
            Some(beyond) => (Some(1 + beyond / count), beyond % count),
            None => ((j < count).then_some(0), j),
        };
        match of {
            Some(of) if of != heading(i) => 0.0,
            _ => columns[(i, column)],
        }
    })
}

/// The places of the first `count` of such columns (`k` before they were cut) in every stretch.
pub fn places_by_heading(all: usize, k: usize, count: usize) -> Vec<Vec<usize>> {
    let others = (k..all).collect::<Vec<usize>>();
    let others = others.chunks(count.max(1)).map(<[usize]>::to_vec);
    std::iter::once((0..count).collect())
        .chain(others)
        .collect()
}
