//! Remarks on a fitted outcome: what changes part of the way through a recording.

use findings::Findings;
use recording::Recording;

use super::outcome::Outcome;
use super::{changes_part_way, checks};

/// The outcome with a warning for everything that changes part of the way through a recording.
pub(super) fn with_changes(
    mut outcome: Outcome,
    recordings: &[&Recording],
    gravity: f64,
) -> Outcome {
    let triad = outcome.calibration.gyroscope.as_ref();
    let gyroscope = triad.map(|triad| (triad.base().t, triad.residual_rms.to_radians()));
    let mut warnings = Findings::new();
    for (recording, choice) in recordings.iter().zip(&outcome.choices) {
        let cut = &choice.segmentation;
        warnings.extend(checks::corrected_before(recording, cut));
        warnings.extend(gyroscope.and_then(|(t, _)| checks::too_fast(recording, cut, &t)));
        warnings.extend(changes_part_way(recording, cut, gravity, gyroscope));
    }
    outcome.calibration.warnings.extend(warnings);
    outcome
}
