//! The detector of motion: the spread of a sensor in a window against its spread at rest.

pub(crate) mod options;

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;

use super::spans::{Span, union};
use crate::error::Error;
use crate::order_statistic::nth_smallest;
use crate::recording::{Recording, Stream, is_before};

findings::tuning! {
    /// The share of windows that are taken to be at rest in any recording that can be calibrated.
    QUIET_SHARE: f64 = 0.1;

    /// Shortest static interval that is kept, s: what remains of three seconds. The window sees the turns before and after, and up to
    /// half a second goes with their ends.
    MIN_STATIC: f64 = 2.5;

    /// Fewest samples in a window whose spread means something.
    MIN_SAMPLES: f64 = 5.0;
}

/// Samples that are judged together where all of them move or none does.
const BLOCK: usize = 64;

findings::tuning! {
    /// Spread that counts as none, as a fraction of the range of the samples: keeps a noise-free
    /// recording from having a threshold of zero.
    SPREAD_FLOOR: f64 = 1e-6;
}

/// A window is in motion where the sum over axes of its squared variance exceeds that at rest by
/// the multiplier: `Σ var² >= multiplier · TS` (Liu et al. 2021, section 3.1), for either sensor.
///
/// Turning about the vertical is invisible to an accelerometer, so that the gyroscope has its say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detector {
    /// Length of the window around each sample, s.
    pub window: f64,
    /// Factor on the threshold.
    pub multiplier: f64,
    /// Shorter spans of motion are ignored, s.
    pub min_dynamic: f64,
    /// Shorter rests, less what the window takes of their ends, are ignored, s.
    pub min_static: f64,
    /// Length of the initial rest that gives the threshold as published, s; `None` takes the
    /// quietest tenth of the recording, which needs no rest at the start.
    pub initial_static: Option<f64>,
    /// Static intervals on a vibrating table count. They are less certain than quiet ones.
    pub shaken: bool,
    /// Quiet stretches in which the device tilts steadily count as static intervals: used where the creep is fitted.
    pub creeping: bool,
    /// Shorter static intervals, in a shorter window, may be taken if those asked for do not suffice for a calibration.
    pub may_shorten: bool,
}

impl Default for Detector {
    fn default() -> Self {
        Self {
            window: 1.0,
            multiplier: 100.0,
            min_dynamic: 0.5,
            min_static: MIN_STATIC.get(),
            initial_static: None,
            shaken: false,
            creeping: false,
            may_shorten: true,
        }
    }
}

/// The detector's statistic of one sensor and its level at rest: computed once, asked for several
/// multipliers.
#[derive(Clone, Debug)]
pub struct Level<'a> {
    t: &'a [f64],
    statistic: Vec<f64>,
    /// Smallest and largest statistic of each [`BLOCK`] samples.
    blocks: Vec<(f64, f64)>,
    /// The threshold `TS` for a multiplier of 1, (unit²)².
    pub at_rest: f64,
}

impl<'a> Level<'a> {
    /// Measures a stream.
    ///
    /// # Errors
    /// A stream without samples or shorter than the window.
    pub fn measure(stream: &'a Stream, detector: &Detector) -> Result<Self, Error> {
        let (Some(&first), Some(&last)) = (stream.t.first(), stream.t.last()) else {
            return Err(Error::not_enough(Finding::of(Kind::NO_SAMPLES)));
        };
        if last - first < detector.window {
            return Err(Error::not_enough(
                Finding::of(Kind::TOO_SHORT)
                    .number("length", last - first, "s")
                    .number("window", detector.window, "s"),
            ));
        }
        let step = stream.median_step().unwrap_or(0.0);
        if step * MIN_SAMPLES.get() > detector.window {
            let mut slow = Finding::of(Kind::SAMPLED_SLOWLY)
                .number("step", step, "s")
                .number("rate", step.recip(), "Hz")
                .number("window", detector.window, "s")
                .count("least", MIN_SAMPLES.get() as usize);
            slow.remedies.push(match step == 1.0 {
                // Stamps that go up by one may count the rows.
                true => Remedy::such_as(OptionName::Rate, "100"),
                // The accelerometer alone needs no turns.
                false => {
                    let window = (step * MIN_SAMPLES.get()).ceil().to_string();
                    Remedy::set_to(OptionName::Window, window)
                }
            });
            return Err(Error::not_enough(slow));
        }
        let extent = Extent::of(&stream.values);
        let statistic = statistic(stream, detector.window, &extent.mean);
        let reference = match detector.initial_static {
            Some(length) => {
                let initial = &stream.values[stream.between(first, first + length)];
                let spread = super::Moments::of(initial).map(|m| m.covariance.diagonal());
                spread.map_or(0.0, |v| v.norm_squared())
            }
            None => quantile(&statistic, QUIET_SHARE.get()),
        };
        let floor = (SPREAD_FLOOR.get() * extent.range).powi(4);
        let floor = floor.max(quantisation(stream));
        let blocks = statistic.chunks(BLOCK).map(range_of).collect();
        Ok(Self {
            t: &stream.t,
            statistic,
            blocks,
            at_rest: reference.max(floor),
        })
    }

    /// The spans in which the statistic reaches `multiplier` times its level at rest.
    pub fn motion(&self, multiplier: f64) -> Vec<Span> {
        let threshold = multiplier * self.at_rest;
        let mut spans: Vec<Span> = Vec::new();
        let mut moving = false;
        let chunks = self.t.chunks(BLOCK).zip(self.statistic.chunks(BLOCK));
        for ((stamps, statistic), &(least, largest)) in chunks.zip(&self.blocks) {
            let (Some(&from), Some(&to)) = (stamps.first(), stamps.last()) else {
                continue;
            };
            if largest < threshold {
                moving = false;
            } else if least >= threshold {
                join(&mut spans, moving, Span { from, to });
                moving = true;
            } else {
                for (&t, &v) in stamps.iter().zip(statistic) {
                    if v >= threshold {
                        join(&mut spans, moving, Span { from: t, to: t });
                    }
                    moving = v >= threshold;
                }
            }
        }
        spans
    }
}

/// Prolongs the last span by a motion that goes on, or begins another.
fn join(spans: &mut Vec<Span>, goes_on: bool, motion: Span) {
    match spans.last_mut() {
        Some(span) if goes_on => span.to = motion.to,
        _ => spans.push(motion),
    }
}

/// Smallest and largest value; not a number for the smallest where one of them is none.
fn range_of(values: &[f64]) -> (f64, f64) {
    let whole = (f64::INFINITY, f64::NEG_INFINITY);
    values.iter().fold(whole, |(low, high), &v| {
        let low = if v < low || v.is_nan() { v } else { low };
        (low, high.max(v))
    })
}

/// `Σ (LSB²/12)²` over the axes: where the noise is smaller than the least significant bit, some rests
/// do not flicker at all and others between two readings.
fn quantisation(stream: &Stream) -> f64 {
    stream
        .least_steps()
        .into_iter()
        .filter(|step| step.is_finite())
        .map(|step| (step * step / 12.0).powi(2))
        .sum()
}

/// The levels of accelerometer and gyroscope.
pub(super) fn levels<'a>(
    recording: &'a Recording,
    detector: &Detector,
) -> Result<[Option<Level<'a>>; 2], Error> {
    let measure = |stream: &'a Option<Stream>| {
        stream
            .as_ref()
            .map(|stream| Level::measure(stream, detector))
            .transpose()
    };
    let (accelerometer, gyroscope) = rayon::join(
        || measure(&recording.accelerometer),
        || measure(&recording.gyroscope),
    );
    Ok([accelerometer?, gyroscope?])
}

/// The spans in which any of the sensors moves.
pub(super) fn motion(levels: &[Option<Level<'_>>; 2], multiplier: f64) -> Vec<Span> {
    union(
        levels
            .iter()
            .flatten()
            .flat_map(|level| level.motion(multiplier))
            .collect(),
    )
}

/// `Σ over axes of var²` in a centred window of `window` seconds, at every sample.
///
/// From running sums of the samples about `centre` at both ends of the window: one pass, whatever its
/// length.
fn statistic(stream: &Stream, window: f64, centre: &Vector3<f64>) -> Vec<f64> {
    let (mut start, mut end) = (0, 0);
    let (mut before, mut through) = (Sums::default(), Sums::default());
    let at = |&t: &f64| {
        while is_before(stream.t[start], t - 0.5 * window) {
            before.add(&stream.values[start], centre);
            start += 1;
        }
        while end < stream.len() && !is_before(t + 0.5 * window, stream.t[end]) {
            through.add(&stream.values[end], centre);
            end += 1;
        }
        let share = ((end - start) as f64).recip();
        (0..3)
            .map(|axis| {
                let mean = (through.first[axis] - before.first[axis]) * share;
                let square = (through.second[axis] - before.second[axis]) * share;
                (square - mean * mean).max(0.0)
            })
            .map(|variance| variance * variance)
            .sum()
    };
    stream.t.iter().map(at).collect()
}

/// Sums of centred samples and of their squares, per axis.
#[derive(Default)]
struct Sums {
    first: [f64; 3],
    second: [f64; 3],
}

impl Sums {
    fn add(&mut self, value: &Vector3<f64>, centre: &Vector3<f64>) {
        for axis in 0..3 {
            let d = value[axis] - centre[axis];
            self.first[axis] += d;
            self.second[axis] += d * d;
        }
    }
}

/// The value below which the share `q` of `values` lies; 0 of none.
fn quantile(values: &[f64], q: f64) -> f64 {
    let rank = (q * values.len().saturating_sub(1) as f64) as usize;
    nth_smallest(values.iter().copied(), rank).unwrap_or(0.0)
}

/// Mean and range of a sensor's samples.
struct Extent {
    mean: Vector3<f64>,
    /// Largest minus smallest value over all axes.
    range: f64,
}

impl Extent {
    fn of(values: &[Vector3<f64>]) -> Self {
        let mut sum = Vector3::zeros();
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for value in values {
            sum += value;
            for axis in 0..3 {
                low[axis] = low[axis].min(value[axis]);
                high[axis] = high[axis].max(value[axis]);
            }
        }
        let (low, high) = (Vector3::from(low), Vector3::from(high));
        Self {
            mean: sum / values.len() as f64,
            range: high.max() - low.min(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sample by sample, as the definition has it.
    fn one_by_one(level: &Level<'_>, multiplier: f64) -> Vec<Span> {
        let threshold = multiplier * level.at_rest;
        let mut spans: Vec<Span> = Vec::new();
        let mut moving = false;
        for (&t, &v) in level.t.iter().zip(&level.statistic) {
            if v >= threshold {
                join(&mut spans, moving, Span { from: t, to: t });
            }
            moving = v >= threshold;
        }
        spans
    }

    #[test]
    fn blocks_give_the_spans_that_a_look_at_every_sample_gives() {
        let t: Vec<f64> = (0..3000).map(|k| 0.01 * f64::from(k)).collect();
        let wave =
            |t: f64| (1.0 + (0.7 * t).sin()).powi(8) * Vector3::new((40.0 * t).sin(), 0.1, 0.0);
        let values: Vec<_> = t.iter().map(|&t| wave(t)).collect();
        let stream = Stream { t, values };
        let level = Level::measure(&stream, &Detector::default()).unwrap();
        let mut found = 0;
        for multiplier in [1.0, 30.0, 1e3, 1e5, 1e9] {
            let spans = level.motion(multiplier);
            assert_eq!(spans, one_by_one(&level, multiplier));
            found += spans.len();
        }
        assert!(found > 5);
    }
}
