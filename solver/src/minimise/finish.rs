//! The last steps: to an offset that leaves eleven digits, or to what double precision allows.

use faer::Mat;

use crate::feasible::{Face, Model, Polytope};
use crate::linear::vector::{add, norm, scaled_norm};
use crate::linear::{Factor, Jacobian, QrFactor};
use crate::minimise::newton;
use crate::minimise::point::Point;
use crate::minimise::scaling::unit_if_zero;
use crate::minimise::system::System;
use crate::rules::{RESOLVED, RISE_BY_ROUNDING};

/// Most last steps.
const MOST: usize = 60;

/// A step this short, relative to each parameter, changes nothing.
const NO_CHANGE: f64 = 2.0 * f64::EPSILON;

/// Relative offset that is good enough: the step that is left is a fraction of a standard error as small, `√(m − n)` times this.
const ENOUGH: f64 = 1e-11;

/// A step that shortens the tangential residual by less than this calls for second derivatives.
const SLOW: f64 = 0.3;

/// Judgement of a point by its Gauss–Newton step.
pub(crate) struct Verdict {
    /// `‖P r‖ / ‖r‖`, zero for a zero residual: the relative offset.
    pub offset: f64,
    /// `‖P r‖`, the length of the residual's part in the column space of `J`.
    pub tangential: f64,
    /// `‖D p‖ / ‖D z‖` of the undamped step.
    pub relative_step: f64,
    /// The dense Jacobian factored, if no constraint is active.
    pub factor: Option<QrFactor>,
    /// The active constraints, where there are constraints.
    pub face: Option<Face>,
    step: Option<Vec<f64>>,
    scale: Vec<f64>,
}

impl Verdict {
    /// Solves for the undamped step by pivoted QR of the Jacobian with unit columns, along the
    /// active constraints and no farther than the others.
    pub fn of(point: &Point, polytope: Option<&Polytope>) -> Self {
        let scale: Vec<f64> = point
            .at
            .jacobian
            .column_norms()
            .into_iter()
            .map(unit_if_zero)
            .collect();
        let face = polytope.map(|p| Face::at(p, point, &scale));
        let residuals = &point.at.residuals;
        let mut whole = None;
        let Jacobian(j) = &point.at.jacobian;
        let (tangential, step) = match &face {
            Some(face) if !face.active().is_empty() => solved(&face.factor(j.as_ref()), residuals),
            _ => solved(whole.insert(QrFactor::new(j.as_ref(), &scale)), residuals),
        };
        let step = step.map(|p| inside(point, polytope, &scale, p));
        let length = step
            .as_ref()
            .map_or(f64::INFINITY, |p| scaled_norm(p, &scale));
        let size = scaled_norm(&point.z, &scale);
        Self {
            offset: if tangential > 0.0 {
                tangential / norm(residuals)
            } else {
                0.0
            },
            tangential,
            relative_step: if length > 0.0 { length / size } else { 0.0 },
            factor: whole,
            face,
            step,
            scale,
        }
    }

    /// Scaled directions that keep to the active constraints.
    fn directions(&self) -> Mat<f64> {
        match &self.face {
            Some(face) => face.directions(),
            None => Mat::from_fn(self.scale.len(), self.scale.len(), |i, k| {
                if i == k { 1.0 / self.scale[i] } else { 0.0 }
            }),
        }
    }
}

/// A step that would leave the feasible set, replaced by the minimum of the model within it.
fn inside(point: &Point, polytope: Option<&Polytope>, scale: &[f64], step: Vec<f64>) -> Vec<f64> {
    let Some(polytope) = polytope else {
        return step;
    };
    let Jacobian(jacobian) = &point.at.jacobian;
    if polytope.violated(&point.z, &step, scale).is_none() {
        return step;
    }
    let model = Model {
        polytope,
        z: &point.z,
        jacobian: jacobian.as_ref(),
        residuals: &point.at.residuals,
        scale,
        lambda: 0.0,
    };
    model.minimum().map_or(step, |(_, p)| p)
}

fn solved(factor: &dyn Factor, residuals: &[f64]) -> (f64, Option<Vec<f64>>) {
    (factor.tangential(residuals), factor.undamped(residuals))
}

/// Undamped steps while they shorten the tangential residual: Gauss–Newton, and Newton where
/// Gauss–Newton is slow and second derivatives are there.
///
/// The cost changes by the square of the offset, so double precision stops resolving it at an
/// offset near 1e-8; the gradient goes on to 1e-15.
pub(crate) fn polish(
    system: &dyn System,
    point: &mut Point,
    polytope: Option<&Polytope>,
) -> Verdict {
    let mut verdict = Verdict::of(point, polytope);
    let mut hessian: Option<(Mat<f64>, Mat<f64>)> = None;
    let mut asked = false;
    for _ in 0..MOST {
        let newton = hessian
            .as_ref()
            .and_then(|(b, s)| newton::step(point, b.as_ref(), s));
        let Some(step) = newton.or_else(|| verdict.step.clone()) else {
            break;
        };
        if is_settled(point, &verdict, &step) {
            break;
        }
        let next = improved(system, point, &step, polytope, &verdict);
        let slow = next
            .as_ref()
            .is_none_or(|(_, after)| after.tangential > SLOW * verdict.tangential);
        if slow && !asked && worth_more(&verdict) {
            asked = true;
            let directions = verdict.directions();
            hessian =
                newton::curvature(system, point, directions.as_ref()).map(|s| (directions, s));
            if hessian.is_some() && next.is_none() {
                continue;
            }
        }
        let Some((nearer, after)) = next else { break };
        *point = nearer;
        verdict = after;
    }
    verdict
}

/// True where the offset is rounding, or the step changes nothing.
fn is_settled(point: &Point, verdict: &Verdict, step: &[f64]) -> bool {
    let rounding = (RESOLVED * (point.at.residuals.len() as f64).sqrt()).max(ENOUGH);
    let still = |(p, z): (&f64, &f64)| p.abs() <= NO_CHANGE * z.abs();
    verdict.offset <= rounding || step.iter().zip(&point.z).all(still)
}

/// True where the offset is far enough from rounding for second derivatives to pay.
fn worth_more(verdict: &Verdict) -> bool {
    verdict.offset > 1e-13 && verdict.relative_step > 1e-14
}

/// The point after a step, if its tangential residual is shorter and its cost no higher.
fn improved(
    system: &dyn System,
    point: &Point,
    step: &[f64],
    polytope: Option<&Polytope>,
    before: &Verdict,
) -> Option<(Point, Verdict)> {
    let mut z = add(&point.z, 1.0, step);
    if let Some(polytope) = polytope {
        if polytope.violated(&point.z, step, &before.scale).is_some() {
            return None;
        }
        let length = norm(&point.at.residuals);
        polytope.settle(&mut z, step, &before.scale, length);
    }
    let next = Point::new(system, z).ok()?;
    let after = Verdict::of(&next, polytope);
    let higher = next.at.cost > point.at.cost * (1.0 + RISE_BY_ROUNDING);
    (!higher && after.tangential < before.tangential).then_some((next, after))
}
