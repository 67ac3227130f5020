//! From a problem and a start to a report.

use std::ops::ControlFlow;

use crate::constraints::ActiveConstraint;
use crate::error::Error;
use crate::feasible::Polytope;
use crate::linear::Jacobian;
use crate::loss::Loss;
use crate::minimise::finish::Verdict;
use crate::minimise::point::Point;
use crate::minimise::system::Dense;
use crate::minimise::{Solution, minimise};
use crate::options::Options;
use crate::parameters::{Mask, Parameters};
use crate::report::{Iteration, Report};
use crate::residual::Problem;
use crate::uncertainty::covariance::uncertainty_along;

/// Minimises `½ ‖r(x)‖²` (or half the sum of the losses) over the free parameters.
///
/// # Errors
/// A start at which the residual or its derivative is not finite or that lies outside the
/// constraints, constraints that contradict themselves, and an empty problem.
///
/// # Examples
/// ```
/// use stillpoint_solver::{Mask, Options, Parameters, Residual, Scalar, lit, solve};
///
/// /// Rosenbrock's valley.
/// struct Valley;
///
/// impl<D: Scalar> Residual<D> for Valley {
///     fn residuals(&self, x: &[D], out: &mut Vec<D>) {
///         out.push((x[1] - x[0] * x[0]) * 10.0);
///         out.push(lit::<D>(1.0) - x[0]);
///     }
/// }
///
/// let start = Parameters::unnamed(&[-1.2, 1.0]);
/// let report = solve(&Valley, &start, &Mask::all(2), &Options::default())?;
/// assert!(report.termination.converged());
/// assert!((report.parameters.values()[1] - 1.0).abs() < 1e-12);
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn solve(
    problem: &dyn Problem,
    start: &Parameters,
    mask: &Mask,
    options: &Options,
) -> Result<Report, Error> {
    solve_observed(problem, start, mask, options, &mut |_, _| {
        ControlFlow::Continue(())
    })
}

/// [`solve`] with a callback after every step tried, which sees the step and the best free
/// parameters so far and may stop the run by `ControlFlow::Break`.
///
/// # Errors
/// As [`solve`].
///
/// # Examples
/// ```
/// use std::ops::ControlFlow;
/// use stillpoint_solver::{Jet, Mask, Options, Parameters, Termination, from_fn, solve_observed};
///
/// let valley = from_fn(|x: &[Jet], r: &mut Vec<Jet>| r.extend([(x[1] - x[0] * x[0]) * 10.0, x[0] - 1.0]));
/// let (start, mask) = (Parameters::unnamed(&[-1.2, 1.0]), Mask::all(2));
/// let mut costs = Vec::new();
/// let report = solve_observed(&valley, &start, &mask, &Options::default(), &mut |step, _| {
///     costs.push(step.cost);
///     if costs.len() < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
/// })?;
/// assert_eq!((costs.len(), report.termination), (3, Termination::Cancelled));
/// # Ok::<(), stillpoint_solver::Error>(())
/// ```
pub fn solve_observed(
    problem: &dyn Problem,
    start: &Parameters,
    mask: &Mask,
    options: &Options,
    observer: &mut dyn FnMut(&Iteration, &[f64]) -> ControlFlow<()>,
) -> Result<Report, Error> {
    if mask.len() != start.len() {
        return Err(Error::MaskLength {
            mask: mask.len(),
            parameters: start.len(),
        });
    }
    let names: Vec<String> = mask
        .free_indices()
        .iter()
        .map(|&k| start.names()[k].clone())
        .collect();
    let polytope = Polytope::new(&options.constraints, start, mask)?;
    let system = Dense::new(problem, start, mask);
    let z = system.restrict(start.values());
    let name = |column: usize| names[column].clone();
    let solution = minimise(&system, z, polytope.as_ref(), options, &name, observer)?;
    let mut parameters = start.clone();
    parameters
        .values_mut()
        .copy_from_slice(&system.embed(&solution.point.z));
    Ok(solution.report(parameters, names, polytope.as_ref()))
}

impl Solution {
    /// The report of a dense problem.
    fn report(
        self,
        parameters: Parameters,
        names: Vec<String>,
        polytope: Option<&Polytope>,
    ) -> Report {
        let held = self
            .verdict
            .face
            .as_ref()
            .filter(|face| !face.active().is_empty());
        let directions = held.map(|face| face.directions());
        let Jacobian(j) = &self.point.at.jacobian;
        let uncertainty = match &self.verdict.factor {
            Some(factor) => uncertainty_along(factor.root().as_ref(), directions, names),
            None => uncertainty_along(j.as_ref(), directions, names),
        };
        let rank = uncertainty.rank;
        let scale = |loss: Loss, scale: f64| loss.scale().map(|_| scale);
        let groups = self.losses.groups.iter();
        Report {
            variance: self.losses.variance(&self.residuals, rank),
            weights: self.losses.weights(&self.residuals),
            row_loss_scales: groups.map(|g| scale(g.1, g.2)).collect(),
            loss_scale: scale(self.losses.rest.0, self.losses.rest.1),
            active: active(&self.point, &self.verdict, polytope),
            infeasibility: polytope.map_or(0.0, |p| p.violation(&self.point.z)),
            cost: self.point.at.cost,
            parameters,
            residuals: self.residuals,
            termination: self.termination,
            iterations: self.iterations,
            jacobian_evaluations: self.evaluations.jacobians,
            evaluations: self.evaluations,
            relative_offset: self.verdict.offset,
            relative_step: self.verdict.relative_step,
            uncertainty,
            rank,
        }
    }
}

/// The constraints held at the end, with their multipliers.
fn active(point: &Point, verdict: &Verdict, polytope: Option<&Polytope>) -> Vec<ActiveConstraint> {
    let (Some(face), Some(polytope)) = (&verdict.face, polytope) else {
        return Vec::new();
    };
    let multipliers = face.multipliers(&point.gradient());
    face.active()
        .iter()
        .zip(multipliers)
        .map(|(&held, multiplier)| {
            let (constraint, value) = polytope.describe(held);
            ActiveConstraint {
                constraint,
                value,
                multiplier,
            }
        })
        .collect()
}
