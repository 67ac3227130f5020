//! The part of segmentation that does not depend on the detector's multiplier, computed once.

use nalgebra::Vector3;
use sensor::Base;

use super::Moments;
use super::detector::{Detector, Level, levels, motion};
use super::ends::Ends;
use super::rejected::{Reason, Rejected};
use super::segmentation::Segmentation;
use super::shaken::shaken;
use super::spans::{Span, static_spans, union};
use super::stamps::Stamps;
use super::stillness::static_and_rejected;
use crate::error::Error;
use crate::intervals::moments::running_sums::RunningSums;
use crate::order_statistic::nth_smallest;
use crate::recording::{Recording, Stream};

/// A median norm of specific force in m/s² lies here.
const SI_NORM: std::ops::Range<f64> = 4.0..16.0;

findings::tuning! {
    /// Faster turns than this are degrees per second or counts, rad/s.
    FASTEST: f64 = 40.0;
    /// A hundredth of the samples of a recording turned by hand are faster than about this, rad/s.
    BY_HAND: f64 = 3.0;
}

/// A recording that can be cut at one multiplier after another without a look at its samples.
#[derive(Debug)]
pub struct Survey<'a> {
    recording: &'a Recording,
    detector: Detector,
    levels: [Option<Level<'a>>; 2],
    gaps: Vec<Span>,
    whole: Span,
    /// Stamps of the accelerometer.
    stamps: Stamps<'a>,
    sums: Option<RunningSums<'a>>,
    ends: Option<Ends<'a>>,
    /// rad/s per unit of the gyroscope, roughly.
    rate_scale: f64,
}

impl<'a> Survey<'a> {
    /// Measures the levels at rest, the gaps and the sums of the samples.
    ///
    /// # Errors
    /// A sensor without samples or a recording shorter than the window.
    pub fn of(recording: &'a Recording, detector: &Detector) -> Result<Self, Error> {
        let accelerometer = recording.accelerometer.as_ref();
        let rate_scale = rate_scale(recording);
        let gyroscope = recording.gyroscope.as_ref();
        Ok(Self {
            ends: gyroscope.map(|stream| Ends::of(stream, rate_scale)),
            rate_scale,
            recording,
            detector: *detector,
            levels: levels(recording, detector)?,
            gaps: gaps(recording).collect(),
            whole: common(recording),
            stamps: Stamps::of(accelerometer.map_or(&[], |stream| &stream.t)),
            sums: accelerometer.and_then(|stream| RunningSums::of(&stream.values)),
        })
    }

    /// The quiet stretches at a multiplier without the turns at their ends; those on a table that vibrates
    /// are not among them.
    pub fn rests(&self, multiplier: f64) -> Vec<Span> {
        let quiet = self.without(motion(&self.levels, multiplier));
        let Some(ends) = &self.ends else {
            return quiet;
        };
        let trimmed = quiet.into_iter().map(|span| ends.trimmed(span));
        let parts = trimmed.flat_map(|span| self.without_swings(ends, span));
        let min_static = self.detector.min_static;
        let rests = parts.filter(|span| span.lasts(min_static) && !ends.moves(*span));
        rests.collect()
    }

    /// The parts of a quiet stretch between swings of the device.
    fn without_swings(&self, ends: &Ends<'_>, span: Span) -> Vec<Span> {
        let (min_dynamic, min_static) = (self.detector.min_dynamic, self.detector.min_static);
        match static_spans(span, &ends.swings(span), min_dynamic, min_static).as_slice() {
            [whole] if *whole == span => vec![span],
            parts => parts.iter().map(|part| ends.trimmed(*part)).collect(),
        }
    }

    /// The quiet stretches without the turns in their middles.
    fn without_turns(&self, quiet: Vec<Span>) -> Vec<Span> {
        let Some(ends) = &self.ends else {
            return quiet;
        };
        let pieces = |span: Span| match ends.without_turns(span).as_slice() {
            [_] => vec![span],
            pieces => pieces.iter().map(|piece| ends.trimmed(*piece)).collect(),
        };
        let all = quiet.into_iter().flat_map(pieces);
        all.filter(|span| span.lasts(self.detector.min_static))
            .collect()
    }

    /// Returns the quiet stretches between motions and interruptions.
    fn without(&self, moving: Vec<Span>) -> Vec<Span> {
        self.lasting(moving, self.detector.min_static)
    }

    fn lasting(&self, mut moving: Vec<Span>, min_static: f64) -> Vec<Span> {
        moving.extend_from_slice(&self.gaps);
        let min_dynamic = self.detector.min_dynamic;
        static_spans(self.whole, &union(moving), min_dynamic, min_static)
    }

    /// Number of the static intervals at a multiplier that last at least `length`, s.
    pub fn count_lasting(&self, multiplier: f64, length: f64) -> usize {
        self.lasting(motion(&self.levels, multiplier), length).len()
    }

    /// The detector it was made with.
    pub fn detector(&self) -> &Detector {
        &self.detector
    }

    /// Standard deviation of an axis of the accelerometer's mean over spans, root mean square, by the
    /// spread within the quietest windows; raw unit.
    pub fn noise_of_means(&self, spans: &[Span]) -> f64 {
        let Some(level) = &self.levels[0] else {
            return 0.0;
        };
        let counts = spans
            .iter()
            .map(|s| self.stamps.between(s.from, s.to).len());
        let share: f64 = counts.map(|n| (n.max(1) as f64).recip()).sum();
        let variance = (level.at_rest / 3.0).sqrt();
        (variance * share / spans.len().max(1) as f64).sqrt()
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
        let mut turned = self.without(gyroscope.motion(multiplier));
        turned.retain(|span| self.ends.as_ref().is_none_or(|ends| !ends.moves(*span)));
        let accelerometer = self.recording.accelerometer.as_ref();
        accelerometer.map_or_else(Vec::new, |stream| shaken(stream, &turned, quiet))
    }

    /// The rests that vibrate clearly, whatever the multiplier, among those that are not taken.
    fn vibrating(&self, multiplier: f64, rests: &[Span]) -> Vec<Span> {
        let clear = multiplier.max(Detector::default().multiplier);
        let mut quiet = rests.to_vec();
        if clear > multiplier {
            quiet.extend(self.rests(clear));
        }
        self.shaken(clear, &quiet)
    }

    /// The recording cut into static intervals and turns at a multiplier. `base` is the accelerometer as far
    /// as it is known: without it the readings give the direction of gravity.
    pub fn segment(&self, multiplier: f64, base: Option<&Base<f64>>) -> Segmentation {
        let level = |level: &Option<Level<'_>>| level.as_ref().map(|l| l.at_rest);
        let mut rests = self.without_turns(self.rests(multiplier));
        let mut vibrating = Vec::new();
        if self.detector.shaken {
            rests.extend(self.shaken(multiplier, &rests));
            rests.sort_by(|a, b| a.from.total_cmp(&b.from));
        } else {
            vibrating = self.vibrating(multiplier, &rests);
        }
        let perfect = Base::identity();
        let base = base.unwrap_or(&perfect);
        let no_tilt = !self.detector.creeping;
        let (statics, mut rejected) =
            static_and_rejected(self.recording, rests, base, self.rate_scale, no_tilt);
        rejected.extend(vibrating.into_iter().map(|span| Rejected {
            span,
            reason: Reason::Vibrating,
        }));
        let mut cut = Segmentation::from_spans(self.recording, &statics, multiplier);
        cut.rejected.append(&mut rejected);
        cut.level_at_rest = self.levels.each_ref().map(level);
        cut
    }
}

/// Cuts a recording into rests and turns by the detector, at its own multiplier.
///
/// # Errors
/// As [`Survey::of`].
pub fn segment(recording: &Recording, detector: &Detector) -> Result<Segmentation, Error> {
    Ok(Survey::of(recording, detector)?.segment(detector.multiplier, None))
}

/// Estimates the factor from the gyroscope's readings to rad/s: 1 if both sensors' readings can be SI units, else the factor that
/// makes the recording's fast turns as fast as a hand's.
fn rate_scale(recording: &Recording) -> f64 {
    let size = |stream: &Stream, q: f64| {
        let rank = (q * stream.len().saturating_sub(1) as f64) as usize;
        nth_smallest(stream.values.iter().map(|v| v.norm()), rank)
    };
    let force = recording.accelerometer.as_ref().and_then(|s| size(s, 0.5));
    let fast = recording.gyroscope.as_ref().and_then(|s| size(s, 0.99));
    let si = force.is_none_or(|f| SI_NORM.contains(&f)) && fast.is_none_or(|w| w < FASTEST.get());
    match fast {
        Some(fast) if !si && fast > 0.0 => BY_HAND.get() / fast,
        _ => 1.0,
    }
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
