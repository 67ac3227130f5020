//! What the clocks of the recordings leave in doubt, and recordings on an even clock.

use findings::Findings;
use recording::{
    ClockDrift, Recording, Stamps, Stream, bursts, clock_drift, clock_offset, even_clock,
    significant,
};

use crate::methods::joint::{ClockState, JointFit};

/// Turns that miss by so much, as `χ²` per degree of freedom, with any clock: samples are not when any stamp says.
const WITH_ANY: f64 = 60.0;

/// Clocks farther apart than this are not asked for a drift, s.
const FAR_APART: f64 = 9.0;

/// Warnings about clocks that no choice makes right.
pub(super) fn doubts(fit: &JointFit) -> Vec<String> {
    let mut doubts = Vec::new();
    for source in &fit.data.sources {
        let clock = &source.clock;
        if clock.state == ClockState::Uncountable {
            doubts.push(format!(
                "{}: the stamps of the gyroscope scatter by {:.1} ms about steps of {:.1} ms: lost samples cannot be \
                 told from late ones, and the stamps are taken as they are. Record with the sensor's own stamps, or take the rows \
                 as evenly spaced: --rate {}",
                source.name,
                1e3 * clock.scatter,
                1e3 * clock.step,
                significant(1.0 / clock.step, 6)
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
pub(super) fn on_even_clocks(recordings: &[&Recording]) -> Vec<Recording> {
    let evened = |recording: &&Recording| {
        let mut recording = (*recording).clone();
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

/// The recordings with even clocks where their stamps come in bursts, and what is said of it; `None` where none do.
pub(crate) fn without_bursts(recordings: &[&Recording]) -> Option<(Vec<Recording>, Findings)> {
    let in_bursts = |recording: &&Recording| {
        let streams = [&recording.accelerometer, &recording.gyroscope];
        streams
            .into_iter()
            .flatten()
            .any(|stream| bursts(&stream.t).is_some())
    };
    if !recordings.iter().any(in_bursts) {
        return None;
    }
    let mut warnings = Findings::new();
    let mut all = Vec::with_capacity(recordings.len());
    for recording in recordings {
        let mut own = (*recording).clone();
        let sensors = [
            ("accelerometer", &mut own.accelerometer),
            ("gyroscope", &mut own.gyroscope),
        ];
        for (sensor, stream) in sensors {
            let Some(stream) = stream else { continue };
            let Some(found) = bursts(&stream.t) else {
                continue;
            };
            warnings.push(format!(
                "{}: the stamps of the {sensor} come in bursts of {} samples: they say when the samples were read, not \
                 when they were taken. An even clock through all of them is used instead, {} Hz{}; record with the sensor's own \
                 stamps",
                recording.name,
                significant(found.size, 2),
                significant(1.0 / found.step, 6),
                match found.lost {
                    0 => String::new(),
                    lost => format!(" with {lost} samples missing"),
                }
            ));
            stream.t = found.even;
        }
        all.push(own);
    }
    (!warnings.is_empty()).then_some((all, warnings))
}

/// Sensors whose clocks are apart: offsets first, then drifts.
pub(super) fn apart(recordings: &[&Recording]) -> Vec<String> {
    let (mut offsets, mut drifts) = (Vec::new(), Vec::new());
    for recording in recordings {
        let sensors = recording.accelerometer.as_ref();
        let Some((force, rate)) = sensors.zip(recording.gyroscope.as_ref()) else {
            continue;
        };
        let offset = clock_offset(force, rate);
        offsets.extend(offset.map(|found| late(&recording.name, found)));
        // The two halves are compared within ten seconds: farther apart they meet another turn.
        if offset.is_none_or(|(offset, _)| offset.abs() <= FAR_APART) {
            drifts.extend(clock_drift(force, rate).map(|drift| running(&recording.name, drift)));
        }
    }
    offsets.append(&mut drifts);
    offsets
}

/// That one clock is late, and perhaps by another offset.
fn late(recording: &str, (offset, other): (f64, Option<f64>)) -> String {
    let shift = match other {
        Some(other) => format!(
            "an offset of {other:.1} s fits about as well: record both by one clock, or turn at uneven intervals"
        ),
        None => "shift its stamps by that".into(),
    };
    let (late, early) = if offset > 0.0 {
        ("gyroscope", "accelerometer")
    } else {
        ("accelerometer", "gyroscope")
    };
    format!(
        "{recording}: the clock of the {late} is {:.1} s late against that of the {early}, by when they move: static intervals \
         of both do not fall together; {shift}",
        offset.abs()
    )
}

/// That one clock runs faster than the other.
fn running(recording: &str, drift: ClockDrift) -> String {
    format!(
        "{recording}: the clock of the gyroscope runs {:.0} ± {:.0} ppm {} than that of the accelerometer, by {} turns: one of \
         the two is wrong by that, and the gyroscope's scale factors with it if it is its own. Say the rate by \
         --rate, or stamp both by one clock",
        1e6 * drift.value.abs(),
        1e6 * drift.error,
        if drift.value > 0.0 {
            "faster"
        } else {
            "slower"
        },
        drift.turns
    )
}
