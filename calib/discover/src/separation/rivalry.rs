//! A named effect and one that the recordings cannot tell from it.

use estimate::calibration::effect_named;
use estimate::methods::joint::{BiasNoise, columns, effect_columns};
use faer::Mat;
use sensor::{EffectRef, Quantity, Role};
use serde::{Deserialize, Serialize};

use super::information::Information;
use crate::family::{Family, beside, coefficients};
use crate::rank::Ranked;
use crate::state::{State, with_companions};

/// An effect as it would be if it alone were what is missing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    /// Its name in the catalogue.
    pub name: String,
    /// Its coefficients and those of what comes with it: `accel_quadratic.x` ….
    pub coefficients: Vec<String>,
    /// Estimates of these, SI units.
    pub values: Vec<f64>,
    /// The parameter that shapes it with its value: `accel_warmup.tau`, s.
    pub shape: Option<(String, f64)>,
}

/// Two effects of which the recordings do not say which it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rivalry {
    /// The one that was named.
    pub named: Rival,
    /// The other.
    pub other: Rival,
    /// Information of the recordings on both.
    pub recorded: Information,
    /// `λ (1 − ρ²)`, how far they are apart: 10.8 is right in 95 of 100 recordings, 21 also 20 to 1.
    pub separation: f64,
}

impl Rival {
    fn of(families: &[Family], ranked: &Ranked, catalogue: &[EffectRef]) -> Option<Self> {
        let family = &families[ranked.family];
        let effect = family.claim.effect()?;
        let (mut names, mut typical) = (Vec::new(), Vec::new());
        for part in with_companions(effect, catalogue) {
            for k in coefficients(&part).0 {
                names.push(full(&part, k));
                typical.push(part.typical_of(k));
            }
        }
        // A companion that is in the model already has no column.
        let values = ranked.score.change.clone();
        names.truncate(values.len());
        let shape = family.hypotheses[ranked.hypothesis].shape;
        Some(Self {
            name: effect.name().into(),
            coefficients: names,
            values: values.iter().zip(&typical).map(|(v, t)| v * t).collect(),
            shape: shape.map(|(k, value)| (full(effect, k), value)),
        })
    }

    /// Returns true if it settles after switching on.
    pub fn settles(&self) -> bool {
        let shaped = |effect: &EffectRef| {
            let mut roles = effect.params().iter().map(|p| p.role);
            roles.any(|role| role == Role::TimeConstant)
        };
        self.shape.is_some()
            && effect_named(&self.name)
                .is_some_and(|e| shaped(&e) && e.needs().contains(&Quantity::Time))
    }

    /// Returns true if it belongs to an instant of the recording that it was seen in.
    pub fn is_of_an_instant(&self) -> bool {
        effect_named(&self.name).is_some_and(|effect| effect.instant().is_some())
    }

    fn value(&self, name: &str) -> Option<f64> {
        let at = self.coefficients.iter().position(|own| own == name);
        let shape = self.shape.as_ref().filter(|(own, _)| own == name);
        at.map(|k| self.values[k])
            .or(shape.map(|(_, value)| *value))
    }

    /// Returns true if the catalogue has all its effects.
    pub fn is_known(&self, catalogue: &[EffectRef]) -> bool {
        let there = |name: &String| {
            let (effect, _) = name.split_once('.')?;
            catalogue.iter().find(|e| e.name() == effect)
        };
        self.coefficients.iter().all(|name| there(name).is_some())
    }

    /// `∂r/∂c` of its coefficients, white-whitened, with their names.
    pub(super) fn columns(
        &self,
        state: &State,
        catalogue: &[EffectRef],
    ) -> (Vec<String>, Mat<f64>) {
        let (mut names, mut parts) = (Vec::new(), Vec::new());
        for effect in catalogue {
            let params = effect.params();
            let value = |k: usize| self.value(&full(effect, k));
            let wanted: Vec<usize> = (0..params.len())
                .filter(|k| self.coefficients.contains(&full(effect, *k)))
                .collect();
            if wanted.is_empty() {
                continue;
            }
            let point: Vec<f64> = params
                .iter()
                .enumerate()
                .map(|(k, p)| value(k).unwrap_or(p.nominal))
                .collect();
            names.extend(wanted.iter().map(|k| full(effect, *k)));
            let (sensitivities, m) = (&state.sensitivities, state.rows());
            parts.push(effect_columns(sensitivities, m, effect, &point, &wanted));
        }
        (names, state.whitened(beside(&parts, state.rows())))
    }
}

fn full(effect: &EffectRef, k: usize) -> String {
    format!("{}.{}", effect.name(), effect.params()[k].name)
}

impl Rivalry {
    /// Builds it from two claims about the same state; `None` where one is no effect.
    pub(crate) fn of(
        state: &State,
        families: &[Family],
        (named, other): (&Ranked, &Ranked),
        catalogue: &[EffectRef],
    ) -> Option<Self> {
        let noise = named.noise;
        let mut rivalry = Self {
            named: Rival::of(families, named, catalogue)?,
            other: Rival::of(families, other, catalogue)?,
            recorded: Information::default(),
            separation: 0.0,
        };
        rivalry.recorded = rivalry.seen_by(state, noise, catalogue);
        rivalry.separation = rivalry.separation_with(&rivalry.recorded);
        Some(rivalry)
    }

    /// Computes the information of a session on both.
    pub(super) fn seen_by(
        &self,
        state: &State,
        noise: BiasNoise,
        catalogue: &[EffectRef],
    ) -> Information {
        let (mut names, mine) = self.named.columns(state, catalogue);
        let (others, theirs) = self.other.columns(state, catalogue);
        // One effect may be the companion of the other.
        let more: Vec<usize> = (0..others.len())
            .filter(|k| !names.contains(&others[*k]))
            .collect();
        names.extend(more.iter().map(|k| others[*k].clone()));
        let theirs = columns(&theirs, &more);
        let all = beside(&[mine, theirs], state.rows());
        Information::of(state, noise, &names, &all)
    }

    /// `λ (1 − ρ²)` by this information: the less of what is left of the one when the other may take its part. Of an effect that
    /// is a part of the other nothing is ever left: then what the other has beside it.
    pub fn separation_with(&self, information: &Information) -> f64 {
        let left = |one: &Rival, other: &Rival| {
            let is_of = |rival: &Rival, name: &String| rival.coefficients.contains(name);
            let is_part = one.coefficients.iter().all(|name| is_of(other, name));
            if is_part {
                return f64::INFINITY;
            }
            let names = information.parameters.iter().enumerate();
            let (mut signal, mut nuisance) = (Vec::new(), Vec::new());
            for (k, name) in names {
                if is_of(other, name) || !is_of(one, name) {
                    nuisance.push(k);
                } else {
                    signal.extend(one.value(name).map(|value| (k, value)));
                }
            }
            information.left_of(&signal, &nuisance)
        };
        left(&self.named, &self.other).min(left(&self.other, &self.named))
    }
}
