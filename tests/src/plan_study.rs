//! A planned session simulated many times over, against its prediction.

use std::ops::Range;

use calib::Error;
use calib::intervals::Detector;
use calib::methods::cut;
use calib::methods::joint::{JointRequest, fit_joint};
use calib::simulate::{HandHeld, Motion, Planned, PlannedStep, Spec};
use plan::{Known, Noise, Plan, Protocol, Timing, Words, parameter_names};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// One parameter.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// The standard error that the plan predicts.
    pub predicted: f64,
    /// Root mean square error of the estimates of sessions that follow the plan.
    pub found: f64,
    /// The same of as many placements in random order.
    pub random: f64,
    /// Sessions that follow the plan and were calibrated.
    pub sessions: usize,
}

/// The study of a plan.
#[derive(Clone, Debug)]
pub struct Study {
    /// Every parameter.
    pub rows: Vec<Row>,
    /// What the plan counts as cut off either end of a rest, s.
    pub cut_predicted: f64,
    /// The same of the rests after the first, as the estimate used them, s.
    pub cut_found: f64,
}

/// The plan as a motion that can be simulated.
pub fn motion(plan: &Plan, timing: &Timing) -> Planned {
    Planned {
        up: plan.steps.first().map_or([0.0, 0.0, 1.0], |first| first.up),
        first_rest: timing.first_rest,
        steps: plan.steps.iter().skip(1).map(|s| step(s, timing)).collect(),
        ..Planned::default()
    }
}

/// A turn and the placement after it.
pub(crate) fn step(step: &plan::Step, timing: &Timing) -> PlannedStep {
    PlannedStep::of(&step.turn, &timing.pace, step.rest)
}

/// Simulates sessions of these seeds that follow the plan of `placements`, and as many in random order, and calibrates all
/// jointly.
///
/// # Errors
/// A spec that contradicts itself, or no session that could be calibrated.
pub fn study(placements: usize, seeds: Range<u64>) -> Result<Study, Error> {
    let (noise, timing) = (Noise::default(), Timing::default());
    let ups = Protocol::Optimal.placements(placements);
    let plan = plan::plan(&ups, &Known::default(), &noise, &timing, Words::Phone);
    let planned = Motion::Planned(motion(&plan, &timing));
    let random = Motion::HandHeld(HandHeld {
        placements: Some(placements),
        initial_rest: Some(timing.first_rest),
        rest: [timing.rest, timing.rest + 1e-3],
        ..HandHeld::default()
    });
    let (found, used) = errors(&planned, seeds.clone())?;
    let (others, _) = errors(&random, seeds)?;
    let rows = parameter_names().into_iter().enumerate();
    let rows = rows
        .map(|(k, name)| Row {
            name,
            predicted: plan
                .after
                .standard_errors
                .get(k)
                .copied()
                .unwrap_or(f64::INFINITY),
            found: root_mean_square(&found, k),
            random: root_mean_square(&others, k),
            sessions: found.len(),
        })
        .collect();
    Ok(Study {
        rows,
        cut_predicted: timing.cut,
        cut_found: 0.5 * (timing.rest - used),
    })
}

fn root_mean_square(errors: &[Vec<f64>], k: usize) -> f64 {
    let sum: f64 = errors.iter().map(|e| e[k] * e[k]).sum();
    (sum / errors.len().max(1) as f64).sqrt()
}

/// Estimate less truth of every parameter, of the sessions that can be calibrated, and the mean length of their rests between
/// the first and the last as the estimate used them, s.
fn errors(motion: &Motion, seeds: Range<u64>) -> Result<(Vec<Vec<f64>>, f64), Error> {
    let of = |seed: u64| -> Result<Option<(Vec<f64>, f64)>, Error> {
        let spec = Spec {
            seed,
            motion: motion.clone(),
            ..Spec::default()
        };
        let session = spec.run()?;
        let choice = cut(&session.recording, &Detector::default(), true, spec.gravity)?;
        let recordings = vec![(&session.recording, &choice.segmentation)];
        let Ok(fit) = fit_joint(&JointRequest::new(recordings, spec.gravity)) else {
            return Ok(None);
        };
        let fitted = fit.all_fitted();
        let error = |name: &String| Some(fitted.parameters.get(name)? - session.truth.get(name)?);
        let lengths: Vec<f64> = fit.data.rests.iter().map(|r| r.span.length()).collect();
        let inner = lengths
            .get(1..lengths.len().saturating_sub(1))
            .unwrap_or(&[]);
        let mean = inner.iter().sum::<f64>() / inner.len().max(1) as f64;
        let errors: Option<Vec<f64>> = parameter_names().iter().map(error).collect();
        Ok(errors.map(|errors| (errors, mean)))
    };
    let all: Result<Vec<_>, Error> = seeds.into_par_iter().map(of).collect();
    let (all, used): (Vec<Vec<f64>>, Vec<f64>) = all?.into_iter().flatten().unzip();
    if all.is_empty() {
        return Err(Error::not_enough("no session could be calibrated"));
    }
    let mean = used.iter().sum::<f64>() / used.len() as f64;
    Ok((all, mean))
}
