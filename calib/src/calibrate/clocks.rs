//! What the clocks of the recordings leave in doubt, and recordings on an even clock.

use crate::methods::joint::{ClockState, JointFit};
use crate::recording::{Recording, Stamps, Stream, even_clock};

/// Turns that miss by so much, as `χ²` per degree of freedom, with any clock: samples are not when any stamp says.
const WITH_ANY: f64 = 60.0;

/// Warnings about clocks that no choice makes right.
pub(super) fn doubts(fit: &JointFit) -> Vec<String> {
    let mut doubts = Vec::new();
    for source in &fit.data.sources {
        let clock = &source.clock;
        if clock.state == ClockState::Uncountable {
            doubts.push(format!(
                "{}: the stamps of the gyroscope scatter by {:.1} ms about steps of {:.1} ms: lost samples cannot be \
                 told from late ones, and the stamps are taken as they are. Record with the sensor's own stamps",
                source.name,
                1e3 * clock.scatter,
                1e3 * clock.step
            ));
        }
        let scatters = clock.scatter > 0.0 && clock.state != ClockState::Uncountable;
        if let Some(misfit) = clock.misfit.filter(|m| scatters && *m > WITH_ANY) {
            doubts.push(format!(
                "{}: the turns miss gravity by {:.0} times their noise with the even clock and with the stamps: \
                 neither may say when the gyroscope was sampled (a sensor that is polled at another rate than its \
                 own). Record with the sensor's own stamps",
                source.name,
                misfit.sqrt()
            ));
        }
    }
    doubts
}

/// The recordings with the gyroscope's stamps of an even clock, where theirs scatter about one.
pub(super) fn on_even_clocks(recordings: &[Recording]) -> Vec<Recording> {
    let evened = |recording: &Recording| {
        let mut recording = recording.clone();
        recording.gyroscope =
            recording
                .gyroscope
                .take()
                .map(|stream| match even_clock(&stream.t) {
                    Stamps::Scattered(clock) => Stream {
                        t: clock.even,
                        ..stream
                    },
                    _ => stream,
                });
        recording
    };
    recordings.iter().map(evened).collect()
}
