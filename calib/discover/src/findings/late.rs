//! Late stamps, which the moving accelerometer shows, as findings.

use ::findings::{Finding, Kind};
use estimate::calibration::Calibration;
use recording::Error;
use recording::intervals::Span;
use sensor::{EffectRef, Model, Nature, Sensor};

use super::EffectFinding;
use super::named::parameters_of;
use crate::family::is_late;
use crate::fault::delay::{Delay, delay, delays};
use crate::fault::integrity::{Integrity, Size};
use crate::gap::channel::Channel;
use crate::request::Session;
use crate::score::log_tail;
use crate::search::Search;
use crate::state::State;

findings::tuning! {
    /// Stamps are late beyond what delays of the gyroscope do if by more standard errors than this.
    MUCH_LATER: f64 = 3.0;

    /// Stamps are late by more than this share of a sample's step: to the square of the step, differences of samples and means over windows are
    /// not the motion at an instant.
    OF_A_STEP: f64 = 0.05;

    /// The chance that stamps which are late by the same in all recordings are said to be late by different times.
    LATE_APART: f64 = 1e-3;
}

/// Stamps that are late.
#[derive(Default)]
pub struct LateStamps {
    /// By the same in all recordings.
    together: Option<(EffectRef, Delay)>,
    /// In each recording by its own, as their clocks were started apart: no error of the sensor.
    pub apart: Vec<Integrity>,
}

impl LateStamps {
    /// Those of the final model, which holds what is late by the same afterwards.
    ///
    /// # Errors
    /// As the joint fit.
    pub fn of(session: &Session<'_>, search: &mut Search) -> Result<Self, Error> {
        let apart = late_apart(&search.last, session);
        if !apart.is_empty() {
            let together = None;
            return Ok(Self { together, apart });
        }
        let together = late(&search.last, session);
        if let Some((effect, late)) = &together {
            let mut extension = search.last.extension.clone();
            let own = (effect.clone(), Some((0, late.delay)));
            extension.effects.push(own);
            search.last = search.fit(session, extension)?;
        }
        Ok(Self { together, apart })
    }

    /// The finding of what is late by the same, with its standard error in the calibration too; the delay that `last` leaves is its gap
    /// after.
    pub fn finding(
        &self,
        session: &Session<'_>,
        last: &State,
        calibration: &mut Calibration,
    ) -> Option<EffectFinding> {
        let (effect, found) = self.together.as_ref()?;
        let name = effect.name();
        for effect in calibration.effects.iter_mut().filter(|e| e.name == name) {
            for p in &mut effect.parameters {
                p.std = Some(found.std);
            }
        }
        Some(EffectFinding {
            name: name.into(),
            statistic: found.statistic,
            dof: 1.0,
            p_value: found.log_p.exp(),
            adjusted_p_value: (-late_evidence(found, session.candidates.len()))
                .exp()
                .min(1.0),
            forms: Vec::new(),
            indistinguishable_from: Vec::new(),
            shared: Vec::new(),
            rivals: Vec::new(),
            may_be_beside: Vec::new(),
            told_apart_by: None,
            parameters: parameters_of(name, calibration),
            channel: Channel::MovingForce,
            gap_before: found.gap_before,
            gap_by_chance: None,
            rms_before: None,
            rms_after: None,
            gap_after: delay(last).map_or(found.gap_before, |again| again.gap_before),
            held_out_gap_before: found.held_out_gap_before,
            held_out_gap_after: found.held_out_gap_after,
        })
    }
}

/// The effect of late stamps, where the moving accelerometer shows it.
fn late(state: &State, session: &Session<'_>) -> Option<(EffectRef, Delay)> {
    let candidates = &session.candidates;
    let effect = candidates.iter().find(|e| is_late(e))?;
    let found = delay(state)?;
    // What delays the gyroscope's axes delays them against the accelerometer too.
    let of_gyroscope = 2.0 * gyroscope_delay(state) + MUCH_LATER.get() * found.std;
    if found.delay.abs() <= of_gyroscope.max(least(session)) {
        return None;
    }
    (late_evidence(&found, candidates.len()) > session.request.threshold())
        .then_some((effect.clone(), found))
}

/// Recordings whose stamps are late each in their own way.
fn late_apart(state: &State, session: &Session<'_>) -> Vec<Integrity> {
    let (all, candidates) = (delays(state), &session.candidates);
    let effect = candidates.iter().find(|e| is_late(e));
    let Some(effect) = effect.filter(|_| differ(&all, LATE_APART.get())) else {
        return Vec::new();
    };
    let needed = session.request.threshold() + (all.len() as f64).ln();
    let least = least(session);
    let late = all
        .iter()
        .filter(|(_, own)| own.delay.abs() > least)
        .filter(|(_, own)| late_evidence(own, candidates.len()) > needed);
    let fault = |(recording, own): &(usize, Delay)| {
        let data = &state.fit.data;
        let rests = data.rests.iter().filter(|r| r.recording == *recording);
        let spans = rests.map(|rest| rest.span);
        let span = spans.reduce(|a, b| Span {
            from: a.from.min(b.from),
            to: a.to.max(b.to),
        })?;
        let way = if own.delay < 0.0 { "early" } else { "late" };
        let recording = &data.sources[*recording].name;
        let finding = Finding::of(Kind::STAMPS_APART)
            .in_recording(recording)
            .number("size", own.delay.abs(), "s")
            .number("error", own.std, "s")
            .detail("way", way);
        Some(Integrity {
            t0: span.from,
            t1: span.to,
            size: Size::at_one_place(own.delay.abs(), "s"),
            ..Integrity::of(effect.name().to_owned(), recording, finding)
        })
    };
    late.filter_map(fault).collect()
}

/// The least delay that samples can show, s.
fn least(session: &Session<'_>) -> f64 {
    let ready = session.ready().into_iter();
    let streams = ready.flat_map(|own| own.accelerometer.iter().chain(&own.gyroscope));
    let steps = streams.filter_map(|own| own.median_step());
    OF_A_STEP.get() * steps.fold(0.0, f64::max)
}

/// Returns true if the time offsets of the recordings differ significantly at level `alpha`.
fn differ(all: &[(usize, Delay)], alpha: f64) -> bool {
    let weight = |own: &Delay| own.std.powi(-2);
    let whole: f64 = all.iter().map(|(_, own)| weight(own)).sum();
    let mean: f64 = all
        .iter()
        .map(|(_, own)| weight(own) * own.delay)
        .sum::<f64>()
        / whole;
    let apart = all
        .iter()
        .map(|(_, own)| weight(own) * (own.delay - mean).powi(2));
    let dof = all.len().saturating_sub(1) as f64;
    log_tail(apart.sum(), dof) < alpha.ln()
}

/// The longest delay of an axis of the gyroscope against another in the model, s.
fn gyroscope_delay(state: &State) -> f64 {
    let effects = state.fit.models.iter().flat_map(Model::effects);
    let delays: Vec<_> = effects
        .filter(|e| e.nature() == Nature::Delay && e.sensor() == Sensor::Gyroscope)
        .collect();
    let fitted = &state.fit.parameters;
    let named = fitted.names().iter().zip(fitted.values());
    let is_of = |name: &str, effect: &str| name.split_once('.').is_some_and(|n| n.0 == effect);
    let of_delay = named.filter(|(name, _)| delays.iter().any(|e| is_of(name, e.name())));
    of_delay.map(|(_, d)| d.abs()).fold(0.0, f64::max)
}

fn late_evidence(found: &Delay, candidates: usize) -> f64 {
    -found.log_p - (2.0 * candidates as f64).ln()
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::request::Request;
    use crate::state::Extension;

    fn is_found(late_by: f64) -> bool {
        let mut spec = Spec::hand_held(21);
        let given = std::collections::BTreeMap::from([("d".to_owned(), late_by)]);
        spec.effects.insert("time_offset".into(), given);
        let recordings = [spec.run().unwrap().recording];
        let session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        let base = State::fit(&session, Extension::default()).unwrap();
        late(&base, &session).is_some()
    }

    #[test]
    fn a_delay_of_a_hundredth_of_a_step_is_none() {
        assert!(is_found(8e-3) && !is_found(1e-4));
    }
}
