//! A lower point along what the Jacobian does not see.

use crate::linear::vector::{add, scaled_norm};
use crate::minimise::ending::is_below_rounding;
use crate::minimise::finish::Verdict;
use crate::minimise::point::Point;
use crate::minimise::system::System;

/// Lengths tried to either side, each a quarter of the one before, from `‖D z‖` on.
const LENGTHS: i32 = 14;

/// The lowest of some points along the direction that the Jacobian sees least, where that is next to nothing: to all linear models the
/// point is a minimum, and so it is to second derivatives where the cost bends by the third power of the way.
///
/// `x₂ c + sin(x₅ c)` is such a sum at `x₅ = 0`: the columns are one, the cost falls as `x₅³` to one side. `None` where no point
/// is lower by more than rounding.
pub(crate) fn lower(system: &dyn System, point: &Point, verdict: &Verdict) -> Option<Point> {
    let v = verdict.factor.as_ref()?.unseen()?;
    let size = scaled_norm(&point.z, &point.at.jacobian.column_norms());
    let mut best = (point.at.cost, 0.0);
    for power in 0..LENGTHS {
        let length = size * 0.25f64.powi(power);
        for t in [length, -length] {
            let cost = system.cost(&add(&point.z, t, &v));
            if cost < best.0 {
                best = (cost, t);
            }
        }
    }
    let fall = point.at.cost - best.0;
    if fall <= 0.0 || is_below_rounding(point, fall) {
        return None;
    }
    Point::new(system, add(&point.z, best.1, &v)).ok()
}
