//! The evidence for all names at once, beside the base models.

use std::f64::consts::LN_2;

use estimate::methods::joint::Column;
use faer::Mat;
use sensor::{EffectRef, Sensor};
use statrs::function::factorial::ln_binomial;

use super::named_claim::NamedClaim;
use crate::family::{Claim, beside, effect_family, families};
use crate::rank::ratio_of;
use crate::score::log_tail;
use crate::state::State;

/// The evidence, by one likelihood ratio, for everything that is held: all its columns at once, as a formula in its place has them.
///
/// The sum of what each of them adds beside the others is no such evidence: of two that need each other each adds nearly all.
/// `None` where the base models do not know one of them.
pub(super) fn evidence_together(
    base: &State,
    held: &[NamedClaim],
    catalogue: &[EffectRef],
) -> Option<f64> {
    let (mut parts, mut log_places, mut shape_dof) = (Vec::new(), 0.0, 0.0);
    for own in held {
        match &own.claim {
            Claim::Effect(effect) => {
                let family = effect_family(base, effect, catalogue);
                let mut ways = family.hypotheses.iter();
                let way = ways.position(|way| way.shape == own.hypothesis.shape)?;
                parts.push(family.columns_of(way));
                log_places += family.log_places;
                shape_dof += family.shape_dof;
            }
            Claim::Disturbed(fault) => {
                let of_kind = || base.suspects.iter().filter(|s| s.fault == *fault);
                let suspect = of_kind().find(|s| Some(s.place) == own.hypothesis.place)?;
                let columns: Vec<&Column> = suspect.columns.iter().collect();
                parts.push(base.sparse(&columns).to_dense());
                log_places += (of_kind().count() as f64).ln();
            }
            Claim::Shape(..) => return None,
        }
    }
    let columns: Mat<f64> = beside(&parts, base.rows());
    let of_gyroscope = held
        .iter()
        .any(|own| own.claim.sensor() == Sensor::Gyroscope);
    let sensor = match of_gyroscope {
        true => Sensor::Gyroscope,
        false => Sensor::Accelerometer,
    };
    let (statistic, dof) = ratio_of(&base.projected, (sensor, &columns), base.walks())?;
    let claims = families(base, catalogue).len() as u64;
    let choice = ln_binomial(claims, held.len() as u64) + LN_2;
    Some(-log_tail(statistic, dof + shape_dof) - log_places - choice)
}
