//! What turns miss because the rate jumps between samples.

use super::integrity::{Integrity, Size};
use crate::state::State;

/// What helps where samples miss something between them.
const SLOWER_OR_FASTER: &str = "place the device gently, sample faster, or filter before sampling";

/// Turns shown of a recording that is sampled too slowly for its shocks.
const SHOWN: usize = 6;

/// Recordings whose rate jumps between samples, where that explains what the turns miss better than a scatter that
/// is the same for all.
pub fn undersampled(state: &State) -> Vec<Integrity> {
    let evident = state
        .fit
        .undersampled()
        .into_iter()
        .filter(|u| u.is_evident);
    let found = evident.filter_map(|found| {
        let turns: Vec<String> = found
            .turns
            .iter()
            .take(SHOWN)
            .map(|(turn, _, angle)| format!("{} ({:.2}°)", turn + 1, angle.to_degrees()))
            .collect();
        let spans = found.turns.iter().map(|(_, span, _)| *span);
        let first = spans.clone().min_by(|a, b| a.from.total_cmp(&b.from))?;
        let last = spans.max_by(|a, b| a.to.total_cmp(&b.to))?;
        let [low, high] = found.share.between;
        Some(Integrity {
            name: "undersampled_motion",
            remedy: Some(SLOWER_OR_FASTER),
            recording: state.fit.data.sources[found.recording].name.clone(),
            interval: None,
            t0: first.from,
            t1: last.to,
            indistinguishable_from: Vec::new(),
            size: Some(Size {
                value: found.rms,
                unit: "rad",
                gap: Some(over_the_readings(state, found.recording)),
            }),
            detail: format!(
                "the rate jumps between samples and {:.2} ({low:.2} to {high:.2}) of each jump is missing in the \
                 angle: {:.2}° rms per turn, most in turns {}",
                found.share.value,
                found.rms.to_degrees(),
                turns.join(", ")
            ),
        })
    });
    found.collect()
}

/// How many times what the noise of the readings makes of the turns of a recording they are expected to miss, with what is
/// missing between samples.
fn over_the_readings(state: &State, recording: usize) -> f64 {
    let fit = &state.fit;
    let noise = fit.rows().noise(fit.parameters.values());
    let share = fit.data.sources[recording].clock.sampling.value;
    let (mut whole, mut of_readings) = (0.0, 0.0);
    for (k, turn) in fit.data.turns.iter().enumerate() {
        if turn.recording == recording {
            let row = fit.first_rows[1] + 2 * k;
            let all = noise.variance[row] + noise.variance[row + 1];
            whole += all;
            of_readings += all - share * share * noise.by_share[k].trace();
        }
    }
    (whole / of_readings).sqrt()
}
