//! Standard errors from few degrees of freedom.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::chance;

/// Half-width of a 95 % interval in standard deviations of a normal law.
const NORMAL: f64 = 1.959_963_985;

findings::tuning! {
    /// With fewer spare numbers than this the residual says too little of the noise: 12.7 or 4.3 standard errors would
    /// be a 95 % interval.
    pub LEAST_SPARE: usize = 3;

    /// A residual that the noise makes by chance in more cases than this says nothing against the noise.
    pub UNREMARKABLE: f64 = 0.05;
}

/// Factor on a standard error that was estimated with `dof` degrees of freedom, so that 1.96 of it are a 95 %
/// interval: `t₀.₉₇₅(dof)/1.96`; 1 without degrees of freedom.
pub fn widening(dof: usize) -> f64 {
    match StudentsT::new(0.0, 1.0, dof as f64) {
        Ok(law) if dof > 0 => law.inverse_cdf(0.975) / NORMAL,
        _ => 1.0,
    }
}

/// The standard normal deviate that chance exceeds as often as this Student's `t` of so many degrees of freedom, within a few parts in a
/// thousand (Wallace 1959).
pub fn normal_score(t: f64, dof: f64) -> f64 {
    let shrunk = (8.0 * dof + 1.0) / (8.0 * dof + 3.0);
    shrunk * (dof * (t * t / dof).ln_1p()).sqrt().copysign(t)
}

/// Standard deviation of a residual: `noise` as it was measured within the intervals where the sum of squares of the residuals
/// with `dof` degrees of freedom does not speak against it, else that of the residuals, widened for few degrees of
/// freedom. A residual above the noise counts as it is where it has degrees of freedom enough. Where no noise was
/// measured, as in a table of means, it is that of the residuals as in any least-squares fit.
pub fn residual_std(square: f64, dof: usize, noise: f64) -> f64 {
    if dof == 0 {
        return noise;
    }
    let own = (square / dof as f64).sqrt();
    if noise <= 0.0 {
        return own;
    }
    let p = chance::of_chi2(square / (noise * noise), dof as f64);
    if p > UNREMARKABLE.get() || own <= noise {
        if dof < LEAST_SPARE.get() {
            noise
        } else {
            own.max(noise)
        }
    } else {
        own * widening(dof)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widening_is_that_of_the_tables_of_student() {
        // Quantiles of Student's t at 97.5 %: 12.706, 4.303, 3.182, 2.228.
        for (dof, t) in [(1, 12.706), (2, 4.303), (3, 3.182), (10, 2.228)] {
            assert!((widening(dof) * 1.959_964 - t).abs() < 5e-4, "{dof}");
        }
        assert!((widening(100_000) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_normal_score_is_exceeded_as_often_as_its_t() {
        for (t, dof) in [(1.0, 5.0), (-3.0, 11.0), (7.0, 19.0)] {
            let z = normal_score(t, dof);
            let share = chance::of_chi2(z * z, 1.0) / chance::of_t(t, dof);
            assert!(z * t > 0.0 && (share - 1.0).abs() < 0.05, "{t}: {share}");
        }
    }

    #[test]
    fn one_spare_number_by_chance_does_not_make_errors_small_or_large() {
        assert_eq!(residual_std(0.0, 1, 2.0), 2.0);
        assert_eq!(residual_std(4.0, 1, 2.0), 2.0);
        // 40 times the noise is no chance: the noise is not what was measured, and one number hardly says what it is.
        assert!((residual_std(6400.0, 1, 2.0) - 80.0 * 12.706 / 1.959_964).abs() < 0.05);
        assert_eq!(residual_std(20.0, 5, 0.0), 2.0);
    }
}
