//! Flicker (1/f) noise of the biases, and what it explains as well as a name does.

use ::findings::Kind;
use recording::Error;

use super::request::Session;
use super::score::score;
use super::search::{Name, Search};
use super::state::State;

findings::tuning! {
    /// Axes that flicker at least where the biases do.
    FLICKERING: usize = 3;
    /// By how much each makes the data likelier at least (log). In eleven clean sessions with 1 mm/s² and 15 °/h of which a walk
    /// left something, the third axis gained 3.6 and more; in some thirty with a bias on one axis that flips or wanders, 2.9 and less.
    LIKELIER: f64 = 3.0;

    /// And by how much more (log) the shape of what remains has to make them likelier to be no flicker: it is the best of many. Of a
    /// clean session with flicker it was 5, of harmonics in the force on every axis 10.
    MUCH_LIKELIER: f64 = 9.0;

    /// Gain of the flicker of an axis (log) on average where there is none and its variance comes out above zero: ½ χ²₁.
    BY_CHANCE: f64 = 0.5;
}

/// Returns true if flicker (1/f) noise of the biases explains the data much better than the final model of a search does.
///
/// At least [`FLICKERING`] axes have to show it, as one axis alone has another cause, and it has to explain more than the
/// shape of the remainder does, where that has one: `by_shape` is what it gains (log), less one for each degree of freedom. It cannot be
/// decided where turns miss motion between the samples.
pub fn flickers(session: &Session<'_>, model: &State, by_shape: Option<f64>) -> bool {
    if !may_flicker(session, model) {
        return false;
    }
    let flicker = ByFlicker::of(model);
    let evident = flicker
        .by_axis
        .iter()
        .filter(|gain| **gain > LIKELIER.get());
    evident.count() >= FLICKERING.get()
        && by_shape.is_none_or(|shape| shape < flicker.whole + MUCH_LIKELIER.get())
}

/// Withdraws the effects and faults that a bias which flickers explains as well: whether there were any.
///
/// The evidence for a name is asked for once more where both hypotheses may have flicker of its sensor's bias. Its likelihood ratio is
/// then the larger of `s − 2 g` and `s′`: `s` that under walks alone, `g` the gain in log-likelihood by flicker without the name beyond
/// what chance gives, `s′` the score of the name under flicker.
pub fn without_flickering(session: &Session<'_>, search: &mut Search) -> Result<bool, Error> {
    if !may_flicker(session, &search.last) {
        return Ok(false);
    }
    let threshold = session.request.threshold();
    search.withdraw_where(session, |name| {
        !beside_flicker(name).is_none_or(|evidence| evidence > name.claim.needed(threshold))
    })
}

/// The evidence for a name where its sensor's bias may flicker with it and without it; `None` where that cannot be worked out.
fn beside_flicker(name: &Name) -> Option<f64> {
    let (without, sensor) = (&name.without, name.claim.sensor());
    let (projected, flickering) = without.flickering();
    let noise = without.noise.with_bias_of(sensor, &flickering);
    let at = projected.at(noise)?;
    let axes = noise.flicker_of(sensor).into_iter().filter(|b| *b > 0.0);
    let by_chance = BY_CHANCE.get() * axes.count() as f64;
    let walking = projected.at(without.noise)?.log_likelihood();
    let gain = (at.log_likelihood() - walking - by_chance).max(0.0);
    let columns = at.columns(&projected.columns(name.columns.as_ref()));
    let score = score(columns.as_ref(), &at.z);
    let own = &name.ranked;
    let lost = own.by_ratio() - own.evidence_at(own.statistic - 2.0 * gain);
    let flickering = own.evidence_at(score.statistic);
    Some(flickering.max(own.evidence - lost))
}

/// Returns true if the biases are taken to walk alone and the recordings can show that they flicker: of a device that turns at rest the
/// rate looks like such a bias.
fn may_flicker(session: &Session<'_>, model: &State) -> bool {
    let moves =
        model.fit.data.misses_something_between_samples() || session.remarks.has(Kind::RESTS_TURN);
    !(session.request.flicker || session.request.noise.is_some() || moves)
}

/// By how much the data are likelier (log) with biases that flicker.
struct ByFlicker {
    /// On all axes, less one for each that does (Akaike 1974).
    whole: f64,
    /// With the flicker of each axis than without it, the walk of that sensor as large as it is beside flicker, or as it is alone.
    by_axis: Vec<f64>,
}

impl ByFlicker {
    fn of(model: &State) -> Self {
        let (projected, flickering) = model.flickering();
        let at = |noise| {
            let whitened = projected.at(noise);
            whitened.map_or(f64::NEG_INFINITY, |w| w.log_likelihood())
        };
        let whole = at(flickering);
        let axes = (0..2).flat_map(|sensor| (0..3).map(move |axis| (sensor, axis)));
        let gain = axes.map(|(sensor, axis)| {
            let mut without = flickering;
            without.flicker[sensor][axis] = 0.0;
            let mut walks = without;
            walks.walk[sensor] = walks.walk[sensor].max(model.noise.walk[sensor]);
            whole - at(without).max(at(walks))
        });
        let count = flickering.flicker.iter().flatten();
        let count = count.filter(|b| **b > 0.0).count();
        Self {
            whole: whole - at(model.noise) - count as f64,
            by_axis: gain.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::rank::Ranked;
    use crate::request::Request;
    use crate::search::Ranking;
    use crate::state::Extension;

    /// The evidence for the first of a ranking at the base model, alone and beside flicker.
    fn evidence(spec: &Spec, claims: &str) -> [f64; 2] {
        let recordings = [spec.run().unwrap().recording];
        let request = Request::new(spec.gravity);
        let session = Session::new(&recordings, &request).unwrap();
        let base = State::fit(&session, Extension::default()).unwrap();
        let ranking = Ranking::of(&base, &request.candidates(), request.threshold());
        let own = |r: &&Ranked| ranking.families[r.family].claim.name().starts_with(claims);
        let ranked = ranking.ranked.iter().find(own).unwrap();
        let name = Name::of(&ranking.families, ranked, base, Vec::new());
        [ranked.evidence, beside_flicker(&name).unwrap()]
    }

    #[test]
    fn flicker_takes_the_evidence_for_what_it_may_be_and_none_of_a_drift() {
        let mut flickers = Spec::hand_held(48);
        flickers.accelerometer.instability = 1e-3;
        let [alone, beside] = evidence(&flickers, "accel_");
        assert!(alone > 0.0 && beside < alone - 2.0, "{alone} {beside}");
        let drifts = Spec::hand_held(41).with_effect("gyro_drift", 2.0);
        let [alone, beside] = evidence(&drifts, "gyro_drift");
        assert!(alone > 8.0 && beside > alone - 0.5, "{alone} {beside}");
    }
}
