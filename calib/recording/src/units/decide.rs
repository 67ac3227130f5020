//! Units that nobody stated, told from the samples.

use super::rests::{rest_throughout, rests, sphere};
use super::turn_unit::{turn_unit, wrong_by};
use crate::Error;
use crate::order_statistic::nth_smallest;
use crate::recording::Stream;
use crate::shown::shown;
use crate::source::place::in_file;
use crate::units::{AccelUnit, GyroUnit, values};

/// Rates beyond this are no hand-held motion in rad/s (29 turns per second): the unit is another.
const FASTEST: f64 = 180.0;

/// No gyroscope at rest is as noisy as 1.7 deg/s, root mean square of a sample: an MPU-6050 has 0.05 (data sheet 3.4,
/// section 6.1).
const NOISIEST: f64 = 0.03;
/// No gyroscope is so biased, rad/s: an MPU-6050 by at most 20 deg/s.
const MOST_BIASED: f64 = 0.7;

/// An accelerometer that lies still has less noise than this share of gravity.
const SHAKEN: f64 = 0.02;

/// Samples that show that a sensor only rests.
const ENOUGH_OF_A_REST: usize = 1000;

/// Gravity in g, in m/s², and in anything that is kept as counts.
const KNOWN: [std::ops::Range<f64>; 3] = [0.8..1.25, 7.5..12.5, 100.0..f64::INFINITY];
/// The median length is no shorter where gravity is in the readings, m/s²: a bias of half of it takes no more off.
const LEAST: f64 = 4.0;
/// Samples looked at.
const LOOKED_AT: usize = 360_000;

/// What is said of a sensor's unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Said<'a, U> {
    /// By the user.
    pub given: Option<U>,
    /// By the file.
    pub stated: Option<U>,
    /// By the file, in words that are no known unit.
    pub strange: Option<&'a str>,
}

/// The radius of the sphere that the means at rest lie on.
fn gravity_at_rest(stream: &Stream) -> Option<f64> {
    let values = &stream.values[..stream.len().min(LOOKED_AT)];
    let rests = rests(values, values);
    let means: Vec<_> = rests.iter().map(|rest| rest.means[0]).collect();
    sphere(&means).map(|(_, radius)| radius)
}

/// The accelerometer's unit: stated, or told by the size of gravity, the median length of a sample.
///
/// # Errors
/// [`Error::Input`] where a recording in known units lacks gravity.
pub(crate) fn accel_unit(
    name: &str,
    stream: &Stream,
    said: Said<'_, AccelUnit>,
    warnings: &mut Vec<String>,
) -> Result<AccelUnit, Error> {
    let stated = said.given.or(said.stated);
    // A bias of half of gravity hides it from the median, but not from the sphere that the rests lie on.
    let by_rests = stated.is_none().then(|| gravity_at_rest(stream)).flatten();
    let norm = by_rests.unwrap_or_else(|| median_norm(stream));
    if by_rests.is_some_and(|level| !KNOWN.iter().any(|range| range.contains(&level))) {
        return Err(in_file(
            name,
            format!(
                "at rest the accelerometer's readings lie on a sphere of radius {norm:.3}, which is gravity in no unit that is known; say the unit, as in --accel-unit m/s^2, or --accel-unit counts to keep them"
            ),
        ));
    }
    let is_gravity = KNOWN[..2].iter().any(|range| range.contains(&norm));
    if let Some(strange) = said.strange.filter(|_| stated.is_none() && !is_gravity) {
        return Err(unknown_unit(
            name,
            "accelerometer",
            strange,
            "--accel-unit cm/s^2",
            "ax",
        ));
    }
    let unit = stated.unwrap_or(match norm {
        0.8..1.25 => AccelUnit::G,
        0.0..100.0 => AccelUnit::MetresPerSecondSquared,
        _ => AccelUnit::Counts,
    });
    if stated.is_none() {
        match unit {
            AccelUnit::G => warnings.push(format!(
                "{name}: accelerometer taken as g (its median length is {norm:.3}); --accel-unit overrides"
            )),
            AccelUnit::Counts => warnings.push(format!(
                "{name}: accelerometer taken as raw counts (its median length is {norm:.1}) and kept as they are; --accel-unit mg or cm/s^2 overrides"
            )),
            _ => {}
        }
    }
    if unit != AccelUnit::Counts && norm * unit.scale() < LEAST && stream.len() >= values::ENOUGH {
        return Err(in_file(
            name,
            format!(
                "the accelerometer's median length is {norm:.3} {}: gravity has been removed, and calibration needs it; record the accelerometer with gravity (\"total\", \"uncalibrated\" or \"with g\"){}",
                unit.name(),
                if stated.is_none() {
                    ", or state its unit with --accel-unit"
                } else {
                    ""
                }
            ),
        ));
    }
    Ok(unit)
}

/// Refuses a unit that is written in the file and not known, where the samples do not tell it either.
fn unknown_unit(name: &str, sensor: &str, unit: &str, option: &str, column: &str) -> Error {
    in_file(
        name,
        format!(
            "the file states {} for the {sensor}, which is no known unit, and the readings do not tell it; say the unit, as in {option}, or what one of it is, as in --columns {column}=NAME*0.001",
            shown(unit)
        ),
    )
}

/// False where one reading in two hundred is faster than a hand turns; spikes are fewer.
fn turns_as_a_hand(stream: &Stream, unit: GyroUnit) -> bool {
    let limit = FASTEST / unit.scale();
    let faster = stream.values.iter().filter(|rate| rate.amax() > limit);
    unit == GyroUnit::Counts || 200 * faster.count() <= stream.len()
}

/// The gyroscope's unit: stated, or told by the turns between rests, else rad/s unless a hand could not turn that
/// fast.
///
/// # Errors
/// [`Error::Input`] where the file states a unit in which the turns are not those that the accelerometer saw.
pub(crate) fn gyro_unit(
    name: &str,
    stream: &Stream,
    accel: Option<&Stream>,
    said: Said<'_, GyroUnit>,
    warnings: &mut Vec<String>,
) -> Result<GyroUnit, Error> {
    if let Some(unit) = said.given {
        return Ok(unit);
    }
    let stated = said.stated;
    let by_turns = accel.and_then(|accel| turn_unit(accel, stream));
    if let (Some(stated), Some(told)) = (stated.filter(|unit| unit.is_told()), by_turns)
        && stated != told
    {
        return Err(in_file(
            name,
            format!(
                "the file states {} for the gyroscope, but its turns are those that the accelerometer saw in {}; say the unit, as in --gyro-unit {}",
                stated.name(),
                told.name(),
                told.name()
            ),
        ));
    }
    if let (Some(stated), Some(accel), None) =
        (stated.filter(|unit| unit.is_told()), accel, by_turns)
        && let Some(factor) = wrong_by(accel, stream, stated)
    {
        return Err(in_file(
            name,
            format!(
                "the file states {} for the gyroscope, but its turns went about {factor:.2} times as far by what the accelerometer saw: the unit is another, or that of the time; say which, as in --time-unit us, --gyro-unit counts, or --columns t=NAME for another clock",
                stated.name()
            ),
        ));
    }
    if let Some(unit) = stated {
        return match turns_as_a_hand(stream, unit) {
            true => Ok(unit),
            false => Err(in_file(
                name,
                format!(
                    "the file states {} for the gyroscope, and it would turn faster than {FASTEST:.0} rad/s again and again; say the unit, as in --gyro-unit counts",
                    unit.name()
                ),
            )),
        };
    }
    if let Some(strange) = said.strange.filter(|_| by_turns.is_none()) {
        return Err(unknown_unit(
            name,
            "gyroscope",
            strange,
            "--gyro-unit deg/s",
            "gx",
        ));
    }
    let fastest = stream
        .values
        .iter()
        .map(nalgebra::Vector3::amax)
        .fold(0.0, f64::max);
    let integers = values::are_integers(stream.values.iter());
    if by_turns.is_none() && rate_at_restless_rest(stream, accel).is_some() && integers {
        warnings.push(format!(
            "{name}: gyroscope taken as raw counts, kept as they are (whole numbers, and no gyroscope at rest reads that much in \
             rad/s); --gyro-unit overrides"
        ));
        return Ok(GyroUnit::Counts);
    }
    if by_turns.is_none() {
        refuse_restless_rest(name, stream, accel)?;
    }
    let (unit, why) = match (by_turns, fastest) {
        (Some(GyroUnit::RadiansPerSecond), _) => return Ok(GyroUnit::RadiansPerSecond),
        (Some(unit), _) => (
            unit,
            "read so, its turns are those that the accelerometer saw".to_owned(),
        ),
        (None, 0.0..FASTEST) => return Ok(GyroUnit::RadiansPerSecond),
        (None, _) if integers => (GyroUnit::Counts, format!("it reaches {fastest:.0}")),
        (None, FASTEST..5000.0) => (
            GyroUnit::DegreesPerSecond,
            format!("it reaches {fastest:.0}"),
        ),
        (None, _) => (GyroUnit::Counts, format!("it reaches {fastest:.0}")),
    };
    let words = match unit {
        GyroUnit::Counts => "raw counts, kept as they are",
        GyroUnit::DegreesPerSecond => "deg/s, degrees per second",
        unit => unit.name(),
    };
    warnings.push(format!(
        "{name}: gyroscope taken as {words} ({why}); --gyro-unit overrides"
    ));
    Ok(unit)
}

/// Whether an accelerometer rests from beginning to end, its noise a small part of gravity.
fn lies_still(values: &[nalgebra::Vector3<f64>]) -> bool {
    rest_throughout(values).is_some_and(|(noise, mean)| noise < SHAKEN * mean.norm())
}

/// Noise and mean of a gyroscope that rests throughout, as the accelerometer beside it does, and would be no gyroscope in
/// rad/s.
fn rate_at_restless_rest(
    stream: &Stream,
    accel: Option<&Stream>,
) -> Option<(f64, nalgebra::Vector3<f64>)> {
    if stream.len() < ENOUGH_OF_A_REST || accel.is_none_or(|accel| !lies_still(&accel.values)) {
        return None;
    }
    rest_throughout(&stream.values)
        .filter(|(noise, mean)| *noise > NOISIEST || mean.amax() > MOST_BIASED)
}

/// Refuses such a gyroscope: no turn tells its unit.
fn refuse_restless_rest(name: &str, stream: &Stream, accel: Option<&Stream>) -> Result<(), Error> {
    let Some((noise, mean)) = rate_at_restless_rest(stream, accel) else {
        return Ok(());
    };
    Err(in_file(
        name,
        format!(
            "the gyroscope rests throughout, so that no turn tells its unit, and in rad/s its noise would be {:.1} and its bias {:.1} deg/s, as no gyroscope has; say the unit, as in --gyro-unit deg/s",
            noise.to_degrees(),
            mean.amax().to_degrees()
        ),
    ))
}

fn median_norm(stream: &Stream) -> f64 {
    let norms = stream.values.iter().map(nalgebra::Vector3::norm);
    nth_smallest(norms, stream.len() / 2).unwrap_or(0.0)
}
