//! From a system and a start to a solution: the run, the last steps, the scale of the loss.

use std::time::Instant;

use crate::error::Error;
use crate::feasible::Polytope;
use crate::finish::{Verdict, polish};
use crate::iterate::{Run, Stop, Watch};
use crate::loss::{Loss, LossScale, Robust, robust_sigma};
use crate::options::{Options, Variant};
use crate::point::{NotFinite, Point};
use crate::report::{Iteration, Termination};
use crate::system::{Counted, Evaluations, System};

/// Relative Gauss–Newton step below which a point is as good as a minimum where rounding keeps the
/// offset from falling (residuals near zero).
const SMALL_STEP: f64 = 1e-8;

/// The same where a limit cut the run short, so that a shorter step may only be a matter of time.
const ROUNDING_STEP: f64 = 1e-14;

/// Room for the trace of a usual run.
const USUAL_STEPS: usize = 32;

/// Most fits with re-estimated scale of the loss.
const SCALE_ROUNDS: usize = 30;

/// Relative change of the scale at which it counts as found.
const SCALE_FOUND: f64 = 1e-9;

/// Where a run ended and what is known there.
pub(crate) struct Solution {
    /// Free parameters with the linearisation there.
    pub point: Point,
    /// The residuals, as the problem gives them.
    pub residuals: Vec<f64>,
    /// Why it stopped.
    pub termination: Termination,
    /// What the Gauss–Newton step says of the point.
    pub verdict: Verdict,
    /// The steps.
    pub iterations: Vec<Iteration>,
    /// How often the problem was evaluated.
    pub evaluations: Evaluations,
    /// Scale of the loss.
    pub loss_scale: Option<f64>,
}

/// Minimises a system from `start`, with the scale of the loss if it is to be estimated.
pub(crate) fn minimise(
    system: &dyn System,
    start: Vec<f64>,
    polytope: Option<&Polytope>,
    options: &Options,
    name: &dyn Fn(usize) -> String,
    watch: Watch<'_>,
) -> Result<Solution, Error> {
    supported(options, polytope)?;
    if let Some(polytope) = polytope {
        polytope.check(&start)?;
    }
    let system = Counted::new(system);
    let mut point = first_point(&system, start, name)?;
    let mut iterations = Vec::with_capacity(USUAL_STEPS);
    let deadline = options
        .time_limit
        .and_then(|limit| Instant::now().checked_add(limit));
    let mut descend = |system: &dyn System, point: &mut Point| {
        let mut run = Run::new(
            system,
            point,
            polytope,
            options,
            deadline,
            &mut iterations,
            watch,
        );
        let stop = run.minimise(point);
        let verdict = match stop {
            Stop::Near | Stop::Step | Stop::Flat | Stop::Stalled => polish(system, point, polytope),
            _ => Verdict::of(point, polytope),
        };
        (stop, verdict)
    };
    let (stop, verdict, loss_scale) = match options.loss.scale() {
        None => {
            let (stop, verdict) = descend(&system, &mut point);
            (stop, verdict, None)
        }
        Some(scale) => {
            let (stop, verdict, scale) =
                with_scale(&system, options.loss, scale, &mut point, &mut descend)?;
            (stop, verdict, Some(scale))
        }
    };
    let evaluations = system.evaluations();
    let residuals = if loss_scale.is_some() {
        system.residuals(&point.z)
    } else {
        point.at.residuals.clone()
    };
    let termination = termination(stop, &verdict, options);
    Ok(Solution {
        point,
        residuals,
        termination,
        verdict,
        iterations,
        evaluations,
        loss_scale,
    })
}

/// One way down from a point, under a loss.
type Descend<'a> = &'a mut dyn FnMut(&dyn System, &mut Point) -> (Stop, Verdict);

/// Fits under a loss, alternating with the estimate of its scale where that is not given.
fn with_scale(
    system: &dyn System,
    loss: Loss,
    scale: LossScale,
    point: &mut Point,
    descend: Descend<'_>,
) -> Result<(Stop, Verdict, f64), Error> {
    let sigma = |z: &[f64]| match scale {
        LossScale::Given(value) => value,
        LossScale::Estimated(factor) => {
            // A perfect fit has no scale; any will do whose square is a number.
            let sigma = factor * robust_sigma(&system.residuals(z));
            sigma.max(f64::MIN_POSITIVE.sqrt())
        }
    };
    let (LossScale::Given(value) | LossScale::Estimated(value)) = scale;
    if value.is_nan() || value <= 0.0 {
        return Err(Error::LossScale { value });
    }
    let mut current = sigma(&point.z);
    if !(current * current).is_normal() {
        return Err(Error::LossScale { value: current });
    }
    for round in 1.. {
        let robust = Robust {
            inner: system,
            loss,
            scale: current,
        };
        // Residuals are finite here; the rewriting keeps them so.
        if let Ok(rewritten) = Point::new(&robust, point.z.clone()) {
            *point = rewritten;
        }
        let (stop, verdict) = descend(&robust, point);
        let next = sigma(&point.z);
        let found = (next - current).abs() <= SCALE_FOUND * current;
        let interrupted = matches!(
            stop,
            Stop::IterationLimit | Stop::TimeLimit | Stop::Cancelled
        );
        if found || interrupted || round == SCALE_ROUNDS {
            return Ok((stop, verdict, current));
        }
        current = next;
    }
    Err(Error::LossScale { value: current })
}

/// What the variant can do.
fn supported(options: &Options, polytope: Option<&Polytope>) -> Result<(), Error> {
    let levenberg = matches!(options.variant, Variant::LevenbergMarquardt { .. });
    if polytope.is_some() && !levenberg {
        return Err(Error::Unsupported {
            variant: options.variant.name(),
            what: "constraints",
        });
    }
    Ok(())
}

/// The start, checked.
fn first_point(
    system: &dyn System,
    z: Vec<f64>,
    name: &dyn Fn(usize) -> String,
) -> Result<Point, Error> {
    let free = z.len();
    if free == 0 {
        return Err(Error::Empty {
            residuals: system.residuals(&z).len(),
            free,
        });
    }
    let point = Point::new(system, z.clone()).map_err(|place| match place {
        NotFinite::Residual { row, value } => Error::NotFinite { row, value },
        NotFinite::Derivative { row, column } => Error::DerivativeNotFinite {
            row,
            parameter: name(system.culprit(&z, row).unwrap_or(column)),
        },
    })?;
    if point.at.residuals.is_empty() {
        return Err(Error::Empty { residuals: 0, free });
    }
    Ok(point)
}

/// The reason in the user's terms: what the point is, before how the loop was left.
fn termination(stop: Stop, verdict: &Verdict, options: &Options) -> Termination {
    if stop == Stop::Cancelled {
        return Termination::Cancelled;
    }
    if verdict.offset <= options.gradient_tolerance {
        return Termination::Gradient;
    }
    let limited = matches!(stop, Stop::IterationLimit | Stop::TimeLimit);
    if verdict.relative_step <= if limited { ROUNDING_STEP } else { SMALL_STEP } {
        return Termination::Step;
    }
    match stop {
        Stop::IterationLimit => Termination::IterationLimit,
        Stop::TimeLimit => Termination::TimeLimit,
        Stop::NotFinite(NotFinite::Residual { row, .. }) => Termination::NotFinite {
            row,
            parameter: None,
        },
        Stop::NotFinite(NotFinite::Derivative { row, column }) => Termination::NotFinite {
            row,
            parameter: Some(column),
        },
        _ => Termination::Stalled,
    }
}
