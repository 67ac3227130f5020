//! Tails of the laws that tests go by: what chance makes as large.
//!
//! A statistic that is no number, as of values without any scatter, says nothing: its chance is 1.

use statrs::distribution::{ContinuousCDF, FisherSnedecor, Gamma, StudentsT};

/// Probability that Student's `t` of `dof` degrees of freedom is by chance as far from zero, on either side.
///
/// # Examples
/// ```
/// // t at 97.5 % of ten degrees of freedom is 2.228.
/// assert!((stillpoint_estimate::methods::chance::of_t(-2.228, 10.0) - 0.05).abs() < 1e-4);
/// assert_eq!(stillpoint_estimate::methods::chance::of_t(0.0 / 0.0, 10.0), 1.0);
/// ```
pub fn of_t(t: f64, dof: f64) -> f64 {
    let law = StudentsT::new(0.0, 1.0, dof).ok();
    law.filter(|_| !t.is_nan())
        .map_or(1.0, |law| 2.0 * law.sf(t.abs()))
}

/// Probability that Fisher's `F`, a mean square of `dof[0]` degrees of freedom over one of `dof[1]`, is by chance as large.
pub fn of_f(f: f64, dof: [f64; 2]) -> f64 {
    let law = FisherSnedecor::new(dof[0], dof[1]).ok();
    law.filter(|_| !f.is_nan()).map_or(1.0, |law| law.sf(f))
}

/// Probability that `χ²` of `dof` degrees of freedom, not always a whole number, is by chance as large.
pub fn of_chi2(chi2: f64, dof: f64) -> f64 {
    let law = Gamma::new(0.5 * dof, 0.5).ok();
    law.filter(|_| !chi2.is_nan())
        .map_or(1.0, |law| law.sf(chi2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_scatter_is_beyond_chance_or_says_nothing() {
        let (none, all) = (f64::NAN, f64::INFINITY);
        assert_eq!(
            [of_t(none, 3.0), of_f(none, [2.0, 3.0]), of_chi2(none, 3.0)],
            [1.0; 3]
        );
        assert_eq!(
            [of_t(-all, 3.0), of_f(all, [2.0, 3.0]), of_chi2(all, 3.0)],
            [0.0; 3]
        );
        assert_eq!(
            [of_t(1.0, 0.0), of_f(1.0, [2.0, 0.0]), of_chi2(1.0, 0.0)],
            [1.0; 3]
        );
    }
}
