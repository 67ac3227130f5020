//! Symptoms of faults in the readings, in numbers.

use findings::{Finding, Kind};
use sensor::Sensor;

use crate::recording::Recording;

findings::tuning! {
    /// Most rows or intervals that a sentence lists.
    LISTED: usize = 8;

    /// Fewer zeros at rest than this share are those of turns.
    IN_TURNS: f64 = 0.005;
}

/// Symptom of a fault in a sensor's readings. Values are in the unit of the readings, times in s. Rows are counted as the lines of a
/// table with one line of header: the first sample is row 2.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Symptom {
    /// An axis is cut off at the end of its range.
    Clipped {
        /// The sensor.
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
        sensor: Sensor,
        /// Rows, in order.
        rows: Vec<usize>,
        /// Their times, s.
        times: Vec<f64>,
        /// Axes on which they stand out, 0 to 2.
        axes: Vec<usize>,
        /// The farthest one's distance from its neighbours.
        largest: f64,
    },
    /// Some static intervals are far noisier than the others.
    Vibration {
        /// The sensor.
        sensor: Sensor,
        /// The intervals, counted from 1.
        intervals: Vec<usize>,
        /// The spread of the noisiest over that of the usual one.
        ratio: f64,
        /// True if these are all intervals from one on to the end, or from the first to one, and equally noisy.
        from_here_on: bool,
    },
    /// The readings swing with one period in most static intervals.
    Swing {
        /// The sensor.
        sensor: Sensor,
        /// The period, s.
        period: f64,
        /// Amplitude of the swing, over the axes.
        size: f64,
    },
    /// The device turns slowly in many static intervals: both sensors agree on it.
    RestsTurn {
        /// The intervals, counted from 1.
        intervals: Vec<usize>,
        /// Number of intervals that were looked at.
        of: usize,
        /// Angle by which the direction of gravity moves in the middle one, rad.
        angle: f64,
        /// Length of the middle one, s.
        length: f64,
    },
    /// The rate wavers in the quietest stretches as in a hand.
    HandHeld {
        /// Root mean square of the wavering rate, rad/s.
        rate: f64,
    },
}

pub(super) fn axes_in_words(axes: &[usize]) -> String {
    let names: Vec<&str> = axes
        .iter()
        .filter_map(|&k| ["x", "y", "z"].get(k).copied())
        .collect();
    names.join(", ")
}

/// `3002, 6002; t = 30.00, 60.00 s`.
fn rows_and_times(rows: &[usize], times: &[f64]) -> String {
    let times = times.iter().take(LISTED.get()).map(|t| format!("{t:.2}"));
    let times: Vec<String> = times.collect();
    format!("{}; t = {} s", listed(rows), times.join(", "))
}

fn listed(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers
        .iter()
        .take(LISTED.get())
        .map(usize::to_string)
        .collect();
    match numbers.len().saturating_sub(LISTED.get()) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

impl Symptom {
    /// The finding with its place and in the unit of a recording's readings.
    pub fn in_recording(&self, recording: &Recording) -> Finding {
        let unit = |sensor: Sensor| match recording.is_in_counts(sensor) {
            true => "counts",
            false => si(sensor),
        };
        self.typed(unit).in_recording(&recording.name)
    }

    /// The finding where `unit` is that of a sensor's readings.
    fn typed(&self, unit: impl Fn(Sensor) -> &'static str) -> Finding {
        let of = |kind: Kind, sensor: Sensor| Finding::of(kind).of_sensor(sensor);
        match self {
            Self::Clipped {
                sensor,
                axis,
                limit,
                rows,
                from_row,
                to_row,
            } => of(Kind::SATURATED, *sensor)
                .detail("axis", axes_in_words(&[*axis]))
                .number("limit", *limit, unit(*sensor))
                .count("rows", *rows)
                .count("from_row", *from_row)
                .count("to_row", *to_row),
            Self::Quantised {
                sensor,
                axes,
                step,
                spread,
            } => of(Kind::QUANTISED, *sensor)
                .detail("axes", axes_in_words(axes))
                .number("step", *step, unit(*sensor))
                .number("noise", *spread, unit(*sensor))
                .number("error", step / 12f64.sqrt(), unit(*sensor))
                .affects("corrected_reading", step / 12f64.sqrt(), unit(*sensor)),
            Self::DeadZone {
                sensor,
                axes,
                share,
                least,
            } => {
                let found = of(Kind::DEAD_ZONE, *sensor)
                    .detail("axes", axes_in_words(axes))
                    .number("least", *least, unit(*sensor))
                    .affects("corrected_reading", *least, unit(*sensor));
                match *share > IN_TURNS.get() {
                    true => found.number("share", *share, "share"),
                    false => found,
                }
            }
            Self::Rezeroed {
                sensor,
                after,
                size,
                intervals,
            } => of(Kind::REZEROED, *sensor)
                .number("after", *after, "s")
                .number("size", *size, unit(*sensor))
                .count("intervals", intervals.len())
                .affects("corrected_reading", *size, unit(*sensor)),
            Self::Spikes {
                sensor,
                rows,
                times,
                axes,
                largest,
            } => of(Kind::SPIKES, *sensor)
                .count("count", rows.len())
                .number("largest", *largest, unit(*sensor))
                .detail("axes", axes_in_words(axes))
                .detail("listed", rows_and_times(rows, times)),
            Self::Vibration {
                sensor,
                intervals,
                ratio,
                from_here_on,
            } => {
                let kind = match from_here_on {
                    true => Kind::NOISE_CHANGED,
                    false => Kind::VIBRATION,
                };
                let plural = if intervals.len() == 1 { "" } else { "s" };
                let called = format!("static interval{plural} {}", listed(intervals));
                of(kind, *sensor)
                    .number("ratio", *ratio, "1")
                    .detail("intervals", called)
            }
            Self::Swing {
                sensor,
                period,
                size,
            } => of(Kind::RESTS_SWING, *sensor)
                .number("period", *period, "s")
                .number("size", *size, unit(*sensor)),
            Self::RestsTurn {
                intervals,
                of,
                angle,
                length,
            } => Finding::of(Kind::RESTS_TURN)
                .count("count", intervals.len())
                .count("of", *of)
                .number("angle", *angle, "rad")
                .number("length", *length, "s"),
            Self::HandHeld { rate } => Finding::of(Kind::HAND_HELD).number("rate", *rate, "rad/s"),
        }
    }
}

/// The unit of a sensor's readings that are no counts.
fn si(sensor: Sensor) -> &'static str {
    match sensor {
        Sensor::Accelerometer => "m/s^2",
        Sensor::Gyroscope => "rad/s",
        Sensor::Magnetometer => "µT",
    }
}

impl From<&Symptom> for Finding {
    /// The finding of readings in m/s² and rad/s.
    fn from(symptom: &Symptom) -> Self {
        symptom.typed(si)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Described, UnitBy};

    #[test]
    fn steps_are_shown_in_the_unit_of_the_readings() {
        let found = Symptom::Quantised {
            sensor: Sensor::Gyroscope,
            axes: vec![0, 2],
            step: 0.0349,
            spread: 0.01,
        };
        let text = Finding::from(&found).to_string();
        assert!(text.contains("in steps of 2 °/s on x, z"), "{text}");
        let mut recording = Recording {
            name: "r".into(),
            ..Recording::default()
        };
        let typed = found.in_recording(&recording);
        assert_eq!(typed.place.recording.as_deref(), Some("r"));
        assert!(typed.severity() > 1.0, "{}", typed.severity());
        recording.description.sensors.push(Described {
            sensor: Sensor::Gyroscope,
            source: String::new(),
            columns: Vec::new(),
            unused: Vec::new(),
            unit: "counts",
            unit_by: UnitBy::File,
            turned: false,
            flipped: Vec::new(),
        });
        let typed = found.in_recording(&recording);
        assert_eq!(typed.numbers[0].unit, "counts");
    }
}
