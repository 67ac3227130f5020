//! An effect of the magnetometer that the readings go with and the model lacks.

use nalgebra::DVector;
use sensor::{EffectRef, Model, Quantity, Sensor};

use crate::methods::chance;
use crate::methods::magnetic::MagneticFit;
use crate::methods::small_sample::widening;

findings::tuning! {
    /// By chance in fewer calibrations than this, over all effects. A false name costs more than a missing one.
    UNLIKELY: f64 = 1e-5;

    /// An effect explains what is left where it leaves less than this share of the field's unevenness. Iron whose distance
    /// changes with the attitude looks like an effect too, and only a part of it goes with any.
    EXPLAINED: f64 = 0.5;
}

/// An effect that the readings go with and the model lacks, or several.
pub struct Missing {
    pub effects: Vec<EffectRef>,
    /// Probability of so much by chance, over all effects.
    pub p_value: f64,
    /// The field's unevenness that it leaves.
    pub unevenness: f64,
}

/// The effect that is the least likely to be nothing, if that is unlikely and it explains most of what `found` leaves; all that go by the field
/// alone, if they explain most of what one leaves: about a bias a cube is a square too. `fit` fits a larger model.
pub fn effect(
    model: &Model,
    found: &MagneticFit,
    has_temperature: bool,
    fit: impl Fn(&Model) -> Option<MagneticFit>,
) -> Option<Missing> {
    // An even field leaves nothing to explain.
    if found.unevenness == 0.0 {
        return None;
    }
    let candidates = effects::catalogue_of(Sensor::Magnetometer).filter(|effect| {
        let own = model
            .effects()
            .iter()
            .any(|own| own.name() == effect.name());
        let thermal = effect.needs().into_iter().any(Quantity::is_thermal);
        !own && (has_temperature || !thermal)
    });
    let candidates: Vec<EffectRef> = candidates.collect();
    let by_field = |effect: &&EffectRef| effect.needs() == [Quantity::MagneticField];
    let of_field: Vec<EffectRef> = candidates.iter().filter(by_field).cloned().collect();
    let each = candidates.into_iter();
    let found_alone = each.filter_map(|effect| judged(model, &[effect], found.unevenness, &fit));
    let best = found_alone.min_by(|a, b| a.p_value.total_cmp(&b.p_value));
    let best = best.filter(|best| best.p_value < UNLIKELY.get());
    let left = best.as_ref().map_or(found.unevenness, |own| own.unevenness);
    let all = (of_field.len() > 1).then(|| judged(model, &of_field, left, &fit));
    let all = all.flatten().filter(|all| all.p_value < UNLIKELY.get());
    all.or(best)
}

/// What effects leave that explain most of this unevenness, by Wald's test in the larger model, with the degrees of freedom of its residuals.
fn judged(
    model: &Model,
    effects: &[EffectRef],
    uneven: f64,
    fit: impl Fn(&Model) -> Option<MagneticFit>,
) -> Option<Missing> {
    let with = |model: Model, effect: &EffectRef| model.with(effect.clone());
    let larger = fit(&effects.iter().fold(model.clone(), with))?;
    if larger.unevenness >= EXPLAINED.get() * uneven {
        return None;
    }
    let count = effects.iter().map(|effect| effect.params().len()).sum();
    let p_value = by_chance(&larger, count)?;
    Some(Missing {
        effects: effects.to_vec(),
        p_value: p_value * magnetometer::EFFECTS.len() as f64,
        unevenness: larger.unevenness,
    })
}

/// Probability that the last `count` parameters are as far from 0 by chance.
fn by_chance(fit: &MagneticFit, count: usize) -> Option<f64> {
    let (values, n) = (&fit.model.values, fit.model.values.len());
    let theta = DVector::from_column_slice(&values[n - count..]);
    let covariance = fit
        .model
        .covariance
        .view((n - count, n - count), (count, count));
    let inverse = covariance.into_owned().try_inverse()?;
    let dof = fit.degrees_of_freedom;
    // The test allows for few degrees of freedom itself.
    let widened = if fit.unevenness > 0.0 {
        widening(dof).powi(2)
    } else {
        1.0
    };
    let square = theta.dot(&(inverse * &theta)) * widened / count as f64;
    Some(chance::of_f(square, [count as f64, dof as f64]))
}
