//! Mean and covariance of a type's parameters: random effects by restricted likelihood.
//!
//! `y_d = θ_d + e_d`, `θ_d ~ N(μ, Σ)`, `e_d ~ N(0, C_d)` with the sessions' covariances known. The restricted likelihood is
//! maximised by expectation and maximisation (Laird & Ware 1982, Biometrics 38, section 4), which keeps `Σ` positive.
//! Outsiders have no say: from a robust start (orthogonalised Gnanadesikan–Kettenring) devices beyond the quantile are left out,
//! the others fitted, and all judged again.

use calib::Calibration;
use calib::limits::parameter;
use calib::prior::{PRIOR_SCHEMA, Prior, belonging};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rayon::prelude::*;

use crate::error::Error;
use crate::statistics::robust_location_scatter;

/// A device beyond this quantile of its type is left out.
const OUTSIDE: f64 = 1e-3;
/// Rounds of leaving out and fitting.
const ROUNDS: usize = 8;
/// Steps of a fit, and the change of the covariance (in units of the robust spread) at which it ends. The start is a moment
/// estimate, so that few are needed.
const STEPS: usize = 200;
const SETTLED: f64 = 1e-5;
/// Variance of the type against the session's mean one that a start has at least: from nothing there is no way up.
const LEAST: f64 = 0.02;
/// Devices whose sums are made together: the order of sums does not depend on the number of threads.
const TOGETHER: usize = 32;

/// Estimated parameters of one device and their covariance.
#[derive(Clone, Debug)]
pub struct Session {
    /// The device.
    pub id: String,
    /// Its parameters.
    pub values: DVector<f64>,
    /// The covariance of their errors.
    pub covariance: DMatrix<f64>,
}

/// The prior of a type from the calibrations of its devices: of the parameters that most of them have.
///
/// # Errors
/// [`Error::TooFew`] where they are too few for the number of parameters.
pub fn prior_of(calibrations: &[(String, Calibration)]) -> Result<Prior, Error> {
    let names = common(calibrations);
    let of = |calibration: &Calibration| {
        let place = |name: &String| calibration.parameters.iter().position(|own| own == name);
        let places: Vec<usize> = names.iter().map(place).collect::<Option<_>>()?;
        let values: Vec<f64> = names
            .iter()
            .map(|name| Some(parameter(calibration, name)?.0))
            .collect::<Option<_>>()?;
        let c = &calibration.covariance;
        let n = places.len();
        let covariance = DMatrix::from_fn(n, n, |i, j| c[places[i]][places[j]]);
        let finite = covariance.iter().chain(&values).all(|v| v.is_finite());
        finite.then(|| (DVector::from_vec(values), covariance))
    };
    let sessions: Vec<Session> = calibrations
        .iter()
        .filter_map(|(id, calibration)| {
            let (values, covariance) = of(calibration)?;
            Some(Session {
                id: id.clone(),
                values,
                covariance,
            })
        })
        .collect();
    let mut prior = fit_prior(&names, &sessions)?;
    prior.without = calibrations.len() - sessions.len();
    for name in &names {
        let effect = name.split_once('.').map(|(effect, _)| effect);
        let effect = effect.filter(|e| calib::calibration::effect_named(e).is_some());
        if let Some(effect) = effect.filter(|e| !prior.effects.iter().any(|own| own == e)) {
            prior.effects.push(effect.to_owned());
        }
    }
    Ok(prior)
}

/// Parameters that at least half of the devices have, biases of single recordings aside.
fn common(calibrations: &[(String, Calibration)]) -> Vec<String> {
    let mut names: Vec<(String, usize)> = Vec::new();
    for name in calibrations.iter().flat_map(|(_, c)| &c.parameters) {
        match names.iter_mut().find(|(own, _)| own == name) {
            Some((_, count)) => *count += 1,
            None => names.push((name.clone(), 1)),
        }
    }
    names.retain(|(name, count)| 2 * count > calibrations.len() && !name.contains('['));
    names.into_iter().map(|(name, _)| name).collect()
}

/// The prior of sessions that all have the parameters `names`, in that order.
///
/// # Errors
/// [`Error::TooFew`] with fewer than three devices per parameter.
pub fn fit_prior(names: &[String], sessions: &[Session]) -> Result<Prior, Error> {
    let p = names.len();
    let needed = 3 * p.max(2);
    if sessions.len() < needed || p == 0 {
        return Err(Error::TooFew {
            found: sessions.len(),
            parameters: p,
            needed,
        });
    }
    // In units in which every parameter spreads by about one.
    let values: Vec<DVector<f64>> = sessions.iter().map(|s| s.values.clone()).collect();
    let (centre, scatter) = robust_location_scatter(&values);
    let unit = DVector::from_fn(p, |k, _| {
        let least = sessions
            .iter()
            .map(|s| s.covariance[(k, k)])
            .fold(f64::INFINITY, f64::min);
        scatter[(k, k)].max(least).max(f64::MIN_POSITIVE).sqrt()
    });
    let scaled: Vec<(DVector<f64>, DMatrix<f64>)> = sessions
        .iter()
        .map(|s| {
            let values = (&s.values - &centre).component_div(&unit);
            (
                values,
                DMatrix::from_fn(p, p, |i, j| s.covariance[(i, j)] / (unit[i] * unit[j])),
            )
        })
        .collect();
    let start = DMatrix::from_fn(p, p, |i, j| scatter[(i, j)] / (unit[i] * unit[j]));
    // The robust scatter has the sessions' errors in it.
    let mut outside: Vec<bool> = scaled
        .iter()
        .map(|(y, _)| belonging(y, &start).is_some_and(|b| b.p_value < OUTSIDE))
        .collect();
    let mut fit = None;
    for _ in 0..ROUNDS {
        let kept: Vec<_> = scaled
            .iter()
            .zip(&outside)
            .filter(|(_, out)| !**out)
            .map(|(s, _)| s)
            .collect();
        if kept.len() < needed {
            return Err(Error::TooFew {
                found: kept.len(),
                parameters: p,
                needed,
            });
        }
        let found = Fit::start(&kept).maximised(&kept);
        let judged: Vec<bool> = scaled
            .iter()
            .map(|(y, c)| {
                let total = &found.sigma + c;
                belonging(&(y - &found.mu), &total).is_none_or(|b| b.p_value < OUTSIDE)
            })
            .collect();
        fit = Some(found);
        if judged == outside {
            break;
        }
        outside = judged;
    }
    let fit = fit.unwrap_or_else(|| Fit::start(&[]));
    let rows = |m: &DMatrix<f64>| -> Vec<Vec<f64>> {
        (0..p)
            .map(|i| (0..p).map(|j| m[(i, j)] * unit[i] * unit[j]).collect())
            .collect()
    };
    let out = sessions.iter().zip(&outside).filter(|(_, out)| **out);
    let outsiders: Vec<String> = out.map(|(s, _)| s.id.clone()).collect();
    Ok(Prior {
        schema: PRIOR_SCHEMA.into(),
        created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
        devices: sessions.len() - outsiders.len(),
        outsiders,
        without: 0,
        effects: Vec::new(),
        parameters: names.to_vec(),
        mean: (centre + fit.mu.component_mul(&unit))
            .iter()
            .copied()
            .collect(),
        covariance: rows(&fit.sigma),
        mean_covariance: rows(&fit.of_mu),
    })
}

struct Fit {
    mu: DVector<f64>,
    sigma: DMatrix<f64>,
    /// Covariance of the error of `mu`.
    of_mu: DMatrix<f64>,
}

type Scaled = (DVector<f64>, DMatrix<f64>);

impl Fit {
    /// By moments: the covariance of the devices less their sessions' mean one, no less than a part of that in any direction.
    fn start(kept: &[&Scaled]) -> Self {
        let p = kept.first().map_or(0, |(y, _)| y.len());
        let n = kept.len().max(2) as f64;
        let mu = kept.iter().fold(DVector::zeros(p), |sum, (y, _)| sum + y) / n;
        let error = kept
            .iter()
            .fold(DMatrix::zeros(p, p), |sum, (_, c)| sum + c)
            / n;
        let whole = kept.iter().fold(DMatrix::zeros(p, p), |sum, (y, _)| {
            let d = y - &mu;
            sum + &d * d.transpose()
        }) / (n - 1.0);
        let of_mu = &whole / n;
        let sigma = error.clone().cholesky().and_then(|factor| {
            let l = factor.l();
            let white = l.solve_lower_triangular(&whole)?;
            let white = l.solve_lower_triangular(&white.transpose())?;
            let axes = SymmetricEigen::new((&white + white.transpose()) * 0.5);
            let spread = axes.eigenvalues.map(|v| (v - 1.0).max(LEAST));
            let back = l * axes.eigenvectors;
            Some(&back * DMatrix::from_diagonal(&spread) * back.transpose())
        });
        Self {
            mu,
            sigma: sigma.unwrap_or(whole),
            of_mu,
        }
    }

    /// The restricted likelihood's maximum over these devices, from here.
    fn maximised(mut self, kept: &[&Scaled]) -> Self {
        for _ in 0..STEPS {
            let Some(next) = self.step(kept) else {
                return self;
            };
            let change = (&next.sigma - &self.sigma).amax();
            self = next;
            if change < SETTLED {
                break;
            }
        }
        self
    }

    fn step(&self, kept: &[&Scaled]) -> Option<Self> {
        let p = self.mu.len();
        let weigh = |group: &[&Scaled]| -> Option<Vec<DMatrix<f64>>> {
            group
                .iter()
                .map(|(_, c)| inverse(&(&self.sigma + c)))
                .collect()
        };
        let groups: Vec<&[&Scaled]> = kept.chunks(TOGETHER).collect();
        let weights: Vec<Vec<DMatrix<f64>>> =
            groups.par_iter().map(|g| weigh(g)).collect::<Option<_>>()?;
        let (mut total, mut sum) = (DMatrix::zeros(p, p), DVector::zeros(p));
        for ((y, _), w) in kept.iter().zip(weights.iter().flatten()) {
            total += w;
            sum += w * y;
        }
        let of_mu = inverse(&total)?;
        let mu = &of_mu * sum;
        // Of Σ − Σ W Σ + Σ W V(μ) W Σ + u uᵀ the outer Σ are drawn out of the sum; the third term is what restricts: μ was estimated too.
        let inner = |(group, weights): (&&[&Scaled], &Vec<DMatrix<f64>>)| {
            let mut sum = DMatrix::zeros(p, p);
            for ((y, _), w) in group.iter().zip(weights) {
                let u = w * (y - &mu);
                sum += w * &of_mu * w - w;
                sum.ger(1.0, &u, &u, 1.0);
            }
            sum
        };
        let inner: Vec<DMatrix<f64>> = groups.par_iter().zip(&weights).map(inner).collect();
        let inner = inner
            .iter()
            .fold(DMatrix::zeros(p, p), |sum, own| sum + own)
            / kept.len() as f64;
        let sigma = &self.sigma + &self.sigma * inner * &self.sigma;
        Some(Self {
            mu,
            sigma: (&sigma + sigma.transpose()) * 0.5,
            of_mu,
        })
    }
}

fn inverse(m: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    Some(m.clone().cholesky()?.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One parameter, equal errors: the restricted maximum has a closed form, `s² − c`.
    #[test]
    fn of_equal_errors_the_spread_is_the_variance_less_the_error() {
        let values = [1.0, 2.0, 4.0, 0.5, 3.0, 2.5, 1.5, 2.2, 3.3, 0.1];
        let sessions: Vec<Session> = values
            .iter()
            .map(|v| Session {
                id: v.to_string(),
                values: DVector::from_element(1, *v),
                covariance: DMatrix::from_element(1, 1, 0.4),
            })
            .collect();
        let prior = fit_prior(&["a".into()], &sessions).unwrap();
        let mean = values.iter().sum::<f64>() / 10.0;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 9.0;
        assert!((prior.mean[0] - mean).abs() < 1e-9);
        assert!(
            (prior.covariance[0][0] - (variance - 0.4)).abs() < 1e-4,
            "{prior:?}"
        );
        assert!((prior.mean_covariance[0][0] - variance / 10.0).abs() < 1e-5);
    }

    #[test]
    fn too_few_devices_are_refused() {
        let session = Session {
            id: "a".into(),
            values: DVector::zeros(2),
            covariance: DMatrix::identity(2, 2),
        };
        let names = ["a".to_owned(), "b".to_owned()];
        let found = fit_prior(&names, &vec![session; 5]).unwrap_err();
        assert!(matches!(
            found,
            Error::TooFew {
                found: 5,
                needed: 6,
                ..
            }
        ));
    }
}
