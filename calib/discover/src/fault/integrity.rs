//! Faults of a recording that its readings show, without a model.

use std::borrow::Cow;

use ::findings::{Finding, Kind};
use estimate::calibrate::{clocks_apart, cut_towards_zero, is_read_otherwise};
use estimate::methods::joint::SensorNoise;
use recording::intervals::{Rails, Segmentation, Span};
use recording::readings::{Symptom, altered_bias};
use recording::{Recording, Stamps, Stream, even_clock};
use sensor::Sensor;
use serde::Serialize;

use super::part_way::read_otherwise;
use crate::request::Session;
use crate::state::State;

findings::tuning! {
    /// Samples at the end of the range that count as saturation.
    CLIPPED: usize = 5;

    /// A rest with this share of its samples at the end of the range is saturated, not quantised.
    MOST: f64 = 0.5;

    /// A least significant bit beyond this many standard deviations of the reading no longer averages out: the mean
    /// of a rest is then off by more than its noise.
    COARSE: f64 = 2.0;

    /// A clock whose steps hardly differ: 95 % within this share of the median.
    REGULAR: f64 = 0.2;
}

/// A fault of the recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Integrity {
    /// `saturation`, `quantisation`, `dead_zone`, `rezeroing`, `lost_samples`, `outlying_turn`, `undersampled_motion`, `mount_slip` or
    /// `disturbed_interval`, `scale_change`, `sign_change`, `columns_swap_part_way`, `clock_offset`, `clock_drift`, `cut_towards_zero`; `time_offset` where it is another in every recording.
    pub name: Cow<'static, str>,
    /// The recording.
    pub recording: String,
    /// The static interval, or the one before the turn, counted from 1; `None` of a whole recording.
    pub interval: Option<usize>,
    /// When, s.
    pub t0: f64,
    /// Until when, s.
    pub t1: f64,
    /// The finding; documents have its text as `detail`.
    #[serde(rename = "detail", serialize_with = "::findings::texts::what")]
    pub finding: Finding,
    /// Names of other faults that these recordings cannot tell from it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub indistinguishable_from: Vec<String>,
    /// Size of the fault, where it is measured: rad for a slip or a turn, or, root mean square over the turns, for
    /// undersampled motion; m/s² or rad/s for the offset of a static interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<Size>,
}

/// Size of a fault, with its unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Size {
    /// In SI units.
    pub value: f64,
    /// `rad`, `rad/s`, `m/s^2` or `s`.
    pub unit: &'static str,
    /// Ratio of the channel's misfit to the noise of the readings, where the fault is not modelled; `None` for a fault at
    /// one place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<f64>,
}

impl Size {
    pub(crate) fn at_one_place(value: f64, unit: &'static str) -> Option<Self> {
        Some(Self {
            value,
            unit,
            gap: None,
        })
    }
}

impl Integrity {
    /// A fault of a recording for as long as its finding says, at no single interval or turn.
    pub(crate) fn of(
        name: impl Into<Cow<'static, str>>,
        recording: &str,
        finding: Finding,
    ) -> Self {
        Self {
            name: name.into(),
            recording: recording.to_owned(),
            interval: None,
            t0: finding.place.t0.unwrap_or(0.0),
            t1: finding.place.t1.unwrap_or(0.0),
            finding,
            indistinguishable_from: Vec::new(),
            size: None,
        }
    }

    /// Returns true if nothing more is named beside it: what the readings are off by is no error of the sensor.
    pub(crate) fn spoils(&self) -> bool {
        matches!(
            self.finding.kind,
            Kind::QUANTISED
                | Kind::CUT_TOWARDS_ZERO
                | Kind::DEAD_ZONE
                | Kind::REZEROED
                | Kind::CLOCK_OFFSET
                | Kind::CLOCK_DRIFT
        ) || is_read_otherwise(&self.finding)
    }
}

/// Saturation, coarse steps, altered biases and lost samples of all recordings.
pub fn integrity(session: &Session<'_>, base: &State) -> Vec<Integrity> {
    let mut all: Vec<Integrity> = cut_off(session, base).into_iter().collect();
    for (number, (recording, choice)) in session.recordings.iter().enumerate() {
        let first = session.first_part_of(number);
        let Some(source) = first.and_then(|part| base.fit.data.sources.get(part)) else {
            continue;
        };
        let sensors = [
            (
                Sensor::Accelerometer,
                &recording.accelerometer,
                &source.accelerometer,
            ),
            (Sensor::Gyroscope, &recording.gyroscope, &source.gyroscope),
        ];
        let otherwise = read_otherwise(session, base, recording, &choice.segmentation).into_iter();
        all.extend(otherwise.map(|found| Integrity::of(found.kind.name(), &recording.name, found)));
        let apart = clocks_apart(&[recording]).into_iter();
        all.extend(apart.map(|found| Integrity::of(found.kind.name(), &recording.name, found)));
        let altered = altered_bias(recording, &choice.segmentation);
        for (sensor, stream, noise) in sensors {
            let Some(stream) = stream else { continue };
            let place = Looked {
                recording,
                segmentation: &choice.segmentation,
                sensor,
                stream,
            };
            let altered = altered.as_ref().filter(|_| sensor == Sensor::Gyroscope);
            let altered = altered.and_then(|symptom| place.altered_bias(symptom));
            // A dead zone is as wide as a step.
            let coarse = noise
                .as_ref()
                .filter(|_| altered.is_none())
                .and_then(|noise| place.quantisation(noise));
            all.extend(altered);
            // Coarse readings repeat at their extremes too.
            if coarse.is_none() {
                all.extend(place.saturation());
            }
            all.extend(coarse);
            for lost in place.lost_samples() {
                match all.iter_mut().find(|fault| is_lost_beside(fault, &lost)) {
                    Some(other) => lost_together(other, &lost),
                    None => all.push(lost),
                }
            }
        }
    }
    all
}

/// Readings of the accelerometer that are cut off towards zero: sizes, squares and cubes of force would make up for it.
fn cut_off(session: &Session<'_>, base: &State) -> Option<Integrity> {
    let found = cut_towards_zero(&base.fit, &session.recordings_of_parts())?;
    let recording = found.place.recording.clone().unwrap_or_default();
    Some(Integrity::of("cut_towards_zero", &recording, found))
}

/// Returns true if the other sensor loses its samples at the same time.
fn is_lost_beside(fault: &Integrity, lost: &Integrity) -> bool {
    fault.name == lost.name
        && fault.recording == lost.recording
        && fault.t0 < lost.t1
        && lost.t0 < fault.t1
}

/// One gap in both sensors.
fn lost_together(fault: &mut Integrity, other: &Integrity) {
    fault.t0 = fault.t0.min(other.t0);
    fault.t1 = fault.t1.max(other.t1);
    fault.finding = samples_missing("accelerometer and gyroscope", fault.t1 - fault.t0)
        .in_recording(&fault.recording)
        .between(fault.t0, fault.t1);
}

fn samples_missing(which: &str, length: f64) -> Finding {
    Finding::of(Kind::SAMPLES_MISSING)
        .detail("which", which)
        .number("length", length, "s")
}

/// One sensor of one recording.
struct Looked<'a> {
    recording: &'a Recording,
    segmentation: &'a Segmentation,
    sensor: Sensor,
    stream: &'a Stream,
}

impl Looked<'_> {
    fn found(
        &self,
        name: &'static str,
        interval: Option<usize>,
        span: Span,
        finding: Finding,
    ) -> Integrity {
        let recording = &self.recording.name;
        let finding = finding.in_recording(recording).between(span.from, span.to);
        Integrity {
            interval,
            ..Integrity::of(name, recording, finding)
        }
    }

    /// Turns and rests with readings at the end of the range.
    fn saturation(&self) -> Vec<Integrity> {
        let rails = Rails::of(&self.stream.values);
        let clipped = |span: Span| {
            let samples = &self.stream.values[self.stream.between(span.from, span.to)];
            (
                samples.iter().filter(|v| rails.reached(v)).count(),
                samples.len(),
            )
        };
        let turns = self.segmentation.turns.iter().filter_map(|turn| {
            let (count, _) = clipped(turn.span);
            (count >= CLIPPED.get()).then_some((turn.from, turn.span, count))
        });
        let rests = self
            .segmentation
            .statics
            .iter()
            .enumerate()
            .filter_map(|(k, rest)| {
                let (count, all) = clipped(rest.span);
                (count as f64 > MOST.get() * all as f64).then_some((k, rest.span, count))
            });
        turns
            .chain(rests)
            .map(|(k, span, count)| {
                let found = Finding::of(Kind::RANGE_REACHED)
                    .of_sensor(self.sensor)
                    .count("count", count);
                self.found("saturation", Some(k + 1), span, found)
            })
            .collect()
    }

    /// A bias that the device itself changes or hides.
    fn altered_bias(&self, symptom: &Symptom) -> Option<Integrity> {
        let name = match symptom {
            Symptom::DeadZone { .. } => "dead_zone",
            Symptom::Rezeroed { .. } => "rezeroing",
            _ => return None,
        };
        Some(self.found(name, None, self.whole(), symptom.into()))
    }

    /// Steps too wide for the noise to even out.
    fn quantisation(&self, noise: &SensorNoise) -> Option<Integrity> {
        let axis = (0..3).find(|&i| noise.step[i] > COARSE.get() * noise.white[i])?;
        let unit = self.sensor.unit();
        let error = noise.step[axis] / 12f64.sqrt();
        let found = Finding::of(Kind::QUANTISED)
            .of_sensor(self.sensor)
            .detail("axes", ["x", "y", "z"][axis])
            .number("step", noise.step[axis], unit)
            .number("noise", noise.white[axis], unit)
            .number("error", error, unit)
            .affects("corrected_reading", error, unit);
        Some(self.found("quantisation", None, self.whole(), found))
    }

    fn whole(&self) -> Span {
        let t = &self.stream.t;
        Span {
            from: t.first().copied().unwrap_or(0.0),
            to: t.last().copied().unwrap_or(0.0),
        }
    }

    /// Steps of a regular clock that leave samples out.
    fn lost_samples(&self) -> Vec<Integrity> {
        let gaps: Vec<Span> = match self.regular_step() {
            Some(step) => self
                .stream
                .t
                .windows(2)
                .filter(|pair| pair[1] - pair[0] > 1.5 * step)
                .map(|pair| Span {
                    from: pair[0],
                    to: pair[1],
                })
                .collect(),
            None => self
                .stream
                .gaps()
                .iter()
                .map(|gap| Span {
                    from: gap.t0,
                    to: gap.t1,
                })
                .collect(),
        };
        gaps.into_iter()
            .map(|gap| {
                let before = self
                    .segmentation
                    .statics
                    .iter()
                    .rposition(|r| r.span.from <= gap.from);
                let found = samples_missing(self.sensor.name(), gap.length());
                self.found("lost_samples", before.map(|k| k + 1), gap, found)
            })
            .collect()
    }

    fn regular_step(&self) -> Option<f64> {
        // Stamps that are rounded to another step than the clock's have longer ones now and then.
        if matches!(even_clock(&self.stream.t), Stamps::Scattered(clock) if clock.lost == 0) {
            return None;
        }
        let median = self.stream.median_step()?;
        let steps = self.stream.t.windows(2).map(|pair| pair[1] - pair[0]);
        let odd = steps
            .filter(|s| (s - median).abs() > REGULAR.get() * median)
            .count();
        (20 * odd < self.stream.len()).then_some(median)
    }
}

#[cfg(test)]
mod tests {
    use recording::Stream;
    use simulate::{Motion, Spec};

    use super::*;
    use crate::request::Request;
    use crate::state::Extension;

    /// Placements of a recording that a search takes in two parts.
    const PLACEMENTS: usize = 64;

    /// Drops the samples after `from` for a fifth of a second.
    fn interrupt(stream: &mut Stream, from: f64) {
        let stays = |t: &f64| *t <= from || *t > from + 0.2;
        let kept = (0..stream.t.len()).filter(|k| stays(&stream.t[*k]));
        let kept: Vec<usize> = kept.collect();
        stream.t = kept.iter().map(|k| stream.t[*k]).collect();
        stream.values = kept.iter().map(|k| stream.values[*k]).collect();
    }

    #[test]
    fn a_gap_of_one_sensor_in_a_long_recording_is_said_once_and_at_its_place() {
        let mut spec = Spec {
            rate: 50.0,
            ..Spec::hand_held(3)
        };
        if let Motion::HandHeld(motion) = &mut spec.motion {
            motion.placements = Some(PLACEMENTS);
            motion.initial_rest = Some(5.0);
            (motion.rest, motion.turn) = ([3.0, 3.5], [1.0, 1.5]);
        }
        let mut recording = spec.run().unwrap().recording;
        let gyroscope = recording.gyroscope.as_mut().unwrap();
        let late = 0.9 * gyroscope.t.last().unwrap();
        interrupt(gyroscope, late);
        let recordings = [recording];
        let session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        assert_eq!(session.parts().count(), 2);
        let base = State::fit(&session, Extension::default()).unwrap();
        let found = integrity(&session, &base);
        let lost: Vec<_> = found.iter().filter(|f| f.name == "lost_samples").collect();
        assert_eq!(lost.len(), 1, "{lost:?}");
        let mut details = lost[0].finding.details.iter();
        assert!(details.any(|detail| detail.value == "gyroscope"));
        let before = lost[0].interval.unwrap();
        assert!((50..PLACEMENTS).contains(&before), "{before}");
    }

    #[test]
    fn a_gyroscope_whose_clock_runs_faster_has_no_late_stamps_and_the_drift_is_said() {
        let spec = Spec::hand_held(3);
        let mut recording = spec.run().unwrap().recording;
        let gyroscope = recording.gyroscope.as_mut().unwrap();
        gyroscope.t.iter_mut().for_each(|t| *t *= 1.002);
        let found = crate::discover(&[recording], &Request::new(spec.gravity)).unwrap();
        let findings = found.findings;
        assert!(findings.calibration.warnings.has(Kind::CLOCK_DRIFT));
        assert!(findings.effects.is_empty(), "{:?}", findings.effects);
    }
}
