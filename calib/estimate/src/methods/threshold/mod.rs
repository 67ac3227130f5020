//! The detector's multiplier, chosen by what the accelerometer fit leaves (Liu et al. 2021,
//! section 3.2), per degree of freedom; and how short a static interval may be.
//!
//! ```text
//! Detector ──► Survey ──► static intervals at each multiplier ──► fit of each ──► plateau
//!    └─ shorter windows, where those asked for make no calibration ─┘
//! ```

mod plateau;
mod several;
mod trial;

pub use several::cut_several;
pub use trial::Trial;

use rayon::prelude::*;
use recording::intervals::{Detector, Segmentation, Span, Survey};
use recording::watch::{Stage, step};
use recording::{Error, Recording, figure};
use sensor::Base;

use self::plateau::plateau;
use self::trial::{NormFit, bare_mean};
use crate::residuals::StaticMean;

/// The multipliers tried.
pub const MULTIPLIERS: [f64; 12] = [3.0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6];

/// Spare placements below which a residual may be small by chance.
const ENOUGH_SPARE: usize = 2;

/// Windows, shortest motions and shortest static intervals of hasty recordings, s.
const SHORTER: [(f64, f64, f64); 2] = [(0.5, 0.3, 1.0), (0.3, 0.3, 0.6)];

/// Shorter intervals are taken where they are so many times as many and the error of a corrected reading
/// so many times smaller ...
const MANY_MORE: f64 = 1.5;
/// ... or where the error is so many times smaller with as many.
const FAR_BETTER: f64 = 4.0;

/// A segmentation and how its multiplier was chosen.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The recording cut at the chosen multiplier.
    pub segmentation: Segmentation,
    /// All multipliers tried; empty where one was given.
    pub trials: Vec<Trial>,
    /// The shortest static interval looked for, s, where it is shorter than what was asked for.
    pub shortened: Option<f64>,
}

impl Choice {
    /// What a user should know of how the recording was cut.
    pub fn remarks(&self) -> Vec<String> {
        let shortened = self.shortened.map(|length| {
            format!(
                "static intervals of {} s and more were used: hold still for 3 s for smaller errors",
                figure(length)
            )
        });
        let rejected = self.segmentation.rejected.iter().map(ToString::to_string);
        shortened.into_iter().chain(rejected).collect()
    }
}

/// Cuts a recording at the multiplier that the accelerometer fit likes best: of those as good as
/// the best, the middle of the longest run that finds the same number of intervals. Where no fit is
/// possible, at the detector's own multiplier.
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
    Ok(Choice {
        segmentation: recording::intervals::segment(recording, detector)?,
        trials: Vec::new(),
        shortened: None,
    })
}

/// What one detector finds at all multipliers.
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
        step(Stage::Cutting)?;
        let survey = Survey::of(recording, detector)?;
        let found: Vec<Vec<Span>> = MULTIPLIERS.par_iter().map(|&m| survey.rests(m)).collect();
        let (trials, bases) = trials(&survey, &found, gravity);
        let (multiplier, chosen) = chosen(&trials, detector.multiplier);
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
        Some((trial.static_intervals, trial.expected_error?))
    }

    /// Whether the recording may hold many more intervals that are only too short.
    fn leaves_out_much(&self) -> bool {
        let Some((found, _)) = self.result() else {
            return true;
        };
        let (_, _, shortest) = SHORTER[0];
        self.survey.count_lasting(self.multiplier, shortest) as f64 >= MANY_MORE * found as f64
    }

    /// Whether this one, of shorter intervals, is to be preferred.
    fn beats(&self, longer: &Self) -> bool {
        match (self.result(), longer.result()) {
            (None, _) => false,
            (Some(_), None) => true,
            (Some((many, error)), Some((few, other))) => {
                let more = many as f64 >= MANY_MORE * few as f64 && MANY_MORE * error <= other;
                more || (many >= few && FAR_BETTER * error <= other)
            }
        }
    }
}

/// The multiplier and its trial: the plateau of those with enough placements to check the fit, else the
/// detector's own where that is a calibration, else any that is one, else the detector's own.
fn chosen(trials: &[Trial], own: f64) -> (f64, Option<usize>) {
    if let Some(k) = plateau(trials, ENOUGH_SPARE) {
        return (MULTIPLIERS[k], Some(k));
    }
    let is_own = |&k: &usize| MULTIPLIERS[k] == own && trials[k].expected_error.is_some();
    match (0..trials.len()).find(is_own).or(plateau(trials, 1)) {
        Some(k) => (MULTIPLIERS[k], Some(k)),
        None => (own, None),
    }
}

/// The trials at all multipliers and the accelerometers they found; multipliers that find the same
/// intervals share a fit.
fn trials(
    survey: &Survey<'_>,
    found: &[Vec<Span>],
    gravity: f64,
) -> (Vec<Trial>, Vec<Option<Base<f64>>>) {
    let runs: Vec<&[Vec<Span>]> = found.chunk_by(|a, b| a == b).collect();
    let tried: Vec<_> = runs
        .par_iter()
        .map(|run| trial(survey, &run[0], gravity))
        .collect();
    let each = runs.iter().zip(tried);
    let repeated = each.flat_map(|(run, trial)| std::iter::repeat_n(trial, run.len()));
    repeated
        .zip(MULTIPLIERS)
        .map(|((trial, base), multiplier)| {
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
    let means = found.iter().filter_map(|&span| survey.mean_force(span));
    let means: Vec<StaticMean> = means.map(bare_mean).collect();
    let fit = NormFit::of(&means, survey.noise_of_means(found), gravity);
    let sound = fit.as_ref().filter(|fit| fit.sound);
    let detector = survey.detector();
    let trial = Trial {
        multiplier: f64::NAN,
        window: detector.window,
        min_static: detector.min_static,
        static_intervals: found.len(),
        spare: sound.map(|fit| fit.spare),
        residual: fit.as_ref().map(|fit| fit.residual),
        expected_error: sound.and_then(NormFit::expected_error),
    };
    (trial, sound.map(|fit| fit.base))
}
