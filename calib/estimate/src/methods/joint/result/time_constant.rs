//! Errors of effects whose time constant is fitted, beyond the linear ones.

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use sensor::{EffectRef, Role};

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::rows::error_columns::effect_columns;
use crate::methods::joint::rows::sensitivity::Sensitivities;

findings::tuning! {
    /// Time constants are looked at up to so many times the fitted one, and down to its inverse.
    SPAN: f64 = 10.0;

    /// Distance of neighbours, in linear standard errors of `ln τ`.
    STEP: f64 = 0.5;
    /// That distance at most.
    WIDEST: f64 = 0.2;

    /// Most of them each way: where the curvature says nothing of the likelihood, as of a column that is all but nothing.
    MOST: u32 = 50;

    /// A likelihood below this share of the greatest ends the way.
    NOTHING: f64 = 1e-4;
}

/// An effect with its coefficients and its time constant.
struct Shaped<'a> {
    effect: &'a EffectRef,
    /// Places of its coefficients in the effect, and among the columns of the Jacobian.
    linear: Vec<usize>,
    columns: Vec<usize>,
    /// The same of the time constant.
    shape: usize,
    shape_column: usize,
    /// All its parameters at the fit.
    values: Vec<f64>,
}

impl JointFit {
    /// Columns of the Jacobian whose standard errors are larger than the linear ones, with the factor.
    ///
    /// The likelihood of a time constant `τ` falls slowly towards long ones, with which an effect looks like a line, and steeply towards
    /// short ones: its curvature at the maximum does not tell. With the profile likelihood `L(τ)`, taken for the density of `ln τ`, and
    /// the coefficients `β(τ)` that maximise it with their covariance `C(τ)`, the mean squares about the estimate are
    ///
    /// ```text
    /// τ:   ∫ L (τ − τ̂)² d ln τ / ∫ L d ln τ          β_k:   ∫ L [(β_k(τ) − β̂_k)² + C_kk(τ)] d ln τ / ∫ L d ln τ
    /// ```
    ///
    /// Of effects that have one of the columns `wanted`.
    pub(super) fn beyond_linear(&self, wanted: &[usize]) -> Vec<(usize, f64)> {
        let effects = self.models.iter().flat_map(|model| model.effects());
        let shaped = effects.filter_map(|effect| self.shaped(effect));
        let is_wanted = |own: &Shaped<'_>| own.all().iter().any(|k| wanted.contains(k));
        let shaped: Vec<Shaped<'_>> = shaped.filter(is_wanted).collect();
        if shaped.is_empty() {
            return Vec::new();
        }
        let sensitivities = self.sensitivities();
        let linear = self.variances_of_weights();
        let factors = shaped
            .iter()
            .filter_map(|own| self.factors(own, &sensitivities, &linear));
        factors.flatten().collect()
    }

    /// Variances of the shared parameters by the weights, at their columns of the Jacobian.
    fn variances_of_weights(&self) -> Vec<f64> {
        let covariance = self.covariance_of_weights();
        let mut of_shared = covariance.iter().enumerate().map(|(k, row)| row[k]);
        let columns = self.free.iter();
        columns
            .map(|place| match *place < self.shared {
                true => of_shared.next().unwrap_or(f64::NAN),
                false => f64::NAN,
            })
            .collect()
    }

    /// An effect of one fitted time constant.
    fn shaped<'a>(&self, effect: &'a EffectRef) -> Option<Shaped<'a>> {
        let params = effect.params();
        let place = |k: usize| {
            self.parameters
                .index(&format!("{}.{}", effect.name(), params[k].name))
        };
        let column = |k: usize| {
            let place = place(k)?;
            self.free.iter().position(|free| *free == place)
        };
        let shape = params.iter().position(|p| p.role == Role::TimeConstant)?;
        let linear: Vec<usize> = (0..params.len())
            .filter(|&k| params[k].role == Role::Coefficient)
            .collect();
        let values = self.parameters.values();
        Some(Shaped {
            effect,
            columns: linear.iter().map(|&k| column(k)).collect::<Option<_>>()?,
            shape_column: column(shape)?,
            values: (0..params.len())
                .map(|k| Some(values[place(k)?]))
                .collect::<Option<_>>()?,
            linear,
            shape,
        })
    }

    fn factors(
        &self,
        own: &Shaped<'_>,
        sensitivities: &Sensitivities,
        linear: &[f64],
    ) -> Option<Vec<(usize, f64)>> {
        let all = own.all();
        let others = (0..self.jacobian.ncols()).filter(|k| !all.contains(k));
        let others: Vec<usize> = others.collect();
        let model = Basis::of(&self.jacobian.select(&others));
        let columns = |tau: f64| {
            let mut p = own.values.clone();
            p[own.shape] = tau;
            let rows = self.residuals.len();
            let mut columns = effect_columns(sensitivities, rows, own.effect, &p, &own.linear);
            self.whitening.white.apply(columns.as_mut());
            let columns = Columns::cut(&columns, self.whitening.white.groups());
            model
                .without(&self.whitening.finish_columns(columns))
                .to_dense()
        };
        let (fitted, tau) = (own.coefficients(), own.values[own.shape]);
        let count = fitted.len();
        let here = columns(tau);
        let of_effect = &here * Mat::from_fn(count, 1, |k, _| fitted[k]);
        let residuals = model.without_column(&self.residuals);
        let without = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i] - of_effect[(i, 0)]);
        let here = At::of(&here, &without)?;
        let weight = |at: &At| (at.log_likelihood - here.log_likelihood).exp();
        let step = (STEP.get() * linear[own.shape_column].sqrt() / tau).min(WIDEST.get());
        let mut profile = Vec::new();
        for step in [-step, step] {
            let ways = (1..=MOST.get()).map(|k| step * f64::from(k));
            for way in ways.take_while(|way| way.abs() < SPAN.get().ln()) {
                let other = tau * way.exp();
                let at = At::of(&columns(other), &without)?;
                let is_nothing = weight(&at) < NOTHING.get();
                profile.push((other, at));
                if is_nothing {
                    break;
                }
            }
        }
        profile.push((tau, here.clone()));
        let whole: f64 = profile.iter().map(|(_, at)| weight(at)).sum();
        let square = |k: usize, (other, at): &(f64, At)| match fitted.get(k) {
            Some(fitted) => (at.coefficients[k] - fitted).powi(2) + at.variances[k],
            None => (other - tau).powi(2),
        };
        let factor = |(k, column): (usize, usize)| {
            let squares = profile.iter().map(|own| weight(&own.1) * square(k, own));
            let variance = squares.sum::<f64>() / whole;
            (column, (variance / linear[column]).sqrt().max(1.0))
        };
        Some(all.into_iter().enumerate().map(factor).collect())
    }
}

/// The fit at one time constant.
#[derive(Clone)]
struct At {
    /// Up to a constant.
    log_likelihood: f64,
    coefficients: DVector<f64>,
    /// Variances of the coefficients.
    variances: DVector<f64>,
}

impl At {
    /// `columns` and the residuals `without` the effect, less what the model takes of both.
    fn of(columns: &Mat<f64>, without: &Mat<f64>) -> Option<Self> {
        let n = columns.ncols();
        let (gram, moved) = (columns.transpose() * columns, columns.transpose() * without);
        let gram = DMatrix::from_fn(n, n, |i, k| gram[(i, k)]);
        let moved = DVector::from_fn(n, |i, _| moved[(i, 0)]);
        let covariance = gram.cholesky()?.inverse();
        let coefficients = -(&covariance * &moved);
        let log_likelihood = -0.5 * coefficients.dot(&moved);
        log_likelihood.is_finite().then(|| Self {
            log_likelihood,
            coefficients,
            variances: covariance.diagonal(),
        })
    }
}

impl Shaped<'_> {
    /// Its columns of the Jacobian, the time constant's last.
    fn all(&self) -> Vec<usize> {
        [self.columns.as_slice(), &[self.shape_column]].concat()
    }

    /// The coefficients at the fit.
    fn coefficients(&self) -> Vec<f64> {
        self.linear.iter().map(|&k| self.values[k]).collect()
    }
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use crate::methods::joint::{JointRequest, fit_joint};

    /// Factors on the standard errors of a warm-up of so many typical sizes, the time constant's last.
    fn factors(size: f64) -> Vec<f64> {
        let spec = Spec::hand_held(3).with_effect("gyro_warmup", size);
        let recording = spec.run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let request = JointRequest::new(vec![(&recording, &segmentation)], spec.gravity);
        let warmup = effects::effect_named("gyro_warmup").unwrap();
        let gyroscope = gyroscope::model().with(warmup);
        let fit = fit_joint(&JointRequest {
            gyroscope,
            ..request
        })
        .unwrap();
        let all: Vec<usize> = (0..fit.free.len()).collect();
        fit.beyond_linear(&all)
            .into_iter()
            .map(|(_, factor)| factor)
            .collect()
    }

    #[test]
    fn a_time_constant_that_is_little_known_has_larger_errors_than_the_linear_ones() {
        let (sure, unsure) = (factors(40.0), factors(1.0));
        assert!(sure.len() == 4 && sure.iter().all(|f| *f < 1.1), "{sure:?}");
        assert!(unsure[3] > 1.1, "{unsure:?}");
    }
}
