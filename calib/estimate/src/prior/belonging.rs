//! Test that a device belongs to its type.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

/// A device of the type is refused in one of so many.
pub const FALSE_FLAGS: f64 = 0.01;

/// Share of that for the parameter that is furthest: what is wrong with a device is mostly one thing. The remainder is for
/// all parameters together.
const ONE_PARAMETER: f64 = 0.8;

/// A device against its type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belonging {
    /// Chance of a device of the type being so far out.
    pub p_value: f64,
    /// The parameter that is furthest.
    pub furthest: usize,
    /// By how many standard deviations.
    pub deviation: f64,
}

impl Belonging {
    /// Returns true if the device belongs to the type.
    pub fn belongs(&self) -> bool {
        self.p_value >= FALSE_FLAGS
    }
}

/// Judges a deviation from the type's mean of covariance `covariance` (type and session): the largest of the parameters'
/// own deviations by Šidák's bound, and all together by `χ²`; none where the covariance is none.
pub fn belonging(deviation: &DVector<f64>, covariance: &DMatrix<f64>) -> Option<Belonging> {
    let n = deviation.len();
    let scale = DVector::from_fn(n, |k, _| covariance[(k, k)].sqrt());
    let z = deviation.component_div(&scale);
    let (furthest, size) = z
        .iter()
        .map(|v| v.abs())
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    let correlation = DMatrix::from_fn(n, n, |i, j| covariance[(i, j)] / (scale[i] * scale[j]));
    let solved = correlation.cholesky()?.solve(&z);
    let all = ChiSquared::new(n as f64).ok()?.sf(z.dot(&solved));
    let tail = 2.0 * Normal::standard().sf(size);
    let one = -(n as f64 * (-tail).ln_1p()).exp_m1();
    let p_value = (one / ONE_PARAMETER)
        .min(all / (1.0 - ONE_PARAMETER))
        .min(1.0);
    p_value.is_finite().then_some(Belonging {
        p_value,
        furthest,
        deviation: z[furthest],
    })
}
