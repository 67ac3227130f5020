//! What is known of static intervals: their history and their vibration.

use nalgebra::Vector3;
use sensor::Kinematics;

use super::sensing::{Models, Sensing};
use super::unneeded;
use crate::covariates::{last_changes, vibrations};
use crate::intervals::{Moments, Segmentation, Span, StaticInterval};

/// A static interval and the truth in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownRest {
    pub span: Span,
    pub known: Kinematics<f64>,
}

/// Rounds at most in which a change of force is judged with the errors that its own sign makes taken off.
const ROUNDS: usize = 5;

/// All of a recording that begins at `start`.
pub(super) fn of(segmentation: &Segmentation, models: &Models, start: f64) -> Vec<KnownRest> {
    let statics = &segmentation.statics;
    let sensing = models.accelerometer.as_ref();
    let shaking = shaking(statics.iter().map(|rest| rest.accelerometer), sensing);
    let known = |(rest, vibration): (&StaticInterval, Vector3<f64>)| {
        let mut known = Kinematics {
            time: 0.5 * (rest.span.from + rest.span.to) - start,
            vibration,
            ..unneeded()
        };
        known.temperature = rest.temperature.unwrap_or(known.temperature);
        KnownRest {
            span: rest.span,
            known,
        }
    };
    let mut rests: Vec<KnownRest> = statics.iter().zip(shaking).map(known).collect();
    let Some(sensing) = sensing else { return rests };
    for _ in 0..ROUNDS {
        let mut last = Vector3::zeros();
        for (own, rest) in rests.iter_mut().zip(statics) {
            if let Some(mean) = rest.accelerometer {
                last = sensing.correct(&sensing.unit.to_si(&mean.mean), &own.known);
            }
            own.known.specific_force = last;
        }
        let forces: Vec<Vector3<f64>> = rests.iter().map(|r| r.known.specific_force).collect();
        let mut settled = true;
        for (own, sign) in rests.iter_mut().zip(last_changes(&forces)) {
            settled &= own.known.last_change == sign;
            own.known.last_change = sign;
        }
        if settled {
            break;
        }
    }
    rests
}

/// The static interval that `t` lies in, or the last one before it.
pub(super) fn last_before(rests: &[KnownRest], t: f64) -> Option<&KnownRest> {
    let after = rests.partition_point(|rest| rest.span.from <= t);
    rests.get(after.checked_sub(1)?)
}

/// Mean square of the vibration in every interval, (m/s²)²: zero where there are no samples.
fn shaking(
    moments: impl Iterator<Item = Option<Moments>>,
    sensing: Option<&Sensing>,
) -> Vec<Vector3<f64>> {
    let variance = |m: Option<Moments>| {
        sensing
            .zip(m)
            .map(|(s, m)| s.spread(&m.covariance))
            .unwrap_or_else(|| Vector3::repeat(f64::INFINITY))
    };
    let variances: Vec<Vector3<f64>> = moments.map(variance).collect();
    let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
    vibrations(&variances)
        .into_iter()
        .map(|v| v.map(finite))
        .collect()
}
