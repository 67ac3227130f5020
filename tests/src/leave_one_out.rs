//! Joint against stepwise on recordings of one device, each left out in turn.

use calib::calibrate::{Method, Request, calibrate};
use calib::methods::cut;
use calib::{Error, Misfit, Misfits, Recording, misfits};

/// What both methods leave in a recording that neither has seen.
#[derive(Clone, Debug, serde::Serialize)]
pub struct HeldOut {
    /// The recording.
    pub recording: String,
    /// `|f| − g` at rest, m/s².
    pub norm: Contest,
    /// The direction of gravity after the turns, degrees.
    pub direction: Contest,
}

/// The misfits of both methods at the same places.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Contest {
    /// Number of rests or turns.
    pub count: usize,
    /// Root mean square under the stepwise method.
    pub stepwise: f64,
    /// Root mean square under the joint method.
    pub joint: f64,
    /// Standard error of their difference, by the delta method over the places: both methods miss the same
    /// rests and turns, so that it is far smaller than the error of either.
    pub standard_error: f64,
}

impl Contest {
    /// By how much the joint method is worse.
    pub fn difference(&self) -> f64 {
        self.joint - self.stepwise
    }

    fn of(stepwise: &[Misfit], joint: &[Misfit]) -> Self {
        let count = stepwise.len();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / count as f64;
        let squares = |all: &[Misfit]| all.iter().map(|m| m.value.powi(2)).collect::<Vec<_>>();
        let (s, j) = (squares(stepwise), squares(joint));
        let (stepwise, joint) = (mean(&s).sqrt(), mean(&j).sqrt());
        // d√(mean e²) = d(mean e²) / (2 √(mean e²))
        let shares: Vec<f64> = s
            .iter()
            .zip(&j)
            .map(|(s, j)| 0.5 * (j / joint - s / stepwise))
            .collect();
        let off: Vec<f64> = shares.iter().map(|d| (d - mean(&shares)).powi(2)).collect();
        Self {
            count,
            stepwise,
            joint,
            standard_error: (mean(&off) / (count as f64 - 1.0)).sqrt(),
        }
    }
}

/// Calibrates on all recordings but one by either method and measures both on that one.
///
/// # Errors
/// What [`calibrate`] and [`cut`] say.
pub fn leave_one_out(recordings: &[Recording], gravity: f64) -> Result<Vec<HeldOut>, Error> {
    let held_out = |(k, recording): (usize, &Recording)| {
        let mut seen = recordings.to_vec();
        seen.remove(k);
        let stepwise = left(&seen, recording, Method::Stepwise, gravity)?;
        let joint = left(&seen, recording, Method::Joint, gravity)?;
        Ok(HeldOut {
            recording: recording.name.clone(),
            norm: Contest::of(&stepwise.rests, &joint.rests),
            direction: Contest::of(&stepwise.turns, &joint.turns),
        })
    };
    recordings.iter().enumerate().map(held_out).collect()
}

/// What a method's calibration leaves in a recording it has not seen.
fn left(
    seen: &[Recording],
    held_out: &Recording,
    method: Method,
    gravity: f64,
) -> Result<Misfits, Error> {
    let request = Request {
        method,
        gravity,
        ..Request::default()
    };
    let calibration = calibrate(seen, &[], &request)?.calibration;
    let choice = cut(held_out, &request.detector, true, gravity)?;
    misfits(held_out, &choice.segmentation, Some(&calibration), gravity)
}

#[cfg(test)]
mod tests {
    use super::*;
    use calib::intervals::Span;

    fn misfits(values: &[f64]) -> Vec<Misfit> {
        let span = Span { from: 0.0, to: 1.0 };
        let at = |(index, value): (usize, &f64)| Misfit {
            index,
            span,
            value: *value,
        };
        values.iter().enumerate().map(at).collect()
    }

    #[test]
    fn misfits_that_grow_by_the_same_factor_differ_by_it_without_doubt() {
        let contest = Contest::of(&misfits(&[3.0, -3.0, 3.0]), &misfits(&[4.0, 4.0, -4.0]));
        assert!((contest.difference() - 1.0).abs() < 1e-15);
        assert!(contest.standard_error < 1e-15);
    }

    #[test]
    fn misfits_that_change_places_differ_by_nothing_with_doubt() {
        // Squares 1 and 9 against 9 and 1, both of mean 5: shares ±½ (9 − 1)/√5, over √(2 − 1).
        let contest = Contest::of(&misfits(&[1.0, 3.0]), &misfits(&[3.0, 1.0]));
        assert_eq!(contest.difference(), 0.0);
        assert!((contest.standard_error - 4.0 / 5.0_f64.sqrt()).abs() < 1e-12);
    }
}
