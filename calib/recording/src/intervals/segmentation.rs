//! Static intervals and the turns between them.

use std::ops::Range;

use findings::{Finding, Kind};
use sensor::Sensor;

use super::moments::Moments;
use super::rejected::Rejected;
use super::saturation::Rails;
use super::spans::Span;
use crate::error::Error;
use crate::recording::{INSTANT, Recording, Stream};
use crate::shown::figure;

findings::tuning! {
    /// A step between gyroscope samples longer than this many median steps is a gap: the rotation in it
    /// is unknown.
    GAP_STEPS: f64 = 5.0;
}

/// A rest of the device.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticInterval {
    /// Begin and end by the stamps, s.
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
    /// Begin and end by the stamps, s.
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

impl TurnFault {
    /// Builds the finding about this fault.
    pub fn finding(&self) -> Finding {
        let within = |kind: Kind, span: &Span| {
            let length = format!("{:.2}", span.length());
            let found = Finding::of(kind).between(span.from, span.to);
            let found = found.detail("length", length);
            found.detail("start", format!("{:.2} s", span.from))
        };
        match self {
            Self::Gap(span) => within(Kind::TURN_GAP, span),
            Self::Frozen(span) => within(Kind::TURN_FROZEN, span),
            Self::Saturated { samples } => {
                Finding::of(Kind::TURN_SATURATED).count("samples", *samples)
            }
            Self::Empty => Finding::of(Kind::TURN_EMPTY),
        }
    }
}

impl std::fmt::Display for TurnFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.finding().what())
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
    /// The part of the recording that this is, where it is one.
    pub part: Option<Part>,
}

/// Words between the name of a recording and the number of a part of it.
const PART: &str = " (part ";

/// A part of a recording that is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Number of the recording's static intervals before its first.
    pub before: usize,
    /// Its number, from 1.
    pub number: usize,
    /// Number of all parts.
    pub of: usize,
}

/// Returns true if `name` is that of a recording, or of a part of it as [`Segmentation::name_in`] gives it.
///
/// # Examples
/// ```
/// use stillpoint_recording::intervals::is_of;
///
/// assert!(is_of("run", "run") && is_of("run (part 2 of 3)", "run"));
/// assert!(!is_of("run 1", "run") && !is_of("run", "run 1"));
/// ```
pub fn is_of(name: &str, recording: &str) -> bool {
    let rest = name.strip_prefix(recording);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(PART))
}

impl Segmentation {
    /// From given rests (in order, disjoint), such as sections picked by hand. One without samples is none, and is named among
    /// those that are rejected.
    pub fn from_spans(recording: &Recording, spans: &[Span], multiplier: f64) -> Self {
        let (spans, empty): (Vec<Span>, Vec<Span>) =
            spans.iter().partition(|span| has_samples(recording, span));
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
            rejected: empty.into_iter().map(Rejected::without_samples).collect(),
            multiplier,
            level_at_rest: [None; 2],
            part: None,
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
                let none = Finding::of(Kind::NO_INTERVAL_THERE)
                    .in_recording(&recording.name)
                    .detail("instant", figure(t));
                return Err(Error::usage(match nearest {
                    Some(rest) => none
                        .detail("from", format!("{:.2}", rest.span.from))
                        .detail("to", format!("{:.2}", rest.span.to)),
                    None => none,
                }));
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

    /// Number of the recording's static intervals before the first.
    pub fn before(&self) -> usize {
        self.part.map_or(0, |part| part.before)
    }

    /// The name of what is cut: that of the recording, and which part of it where it is one.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_recording::Recording;
    /// use stillpoint_recording::intervals::{Segmentation, Span};
    ///
    /// let rests = [Span { from: 0.0, to: 5.0 }, Span { from: 7.0, to: 12.0 }];
    /// let recording = Recording { name: "long.csv".into(), ..Recording::default() };
    /// let whole = Segmentation::from_spans(&recording, &rests, 10.0);
    /// assert_eq!(whole.name_in(&recording.name), "long.csv");
    /// ```
    pub fn name_in(&self, recording: &str) -> String {
        match self.part {
            None => recording.to_owned(),
            Some(Part { number, of, .. }) => format!("{recording}{PART}{number} of {of})"),
        }
    }

    /// Part `number`, from 1, of as many with nearly as many static intervals each: these with the turns between them, counted from its first.
    pub fn part(&self, number: usize, of: usize) -> Self {
        let count = self.statics.len();
        let which = (number - 1) * count / of..number * count / of;
        let inside = |turn: &&Turn| which.contains(&turn.from) && which.contains(&(turn.from + 1));
        let turns = self.turns.iter().filter(inside);
        Self {
            turns: turns
                .map(|turn| Turn {
                    from: turn.from - which.start,
                    ..turn.clone()
                })
                .collect(),
            part: Some(Part {
                before: self.before() + which.start,
                number,
                of,
            }),
            statics: self.statics[which].to_vec(),
            rejected: self.rejected.clone(),
            ..*self
        }
    }
}

/// Returns true if the accelerometer, or else the gyroscope, has samples in a span.
fn has_samples(recording: &Recording, span: &Span) -> bool {
    let stream = recording.accelerometer.as_ref();
    let stream = stream.or(recording.gyroscope.as_ref());
    let is_sampled = |stream: &Stream| !stream.between(span.from, span.to).is_empty();
    span.length() > 0.0 && stream.is_none_or(is_sampled)
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
    if widest[1] - widest[0] > GAP_STEPS.get() * step + INSTANT.get() {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intervals::Reason;
    use nalgebra::Vector3;

    #[test]
    fn an_interval_without_samples_is_none_and_is_named() {
        let t: Vec<f64> = (0..100).map(|k| 0.1 * f64::from(k)).collect();
        let values = vec![Vector3::z(); t.len()];
        let recording = Recording {
            accelerometer: Some(Stream { t, values }),
            ..Recording::default()
        };
        let span = |from: f64, to: f64| Span { from, to };
        let given = [
            span(0.0, 2.0),
            span(3.0, 3.0),
            span(5.0, 4.0),
            span(6.01, 6.05),
            span(7.0, 9.0),
        ];
        let cut = Segmentation::from_spans(&recording, &given, 100.0);
        assert_eq!(cut.statics.len(), 2);
        assert_eq!(cut.turns.len(), 1);
        assert!(cut.statics.iter().all(|rest| rest.accelerometer.is_some()));
        assert_eq!(cut.rejected.len(), 3);
        assert!(cut.rejected.iter().all(|r| r.reason == Reason::Empty));
    }
}
