//! Mean and covariance of a type's parameters: random effects by restricted likelihood.
//!
//! `y_d = θ_d + e_d`, `θ_d ~ N(μ, Σ)`, `e_d ~ N(0, C_d)` with the sessions' covariances known (Laird & Ware 1982, Biometrics 38).
//! Devices that do not belong have no say: `members.rs`.

mod members;
mod restricted_likelihood;

use calib::Calibration;
use calib::limits::parameter;
use calib::prior::{PRIOR_SCHEMA, Prior};
use nalgebra::{DMatrix, DVector};

use self::members::members;
use self::restricted_likelihood::Seen;
use crate::error::Error;
use crate::statistics::robust_location_scatter;

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
    let scaled: Vec<Seen> = sessions
        .iter()
        .map(|s| {
            let values = (&s.values - &centre).component_div(&unit);
            (
                values,
                DMatrix::from_fn(p, p, |i, j| s.covariance[(i, j)] / (unit[i] * unit[j])),
            )
        })
        .collect();
    let scatter = DMatrix::from_fn(p, p, |i, j| scatter[(i, j)] / (unit[i] * unit[j]));
    let too_few = |found: usize| Error::TooFew {
        found,
        parameters: p,
        needed,
    };
    let found = members(&scaled, &scatter).ok_or_else(|| too_few(0))?;
    let kept = found.of_type.iter().filter(|own| **own).count();
    if kept < needed {
        return Err(too_few(kept));
    }
    let fit = found.fit;
    let rows = |m: &DMatrix<f64>| -> Vec<Vec<f64>> {
        (0..p)
            .map(|i| (0..p).map(|j| m[(i, j)] * unit[i] * unit[j]).collect())
            .collect()
    };
    let of_type = sessions.iter().zip(&found.of_type);
    let outsiders = of_type.filter(|(_, own)| !**own);
    let outsiders: Vec<String> = outsiders.map(|(s, _)| s.id.clone()).collect();
    Ok(Prior {
        schema: PRIOR_SCHEMA.into(),
        created_by: concat!("stillpoint ", env!("CARGO_PKG_VERSION")).into(),
        devices: kept,
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

#[cfg(test)]
mod tests {
    use statrs::distribution::{ContinuousCDF, Normal};

    use super::*;

    /// Normal numbers: SplitMix64 through the quantile function.
    struct Random(u64);

    impl Random {
        fn normal(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let bits = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            let bits = (bits ^ (bits >> 31)) >> 11;
            Normal::standard().inverse_cdf((bits as f64 + 0.5) / (1_u64 << 53) as f64)
        }
    }

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

    /// Sessions of `n` devices with `p` parameters that spread by one, errors of a third to two thirds, some `far` in one parameter.
    fn fleet(random: &mut Random, n: usize, p: usize, far: &[(usize, f64)]) -> Vec<Session> {
        let mut session = |k: usize| {
            let error = 0.3 + 0.1 * (k % 4) as f64;
            let size = (1.0 + error * error).sqrt();
            let mut values = DVector::from_fn(p, |_, _| size * random.normal());
            if let Some((device, by)) = far.iter().find(|(device, _)| *device == k) {
                values[device % p] += by;
            }
            Session {
                id: k.to_string(),
                values,
                covariance: DMatrix::identity(p, p) * (error * error),
            }
        };
        (0..n).map(&mut session).collect()
    }

    fn names(p: usize) -> Vec<String> {
        (0..p).map(|k| format!("p{k}")).collect()
    }

    /// Variance that a prior states, over the parameters.
    fn mean_variance(prior: &Prior) -> f64 {
        let p = prior.parameters.len();
        (0..p).map(|k| prior.covariance[k][k]).sum::<f64>() / p as f64
    }

    #[test]
    fn of_fleets_of_sound_devices_next_to_none_is_left_out_and_spreads_are_not_small() {
        for (n, p, fleets) in [(72, 21, 3), (100, 21, 2), (40, 9, 8)] {
            let mut random = Random(n as u64);
            let (mut out, mut variance) = (0, 0.0);
            for _ in 0..fleets {
                let prior = fit_prior(&names(p), &fleet(&mut random, n, p, &[])).unwrap();
                out += prior.outsiders.len();
                variance += mean_variance(&prior) / f64::from(fleets);
            }
            // One fleet in twenty loses a device.
            assert!(out <= 2, "{n} devices, {p} parameters: {out} left out");
            // A variance of 1 from n values, in p parameters and so many fleets.
            let error = 1.3 * (2.0 / (n * p) as f64 / f64::from(fleets)).sqrt();
            assert!((variance - 1.0).abs() < 4.0 * error, "{n}, {p}: {variance}");
        }
    }

    #[test]
    fn devices_that_are_off_in_one_parameter_are_left_out_alone() {
        for (n, p) in [(72, 21), (60, 9)] {
            let mut random = Random(3);
            let (mut found, mut sound) = (0, 0);
            for _ in 0..2 {
                let far = [(11, 8.0), (40, -20.0)];
                let prior = fit_prior(&names(p), &fleet(&mut random, n, p, &far)).unwrap();
                let is_far = |id: &&String| ["11", "40"].contains(&id.as_str());
                let (of_far, others): (Vec<_>, Vec<_>) = prior.outsiders.iter().partition(is_far);
                found += of_far.len();
                sound += others.len();
            }
            assert!(found == 4 && sound <= 1, "{n}, {p}: {found}, {sound}");
        }
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
