//! Forms of an error that explain as much as a named effect does.

use sensor::{Axis, Covariate, EffectRef, Quantity};

use super::dictionary::{Factors, Product, forms_of};
use super::instead::outside;
use crate::family::coefficients;
use crate::rank::APART;
use crate::score::{log_tail, score};
use crate::search::Name;

findings::tuning! {
    /// So many are stated.
    STATED: usize = 3;
}

/// The forms `e_i = c_i h_i`, `h` a product of what the named effect looks at, whose likelihood is no less than a twentieth of its own and
/// that are no effect of the `catalogue`; the likeliest [`STATED`] of them, likeliest first. None for an effect with a shape.
///
/// Over the attitudes of a recording `f⁴` is nearly `f²` and `f |f|` nearly `f³`: which of them a device has is known only where it is
/// large.
pub fn forms(name: &Name, catalogue: &[EffectRef]) -> Vec<String> {
    let found = name
        .claim
        .effect()
        .filter(|effect| coefficients(effect).1.is_none());
    found
        .and_then(|effect| as_likely(name, effect, catalogue))
        .unwrap_or_default()
}

fn as_likely(name: &Name, effect: &EffectRef, catalogue: &[EffectRef]) -> Option<Vec<String>> {
    let (state, ranked) = (&name.without, &name.ranked);
    let whitened = state.projected.at_share(ranked.noise, ranked.scatter)?;
    let (needs, signal) = (effect.needs(), Quantity::signal_of(effect.sensor()));
    let looked_at = |q: &Quantity| needs.contains(q) || *q == signal;
    let alike = |other: &&EffectRef| other.needs().iter().all(looked_at);
    let catalogue: Vec<_> = catalogue.iter().filter(alike).cloned().collect();
    let products = forms_of(state, effect.sensor(), &needs);
    let own = log_tail(ranked.score.statistic, ranked.score.dof as f64);
    let likely = outside(state, &catalogue, products).into_iter();
    let likely = likely.filter_map(|product| {
        let found = score(whitened.columns(&product.columns).as_ref(), &whitened.z);
        let log_p = log_tail(found.statistic, found.dof as f64);
        (log_p < own + APART.get()).then(|| (log_p, written(&product)))
    });
    let mut likely: Vec<(f64, String)> = likely.collect();
    likely.sort_by(|a, b| a.0.total_cmp(&b.0));
    likely.truncate(STATED.get());
    Some(likely.into_iter().map(|(_, form)| form).collect())
}

/// `A_i += c_i f_i^4`.
fn written(product: &Product) -> String {
    let letter = product.sensor.letter();
    let factors = product.parts.first();
    let factors = factors.map_or_else(String::new, |(axis, factors)| of_axis(*axis, factors));
    format!("{letter}_i += c_i {factors}")
}

/// The factors on an axis, those of other axes by how many axes later they are.
fn of_axis(axis: Axis, factors: &Factors) -> String {
    let later = |other: Axis| match (other.index() + 3 - axis.index()) % 3 {
        0 => "i".into(),
        by => format!("(i+{by})"),
    };
    let one = |(covariate, power): &(Covariate, u32)| {
        let written = match *covariate {
            Covariate::SpecificForce(other) => format!("f_{}", later(other)),
            Covariate::AngularRate(other) => format!("w_{}", later(other)),
            Covariate::ForceSize(other) => format!("|f_{}|", later(other)),
            Covariate::RateSize(other) => format!("|w_{}|", later(other)),
            other => other.name(),
        };
        match power {
            1 => written,
            power => format!("{written}^{power}"),
        }
    };
    factors.iter().map(one).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use crate::{Request, discover};

    #[test]
    fn a_small_error_in_the_third_power_may_be_one_in_the_square_with_its_sign_and_a_large_one_not()
    {
        let forms = |times: f64| {
            let spec = Spec::hand_held(4).with_effect("accel_cubic", times);
            let recordings = [spec.run().unwrap().recording];
            let found = discover(&recordings, &Request::new(spec.gravity)).unwrap();
            let effect = found.findings.effects.into_iter().next().unwrap();
            assert_eq!(effect.name, "accel_cubic");
            effect.forms
        };
        let other = "A_i += c_i f_i |f_i|".to_owned();
        let [small, large] = [1.0, 30.0].map(forms);
        assert!(small.contains(&other), "{small:?}");
        assert!(!large.contains(&other), "{large:?}");
    }
}
