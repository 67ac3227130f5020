//! The nearest point of the feasible set.

use faer::Mat;

use super::{Face, Polytope, active_at_minimum};
use crate::error::Error;
use crate::vector::add;

/// Most constraints added one by one after the quadratic program.
const REPAIRS: usize = 20;

/// The point of the set with the least `Σ ((zₖ' − zₖ) / max(1, |zₖ|))²`.
pub(crate) fn nearest(polytope: &Polytope, z: &[f64]) -> Result<Vec<f64>, Error> {
    if polytope.contains(z) {
        return Ok(z.to_vec());
    }
    let n = z.len();
    let scale: Vec<f64> = z.iter().map(|z| 1.0 / z.abs().max(1.0)).collect();
    // ‖D p‖² as a least-squares problem without damping: J = D, r = 0. The residual has to have a
    // length for the program's units, so it gets a row that no parameter touches.
    let distance = Mat::from_fn(n + 1, n, |i, k| if i == k { scale[k] } else { 0.0 });
    let residuals: Vec<f64> = (0..=n).map(|i| if i == n { 1.0 } else { 0.0 }).collect();
    let program = active_at_minimum(polytope, z, distance.as_ref(), &residuals, &scale, 0.0);
    let mut active = program.unwrap_or_default();
    for _ in 0..REPAIRS {
        let face = Face::new(polytope, active.clone(), &scale);
        let step = face.onto(polytope, z);
        match polytope.violated(z, &step) {
            None => {
                let mut moved = add(z, 1.0, &step);
                polytope.settle(&mut moved, &step, &scale, 0.0);
                return Ok(moved);
            }
            Some(more) if active.contains(&more) => break,
            Some(more) => active.push(more),
        }
    }
    polytope.check(z).map(|()| z.to_vec())
}
