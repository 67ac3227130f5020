//! The detector's multiplier, chosen by what the accelerometer fit leaves (Liu et al. 2021,
//! section 3.2), per degree of freedom; and how short a static interval may be.
//!
//! ```text
//! Detector ──► Survey ──► static intervals at each multiplier ──► fit of each ──► plateau
//!    └─ shorter windows, where those asked for make no calibration ─┘
//! ```

mod another;
mod compared;
mod plateau;
mod several;
mod trial;

pub use another::OfAnother;
pub use several::cut_several;
pub use trial::Trial;

use findings::{Finding, Kind};
use nalgebra::Vector3;
use rayon::prelude::*;
use recording::intervals::{Detector, Rejected, Segmentation, Span, Survey};
use recording::{Error, Recording};
use sensor::Base;

use self::plateau::{most_placements, plateau};
use self::trial::NormFit;
use crate::residuals::StaticMean;

/// The multipliers tried.
pub const MULTIPLIERS: [f64; 12] = [3.0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6];

/// Those tried beside where the best of them lie at their end: a quiet sensor in a hand that trembles.
const IN_THE_HAND: [f64; 4] = [3e6, 1e7, 3e7, 1e8];

findings::tuning! {
    /// Multipliers that are the end of those tried.
    LAST: usize = 2;

    /// Spare placements below which a residual may be small by chance.
    ENOUGH_SPARE: usize = 2;

    /// Shorter intervals are taken where they are so many times as many and the error of a corrected reading
    /// so many times smaller ...
    MANY_MORE: f64 = 1.5;
    /// ... or where the error is so many times smaller with as many.
    FAR_BETTER: f64 = 4.0;

    /// Neighbours whose forces differ by less than this share are one placement, which something interrupted (0.5°).
    SAME_PLACEMENT: f64 = 9e-3;
}

/// Windows, shortest motions and shortest static intervals of hasty recordings, s.
const SHORTER: [(f64, f64, f64); 2] = [(0.5, 0.3, 1.0), (0.3, 0.3, 0.6)];

/// A segmentation and how its multiplier was chosen.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The recording cut at the chosen multiplier.
    pub segmentation: Segmentation,
    /// All multipliers tried; empty where one was given.
    pub trials: Vec<Trial>,
    /// The shortest static interval looked for, s, where it is shorter than what was asked for.
    pub shortened: Option<f64>,
    /// Static intervals in a part of the recording that fit another accelerometer.
    pub of_another: Option<OfAnother>,
}

impl Choice {
    /// Builds the choice of a segmentation that was given.
    pub fn given(segmentation: Segmentation) -> Self {
        Self {
            segmentation,
            trials: Vec::new(),
            shortened: None,
            of_another: None,
        }
    }

    /// Returns the findings on how the recording was cut, for the user.
    pub fn remarks(&self) -> Vec<Finding> {
        let shortened = self
            .shortened
            .map(|length| Finding::of(Kind::SHORT_INTERVALS).number("least", length, "s"));
        let of_another = self.of_another.as_ref().map(OfAnother::finding);
        let rejected = Rejected::findings(&self.segmentation.rejected);
        let all = shortened.into_iter().chain(of_another);
        all.chain(rejected).collect()
    }
}

/// Cuts a recording at the multiplier that the accelerometer fit likes best: of those as good as
/// the best, the middle of the longest run that finds the same number of intervals. Where no fit is
/// possible, at the detector's own multiplier.
///
/// Where none is a calibration, the multiplier with the most placements that one accelerometer can have read.
///
/// Where the static intervals asked for make no calibration, or shorter ones a far better one, the
/// shorter ones are taken, if the detector allows it.
///
/// # Errors
/// As [`recording::intervals::segment`].
pub fn choose_multiplier(
    recording: &Recording,
    detector: &Detector,
    gravity: f64,
) -> Result<Choice, Error> {
    let mut best = Attempt::of(recording, detector, gravity)?;
    if detector.may_shorten {
        for (window, min_dynamic, min_static) in SHORTER {
            let shorter = Detector {
                window,
                min_dynamic,
                min_static,
                ..*detector
            };
            if min_static >= detector.min_static || !best.leaves_out_much() {
                break;
            }
            // A stream too slow for the shorter window has nothing more to tell.
            if let Ok(other) = Attempt::of(recording, &shorter, gravity)
                && other.beats(&best)
            {
                best = other;
            }
        }
    }
    let used = best.survey.detector().min_static;
    Ok(Choice {
        segmentation: best.segment(),
        shortened: (used < detector.min_static).then_some(used),
        of_another: best.of_another(gravity),
        trials: best.trials,
    })
}

/// Cuts a recording by [`choose_multiplier`], or at the detector's own multiplier.
///
/// # Errors
/// As [`recording::intervals::segment`].
pub fn cut(
    recording: &Recording,
    detector: &Detector,
    choose: bool,
    gravity: f64,
) -> Result<Choice, Error> {
    if choose {
        return choose_multiplier(recording, detector, gravity);
    }
    let segmentation = recording::intervals::segment(recording, detector)?;
    Ok(Choice::given(segmentation))
}

/// Result of one detector at all multipliers.
struct Attempt<'a> {
    survey: Survey<'a>,
    trials: Vec<Trial>,
    /// The multiplier chosen, and its trial where there is a calibration in it.
    multiplier: f64,
    chosen: Option<usize>,
    bases: Vec<Option<Base<f64>>>,
}

impl<'a> Attempt<'a> {
    fn of(recording: &'a Recording, detector: &Detector, gravity: f64) -> Result<Self, Error> {
        let survey = Survey::of(recording, detector)?;
        let (mut trials, mut bases) = trials_at(&survey, &MULTIPLIERS, gravity);
        let (mut multiplier, mut chosen) = choice(&trials, detector.multiplier);
        if chosen.is_none_or(|k| k + LAST.get() >= trials.len()) {
            let (more, of_more) = trials_at(&survey, &IN_THE_HAND, gravity);
            trials.extend(more);
            bases.extend(of_more);
            (multiplier, chosen) = choice(&trials, detector.multiplier);
        }
        Ok(Self {
            survey,
            trials,
            multiplier,
            chosen,
            bases,
        })
    }

    fn segment(&self) -> Segmentation {
        let base = self.chosen.and_then(|k| self.bases[k].as_ref());
        self.survey.segment(self.multiplier, base)
    }

    /// Number of static intervals and error of the trial chosen.
    fn result(&self) -> Option<(usize, f64)> {
        let trial = &self.trials[self.chosen?];
        Some((trial.placements, trial.expected_error?))
    }

    /// The trial at the multiplier chosen.
    fn trial(&self) -> Option<&Trial> {
        let chosen = |t: &&Trial| t.multiplier == self.multiplier;
        self.trials.iter().find(chosen)
    }

    /// Returns true if this attempt, of shorter intervals, has many more placements that a single accelerometer can
    /// have read.
    fn shows_many_more(&self, longer: &Self) -> bool {
        let few = longer.trial().map_or(0, |t| t.placements);
        let more = |t: &Trial| t.plausible && t.placements as f64 >= MANY_MORE.get() * few as f64;
        self.trial().is_some_and(more)
    }

    /// Returns true if the recording may hold many more intervals that are only too short.
    fn leaves_out_much(&self) -> bool {
        let Some((found, _)) = self.result() else {
            return true;
        };
        let (_, _, shortest) = SHORTER[0];
        self.survey.count_lasting(self.multiplier, shortest) as f64
            >= MANY_MORE.get() * found as f64
    }

    /// Returns true if this attempt, of shorter intervals, is better than the `longer` one: a calibration where that
    /// has none, many more placements with a smaller error, or as many with a far smaller error.
    fn beats(&self, longer: &Self) -> bool {
        match (self.result(), longer.result()) {
            (None, None) => self.shows_many_more(longer),
            (None, Some(_)) => false,
            (Some(_), None) => true,
            (Some((many, error)), Some((few, other))) => {
                let more =
                    many as f64 >= MANY_MORE.get() * few as f64 && MANY_MORE.get() * error <= other;
                more || (many >= few && FAR_BETTER.get() * error <= other)
            }
        }
    }
}

/// The multiplier and its trial: the plateau of those with enough placements to check the fit, else the
/// detector's own where that is a calibration, else any that is one, else the one with the most placements, else the
/// detector's own.
fn choice(trials: &[Trial], own: f64) -> (f64, Option<usize>) {
    if let Some(k) = plateau(trials, ENOUGH_SPARE.get()) {
        return (trials[k].multiplier, Some(k));
    }
    let is_own = |&k: &usize| trials[k].multiplier == own && trials[k].expected_error.is_some();
    let known = (0..trials.len()).find(is_own).or(plateau(trials, 1));
    match known.or(most_placements(trials)) {
        Some(k) => (trials[k].multiplier, Some(k)),
        None => (own, None),
    }
}

/// The trials at some multipliers and the accelerometers they found; multipliers that find the same
/// intervals share a fit.
fn trials_at(
    survey: &Survey<'_>,
    multipliers: &[f64],
    gravity: f64,
) -> (Vec<Trial>, Vec<Option<Base<f64>>>) {
    let found: Vec<Vec<Span>> = multipliers.par_iter().map(|&m| survey.rests(m)).collect();
    let runs: Vec<&[Vec<Span>]> = found.chunk_by(|a, b| a == b).collect();
    let tried: Vec<_> = runs
        .par_iter()
        .map(|run| trial(survey, &run[0], gravity))
        .collect();
    let each = runs.iter().zip(tried);
    let repeated = each.flat_map(|(run, trial)| std::iter::repeat_n(trial, run.len()));
    repeated
        .zip(multipliers)
        .map(|((trial, base), &multiplier)| {
            let trial = Trial {
                multiplier,
                ..trial
            };
            (trial, base)
        })
        .unzip()
}

/// A fit to given intervals, whatever the multiplier.
fn trial(survey: &Survey<'_>, found: &[Span], gravity: f64) -> (Trial, Option<Base<f64>>) {
    let forces: Vec<Vector3<f64>> = found.iter().filter_map(|&s| survey.mean_force(s)).collect();
    let means: Vec<StaticMean> = forces.iter().copied().map(StaticMean::bare).collect();
    let placements = placements(&forces);
    // What is in pieces tells no more than the whole.
    let by_pieces = (means.len() as f64 / placements.max(1) as f64).sqrt();
    let fit = NormFit::of(&means, survey.noise_of_means(found), gravity);
    let sound = fit.as_ref().filter(|fit| fit.sound);
    let detector = survey.detector();
    let trial = Trial {
        multiplier: f64::NAN,
        window: detector.window,
        min_static: detector.min_static,
        static_intervals: found.len(),
        placements,
        plausible: fit.as_ref().is_some_and(|fit| fit.plausible),
        spare: sound.map(|fit| fit.spare),
        residual: fit.as_ref().map(|fit| fit.residual),
        expected_error: sound
            .and_then(NormFit::expected_error)
            .map(|error| error * by_pieces),
    };
    (trial, sound.map(|fit| fit.base))
}

/// Number of placements among intervals with these mean forces: neighbours with the same force are one.
fn placements(forces: &[Vector3<f64>]) -> usize {
    let is_same =
        |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < SAME_PLACEMENT.get() * a.norm();
    forces.chunk_by(is_same).count()
}

#[cfg(test)]
mod tests {
    use simulate::{Between, HandHeld, Motion, Resampled, Spec};

    use super::*;

    fn spec(seed: u64, rest: [f64; 2]) -> Spec {
        let mut spec = Spec::hand_held(seed);
        spec.motion = Motion::HandHeld(HandHeld {
            placements: Some(14),
            initial_rest: Some(20.0),
            rest,
            ..HandHeld::default()
        });
        spec
    }

    fn found(spec: &Spec) -> [usize; 2] {
        let session = spec.run().unwrap();
        let choice = cut(&session.recording, &Detector::default(), true, spec.gravity).unwrap();
        let truth = session.truth.static_intervals.len();
        [choice.segmentation.statics.len(), truth]
    }

    #[test]
    fn a_gyroscope_between_the_stamps_of_another_clock_has_the_rests_of_the_device() {
        for (seed, rate, own) in [(1, 99.75, 99.70), (2, 100.0, 99.9), (3, 50.0, 49.98)] {
            for by in [Between::Linear, Between::Hold] {
                let mut spec = spec(seed, [15.0, 35.0]);
                spec.rate = rate;
                spec.gyroscope.resampled = Some(Resampled { rate: own, by });
                let [found, truth] = found(&spec);
                assert_eq!(found, truth, "{rate} {own} {by:?}");
            }
        }
    }

    #[test]
    fn a_placement_counts_once_however_often_it_is_interrupted() {
        let (up, level) = (9.8 * Vector3::z(), 9.8 * Vector3::x());
        let near = up + Vector3::new(0.05, 0.0, 0.0);
        assert_eq!(placements(&[up, near, up, level, up, up]), 3);
        assert_eq!(placements(&[]), 0);
    }
}
