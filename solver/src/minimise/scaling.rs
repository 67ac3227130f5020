//! Scaling that makes the steps independent of the parameters' units.

/// Share of an old norm that is left per step. Moré keeps all of it; a column that was huge far from the
/// solution then holds its parameter back for ever (MGH10 from its first start passes 1e49).
const MEMORY: f64 = 0.9;

/// `D`, the largest norm each column of the Jacobian has had of late.
///
/// Moré, "The Levenberg-Marquardt algorithm: implementation and theory", 1978: multiplying a
/// parameter by a factor divides its column by it and leaves `D x` as it was.
#[derive(Clone, Debug)]
pub(crate) struct Scaling {
    largest: Vec<f64>,
    scale: Vec<f64>,
}

impl Scaling {
    /// Nothing seen yet.
    pub fn new(n: usize) -> Self {
        Self {
            largest: vec![0.0; n],
            scale: vec![1.0; n],
        }
    }

    /// Takes the column norms of a new Jacobian into account.
    pub fn update(&mut self, norms: &[f64]) {
        for ((largest, scale), &norm) in self.largest.iter_mut().zip(&mut self.scale).zip(norms) {
            *largest = norm.max(*largest * MEMORY);
            *scale = unit_if_zero(*largest);
        }
    }

    /// The diagonal of `D` (`n`); 1 where a column has always been zero, whose step is zero then.
    pub fn diagonal(&self) -> &[f64] {
        &self.scale
    }
}

/// The norms with 1 in place of 0, to divide by.
pub(crate) fn unit_if_zero(norm: f64) -> f64 {
    if norm > 0.0 { norm } else { 1.0 }
}
