//! What was found, in numbers, and its sentence.

use std::fmt;

use sensor::Sensor;
use serde::Serialize;

use crate::recording::Frozen;
use crate::shown::figure;

/// Most rows or intervals that a sentence lists.
const LISTED: usize = 8;
/// Most places with rows and times.
const PLACES: usize = 3;

/// Fewer zeros at rest than this share are those of turns.
const IN_TURNS: f64 = 0.005;

/// What the readings show of a sensor. Values in the unit of the readings, rows counted as the
/// lines of a table with one line of header, the first sample being row 2; times in s.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Finding {
    /// All readings from a row on repeat one pattern: memory that was never written.
    ErasedTail {
        /// The first such row.
        first_row: usize,
        /// Their number.
        rows: usize,
        /// Time of the first, s.
        time: f64,
    },
    /// Rows repeat one reading for longer than chance and steps of the readings make it.
    Frozen {
        /// The sensors, by name.
        sensors: Vec<&'static str>,
        /// How many rows repeat the one before.
        rows: usize,
        /// Where, the first of one sensor each: first and last row, begin and end in s.
        places: Vec<(usize, usize, f64, f64)>,
    },
    /// An axis is cut off at the end of its range.
    Clipped {
        /// The sensor.
        #[serde(serialize_with = "name")]
        sensor: Sensor,
        /// The axis, 0 to 2.
        axis: usize,
        /// The reading at which it is cut off.
        limit: f64,
        /// Number of rows there.
        rows: usize,
        /// The first and the last of them.
        from_row: usize,
        /// See `from_row`.
        to_row: usize,
    },
    /// The steps of the readings are wider than the noise.
    Quantised {
        /// The sensor.
        #[serde(serialize_with = "name")]
        sensor: Sensor,
        /// The axes, 0 to 2.
        axes: Vec<usize>,
        /// The widest step.
        step: f64,
        /// The standard deviation within static intervals on the same axis.
        spread: f64,
    },
    /// Small signals read as exactly zero.
    DeadZone {
        /// The sensor.
        #[serde(serialize_with = "name")]
        sensor: Sensor,
        /// The axes, 0 to 2.
        axes: Vec<usize>,
        /// Share of the readings in static intervals that are zero, on the axis with most.
        share: f64,
        /// The smallest reading that is not zero, on that axis.
        least: f64,
    },
    /// The bias jumps at the same time into every static interval.
    Rezeroed {
        /// The sensor.
        #[serde(serialize_with = "name")]
        sensor: Sensor,
        /// From the begin of a static interval to the jump, s.
        after: f64,
        /// Root mean square length of the jumps.
        size: f64,
        /// The intervals, counted from 1.
        intervals: Vec<usize>,
    },
    /// Single readings far from their neighbours on both sides, which agree.
    Spikes {
        /// The sensor.
        #[serde(serialize_with = "name")]
        sensor: Sensor,
        /// Rows, in order.
        rows: Vec<usize>,
        /// Axes on which they stand out, 0 to 2.
        axes: Vec<usize>,
        /// The farthest one's distance from its neighbours.
        largest: f64,
    },
    /// Some static intervals are far noisier than the others.
    Vibration {
        /// The sensor.
        #[serde(serialize_with = "name")]
        sensor: Sensor,
        /// The intervals, counted from 1.
        intervals: Vec<usize>,
        /// The spread of the noisiest over that of the usual one.
        ratio: f64,
        /// Whether these are all from one on to the end, or from the first to one, and equally noisy.
        from_here_on: bool,
    },
    /// The rate wavers in the quietest stretches as in a hand.
    HandHeld {
        /// Root mean square of the wavering rate, rad/s.
        rate: f64,
    },
}

impl Finding {
    /// What is said of readings that repeat one; `None` of none.
    pub(crate) fn of_frozen(frozen: &[Frozen]) -> Option<Self> {
        let mut sensors: Vec<&str> = frozen.iter().map(|f| f.sensor.name()).collect();
        sensors.dedup();
        let mut places: Vec<_> = frozen
            .iter()
            .map(|f| {
                (
                    f.first_row,
                    f.first_row + f.rows - 1,
                    f.span.from,
                    f.span.to,
                )
            })
            .collect();
        places.sort_by_key(|place| (place.0, place.1));
        // Both sensors of one table are in the same rows, or nearly.
        places.dedup_by(|next, last| {
            let same = next.0 <= last.1;
            if same {
                *last = (last.0, last.1.max(next.1), last.2, last.3.max(next.3));
            }
            same
        });
        let rows = places.iter().map(|place| place.1 + 1 - place.0).sum();
        (!places.is_empty()).then_some(Self::Frozen {
            sensors,
            rows,
            places,
        })
    }
}

/// The sensor's name for JSON.
fn name<S: serde::Serializer>(sensor: &Sensor, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(sensor.name())
}

fn axes_in_words(axes: &[usize]) -> String {
    let names: Vec<&str> = axes
        .iter()
        .filter_map(|&k| ["x", "y", "z"].get(k).copied())
        .collect();
    names.join(", ")
}

fn listed(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers.iter().take(LISTED).map(usize::to_string).collect();
    match numbers.len().saturating_sub(LISTED) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ErasedTail {
                first_row,
                rows,
                time,
            } => write!(
                f,
                "the last {rows} rows, from row {first_row} (t = {time:.3} s) on, repeat one reading on all \
                 axes: erased memory, left out"
            ),
            Self::Frozen {
                sensors,
                rows,
                places,
            } => {
                let one = |place: &(usize, usize, f64, f64)| {
                    let (first, last, from, to) = place;
                    format!("rows {first} to {last}, t = {from:.2} to {to:.2} s")
                };
                let shown: Vec<String> = places.iter().take(PLACES).map(one).collect();
                let more = match places.len().saturating_sub(PLACES) {
                    0 => String::new(),
                    more => format!("; and {more} more"),
                };
                write!(
                    f,
                    "{rows} rows repeat the reading of the {} before them, in {} place{} ({}{more}): they are frozen and left out",
                    sensors.join(" and the "),
                    places.len(),
                    if places.len() == 1 { "" } else { "s" },
                    shown.join("; ")
                )
            }
            Self::Clipped {
                sensor,
                axis,
                limit,
                rows,
                from_row,
                to_row,
            } => write!(
                f,
                "{} {} is saturated at {} in {rows} of the rows {from_row} to {to_row}: its range ends there, \
                 and the signal is larger; set a larger range",
                sensor.name(),
                axes_in_words(&[*axis]),
                figure(*limit)
            ),
            Self::Quantised {
                sensor,
                axes,
                step,
                spread,
            } => write!(
                f,
                "the {} reads in steps of {step:.3e} on {}, wider than its noise ({spread:.1e}): no static \
                 mean is known better than a step over √12, {:.1e}",
                sensor.name(),
                axes_in_words(axes),
                step / 12f64.sqrt()
            ),
            Self::DeadZone {
                sensor,
                axes,
                share,
                least,
            } => {
                let (samples, unknown) = match *share > IN_TURNS {
                    true => (
                        format!("{:.0} % of the samples of static intervals", 100.0 * share),
                        "its bias and the errors",
                    ),
                    false => ("some samples of turns".into(), "the errors"),
                };
                write!(
                    f,
                    "the {} reads exactly zero on {} in {samples} and nothing between zero and {least:.2e}: a dead \
                     zone, or readings from a fusion filter; {unknown} of slow turns cannot be known, record the \
                     raw sensor",
                    sensor.name(),
                    axes_in_words(axes)
                )
            }
            Self::Rezeroed {
                sensor,
                after,
                size,
                intervals,
            } => write!(
                f,
                "the bias of the {} jumps {after:.1} s into the static intervals, by {size:.1e} (rms over {} of \
                 them): the device sets its zero anew while it rests; turns and rests are then read about \
                 different zeros, switch its own calibration off or record uncalibrated readings",
                sensor.name(),
                intervals.len()
            ),
            Self::Spikes {
                sensor,
                rows,
                axes,
                largest,
            } => write!(
                f,
                "{} single readings of the {} on {} leave their neighbours by up to {largest:.3e} and \
                 return (rows {}): transfer errors or knocks, replaced by the mean of their neighbours",
                rows.len(),
                sensor.name(),
                axes_in_words(axes),
                listed(rows)
            ),
            Self::Vibration {
                sensor,
                intervals,
                ratio,
                from_here_on,
            } => write!(
                f,
                "the {} is up to {ratio:.1} times noisier in static interval{} {} than in the others{}",
                sensor.name(),
                if intervals.len() == 1 { "" } else { "s" },
                listed(intervals),
                if *from_here_on {
                    ": from there on it vibrates (a fan, a motor), or the range or the filter was changed; switch that off, or \
                     split the recording there"
                } else {
                    ", as from vibration or a hand; lay the device down there too"
                }
            ),
            Self::HandHeld { rate } => write!(
                f,
                "the device never lies still (its rate wavers by {:.0} mrad/s in the quietest stretches, as in a \
                 hand): lay it down",
                1e3 * rate
            ),
        }
    }
}
