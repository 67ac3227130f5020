//! A formula for what no effect of the catalogue explains.
//!
//! ```text
//! dictionary ──► the likeliest 40 ──► group lasso on halves ──► backward elimination ──► Formula ──► refit, held out
//!  products        score, walks          stable groups             terms                  evidence       gap
//! ```

mod alternatives;
mod chosen;
mod dictionary;
mod forms;
mod group_lasso;
mod instead;
mod most;
mod screen;
mod stability;
mod terms;

use alternatives::alternatives;
use chosen::{Chosen, Stable};
use dictionary::{Product, dictionary, log_formulas};
use estimate::calibration::EffectParameter;
pub use forms::forms;
pub use instead::{hidden_formula, instead_of_names};
use screen::{Screened, screen};
use sensor::{EffectRef, Formula, Sensor};
use serde::Serialize;
use stability::stability;
use terms::terms;

use super::family::effect_family;
use super::gap::channel::Channel;
use super::gap::held_out::{held_out, held_out_as_after};
use super::gap::sequence::Misfit;
use super::rank::{APART, Ranked, rank};
use super::remainder::unexplained::Unexplained;
use super::request::Session;
use super::state::State;

findings::tuning! {
    /// Formulas that are tried, at most.
    MOST_TRIED: usize = 3;
    /// They are less likely than the first by at most so many times [`APART`].
    NEARLY: f64 = 3.0;

    /// Share of the excess of the held-out gap over 1 that may be left.
    MAY_REMAIN: f64 = 0.2;
}

/// A formula that explains what no effect of the catalogue does. It is no name: another formula may do as well.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proposal {
    /// Name of the formula.
    pub name: String,
    /// The formula as users read it.
    pub equation: String,
    /// The sensor that has it.
    pub sensor: Sensor,
    /// Its coefficients after the refit, named by axis and factors.
    pub terms: Vec<EffectParameter>,
    /// The channel that it is judged by: that of the unexplained rest.
    pub channel: Channel,
    /// Likelihood ratio against the model without it, the walks profiled.
    pub statistic: f64,
    /// Chance of so much by any formula of as many terms where nothing is missing.
    pub adjusted_p_value: f64,
    /// `√(χ²/dof)` of the channel on intervals that the fit did not see, without it.
    pub held_out_gap_before: f64,
    /// With it.
    pub held_out_gap_after: f64,
    /// Share of the halves of the intervals that select each of its products: the least.
    pub stability: f64,
    /// Alternatives to single terms that fit about as well, each as a formula of one term.
    pub alternatives: Vec<String>,
    /// The formula itself.
    #[serde(skip)]
    pub formula: Formula,
}

/// A formula with the model that holds it.
#[derive(Clone, Debug)]
pub struct Proposed {
    /// The formula, with estimated sizes.
    pub formula: Formula,
    /// The effect that it is in the model.
    pub effect: EffectRef,
    /// The model with it.
    pub state: State,
    ranked: Ranked,
    stability: f64,
    gaps: [f64; 2],
    alternatives: Vec<String>,
}

impl Proposed {
    /// Chance of so much by any formula of as many terms where nothing is missing.
    fn p_value(&self) -> f64 {
        (-self.ranked.evidence).exp().min(1.0)
    }

    /// Builds the proposal as it is written to the file; `parameters` are those of the refit.
    pub fn written(self, channel: Channel, parameters: Vec<EffectParameter>) -> Proposal {
        let adjusted_p_value = self.p_value();
        let mut formula = self.formula;
        for (term, p) in formula.terms.iter_mut().zip(&parameters) {
            term.size = p.value;
        }
        Proposal {
            name: self.effect.name().into(),
            equation: formula.to_string(),
            sensor: formula.sensor,
            terms: parameters,
            channel,
            statistic: self.ranked.statistic,
            adjusted_p_value,
            held_out_gap_before: self.gaps[0],
            held_out_gap_after: self.gaps[1],
            stability: self.stability,
            alternatives: self.alternatives,
            formula,
        }
    }
}

/// Looks for a formula for the rest that `last` leaves; `None` where none is selected time and again, is
/// significant among all formulas of as many terms, and closes the gap on intervals that the fit did not see.
pub fn propose(session: &Session<'_>, last: &State, rest: &Unexplained) -> Option<Proposed> {
    let products = dictionary(last);
    let screened = screen(last, &products)?;
    propose_of(session, last, rest, (&products, &screened))
}

/// A formula of some products for the rest that `last` leaves. Where the likeliest formula does not close the gap, what is like it and less likely may.
fn propose_of(
    session: &Session<'_>,
    last: &State,
    rest: &Unexplained,
    (products, screened): (&[Product], &Screened),
) -> Option<Proposed> {
    let frequencies = stability(last, products, screened);
    let stable = Stable::of(screened, products, &frequencies);
    let first = *stable.places.first()?;
    let alike = stable
        .places
        .iter()
        .filter(|&&place| stable.are_alike(first, place));
    let nearly = alike.filter(|&&place| {
        screened.log_p(place) < screened.log_p(first) + NEARLY.get() * APART.get()
    });
    let mut left = stable.clone();
    for _ in 0..nearly.count().min(MOST_TRIED.get()) {
        let chosen = left.chosen();
        let taken = chosen.first()?.place;
        match tried(session, last, rest, (screened, products, &chosen))? {
            Tried::Closes(proposed) => return Some(*proposed),
            Tried::Open => left.places.retain(|&place| place != taken),
        }
    }
    None
}

/// Result of trying a formula.
enum Tried {
    Closes(Box<Proposed>),
    /// It leaves a gap.
    Open,
}

/// One formula, of the products that were chosen; `None` where it is not evident.
fn tried(
    session: &Session<'_>,
    last: &State,
    rest: &Unexplained,
    (screened, products, chosen): (&Screened, &[Product], &[Chosen<'_>]),
) -> Option<Tried> {
    let sensor = chosen.first()?.product.sensor;
    let found = terms(&screened.whitened, chosen)?;
    let formula = Formula::new(sensor, found.terms.clone());
    let effect = formula.effect(name_of(sensor)).ok()?;
    let tried = log_formulas(products, found.products, found.terms.len());
    let ranked = evidence(last, &effect, tried)?;
    if ranked.evidence <= session.request.threshold() {
        return None;
    }
    let mut extension = last.extension.clone();
    extension.effects.push((effect.clone(), None));
    let state = State::fit(session, extension).ok()?;
    let Some(gaps) = closed(last, &state, rest.channel) else {
        return Some(Tried::Open);
    };
    let kept: Vec<_> = screened.kept.iter().map(|k| &products[*k]).collect();
    Some(Tried::Closes(Box::new(Proposed {
        formula,
        effect,
        state,
        ranked,
        stability: found.stability,
        gaps,
        alternatives: alternatives(&screened.whitened, &found, &kept),
    })))
}

/// The name of a proposed effect.
pub fn name_of(sensor: Sensor) -> &'static str {
    match sensor {
        Sensor::Accelerometer => "accel_proposed",
        Sensor::Gyroscope => "gyro_proposed",
        Sensor::Magnetometer => "mag_proposed",
    }
}

/// The evidence for a formula, one of `exp(log_formulas)` of as many products.
fn evidence(last: &State, effect: &EffectRef, log_formulas: f64) -> Option<Ranked> {
    let mut family = effect_family(last, effect, &[]);
    family.log_places = log_formulas;
    rank(&last.projected, &[family], last.walks()).pop()
}

/// The held-out gap of the channel before and after, at the noise of the model after; `None` unless what was there is not
/// noise, `gap² ≤ 1 + 2 √(2/dof)`, and what is left is, or a small share of what was.
fn closed(before: &State, after: &State, channel: Channel) -> Option<[f64; 2]> {
    let of = |misfits: [Misfit; 3]| misfits.get(channel as usize).copied();
    let before = of(held_out_as_after(before, after)?)?;
    let after = of(held_out(after, after.noise)?)?;
    let gaps = [before.gap(), after.gap()];
    let error = 2.0 * (2.0 / after.dof.max(1.0)).sqrt();
    let [was_noise, is_noise] = gaps.map(|gap| gap * gap <= 1.0 + error);
    let is_small = gaps[1] - 1.0 <= MAY_REMAIN.get() * (gaps[0] - 1.0);
    (!was_noise && gaps[1] < gaps[0] && (is_noise || is_small)).then_some(gaps)
}

#[cfg(test)]
mod tests;
