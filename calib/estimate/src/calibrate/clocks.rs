//! Doubts about the clocks of the recordings, and recordings on an even clock.

use findings::{Finding, Findings, Kind};
use recording::{
    ClockDrift, Recording, Stamps, Stream, bursts, clock_drift, clock_offset, even_clock,
};

use sensor::Sensor;

use crate::methods::joint::{ClockState, JointFit};

/// Turns that miss by so much, as `χ²` per degree of freedom, with any clock: samples are not when any stamp says.
const WITH_ANY: f64 = 60.0;

/// Clocks farther apart than this are not asked for a drift, s.
const FAR_APART: f64 = 9.0;

/// Warnings about clocks that no choice makes right.
pub(super) fn doubts(fit: &JointFit) -> Vec<Finding> {
    let mut doubts = Vec::new();
    for source in &fit.data.sources {
        let clock = &source.clock;
        if clock.state == ClockState::Uncountable {
            doubts.push(
                Finding::of(Kind::ClockUncountable)
                    .in_recording(&source.name)
                    .of_sensor(Sensor::Gyroscope)
                    .number("scatter", clock.scatter, "s")
                    .number("step", clock.step, "s"),
            );
        }
        let scatters = clock.scatter > 0.0 && clock.state != ClockState::Uncountable;
        if let Some(misfit) = clock.misfit.filter(|m| scatters && *m > WITH_ANY) {
            doubts.push(
                Finding::of(Kind::ClockUnknown)
                    .in_recording(&source.name)
                    .of_sensor(Sensor::Gyroscope)
                    .number("ratio", misfit.sqrt(), "1"),
            );
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
            (Sensor::Accelerometer, &mut own.accelerometer),
            (Sensor::Gyroscope, &mut own.gyroscope),
        ];
        for (sensor, stream) in sensors {
            let Some(stream) = stream else { continue };
            let Some(found) = bursts(&stream.t) else {
                continue;
            };
            let bursts = Finding::of(Kind::StampsInBursts)
                .in_recording(&recording.name)
                .of_sensor(sensor)
                .number("size", found.size, "1")
                .number("rate", 1.0 / found.step, "Hz");
            warnings.push(match found.lost {
                0 => bursts,
                lost => bursts.number("lost", lost as f64, "count"),
            });
            stream.t = found.even;
        }
        all.push(own);
    }
    (!warnings.is_empty()).then_some((all, warnings))
}

/// Sensors whose clocks are apart: offsets first, then drifts.
pub(super) fn apart(recordings: &[&Recording]) -> Vec<Finding> {
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

/// One clock that is late, perhaps by another offset.
fn late(recording: &str, (offset, other): (f64, Option<f64>)) -> Finding {
    let (late, early) = if offset > 0.0 {
        (Sensor::Gyroscope, Sensor::Accelerometer)
    } else {
        (Sensor::Accelerometer, Sensor::Gyroscope)
    };
    let found = Finding::of(Kind::ClockOffset)
        .in_recording(recording)
        .of_sensor(late)
        .detail("other", early.name())
        .number("late", offset.abs(), "s")
        // While the device turns at 1 rad/s.
        .affects("turn", offset.abs(), "rad");
    match other {
        Some(other) => found.number("also", other, "s"),
        None => found,
    }
}

/// One clock that runs faster than the other.
fn running(recording: &str, drift: ClockDrift) -> Finding {
    let is_faster = drift.value > 0.0;
    Finding::of(Kind::ClockDrift)
        .in_recording(recording)
        .of_sensor(Sensor::Gyroscope)
        .number("drift", 1e6 * drift.value.abs(), "1")
        .number("error", 1e6 * drift.error, "1")
        .detail("which", if is_faster { "faster" } else { "slower" })
        .count("turns", drift.turns)
}
