//! Doubts about the clocks of the recordings, and recordings on an even clock.

use std::borrow::Cow;

use findings::{Finding, Findings, Kind, Level, OptionName, Remedy, significant};
use recording::{
    ClockDrift, Recording, Stamps, Stream, bursts, clock_drift, clock_offset, even_clock,
};

use sensor::Sensor;

use crate::methods::joint::{Channel, ClockState, JointFit};

findings::tuning! {
    /// Turns that miss by so much, as `χ²` per degree of freedom, with any clock: samples are not when any stamp says.
    WITH_ANY: f64 = 60.0;

    /// Clocks farther apart than this are not asked for a drift, s.
    FAR_APART: f64 = 9.0;

    /// A clock that runs faster by more than this forbids the use of the gyroscope: half a degree in a turn by 90°.
    RUNS_AWAY: f64 = 5e-3;
}

/// Warnings about clocks that no choice makes right.
pub(in crate::calibrate) fn doubts(fit: &JointFit) -> Vec<Finding> {
    let mut doubts = Vec::new();
    // A single turn that misses is no clock's: beside it the others fit.
    let left = fit.reduced_chi2(Channel::Direction).unwrap_or(0.0);
    for source in &fit.data.sources {
        let clock = &source.clock;
        if clock.state == ClockState::Uncountable {
            // Right where no sample is lost.
            let rate = significant(1.0 / clock.step, 6);
            doubts.push(
                Finding::of(Kind::CLOCK_UNCOUNTABLE)
                    .in_recording(&source.name)
                    .of_sensor(Sensor::Gyroscope)
                    .number("scatter", clock.scatter, "s")
                    .number("step", clock.step, "s")
                    .only_remedies([Remedy::SensorStamps, Remedy::set_to(OptionName::Rate, rate)]),
            );
        }
        let scatters = clock.scatter > 0.0 && clock.state != ClockState::Uncountable;
        if let Some(misfit) = clock
            .misfit
            .filter(|m| scatters && m.min(left) > WITH_ANY.get())
        {
            doubts.push(
                Finding::of(Kind::CLOCK_UNKNOWN)
                    .in_recording(&source.name)
                    .of_sensor(Sensor::Gyroscope)
                    .number("ratio", misfit.sqrt(), "1"),
            );
        }
    }
    doubts
}

/// The recording with the gyroscope's stamps of an even clock; `None` where its stamps do not scatter about one.
pub(in crate::calibrate) fn on_even_clocks(recording: &Recording) -> Option<Recording> {
    let stream = recording.gyroscope.as_ref()?;
    let Stamps::Scattered(clock) = even_clock(&stream.t) else {
        return None;
    };
    let gyroscope = Stream {
        t: clock.even,
        ..stream.clone()
    };
    Some(Recording {
        gyroscope: Some(gyroscope),
        ..recording.clone()
    })
}

/// The recording with even clocks where its stamps come in bursts, and the findings about them; `None` where none do.
pub(in crate::calibrate) fn without_bursts(recording: &Recording) -> Option<(Recording, Findings)> {
    let mut evened = Cow::Borrowed(recording);
    let mut found = Findings::new();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let Some(bursts) = recording
            .stream(sensor)
            .and_then(|stream| bursts(&stream.t))
        else {
            continue;
        };
        let finding = Finding::of(Kind::STAMPS_IN_BURSTS)
            .in_recording(&recording.name)
            .of_sensor(sensor)
            .number("size", bursts.size, "1")
            .number("rate", 1.0 / bursts.step, "Hz");
        found.push(match bursts.lost {
            0 => finding,
            lost => finding.number("lost", lost as f64, "count"),
        });
        if let Some(stream) = evened.to_mut().stream_mut(sensor) {
            stream.t = bursts.even;
        }
    }
    (!found.is_empty()).then(|| (evened.into_owned(), found))
}

/// Sensors whose clocks are apart: offsets first, then drifts.
pub fn clocks_apart(recordings: &[&Recording]) -> Vec<Finding> {
    let (mut offsets, mut drifts) = (Vec::new(), Vec::new());
    for recording in recordings {
        let Some((force, rate)) = both(recording) else {
            continue;
        };
        let offset = clock_offset(force, rate);
        // The two halves are compared within ten seconds: farther apart they meet another turn.
        let may_drift = offset.is_none_or(|(offset, _)| offset.abs() <= FAR_APART.get());
        let drift = may_drift.then(|| clock_drift(force, rate)).flatten();
        // No offset holds for the whole recording where a clock runs so much faster.
        if drift.is_none_or(|drift| drift.value.abs() <= RUNS_AWAY.get()) {
            offsets.extend(offset.map(|found| late(&recording.name, found)));
        }
        drifts.extend(drift.map(|drift| running(&recording.name, drift)));
    }
    offsets.append(&mut drifts);
    offsets
}

/// Accelerometer and gyroscope of a recording that has them.
fn both(recording: &Recording) -> Option<(&Stream, &Stream)> {
    let force = recording.accelerometer.as_ref();
    force.zip(recording.gyroscope.as_ref())
}

/// One clock that is late, perhaps by another offset.
fn late(recording: &str, (offset, other): (f64, Option<f64>)) -> Finding {
    let (late, early) = if offset > 0.0 {
        (Sensor::Gyroscope, Sensor::Accelerometer)
    } else {
        (Sensor::Accelerometer, Sensor::Gyroscope)
    };
    let found = Finding::of(Kind::CLOCK_OFFSET)
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
    let runs_away = drift.value.abs() > RUNS_AWAY.get();
    let found = Finding::of(Kind::CLOCK_DRIFT)
        .in_recording(recording)
        .of_sensor(Sensor::Gyroscope)
        .number("drift", 1e6 * drift.value.abs(), "1")
        .number("error", 1e6 * drift.error, "1")
        .detail("which", if is_faster { "faster" } else { "slower" })
        .count("turns", drift.turns);
    match runs_away {
        true => found.at_level(Level::Bad),
        false => found,
    }
}
