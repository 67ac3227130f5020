//! The nearest point of the feasible set.

use faer::Mat;

use super::{Model, Polytope};
use crate::constraints::Constraints;
use crate::error::Error;
use crate::linear::vector::add;
use crate::parameters::{Mask, Parameters};

impl Constraints {
    /// Moves the free parameters to the nearest point that meets all constraints; distances count
    /// relative to the size of each parameter (absolutely below 1).
    ///
    /// # Errors
    /// A name that no parameter has, and constraints that contradict each other.
    pub fn project(&self, parameters: &mut Parameters, mask: &Mask) -> Result<(), Error> {
        let Some(polytope) = Polytope::new(self, parameters, mask)? else {
            return Ok(());
        };
        let free = mask.free_indices();
        let z: Vec<f64> = free.iter().map(|&k| parameters.values()[k]).collect();
        let nearest = nearest(&polytope, &z)?;
        for (&k, value) in free.iter().zip(nearest) {
            parameters.values_mut()[k] = value;
        }
        Ok(())
    }
}

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
    let model = Model {
        polytope,
        z,
        jacobian: distance.as_ref(),
        residuals: &residuals,
        scale: &scale,
        lambda: 0.0,
    };
    let Some((_, step)) = model.minimum() else {
        return polytope.check(z).map(|()| z.to_vec());
    };
    let mut moved = add(z, 1.0, &step);
    polytope.settle(&mut moved, &step, &scale, 0.0);
    Ok(moved)
}
