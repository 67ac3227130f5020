//! What of a recording does not depend on the detector's multiplier, found once.

use nalgebra::Vector3;

use super::Moments;
use super::detector::{Detector, Level, levels, motion};
use super::running_sums::RunningSums;
use super::segmentation::Segmentation;
use super::shaken::shaken;
use super::spans::{Span, static_spans, union};
use super::stamps::Stamps;
use crate::error::Error;
use crate::recording::{Recording, Stream};

/// A recording that can be cut at one multiplier after another without a look at its samples.
#[derive(Debug)]
pub struct Survey<'a> {
    recording: &'a Recording,
    detector: Detector,
    levels: [Option<Level<'a>>; 2],
    gaps: Vec<Span>,
    whole: Span,
    /// Of the accelerometer.
    stamps: Stamps<'a>,
    sums: Option<RunningSums<'a>>,
}

impl<'a> Survey<'a> {
    /// Measures the levels at rest, the gaps and the sums of the samples.
    ///
    /// # Errors
    /// A sensor without samples or a recording shorter than the window.
    pub fn of(recording: &'a Recording, detector: &Detector) -> Result<Self, Error> {
        let accelerometer = recording.accelerometer.as_ref();
        Ok(Self {
            recording,
            detector: *detector,
            levels: levels(recording, detector)?,
            gaps: gaps(recording).collect(),
            whole: common(recording),
            stamps: Stamps::of(accelerometer.map_or(&[], |stream| &stream.t)),
            sums: accelerometer.and_then(|stream| RunningSums::of(&stream.values)),
        })
    }

    /// The rests at a multiplier, those on a table that vibrates not among them.
    pub fn rests(&self, multiplier: f64) -> Vec<Span> {
        self.without(motion(&self.levels, multiplier))
    }

    /// What is left between motions and gaps.
    fn without(&self, mut moving: Vec<Span>) -> Vec<Span> {
        moving.extend_from_slice(&self.gaps);
        let Detector {
            min_dynamic,
            min_static,
            ..
        } = self.detector;
        static_spans(self.whole, &union(moving), min_dynamic, min_static)
    }

    /// The accelerometer's mean over a rest, raw unit; `None` without samples.
    pub fn mean_force(&self, rest: Span) -> Option<Vector3<f64>> {
        let stream = self.recording.accelerometer.as_ref()?;
        let samples = self.stamps.between(rest.from, rest.to);
        match &self.sums {
            Some(sums) => sums.mean(samples),
            None => Some(Moments::of(&stream.values[samples])?.mean),
        }
    }

    /// The rests at a multiplier that only the accelerometer does not take for rests.
    fn shaken(&self, multiplier: f64, quiet: &[Span]) -> Vec<Span> {
        let [_, Some(gyroscope)] = &self.levels else {
            return Vec::new();
        };
        let turned = self.without(gyroscope.motion(multiplier));
        let accelerometer = self.recording.accelerometer.as_ref();
        accelerometer.map_or_else(Vec::new, |stream| shaken(stream, &turned, quiet))
    }

    /// The recording cut into rests and turns at a multiplier.
    pub fn segment(&self, multiplier: f64) -> Segmentation {
        let level = |level: &Option<Level<'_>>| level.as_ref().map(|l| l.at_rest);
        let mut rests = self.rests(multiplier);
        if self.detector.shaken {
            rests.extend(self.shaken(multiplier, &rests));
            rests.sort_by(|a, b| a.from.total_cmp(&b.from));
        }
        Segmentation {
            level_at_rest: self.levels.each_ref().map(level),
            ..Segmentation::from_spans(self.recording, &rests, multiplier)
        }
    }
}

/// Cuts a recording into rests and turns by the detector, at its own multiplier.
///
/// # Errors
/// As [`Survey::of`].
pub fn segment(recording: &Recording, detector: &Detector) -> Result<Segmentation, Error> {
    Ok(Survey::of(recording, detector)?.segment(detector.multiplier))
}

/// The interruptions of either sensor: what the device did in them is not known.
fn gaps(recording: &Recording) -> impl Iterator<Item = Span> + '_ {
    [&recording.accelerometer, &recording.gyroscope]
        .into_iter()
        .flatten()
        .flat_map(Stream::gaps)
        .map(|gap| Span {
            from: gap.t0,
            to: gap.t1,
        })
}

/// The time in which all sensors of the recording have samples.
fn common(recording: &Recording) -> Span {
    [&recording.accelerometer, &recording.gyroscope]
        .into_iter()
        .flatten()
        .fold(
            Span {
                from: f64::NEG_INFINITY,
                to: f64::INFINITY,
            },
            |span, stream| Span {
                from: stream.t.first().map_or(span.from, |&t| span.from.max(t)),
                to: stream.t.last().map_or(span.to, |&t| span.to.min(t)),
            },
        )
}
