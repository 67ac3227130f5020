//! Static intervals and the turns between them.

use std::ops::Range;

use super::detector::{Detector, Level, levels, motion};
use super::moments::Moments;
use super::saturation::Rails;
use super::spans::{Span, static_spans, union};
use crate::error::Error;
use crate::recording::{Recording, Stream};

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
                        (samples.clone(), fault(stream, samples, span, step, &rails))
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
            multiplier,
            level_at_rest: [None; 2],
        }
    }
}

/// Cuts a recording into rests and turns by the detector.
///
/// # Errors
/// A sensor without samples or a recording shorter than the window.
pub fn segment(recording: &Recording, detector: &Detector) -> Result<Segmentation, Error> {
    let levels = levels(recording, detector)?;
    Ok(segment_at(
        recording,
        detector,
        &levels,
        detector.multiplier,
    ))
}

/// [`segment`] for several multipliers from one measurement of the levels.
///
/// # Errors
/// As [`segment`].
pub fn segment_each(
    recording: &Recording,
    detector: &Detector,
    multipliers: &[f64],
) -> Result<Vec<Segmentation>, Error> {
    let levels = levels(recording, detector)?;
    Ok(multipliers
        .iter()
        .map(|&m| segment_at(recording, detector, &levels, m))
        .collect())
}

fn segment_at(
    recording: &Recording,
    detector: &Detector,
    levels: &[Option<Level>; 2],
    multiplier: f64,
) -> Segmentation {
    let mut moving = motion(levels, multiplier);
    moving.extend(gaps(recording));
    let moving = union(moving);
    let spans = static_spans(
        common(recording),
        &moving,
        detector.min_dynamic,
        detector.min_static,
    );
    Segmentation {
        level_at_rest: levels
            .each_ref()
            .map(|level| level.as_ref().map(|l| l.at_rest)),
        ..Segmentation::from_spans(recording, &spans, multiplier)
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

fn static_interval(recording: &Recording, span: Span) -> StaticInterval {
    let moments = |stream: &Option<Stream>| {
        let stream = stream.as_ref()?;
        Moments::of(&stream.values[stream.between(span.from, span.to)])
    };
    let middle = 0.5 * (span.from + span.to);
    StaticInterval {
        span,
        accelerometer: moments(&recording.accelerometer),
        gyroscope: moments(&recording.gyroscope),
        temperature: recording.temperature.as_ref().and_then(|t| t.at(middle)),
    }
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
    if widest[1] - widest[0] > GAP_STEPS * step {
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
