//! Test for equal sizes of an effect in several units.

use estimate::calibration::EffectParameter;
use nalgebra::{DMatrix, DVector};
use sensor::{EffectRef, Role};

use super::findings::Agreement;
use super::unit::Unit;
use crate::score::log_tail;

/// Compares the coefficients of `effect` in the units whose models have it; `None` of one whose parameters belong to a
/// recording or that a shape of its own scales, and where fewer than two units have it.
pub(super) fn agreement(
    units: &[Unit<'_>],
    effect: &EffectRef,
    among: &[bool],
) -> Option<Agreement> {
    let params = effect.params();
    if params.iter().any(|p| p.role != Role::Coefficient) {
        return None;
    }
    let own = units.iter().zip(among).filter(|(_, is_in)| **is_in);
    let sizes = own
        .map(|(unit, _)| size(unit, effect))
        .collect::<Option<Vec<_>>>()?;
    let free: Vec<&String> = sizes.first()?.0.iter().collect();
    if sizes.len() < 2
        || sizes
            .iter()
            .any(|(names, ..)| names.iter().collect::<Vec<_>>() != free)
    {
        return None;
    }
    let (mean, covariance, chi2) = combined(
        &sizes
            .iter()
            .map(|(_, x, c)| (x.clone(), c.clone()))
            .collect::<Vec<_>>(),
    )?;
    let dof = ((sizes.len() - 1) * free.len()) as f64;
    let unit_of = |name: &str| {
        params
            .iter()
            .find(|p| p.name == name)
            .map_or("", |p| &*p.unit)
    };
    let mean = free.iter().enumerate().map(|(k, name)| EffectParameter {
        name: (*name).clone(),
        value: mean[k],
        std: Some(covariance[(k, k)].sqrt()),
        unit: unit_of(name).into(),
    });
    Some(Agreement {
        chi2,
        dof,
        p_value: log_tail(chi2, dof).exp(),
        mean: mean.collect(),
    })
}

/// Names, values and covariance of the free coefficients of an effect.
fn size(unit: &Unit<'_>, effect: &EffectRef) -> Option<(Vec<String>, DVector<f64>, DMatrix<f64>)> {
    let prefix = format!("{}.", effect.name());
    let fitted = unit
        .state
        .fit
        .fitted_where(|name| name.starts_with(&prefix));
    let free = &fitted.free;
    let values = free
        .iter()
        .map(|name| Some(fitted.parameters.values()[fitted.parameters.index(name)?]));
    let values = values.collect::<Option<Vec<f64>>>()?;
    let n = values.len();
    let names = free.iter().map(|name| name[prefix.len()..].to_owned());
    Some((
        names.collect(),
        DVector::from_vec(values),
        DMatrix::from_fn(n, n, |i, j| fitted.covariance[i][j]),
    ))
}

/// Weighted mean, its covariance, and `Σ (xᵢ − x̄)ᵀ Cᵢ⁻¹ (xᵢ − x̄)`.
fn combined(sizes: &[(DVector<f64>, DMatrix<f64>)]) -> Option<(DVector<f64>, DMatrix<f64>, f64)> {
    let n = sizes.first()?.0.len();
    let (mut information, mut moved) = (DMatrix::zeros(n, n), DVector::zeros(n));
    let mut precisions = Vec::new();
    for (x, c) in sizes {
        let precision = c.clone().cholesky()?.inverse();
        moved += &precision * x;
        information += &precision;
        precisions.push(precision);
    }
    let covariance = information.cholesky()?.inverse();
    let mean = &covariance * moved;
    let apart = sizes.iter().zip(&precisions).map(|((x, _), precision)| {
        let d = x - &mean;
        d.dot(&(precision * &d))
    });
    let chi2 = apart.sum();
    Some((mean, covariance, chi2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sizes_three_errors_of_their_difference_apart_have_nine() {
        let of = |x: f64, std: f64| {
            (
                DVector::from_element(1, x),
                DMatrix::from_element(1, 1, std * std),
            )
        };
        // 3 and 4 make an error of 5 of the difference, which is 15.
        let (mean, covariance, chi2) = combined(&[of(0.0, 3.0), of(15.0, 4.0)]).unwrap();
        assert!((chi2 - 9.0).abs() < 1e-12);
        // Weights 16 : 9.
        assert!((mean[0] - 15.0 * 9.0 / 25.0).abs() < 1e-12);
        assert!((covariance[(0, 0)] - 144.0 / 25.0).abs() < 1e-12);
    }
}
