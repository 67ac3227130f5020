//! Mean and covariance of a type's parameters: random effects by restricted likelihood.
//!
//! `y_d = θ_d + e_d`, `θ_d ~ N(μ, Σ)`, `e_d ~ N(0, C_d)` with the sessions' covariances known. The restricted likelihood is
//! maximised by expectation and maximisation (Laird & Ware 1982, Biometrics 38, section 4), which keeps `Σ` positive.
//! Outsiders have no say: from a robust start (orthogonalised Gnanadesikan–Kettenring) devices beyond the quantile are left out,
//! the others fitted, and all judged again.

use calib::Calibration;
use calib::limits::parameter;
use calib::prior::{PRIOR_SCHEMA, Prior, belonging};
use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::statistics::robust_location_scatter;

/// A device beyond this quantile of its type is left out.
const OUTSIDE: f64 = 1e-3;
/// Rounds of leaving out and fitting.
const ROUNDS: usize = 8;
/// Steps of a fit, and the change of the covariance (relative to its diagonal) at which it ends.
const STEPS: usize = 2000;
const SETTLED: f64 = 1e-6;

/// What one device's session says.
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
    let mut fit = Fit::start(&start);
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
        fit = fit.maximised(&kept);
        let judged: Vec<bool> = scaled
            .iter()
            .map(|(y, c)| {
                let total = &fit.sigma + c;
                belonging(&(y - &fit.mu), &total).is_none_or(|b| b.p_value < OUTSIDE)
            })
            .collect();
        if judged == outside {
            break;
        }
        outside = judged;
    }
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

impl Fit {
    fn start(scatter: &DMatrix<f64>) -> Self {
        Self {
            mu: DVector::zeros(scatter.nrows()),
            sigma: scatter.clone(),
            of_mu: DMatrix::zeros(scatter.nrows(), scatter.nrows()),
        }
    }

    /// The restricted likelihood's maximum over these devices, from here.
    fn maximised(mut self, kept: &[&(DVector<f64>, DMatrix<f64>)]) -> Self {
        let p = self.mu.len();
        for _ in 0..STEPS {
            let Some(weights) = kept
                .iter()
                .map(|(_, c)| inverse(&(&self.sigma + c)))
                .collect::<Option<Vec<_>>>()
            else {
                return self;
            };
            let total: DMatrix<f64> = weights.iter().fold(DMatrix::zeros(p, p), |sum, w| sum + w);
            let Some(of_mu) = inverse(&total) else {
                return self;
            };
            let mut sum = DVector::zeros(p);
            for ((y, _), w) in kept.iter().zip(&weights) {
                sum += w * y;
            }
            let mu = &of_mu * sum;
            let mut sigma = DMatrix::zeros(p, p);
            for ((y, _), w) in kept.iter().zip(&weights) {
                let u = &self.sigma * (w * (y - &mu));
                // Of Σ − Σ W Σ + Σ W V(μ) W Σ, the second restricted: μ was estimated too.
                let left = &self.sigma * w;
                sigma += &self.sigma - &left * &self.sigma
                    + &left * &of_mu * left.transpose()
                    + &u * u.transpose();
            }
            sigma /= kept.len() as f64;
            sigma = (&sigma + sigma.transpose()) * 0.5;
            let change = (&sigma - &self.sigma).amax();
            self = Self { mu, sigma, of_mu };
            if change < SETTLED {
                break;
            }
        }
        self
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
