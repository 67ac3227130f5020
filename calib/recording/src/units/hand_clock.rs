//! Clocks without a unit, against the pace at which a hand turns a device from rest to rest.

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;
use sensor::Sensor;

use super::rests::{rests, sphere};
use super::turn_unit::turn_unit;
use crate::Error;
use crate::averages::median;
use crate::recording::{Recording, Stream};
use crate::source::place::in_file;
use crate::units::{CLOCKS, TimeUnit};

findings::tuning! {
    /// No hand turns a device faster than this from rest to rest, over and over, rad/s.
    FASTEST: f64 = 2.5;
    /// No hand is as slow, rad/s.
    SLOWEST: f64 = 0.05;
    /// Turns that tilt less say little, rad.
    TILT: f64 = 0.4;
    /// Turns that tell a pace.
    FEWEST: usize = 5;
    /// A turn from rest to rest that takes longer is none by hand, s.
    LONGEST: f64 = 30.0;
    /// Directions to all sides have spans alike, to this share.
    ROUND: f64 = 0.3;
    /// Samples looked at.
    LOOKED_AT: usize = 360_000;
}

/// Rates of recordings of turns, Hz.
const RATES: std::ops::Range<f64> = 20.0..2000.0;

/// The turns from rest to rest: the usual one of their paces, rad/s, and of their durations, s.
struct Pace {
    speed: f64,
    duration: f64,
}

fn pace(accel: &Stream) -> Option<Pace> {
    let count = accel.len().min(LOOKED_AT.get());
    let values = &accel.values[..count];
    let rests = rests(values, values);
    let means: Vec<_> = rests.iter().map(|rest| rest.means[0]).collect();
    let centre = sphere(&means).map_or_else(|| offset(&means), |(centre, _)| centre);
    // A rest is known by its middle half.
    let margin = |at: usize| (rests[at].to - rests[at].from) / 2;
    let turns = (1..rests.len()).filter_map(|at| {
        let angle = (means[at - 1] - centre).angle(&(means[at] - centre));
        let from = rests[at - 1].to + margin(at - 1);
        let to = rests[at].from.saturating_sub(margin(at));
        let time = accel.t.get(to)? - accel.t.get(from)?;
        (angle > TILT.get() && time > 0.0).then_some((angle / time, time))
    });
    let turns: Vec<(f64, f64)> = turns.collect();
    (turns.len() >= FEWEST.get()).then_some(())?;
    Some(Pace {
        speed: median(turns.iter().map(|turn| turn.0))?,
        duration: median(turns.iter().map(|turn| turn.1))?,
    })
}

/// The middle of means that lie to one side of zero, as those of a converter without a sign do; else zero.
fn offset(means: &[Vector3<f64>]) -> Vector3<f64> {
    let Some(first) = means.first() else {
        return Vector3::zeros();
    };
    let low = means.iter().fold(*first, |low, mean| low.inf(mean));
    let high = means.iter().fold(*first, |high, mean| high.sup(mean));
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let is_round = half.min() > ROUND.get() * half.max();
    match is_round && middle.norm() > half.max() {
        true => middle,
        false => Vector3::zeros(),
    }
}

/// The clock in which the pace is a hand's, per second.
fn clock(step: f64, unit: TimeUnit, speed: f64) -> Option<f64> {
    let slower = |clock: &f64| {
        let change = clock / unit.per_second();
        (SLOWEST.get()..FASTEST.get()).contains(&(speed * change))
            && RATES.contains(&(change / step))
    };
    CLOCKS.into_iter().find(slower)
}

/// Refuses stamps whose unit was a guess and in which no hand would have turned the device: too fast for one where they count
/// something longer, too slowly where they count the rows.
///
/// # Errors
/// The clock that they may be of, or that they count the rows.
pub(crate) fn refuse(recording: &Recording) -> Result<(), Error> {
    let told = |kind: Kind| recording.warnings.iter().find(|own| own.kind == kind);
    let guessed = told(Kind::TIME_UNIT_TOLD).filter(|own| own.value("rate").is_some());
    let (Some(accel), true) = (
        &recording.accelerometer,
        guessed.is_some() || told(Kind::STAMPS_COUNT_ROWS).is_some(),
    ) else {
        return Ok(());
    };
    // Turns that are those that the gyroscope saw were not faster.
    let gyro = recording.gyroscope.as_ref();
    if gyro.is_some_and(|gyro| turn_unit(accel, gyro).is_some()) {
        return Ok(());
    }
    let Some(pace) = pace(accel) else {
        return Ok(());
    };
    let described = recording.description.of(Sensor::Accelerometer);
    let source = described.map_or(&recording.name, |own| &own.source);
    let Some(guessed) = guessed else {
        return match pace.duration > LONGEST.get() {
            true => Err(in_file(source, Finding::of(Kind::STAMPS_BY_ONE))),
            false => Ok(()),
        };
    };
    let unit = guessed.word("unit").and_then(|unit| unit.parse().ok());
    let (Some(unit), Some(step)) = (unit, accel.median_step()) else {
        return Ok(());
    };
    let other = clock(step, unit, pace.speed).filter(|_| pace.speed > FASTEST.get());
    let Some(clock) = other else { return Ok(()) };
    let found = Finding::of(Kind::TIME_UNIT_TOO_FAST)
        .detail("unit", unit.name())
        .detail("speed", format!("{:.0}°/s", pace.speed.to_degrees()));
    let by_clock = described.map_or_else(String::new, |own| own.by_clock(clock));
    Err(in_file(
        source,
        found.only_remedies([Remedy::examples([
            (OptionName::Columns, by_clock.as_str()),
            (OptionName::TimeUnit, unit.name()),
        ])]),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Unit};

    /// Twelve rests of 4 s and turns of 1.5 s at 50 Hz, stamped by `stamp` of the row.
    fn recording(header: &str, stamp: impl Fn(usize) -> String) -> Result<Recording, Error> {
        with_offset(header, 0.0, stamp)
    }

    /// The same in counts of a converter whose zero is at `offset`.
    fn with_offset(
        header: &str,
        offset: f64,
        stamp: impl Fn(usize) -> String,
    ) -> Result<Recording, Error> {
        let mut text = format!("{header},ax,ay,az\n");
        let mut attitude = Rotation3::identity();
        for k in 0..12 * 275 {
            let (place, at) = (k / 275, k % 275);
            let axis = Unit::new_normalize(Vector3::new(
                1.0,
                (place % 3) as f64 - 1.0,
                place as f64 * 0.1,
            ));
            if at >= 200 {
                attitude = Rotation3::from_axis_angle(&axis, 1.6 / 75.0) * attitude;
            }
            let noise = Vector3::from_fn(|i, _| 0.01 * ((k * (7 + 3 * i)) as f64).sin());
            let f = attitude * Vector3::z() * 9.8 + noise + Vector3::repeat(offset);
            text += &format!("{},{:.4},{:.4},{:.4}\n", stamp(k), f.x, f.y, f.z);
        }
        Recording::from_bytes("a.csv", text.as_bytes(), &Default::default())
    }

    #[test]
    fn hundredths_and_ticks_are_asked_about_with_the_clock_that_makes_a_hand_of_it() {
        for (per_row, expected) in [(2, "t=stamp/100"), (655, "t=stamp/32768")] {
            let found = recording("stamp", |k| (k * per_row).to_string());
            let words = found.unwrap_err().text(findings::Front::CommandLine);
            assert!(words.contains(expected), "{words}");
        }
        let found = with_offset("stamp", 240.0, |k| (k * 655).to_string());
        let words = found.unwrap_err().text(findings::Front::CommandLine);
        assert!(words.contains("t=stamp/32768"), "{words}");
        for per_row in [20, 20_000] {
            recording("stamp", |k| (k * per_row).to_string()).unwrap();
        }
    }

    #[test]
    fn stamps_that_count_rows_are_told_by_turns_of_a_minute() {
        let found = recording("t", |k| k.to_string()).unwrap_err();
        let words = found.text(findings::Front::CommandLine);
        assert!(words.contains("--rate"), "{words}");
    }
}
