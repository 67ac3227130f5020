//! The devices that are of the type, and the fit to those.
//!
//! From a robust start devices are fitted and all judged again, each by a type that it has no say in. One is left out where
//! chance explains so much in no more than one whole fleet of twenty. In a fleet of sessions with equal errors the distance of
//! a device by its own fit is `D/(D − 1)² d² ~ Beta(p/2, (D − p − 1)/2)` (SAS/QC User's Guide, procedure MVPMONITOR, Computing T²
//! Control Limits); by the fit without it, it is the `F` of a further device, and one test does for both.

use calib::prior::{Belonging, EstimatedType, belonging};
use nalgebra::{DMatrix, DVector};

use super::restricted_likelihood::{Fit, Seen};

findings::tuning! {
    /// Chance of a fleet of sound devices losing any.
    OF_FLEET: f64 = 0.05;
    /// Chance of a device of the type, by the robust location and scatter, below which it is left out of the start.
    OF_START: f64 = 1e-3;
    /// Change of the covariance, in units of the robust spread, at which a fit ends that is only to judge by.
    ROUGH: f64 = 1e-3;
    /// The same for the last fit.
    SETTLED: f64 = 1e-6;
    /// Rounds of leaving out and fitting.
    ROUNDS: usize = 12;
    /// A device that comes back so often stays: a fit without it has said so, and what left it out is an approximation.
    RETURNS: usize = 2;
}

/// A type and its devices.
pub(super) struct Members {
    pub fit: Fit,
    /// True for each device that is of the type; the fit is to these.
    pub of_type: Vec<bool>,
}

/// Fits the type of the devices that belong together; none where a fit is impossible.
pub(super) fn members(devices: &[Seen], scatter: &DMatrix<f64>) -> Option<Members> {
    let fit = |of_type: &[bool], near: Option<&Fit>, settled: f64| {
        let kept = devices.iter().zip(of_type).filter(|(_, own)| **own);
        let kept: Vec<&Seen> = kept.map(|(device, _)| device).collect();
        Fit::maximised(&kept, near.map(|fit| fit.sigma.clone()), settled)
    };
    let of_type = start(devices, scatter);
    let mut found = Members {
        fit: fit(&of_type, None, ROUGH.get())?,
        of_type,
    };
    let mut returns = vec![0; devices.len()];
    for _ in 1..ROUNDS.get() {
        let of_type = found.judged(devices, &returns);
        if of_type == found.of_type {
            break;
        }
        for ((count, now), before) in returns.iter_mut().zip(&of_type).zip(&found.of_type) {
            *count += usize::from(*now && !before);
        }
        let Some(next) = fit(&of_type, Some(&found.fit), ROUGH.get()) else {
            break;
        };
        found = Members { fit: next, of_type };
    }
    found.fit = fit(&found.of_type, Some(&found.fit), SETTLED.get())?;
    Some(found)
}

/// Devices near the robust location, and no fewer than the half that is nearest.
fn start(devices: &[Seen], scatter: &DMatrix<f64>) -> Vec<bool> {
    let chance = |(y, _): &Seen| belonging(y, scatter).map_or(0.0, |found| found.p_value);
    let factor = scatter.clone().cholesky();
    let distance = |(y, _): &Seen| factor.as_ref().map_or(0.0, |l| y.dot(&l.solve(y)));
    let mut nearest: Vec<(f64, usize)> = devices.iter().map(distance).zip(0..).collect();
    nearest.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = (devices.len() + scatter.nrows()).div_ceil(2);
    let mut of_type: Vec<bool> = devices
        .iter()
        .map(|d| chance(d) >= OF_START.get())
        .collect();
    for (_, k) in nearest.into_iter().take(half) {
        of_type[k] = true;
    }
    of_type
}

impl Members {
    /// Every device judged by the others.
    fn judged(&self, devices: &[Seen], returns: &[usize]) -> Vec<bool> {
        let of_type = Type {
            count: self.of_type.iter().filter(|own| **own).count(),
            mu: self.fit.mu.clone(),
            sigma: self.fit.sigma.clone(),
            of_mu: self.fit.of_mu.clone(),
        };
        let limit = OF_FLEET.get() / devices.len() as f64;
        let precision = of_type.of_mu.clone().cholesky().map(|l| l.inverse());
        let judge = |((device, own), count): ((&Seen, &bool), &usize)| {
            let judged = match own {
                true => {
                    let others = precision.as_ref().and_then(|p| of_type.without(device, p));
                    others.and_then(|others| others.judge(device))
                }
                false => of_type.judge(device),
            };
            *count >= RETURNS.get() || judged.is_some_and(|found| found.p_value >= limit)
        };
        let all = devices.iter().zip(&self.of_type).zip(returns);
        all.map(judge).collect()
    }
}

/// A type from `count` devices.
struct Type {
    count: usize,
    mu: DVector<f64>,
    sigma: DMatrix<f64>,
    of_mu: DMatrix<f64>,
}

impl Type {
    fn judge(&self, (y, session): &Seen) -> Option<Belonging> {
        let known = EstimatedType {
            covariance: &self.sigma,
            mean_covariance: &self.of_mu,
            devices: self.count,
        };
        known.belonging(&(y - &self.mu), session)
    }

    /// The type without one of its devices, from `precision = V⁻¹`.
    ///
    /// `V' = (V⁻¹ − W)⁻¹`, `μ' = μ − V' W g` with `g = y − μ`. At the maximum the slopes of all devices cancel, so that without
    /// one of slope `W (g gᵀ − T + V) W` the maximum moves by `−A (g gᵀ − T + V) Aᵀ D/((D − 1)(D − 2))`, `A = D V W`: a Newton
    /// step over sessions of the mean weight, exact where their errors are equal.
    fn without(&self, (y, session): &Seen, precision: &DMatrix<f64>) -> Option<Self> {
        let d = self.count as f64;
        let total = &self.sigma + session;
        let weight = total.clone().cholesky()?.inverse();
        let left = precision - &weight;
        let of_mu = left.cholesky()?.inverse();
        let gap = y - &self.mu;
        let mu = &self.mu - &of_mu * (&weight * &gap);
        let a = &self.of_mu * weight * d;
        let own = &gap * gap.transpose() - total + &self.of_mu;
        let change = &a * own * a.transpose() * (-d / ((d - 1.0) * (d - 2.0)));
        Some(Self {
            count: self.count - 1,
            mu,
            sigma: &self.sigma + &change,
            of_mu: of_mu + change / (d - 1.0),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quantile(k: usize) -> f64 {
        let normal = statrs::distribution::Normal::standard();
        statrs::distribution::ContinuousCDF::inverse_cdf(&normal, (k as f64 + 0.5) / 41.0)
    }

    /// Sessions with equal errors: the type without a device is the fit of the others.
    #[test]
    fn the_type_without_a_device_is_that_of_the_others() {
        let error = DMatrix::from_row_slice(2, 2, &[0.2, 0.05, 0.05, 0.1]);
        let device = |k: usize| {
            let (a, b) = (quantile(k), quantile(k * 17 % 41));
            (DVector::from_vec(vec![a, 0.5 * a + b]), error.clone())
        };
        let devices: Vec<Seen> = (0..41).map(device).collect();
        let all: Vec<&Seen> = devices.iter().collect();
        let fit = Fit::maximised(&all, None, SETTLED.get()).unwrap();
        let whole = Type {
            count: 41,
            mu: fit.mu,
            sigma: fit.sigma,
            of_mu: fit.of_mu,
        };
        let precision = whole.of_mu.clone().try_inverse().unwrap();
        let without = whole.without(&devices[0], &precision).unwrap();
        let others = Fit::maximised(&all[1..], None, SETTLED.get()).unwrap();
        assert!((without.mu - others.mu).amax() < 1e-8);
        assert!((without.sigma - others.sigma).amax() < 1e-6);
        assert!((without.of_mu - others.of_mu).amax() < 1e-7);
    }
}
