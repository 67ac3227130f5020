//! A formula that explains the whole better than the names do, or what the noise of the biases was taken for.

use estimate::methods::joint::orthonormal;
use faer::Mat;
use sensor::EffectRef;

use super::dictionary::{Product, dictionary};
use super::most::most_evidence;
use super::screen::{Screened, screen};
use super::{Proposed, propose_of};
use crate::family::{coefficients, effect_family, may_be_missing};
use crate::rank::APART;
use crate::remainder::described::Described;
use crate::remainder::unexplained::{Unexplained, rest_beside, rest_of};
use crate::request::Session;
use crate::search::Search;
use crate::state::State;

findings::tuning! {
    /// A product of which an effect of the catalogue leaves less than this share (`1 − ρ²`) is that effect, no formula.
    SAME: f64 = 2e-3;

    /// So many disturbances may be one error of the sensor.
    SEVERAL: usize = 2;
}

/// Looks for a formula beside the base models, with what these leave; `None` where it is not likelier than the named effects,
/// or several disturbances, and what they leave of single intervals and turns, by [`APART`]. `of_base` is what shapes say of the
/// base models, where that is known.
pub fn instead_of_names(
    session: &Session<'_>,
    search: &Search,
    of_base: Option<Described>,
) -> Option<(Proposed, Unexplained)> {
    let mut claims = search.names.iter().map(|name| &name.claim);
    let several = search.last.extension.disturbed.len() >= SEVERAL.get();
    if !several && !claims.any(|claim| claim.effect().is_some()) {
        return None;
    }
    let base = &search.base;
    let needed = search.evidence + APART.get();
    let (products, screened) = promising(session, base, needed)?;
    let alpha = session.request.alpha_of_rest();
    let described = of_base.unwrap_or_else(|| Described::of(base, -alpha.ln()));
    let whole = rest_beside(base, &described, alpha)
        .or_else(|| rest_of(&base.at_noise(screened.noise), alpha))?;
    let found = propose_of(session, base, &whole, (&products, &screened))?;
    (found.ranked.by_ratio() > needed).then_some((found, whole))
}

/// Looks for a formula where `last` leaves nothing that is more than its noise, with what is left where the biases have the noise
/// that suits the formula. Its evidence is that over all that the noise may be, as that of an effect.
pub fn hidden_formula(session: &Session<'_>, last: &State) -> Option<(Proposed, Unexplained)> {
    if last.noise_given {
        return None;
    }
    let (products, screened) = promising(session, last, session.request.threshold())?;
    let alpha = session.request.alpha_of_rest();
    let mut rest = rest_of(&last.at_noise(screened.noise), alpha)?;
    let found = propose_of(session, last, &rest, (&products, &screened))?;
    rest.p_value = found.p_value();
    Some((found, rest))
}

/// The products that are no effect's of the catalogue, screened; `None` where no formula of them has more evidence than `needed`.
pub(super) fn promising(
    session: &Session<'_>,
    state: &State,
    needed: f64,
) -> Option<(Vec<Product>, Screened)> {
    let catalogue = &session.candidates;
    let products = outside(state, catalogue, dictionary(state));
    let screened = screen(state, &products)?;
    let most = most_evidence(&screened, &products, state.levels());
    (most > needed).then_some((products, screened))
}

/// The `products` that are no effect of the catalogue that may be missing.
pub(super) fn outside(
    base: &State,
    catalogue: &[EffectRef],
    mut products: Vec<Product>,
) -> Vec<Product> {
    let spans = catalogue
        .iter()
        .filter(|effect| may_be_missing(base, effect) && coefficients(effect).1.is_none())
        .map(|effect| {
            let family = effect_family(base, effect, catalogue);
            orthonormal(&base.projected.columns(family.columns_of(0).as_ref()))
        });
    let spans: Vec<Mat<f64>> = spans.collect();
    let is_within = |column: &Mat<f64>| {
        let held = |span: &Mat<f64>| (span.transpose() * column).squared_norm_l2();
        spans.iter().any(|span| held(span) > 1.0 - SAME.get())
    };
    let is_own = |product: &Product| {
        let mut columns =
            (0..product.columns.ncols()).map(|k| product.columns.as_ref().subcols(k, 1).to_owned());
        columns.all(|column| is_within(&column))
    };
    products.retain(|product| !is_own(product));
    products
}
