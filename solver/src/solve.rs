//! From a problem and a start to a report.

use crate::covariance::uncertainty;
use crate::error::Error;
use crate::finish::{Verdict, polish};
use crate::iterate::{Run, Stop};
use crate::linear::Jacobian;
use crate::options::Options;
use crate::parameters::{Mask, Parameters};
use crate::point::{NotFinite, Point};
use crate::report::{Report, Termination};
use crate::residual::Problem;
use crate::system::{Dense, System};

/// Relative Gauss–Newton step below which a point is as good as a minimum where rounding keeps the
/// offset from falling (residuals near zero).
const SMALL_STEP: f64 = 1e-8;

/// Minimises `½ ‖r(x)‖²` over the free parameters.
///
/// # Errors
/// A start at which the residual or its derivative is not finite, and an empty problem.
pub fn solve(
    problem: &dyn Problem,
    start: &Parameters,
    mask: &Mask,
    options: &Options,
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
    let system = Dense::new(problem, start, mask);
    let first = first_point(&system, system.restrict(start.values()), &names)?;
    let mut run = Run::new(&system, first, options);
    let stop = run.minimise();
    let Run {
        mut point,
        iterations,
        mut jacobian_evaluations,
        ..
    } = run;
    let verdict = match stop {
        Stop::Near | Stop::Step | Stop::Flat | Stop::Stalled => {
            polish(&system, &mut point, &mut jacobian_evaluations)
        }
        Stop::IterationLimit | Stop::NotFinite(_) => Verdict::of(&point),
    };
    let mut parameters = start.clone();
    parameters
        .values_mut()
        .copy_from_slice(&system.embed(&point.z));
    let Jacobian::Dense(jacobian) = &point.at.jacobian;
    Ok(Report {
        uncertainty: uncertainty(jacobian, names),
        parameters,
        cost: point.at.cost,
        residuals: point.at.residuals.clone(),
        termination: termination(stop, &verdict, options),
        iterations,
        jacobian_evaluations,
    })
}

/// The start, checked.
fn first_point(system: &dyn System, z: Vec<f64>, names: &[String]) -> Result<Point, Error> {
    let free = z.len();
    let point = Point::new(system, z).map_err(|place| match place {
        NotFinite::Residual { row, value } => Error::NotFinite { row, value },
        NotFinite::Derivative { row, column } => Error::DerivativeNotFinite {
            row,
            parameter: names[column].clone(),
        },
    })?;
    let residuals = point.at.residuals.len();
    if residuals == 0 || free == 0 {
        return Err(Error::Empty { residuals, free });
    }
    Ok(point)
}

/// The reason in the user's terms: what the point is, before how the loop was left.
fn termination(stop: Stop, verdict: &Verdict, options: &Options) -> Termination {
    if verdict.offset <= options.gradient_tolerance {
        return Termination::Gradient;
    }
    if verdict.relative_step <= SMALL_STEP {
        return Termination::Step;
    }
    match stop {
        Stop::IterationLimit => Termination::IterationLimit,
        _ => Termination::Stalled,
    }
}
