//! Turns that miss gravity so far that a fit to all of them meets no turn at all.

use super::trial::Trial;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::orientation::oriented::At;
use crate::methods::joint::result::analysis::Analysis;

findings::tuning! {
    /// A fit that misses gravity after turns by more than this, rad (root mean square), is bent too far to judge single turns by it.
    GROSS: f64 = 0.0175;

    /// Turns are what bends it where the others are missed by less than this share of the sum of squares without them.
    LEFT: f64 = 1.0 / 9.0;
}

/// The suspects `given` and the fewest others, the worst first, that bend a fit which misses gravity grossly: those without which the others
/// are as their noise, or else the first that leave little; `None` where it does not, or where no `most` do.
pub fn bends(
    at: &At<'_>,
    analysis: &Analysis,
    (candidates, trial): (&[Suspect], &Trial<'_>),
    given: &[usize],
    most: usize,
) -> Option<Vec<usize>> {
    let turns = &at.linear.residuals[at.rows.first_turn_row()..];
    let square: f64 = turns.iter().map(|r| r * r).sum();
    // Two rows of every turn are one angle.
    if 2.0 * square <= turns.len() as f64 * GROSS.get().powi(2) {
        return None;
    }
    let left = |found: &[usize]| {
        let found: Vec<&Suspect> = found.iter().map(|&k| &candidates[k]).collect();
        analysis.left_in_turns(at.rows, &found)
    };
    let mut found = given.to_vec();
    let whole = left(&found);
    let mut leave_little = None;
    while found.len() < most
        && let Some(worst) = trial.worst(&found)
    {
        trial.add(&mut found, worst, given.len());
        if left(&found) < LEFT.get() * whole {
            let all: Vec<&Suspect> = found.iter().map(|&k| &candidates[k]).collect();
            if !analysis.is_missed(at.rows, &all) {
                return Some(found);
            }
            leave_little.get_or_insert_with(|| found.clone());
        }
    }
    leave_little
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use crate::methods::joint::faults::OUTLYING_TURN;
    use crate::methods::joint::{JointRequest, fit_joint};

    #[test]
    fn turns_of_which_a_third_is_lost_are_found_however_they_bend_the_first_fit() {
        for (seed, lost) in [
            (1, &[3, 8][..]),
            (2, &[2, 6, 11]),
            (3, &[1, 4, 8, 11]),
            (5, &[1, 4, 8, 9]),
        ] {
            let mut recording = Spec::hand_held(seed).run().unwrap().recording;
            let segmentation = segment(&recording, &Detector::default()).unwrap();
            for &turn in lost {
                let rates = recording.gyroscope.as_mut().unwrap();
                let own = &mut rates.values[segmentation.turns[turn].samples.clone()];
                own.iter_mut().for_each(|rate| *rate *= 0.67);
            }
            let gravity = Spec::hand_held(seed).gravity;
            let cut = vec![(&recording, &segmentation)];
            let fit = fit_joint(&JointRequest::new(cut, gravity)).unwrap();
            let turns = fit.flagged.iter().filter(|a| a.fault == &OUTLYING_TURN);
            let turns: Vec<usize> = turns.map(|a| a.interval).collect();
            assert_eq!(turns, lost, "{:?}", fit.flagged);
        }
    }
}
