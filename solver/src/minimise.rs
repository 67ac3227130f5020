//! From a system and a start to a solution: the run, the last steps, the scale of the loss.

pub(crate) mod ending;
pub(crate) mod finish;
pub(crate) mod iterate;
pub(crate) mod newton;
pub(crate) mod point;
pub(crate) mod scaling;
pub(crate) mod stop;
pub(crate) mod system;
pub(crate) mod unseen;
pub(crate) mod vanishing;

use crate::clock::after;
use crate::error::Error;
use crate::feasible::Polytope;
use crate::loss::graduation::{FIRST, widths};
use crate::loss::robust::{Losses, Robust, robust_sigma};
use crate::loss::{Loss, LossScale};
use crate::minimise::ending::{escape, is_flat_all_around, is_zero, termination};
use crate::minimise::finish::{Verdict, polish};
use crate::minimise::iterate::{Run, Watch};
use crate::minimise::point::{NotFinite, Point};
use crate::minimise::stop::Stop;
use crate::minimise::system::{Counted, Evaluations, System};
use crate::options::{Options, Variant};
use crate::report::{Iteration, Termination};

/// Room for the trace of a usual run.
const USUAL_STEPS: usize = 32;

/// Most fits with re-estimated scale of the loss.
const SCALE_ROUNDS: usize = 30;

/// Relative change of the scale at which it counts as found.
const SCALE_FOUND: f64 = 1e-9;

/// Most saddles left on one way down.
const ESCAPES: usize = 4;

/// End of a run and what is known there.
pub(crate) struct Solution {
    /// Free parameters with the linearisation there.
    pub point: Point,
    /// The residuals, as the problem gives them.
    pub residuals: Vec<f64>,
    /// Why it stopped.
    pub termination: Termination,
    /// Judgement of the point by its Gauss–Newton step.
    pub verdict: Verdict,
    /// The steps.
    pub iterations: Vec<Iteration>,
    /// Number of evaluations of the problem.
    pub evaluations: Evaluations,
    /// The losses with their scales.
    pub losses: Losses,
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
    let system = Counted::new(system, options.max_second_derivatives);
    let mut point = first_point(&system, start, name)?;
    let mut iterations = Vec::with_capacity(USUAL_STEPS);
    let deadline = options.time_limit.and_then(after);
    let counted = &system;
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
        for escapes in 0.. {
            let (stop, verdict) = down(&mut run, system, point, polytope, options);
            let mut ended = termination(stop, point, &verdict, options);
            if ended == Termination::Stalled {
                counted.open_reserve();
                let free = polytope.is_none() && escapes < ESCAPES;
                let lower = || {
                    vanishing::lower(system, point)
                        .or_else(|| unseen::lower(system, point, &verdict))
                };
                if let Some(lower) = free.then(lower).flatten() {
                    *point = lower;
                    run.restart(point);
                    continue;
                }
                if is_flat_all_around(system, point, &verdict) {
                    ended = Termination::Cost;
                }
            }
            if !ended.converged() || ended == Termination::Zero || polytope.is_some() {
                return (ended, verdict);
            }
            let lower = escape(system, point, &verdict, options)
                .or_else(|| unseen::lower(system, point, &verdict));
            match lower {
                None => return (ended, verdict),
                Some(_) if escapes == ESCAPES => return (Termination::Saddle, verdict),
                Some(lower) => {
                    *point = lower;
                    run.restart(point);
                }
            }
        }
        (Termination::Saddle, Verdict::of(point, polytope))
    };
    let mut losses = Losses::new(options.loss, &options.row_losses);
    let (ended, verdict) = if losses.is_quadratic() {
        descend(&system, &mut point)
    } else {
        with_losses(&system, &mut losses, options, &mut point, &mut descend)?
    };
    let evaluations = system.evaluations();
    let residuals = if losses.is_quadratic() {
        point.at.residuals.clone()
    } else {
        system.residuals(&point.z)
    };
    let counted = losses
        .weights(&residuals)
        .iter()
        .filter(|w| **w > 0.0)
        .count();
    let termination = match ended {
        ended if ended.converged() && !losses.is_quadratic() && counted < point.z.len() => {
            Termination::Weightless
        }
        ended => ended,
    };
    Ok(Solution {
        point,
        residuals,
        termination,
        verdict,
        iterations,
        evaluations,
        losses,
    })
}

/// The loop and the last steps; where those fail, the loop goes on to the tolerance itself.
fn down(
    run: &mut Run<'_>,
    system: &dyn System,
    point: &mut Point,
    polytope: Option<&Polytope>,
    options: &Options,
) -> (Stop, Verdict) {
    loop {
        let stop = run.minimise(point);
        let verdict = match stop {
            Stop::Near if !options.last_digits => Verdict::of(point, polytope),
            Stop::Near | Stop::Step | Stop::Flat | Stop::Stalled => polish(system, point, polytope),
            _ => Verdict::of(point, polytope),
        };
        let done = verdict.offset <= options.gradient_tolerance || is_zero(point);
        if stop != Stop::Near || done || !run.nearer(options.gradient_tolerance) {
            return (stop, verdict);
        }
    }
}

/// One way down from a point.
type Descend<'a> = &'a mut dyn FnMut(&dyn System, &mut Point) -> (Termination, Verdict);

/// Fits under losses, alternating with the estimate of their scales where those are not given.
///
/// Graduated, there are two ways down: through ever narrower losses from what is least squares, and from
/// the fit of least absolute values, which one-sided outliers bend less. The lower end is taken.
fn with_losses(
    system: &dyn System,
    losses: &mut Losses,
    options: &Options,
    point: &mut Point,
    descend: Descend<'_>,
) -> Result<(Termination, Verdict), Error> {
    check_losses(losses)?;
    let start = system.residuals(&point.z);
    estimate(losses, &start);
    if let Some(value) = losses.scales().find(|s| !(s * s).is_normal()) {
        return Err(Error::LossScale { value });
    }
    let mut robust = RobustFit { system, descend };
    let few = counted(losses, &start) < point.z.len();
    if !options.graduated && !few {
        return Ok(robust.rounds(losses, point));
    }
    let (mut other, mut there) = (losses.clone(), point.clone());
    let wide = 2.0 * losses.largest(&start);
    let first = robust.narrowed(losses, point, wide);
    if is_interrupted(first.0) {
        return Ok(first);
    }
    robust.once(&other.absolute(), &mut there);
    let residuals = system.residuals(&there.z);
    estimate(&mut other, &residuals);
    let wide = FIRST * other.spread(&residuals);
    let second = robust.narrowed(&mut other, &mut there, wide);
    let common = losses.narrower(&other);
    let cost = |point: &Point| common.cost(&system.residuals(&point.z));
    if cost(&there) < cost(point) {
        (*losses, *point) = (other, there);
        return Ok(second);
    }
    Ok(first)
}

/// Scales of the losses that are to be estimated, from residuals.
fn estimate(losses: &mut Losses, residuals: &[f64]) {
    losses.rescale(residuals, |loss, residuals, scale| match loss.scale() {
        // A perfect fit has no scale; any will do whose square is a number.
        Some(LossScale::Estimated(factor)) => {
            (factor * robust_sigma(residuals)).max(f64::MIN_POSITIVE.sqrt())
        }
        _ => scale,
    });
}

/// Fits of a system under losses.
struct RobustFit<'a> {
    system: &'a dyn System,
    descend: Descend<'a>,
}

impl RobustFit<'_> {
    /// With the scales as they are.
    fn once(&mut self, losses: &Losses, point: &mut Point) -> (Termination, Verdict) {
        let robust = Robust {
            inner: self.system,
            losses: losses.clone(),
        };
        // Residuals are finite here; the rewriting keeps them so.
        if let Ok(rewritten) = Point::new(&robust, point.z.clone()) {
            *point = rewritten;
        }
        (self.descend)(&robust, point)
    }

    /// Until the scales are found.
    fn rounds(&mut self, losses: &mut Losses, point: &mut Point) -> (Termination, Verdict) {
        let mut round = 1;
        loop {
            let (ended, verdict) = self.once(losses, point);
            let before = losses.clone();
            estimate(losses, &self.system.residuals(&point.z));
            let found = (losses.scales().zip(before.scales()))
                .all(|(next, current)| (next - current).abs() <= SCALE_FOUND * current);
            if found || is_interrupted(ended) || round == SCALE_ROUNDS {
                *losses = before;
                return (ended, verdict);
            }
            round += 1;
        }
    }

    /// From `widest` times the scales down to the scales.
    fn narrowed(
        &mut self,
        losses: &mut Losses,
        point: &mut Point,
        widest: f64,
    ) -> (Termination, Verdict) {
        for factor in widths(widest) {
            let mut wide = losses.clone();
            estimate(&mut wide, &self.system.residuals(&point.z));
            wide.widen(factor);
            let (ended, verdict) = self.once(&wide, point);
            if is_interrupted(ended) {
                *losses = wide;
                return (ended, verdict);
            }
        }
        estimate(losses, &self.system.residuals(&point.z));
        self.rounds(losses, point)
    }
}

fn is_interrupted(ended: Termination) -> bool {
    use Termination::{Cancelled, IterationLimit, TimeLimit};
    matches!(ended, IterationLimit | TimeLimit | Cancelled)
}

/// Number of residuals that count.
fn counted(losses: &Losses, residuals: &[f64]) -> usize {
    losses
        .weights(residuals)
        .iter()
        .filter(|w| **w > 0.0)
        .count()
}

fn check_losses(losses: &Losses) -> Result<(), Error> {
    let groups = losses.groups.iter().map(|g| g.1);
    for loss in std::iter::once(losses.rest.0).chain(groups.clone()) {
        loss.check()?;
    }
    let given = |loss: Loss| match loss.scale() {
        Some(LossScale::Given(value) | LossScale::Estimated(value)) => value,
        None => 1.0,
    };
    match std::iter::once(losses.rest.0)
        .chain(groups)
        .map(given)
        .find(|v| v.is_nan() || *v <= 0.0)
    {
        Some(value) => Err(Error::LossScale { value }),
        None => Ok(()),
    }
}

/// Check that the variant can do what is asked.
fn supported(options: &Options, polytope: Option<&Polytope>) -> Result<(), Error> {
    let refused = matches!(
        options.variant,
        Variant::GaussNewtonMinimumNorm | Variant::Own(_)
    );
    if polytope.is_some() && refused {
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
