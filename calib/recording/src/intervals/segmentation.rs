//! Static intervals and the turns between them.

use std::ops::Range;

use sensor::Sensor;

use super::moments::Moments;
use super::rejected::Rejected;
use super::saturation::Rails;
use super::spans::Span;
use crate::error::Error;
use crate::recording::{INSTANT, Recording, Stream};
use crate::shown::figure;

/// A step between gyroscope samples longer than this many median steps is a gap: the rotation in it
/// is unknown.
const GAP_STEPS: f64 = 5.0;

/// A rest of the device.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticInterval {
    /// When.
    pub span: Span,
    /// Moments of the accelerometer, raw unit.
    pub accelerometer: Option<Moments>,
    /// Moments of the gyroscope, raw unit.
    pub gyroscope: Option<Moments>,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
}

impl StaticInterval {
    /// Moments of an inertial sensor, raw unit.
    pub fn moments(&self, sensor: Sensor) -> Option<Moments> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer,
            Sensor::Gyroscope => self.gyroscope,
            Sensor::Magnetometer => None,
        }
    }
}

/// The motion from static interval `from` to `from + 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// Index of the static interval before it.
    pub from: usize,
    /// When.
    pub span: Span,
    /// Its gyroscope samples.
    pub samples: Range<usize>,
    /// Why it cannot be integrated, if so.
    pub fault: Option<TurnFault>,
}

/// Why the rotation in a turn is not known.
#[derive(Clone, Debug, PartialEq)]
pub enum TurnFault {
    /// No samples for a while.
    Gap(Span),
    /// The gyroscope repeats one reading.
    Frozen(Span),
    /// Readings at the end of the range.
    Saturated {
        /// Number of samples there.
        samples: usize,
    },
    /// Fewer than two samples.
    Empty,
}

impl std::fmt::Display for TurnFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Gap(span) => {
                write!(f, "gap of {:.2} s at t = {:.2} s", span.length(), span.from)
            }
            Self::Frozen(span) => write!(
                f,
                "frozen for {:.2} s at t = {:.2} s",
                span.length(),
                span.from
            ),
            Self::Saturated { samples } => write!(f, "{samples} saturated gyroscope samples"),
            Self::Empty => write!(f, "no gyroscope samples"),
        }
    }
}

/// A recording cut into rests and turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmentation {
    /// The rests, in order.
    pub statics: Vec<StaticInterval>,
    /// The motions between neighbouring rests.
    pub turns: Vec<Turn>,
    /// Quiet stretches in which the device turned or tilted.
    pub rejected: Vec<Rejected>,
    /// The multiplier used.
    pub multiplier: f64,
    /// The detector's level at rest of accelerometer and gyroscope, raw unit⁴; `None` where the
    /// rests were given.
    pub level_at_rest: [Option<f64>; 2],
}

impl Segmentation {
    /// From given rests (in order, disjoint), such as sections picked by hand.
    pub fn from_spans(recording: &Recording, spans: &[Span], multiplier: f64) -> Self {
        let statics = spans
            .iter()
            .map(|&span| static_interval(recording, span))
            .collect();
        let gyroscope = recording.gyroscope.as_ref();
        let step = gyroscope.and_then(Stream::median_step).unwrap_or(0.0);
        let rails = Rails::of(gyroscope.map_or(&[], |stream| &stream.values));
        let turns = spans
            .windows(2)
            .enumerate()
            .map(|(from, pair)| {
                let span = Span {
                    from: pair[0].to,
                    to: pair[1].from,
                };
                let (samples, fault) = match gyroscope {
                    Some(stream) => {
                        let samples = stream.between(span.from, span.to);
                        let fault = frozen(recording, &span)
                            .or_else(|| fault(stream, samples.clone(), span, step, &rails));
                        (samples, fault)
                    }
                    None => (0..0, Some(TurnFault::Empty)),
                };
                Turn {
                    from,
                    span,
                    samples,
                    fault,
                }
            })
            .collect();
        Self {
            statics,
            turns,
            rejected: Vec::new(),
            multiplier,
            level_at_rest: [None; 2],
        }
    }

    /// The same without the static intervals that hold `instants`, s: a turn then lasts from the one before to the one after.
    ///
    /// # Errors
    /// [`Error::Usage`] for an instant within no static interval; it names the nearest.
    pub fn without(&self, recording: &Recording, instants: &[f64]) -> Result<Self, Error> {
        for &t in instants {
            let away = |rest: &StaticInterval| (rest.span.from - t).max(t - rest.span.to);
            let nearest = self
                .statics
                .iter()
                .min_by(|a, b| away(a).total_cmp(&away(b)));
            if nearest.is_none_or(|rest| away(rest) > 0.0) {
                let nearest = nearest.map_or_else(String::new, |rest| {
                    format!(
                        "; the nearest lasts from {:.2} to {:.2} s",
                        rest.span.from, rest.span.to
                    )
                });
                return Err(Error::Usage(format!(
                    "{}: no static interval at t = {} s that could be left out{nearest}",
                    recording.name,
                    figure(t)
                )));
            }
        }
        let is_kept = |span: &Span| !instants.iter().any(|t| (span.from..=span.to).contains(t));
        let spans = self.statics.iter().map(|rest| rest.span);
        let spans: Vec<Span> = spans.filter(is_kept).collect();
        Ok(Self {
            rejected: self.rejected.clone(),
            level_at_rest: self.level_at_rest,
            ..Self::from_spans(recording, &spans, self.multiplier)
        })
    }

    /// A stretch of neighbouring static intervals with the turns between them, counted from its first.
    pub fn stretch(&self, which: Range<usize>) -> Self {
        let inside = |turn: &&Turn| which.contains(&turn.from) && which.contains(&(turn.from + 1));
        let turns = self.turns.iter().filter(inside);
        Self {
            turns: turns
                .map(|turn| Turn {
                    from: turn.from - which.start,
                    ..turn.clone()
                })
                .collect(),
            statics: self.statics[which].to_vec(),
            rejected: self.rejected.clone(),
            ..*self
        }
    }
}

fn static_interval(recording: &Recording, span: Span) -> StaticInterval {
    let moments = |stream: &Option<Stream>| {
        let stream = stream.as_ref()?;
        Moments::of(&stream.values[stream.between(span.from, span.to)])
    };
    StaticInterval {
        span,
        accelerometer: moments(&recording.accelerometer),
        gyroscope: moments(&recording.gyroscope),
        temperature: recording
            .temperature
            .as_ref()
            .and_then(|t| t.mean(span.from, span.to)),
    }
}

/// The fault of a turn in which the gyroscope repeats one reading.
fn frozen(recording: &Recording, turn: &Span) -> Option<TurnFault> {
    let own = recording.frozen.iter();
    let mut own = own.filter(|frozen| frozen.sensor == Sensor::Gyroscope);
    own.find(|frozen| frozen.span.touches(turn))
        .map(|frozen| TurnFault::Frozen(frozen.span))
}

fn fault(
    stream: &Stream,
    samples: Range<usize>,
    span: Span,
    step: f64,
    rails: &Rails,
) -> Option<TurnFault> {
    let mut stamps = vec![span.from];
    stamps.extend_from_slice(&stream.t[samples.clone()]);
    stamps.push(span.to);
    let widest = stamps
        .windows(2)
        .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    if widest[1] - widest[0] > GAP_STEPS * step + INSTANT {
        return Some(TurnFault::Gap(Span {
            from: widest[0],
            to: widest[1],
        }));
    }
    let samples_in = samples.len();
    let saturated = stream.values[samples]
        .iter()
        .filter(|v| rails.reached(v))
        .count();
    if samples_in < 2 {
        return Some(TurnFault::Empty);
    }
    (saturated > 0).then_some(TurnFault::Saturated { samples: saturated })
}
