//! Faults of a recording that the final fit shows: disturbances, and turns whose rate jumps between samples.

use ::findings::{Finding, Kind};
use estimate::methods::joint::{Flagged, OUTLYING_TURN, Reason, Scope};

use super::integrity::{Integrity, Size};
use crate::search::Either;
use crate::state::State;

findings::tuning! {
    /// Turns shown of a recording that is sampled too slowly for its shocks.
    SHOWN: usize = 6;
}

/// Builds the faults from the disturbances that a fit flagged. A turn counts as lost samples where `seen`, the faults in
/// the readings themselves, has lost samples at that time; `either` has the alternatives to each disturbance.
pub fn disturbed(state: &State, seen: &[Integrity], either: &[Either]) -> Vec<Integrity> {
    let sizes = state.disturbed_sizes();
    let found = state.fit.flagged.iter().zip(sizes);
    // A rate that is off in an interval is off up to the turns beside it, which see it as a creep.
    let is_excursion = |of: &Flagged| {
        let all = state.fit.flagged.iter();
        let mut excursions = all.filter(|a| a.fault.kind == Kind::RATE_EXCURSION);
        excursions.any(|a| (a.recording, a.interval) == (of.recording, of.interval))
    };
    found
        // An interval within which a bias stepped is no fault of the recording.
        .filter(|(flagged, _)| flagged.reason == Reason::Disturbed)
        .filter(|(flagged, _)| flagged.fault.kind != Kind::CREEP || !is_excursion(flagged))
        .map(|(flagged, (known, size))| {
            let or = either.iter().find(|either| either.known == known);
            let recording = &state.fit.data.sources[flagged.recording].name;
            let lost = seen.iter().any(|fault| {
                fault.name == "lost_samples"
                    && fault.recording == *recording
                    && fault.t0 < flagged.span.to
                    && fault.t1 > flagged.span.from
            });
            let fault = flagged.fault;
            let (size, unit) = (fault.size(size, flagged.span), fault.unit);
            let is_of_a_turn = fault.scope == Scope::Turn;
            let (name, kind) = match fault == &OUTLYING_TURN && lost {
                true => ("lost_samples", Kind::TURN_WITHOUT_SAMPLES),
                false => (fault.name, fault.kind),
            };
            let found = Finding::of(kind)
                .in_recording(recording)
                .between(flagged.span.from, flagged.span.to)
                .number("size", size, unit)
                .affects("corrected_reading", size, unit);
            let found = match is_of_a_turn {
                true => found.at_turn(flagged.interval),
                false => found.at_interval(flagged.interval),
            };
            Integrity {
                interval: Some(flagged.interval + 1),
                indistinguishable_from: or.map_or_else(Vec::new, |either| either.or.clone()),
                size: Size::at_one_place(size, unit),
                ..Integrity::of(name, recording, found)
            }
        })
        .collect()
}

/// Recordings whose rate jumps between samples, where that explains what the turns miss better than a scatter that
/// is the same for all.
pub fn undersampled(state: &State) -> Vec<Integrity> {
    let evident = state
        .fit
        .undersampled()
        .into_iter()
        .filter(|u| u.is_evident);
    let found = evident.filter_map(|found| {
        let left = TurnMisses::of(state, found.recording);
        let turns: Vec<String> = found
            .turns
            .iter()
            .take(SHOWN.get())
            .map(|(turn, _, _)| format!("{}{}", turn + 1, left.of_turn(*turn)))
            .collect();
        let spans = found.turns.iter().map(|(_, span, _)| *span);
        let first = spans.clone().min_by(|a, b| a.from.total_cmp(&b.from))?;
        let last = spans.max_by(|a, b| a.to.total_cmp(&b.to))?;
        let [low, high] = found.share.between;
        let recording = &state.fit.data.sources[found.recording].name;
        let finding = Finding::of(Kind::UNDERSAMPLED_MOTION)
            .in_recording(recording)
            .between(first.from, last.to)
            .number("share", found.share.value, "share")
            .number("low", low, "share")
            .number("high", high, "share")
            .number("angle", left.rms(), "rad")
            .detail("turns", turns.join(", "))
            .affects("turn", left.rms(), "rad");
        Some(Integrity {
            size: Some(Size {
                value: left.rms(),
                unit: "rad",
                gap: Some(left.over_the_readings(state)),
            }),
            ..Integrity::of("undersampled_motion", recording, finding)
        })
    });
    found.collect()
}

/// Errors of gravity's direction after the turns of one recording.
struct TurnMisses {
    recording: usize,
    /// Place of each turn in the recording's segmentation, and the angle, rad.
    angles: Vec<(usize, f64)>,
}

impl TurnMisses {
    fn of(state: &State, recording: usize) -> Self {
        let turns = state.fit.data.turns.iter().zip(&state.fit.chords);
        let own = turns.filter(|(turn, _)| turn.recording == recording);
        Self {
            recording,
            angles: own.map(|(turn, chord)| (turn.turn, *chord)).collect(),
        }
    }

    fn square(&self) -> f64 {
        self.angles.iter().map(|(_, angle)| angle * angle).sum()
    }

    /// Root mean square over the turns, rad.
    fn rms(&self) -> f64 {
        (self.square() / self.angles.len().max(1) as f64).sqrt()
    }

    /// ` (0.41°)` of one turn.
    fn of_turn(&self, turn: usize) -> String {
        let own = self.angles.iter().find(|(place, _)| *place == turn);
        own.map_or_else(String::new, |(_, angle)| {
            format!(" ({:.2}°)", angle.to_degrees())
        })
    }

    /// Returns the ratio of their root mean square to that predicted from the noise of the readings.
    fn over_the_readings(&self, state: &State) -> f64 {
        let fit = &state.fit;
        let noise = fit.rows().noise(fit.parameters.values());
        let share = fit.data.sources[self.recording].clock.sampling.value;
        let of_readings: f64 = fit
            .data
            .turns
            .iter()
            .enumerate()
            .filter(|(_, turn)| turn.recording == self.recording)
            .map(|(k, _)| {
                let row = fit.first_rows[1] + 2 * k;
                let all = noise.variance[row] + noise.variance[row + 1];
                all - share * share * noise.by_share[k].trace()
            })
            .sum();
        (self.square() / of_readings).sqrt()
    }
}
