//! The multiplier that most of its neighbours agree with.

use super::trial::Trial;

findings::tuning! {
    /// Fits within this factor of the best are as good: what many multipliers agree on counts for more.
    AS_GOOD: f64 = 1.3;
}

/// The middle of the longest run of good trials with one number of intervals, among those with so many
/// spare placements.
pub(super) fn plateau(trials: &[Trial], spare: usize) -> Option<usize> {
    let error = |t: &Trial| t.expected_error.filter(|_| t.spare >= Some(spare));
    let best = trials.iter().filter_map(error).min_by(f64::total_cmp)?;
    let good = |t: &Trial| error(t).is_some_and(|r| r <= AS_GOOD.get() * best);
    let mut longest = 0..0;
    let mut from = 0;
    for k in 0..trials.len() {
        let joins = k > from
            && trials[k].static_intervals == trials[from].static_intervals
            && good(&trials[from]);
        if !(joins && good(&trials[k])) {
            from = k;
        }
        if good(&trials[k]) && k + 1 - from > longest.len() {
            longest = from..k + 1;
        }
    }
    (!longest.is_empty()).then(|| longest.start + (longest.len() - 1) / 2)
}

/// The middle of the longest run of plausible trials with the most placements: where no calibration can be made of any, that is what
/// the recording shows.
pub(super) fn most_placements(trials: &[Trial]) -> Option<usize> {
    let plausible = |t: &&Trial| t.plausible;
    let most = trials
        .iter()
        .filter(plausible)
        .map(|t| t.placements)
        .max()?;
    let is_best = |t: &Trial| t.plausible && t.placements == most;
    let runs = trials.chunk_by(|a, b| {
        is_best(a) == is_best(b) && (!is_best(a) || a.static_intervals == b.static_intervals)
    });
    let mut longest = 0..0;
    let mut from = 0;
    for run in runs {
        if is_best(&run[0]) && run.len() > longest.len() {
            longest = from..from + run.len();
        }
        from += run.len();
    }
    (!longest.is_empty()).then(|| longest.start + (longest.len() - 1) / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trials(rows: &[(usize, f64)]) -> Vec<Trial> {
        rows.iter()
            .map(|&(static_intervals, r)| Trial {
                multiplier: 1.0,
                window: 1.0,
                min_static: 3.0,
                spare: (r > 0.0).then_some(3),
                static_intervals,
                placements: static_intervals,
                plausible: r > 0.0,
                residual: (r > 0.0).then_some(r),
                expected_error: (r > 0.0).then_some(r),
            })
            .collect()
    }

    #[test]
    fn the_middle_of_the_longest_good_run_is_chosen() {
        let rows = [
            (9, 0.0),
            (12, 5.0),
            (14, 1.0),
            (14, 1.02),
            (14, 1.05),
            (15, 1.0),
            (13, 9.0),
        ];
        assert_eq!(plateau(&trials(&rows), 2), Some(3));
    }

    #[test]
    fn without_a_fit_nothing_is_chosen() {
        assert_eq!(plateau(&trials(&[(2, 0.0), (3, 0.0)]), 1), None);
        assert_eq!(most_placements(&trials(&[(2, 0.0), (3, 0.0)])), None);
    }

    #[test]
    fn without_a_calibration_most_placements_count() {
        let rows = [
            (2, 0.0),
            (11, 1.0),
            (9, 1.0),
            (10, 1.0),
            (10, 1.0),
            (10, 1.0),
        ];
        let mut trials = trials(&rows);
        trials[1].placements = 10;
        assert_eq!(most_placements(&trials), Some(4));
    }
}
