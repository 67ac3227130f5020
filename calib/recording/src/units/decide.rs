//! Units that nobody stated, told from the samples.

use super::direction::is_direction;
use super::rests::{rest_throughout, rests, sphere};
use super::turn_unit::{turn_unit, unit_change, wrong_by};
use crate::Error;
use crate::order_statistic::nth_smallest;
use crate::recording::{Stream, UnitBy};
use crate::shown::{shown, significant};
use crate::source::place::in_file;
use crate::units::{AccelUnit, GyroUnit, STANDARD_GRAVITY, values};
use findings::{Finding, Findings, Kind, OptionName, Remedy};
use sensor::Sensor;

findings::tuning! {
    /// Rates beyond this are no hand-held motion in rad/s (29 turns per second): the unit is another.
    FASTEST: f64 = 180.0;

    /// No gyroscope at rest is as noisy as 1.7 deg/s, root mean square of a sample: an MPU-6050 has 0.05 (data sheet 3.4,
    /// section 6.1).
    NOISIEST: f64 = 0.03;
    /// No gyroscope is so biased, rad/s: an MPU-6050 by at most 20 deg/s.
    MOST_BIASED: f64 = 0.7;

    /// An accelerometer that lies still has less noise than this share of gravity.
    SHAKEN: f64 = 0.02;

    /// Samples that show that a sensor only rests.
    ENOUGH_OF_A_REST: usize = 1000;
}

/// Gravity in g, in m/s², and in anything that is kept as counts.
const KNOWN: [std::ops::Range<f64>; 3] = [0.8..1.25, 7.5..12.5, 100.0..f64::INFINITY];

findings::tuning! {
    /// The median length is no shorter where gravity is in the readings, m/s²: a bias of half of it takes no more off.
    LEAST: f64 = 4.0;
    /// Samples looked at.
    LOOKED_AT: usize = 360_000;
}

/// Gravity in a unit as a share of what it should be, where another unit is offered.
const NEAR_GRAVITY: std::ops::Range<f64> = 0.88..1.14;

findings::tuning! {
    /// A length keeps its size where the middle half of the samples lies within this ratio.
    STEADY: f64 = 0.9;
}

/// Statements about a sensor's unit, by their source.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Said<'a, U> {
    /// By the user.
    pub given: Option<U>,
    /// By the file.
    pub stated: Option<U>,
    /// By the file, in words that are no known unit.
    pub strange: Option<&'a str>,
}

impl<U> Said<'_, U> {
    /// Who says the unit; the data where nobody does.
    pub fn by(&self) -> UnitBy {
        match (&self.given, &self.stated) {
            (Some(_), _) => UnitBy::Option,
            (_, Some(_)) => UnitBy::File,
            _ => UnitBy::Data,
        }
    }
}

/// Builds a finding about a sensor of the recording `name`.
fn told(kind: Kind, name: &str, sensor: Sensor) -> Finding {
    Finding::of(kind).in_recording(name).of_sensor(sensor)
}

/// The radius of the sphere that the means at rest lie on.
fn gravity_at_rest(stream: &Stream) -> Option<f64> {
    let values = &stream.values[..stream.len().min(LOOKED_AT.get())];
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
    warnings: &mut Findings,
) -> Result<AccelUnit, Error> {
    refuse_direction(name, stream)?;
    let stated = said.given.or(said.stated);
    // A bias of half of gravity hides it from the median, but not from the sphere that the rests lie on.
    let by_rests = gravity_at_rest(stream);
    let norm = by_rests.unwrap_or_else(|| median_norm(&stream.values));
    if let Some(unit) = stated.filter(|unit| *unit != AccelUnit::Counts) {
        refuse_other_gravity(name, stream, by_rests, unit, said.given.is_some())?;
    }
    let by_rests = by_rests.filter(|_| stated.is_none());
    if by_rests.is_some_and(|level| !KNOWN.iter().any(|range| range.contains(&level))) {
        let found = Finding::of(Kind::GRAVITY_OF_NO_UNIT).detail("radius", significant(norm, 4));
        let is_gravity =
            |unit: &AccelUnit| NEAR_GRAVITY.contains(&(norm * unit.scale() / STANDARD_GRAVITY));
        let fitting = AccelUnit::PHYSICAL.into_iter().find(is_gravity);
        return Err(in_file(
            name,
            match fitting {
                Some(unit) => found.only_remedies([Remedy::examples([
                    (OptionName::AccelUnit, unit.name()),
                    (OptionName::AccelUnit, AccelUnit::Counts.name()),
                ])]),
                None => found,
            },
        ));
    }
    let is_gravity = KNOWN[..2].iter().any(|range| range.contains(&norm));
    if let Some(strange) = said.strange.filter(|_| stated.is_none() && !is_gravity) {
        let unit = (OptionName::AccelUnit, "cm/s^2");
        return Err(unknown_unit(
            name,
            Sensor::Accelerometer,
            strange,
            unit,
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
            AccelUnit::G => warnings.push(
                told(Kind::UNIT_BY_GRAVITY, name, Sensor::Accelerometer)
                    .detail("unit", unit.name())
                    .number("norm", norm, "1"),
            ),
            AccelUnit::Counts => warnings.push(
                told(Kind::READ_AS_COUNTS, name, Sensor::Accelerometer)
                    .number("norm", norm, "1")
                    .remedy(Remedy::if_wrong([OptionName::AccelUnit])),
            ),
            _ => {}
        }
    }
    if unit != AccelUnit::Counts
        && norm * unit.scale() < LEAST.get()
        && stream.len() >= values::ENOUGH.get()
    {
        let removed = Finding::of(Kind::GRAVITY_REMOVED)
            .detail("norm", format!("{norm:.3}"))
            .detail("unit", unit.name());
        return Err(in_file(
            name,
            match stated {
                None => removed.remedy(Remedy::set(OptionName::AccelUnit)),
                Some(_) => removed,
            },
        ));
    }
    Ok(unit)
}

/// Refuses readings of one length in every row: their size was divided out, and with it what gravity says of them.
fn refuse_direction(name: &str, stream: &Stream) -> Result<(), Error> {
    let values = &stream.values[..stream.len().min(LOOKED_AT.get())];
    if values.len() < values::ENOUGH.get() || !is_direction(values) {
        return Ok(());
    }
    Err(in_file(
        name,
        Finding::of(Kind::NORMALISED)
            .detail("length", format!("{:.4}", median_norm(&stream.values))),
    ))
}

/// Refuses a unit in which gravity at rest would be another than the earth's, and names the one in which it is.
fn refuse_other_gravity(
    name: &str,
    stream: &Stream,
    by_rests: Option<f64>,
    unit: AccelUnit,
    given: bool,
) -> Result<(), Error> {
    let steady = || Some(median_norm(&stream.values)).filter(|_| keeps_its_length(&stream.values));
    let Some(radius) = by_rests.or_else(steady) else {
        return Ok(());
    };
    let in_unit = radius * unit.scale();
    if KNOWN[1].contains(&in_unit) {
        return Ok(());
    }
    let share = |unit: &AccelUnit| radius * unit.scale() / STANDARD_GRAVITY;
    let right = AccelUnit::PHYSICAL
        .into_iter()
        .find(|unit| NEAR_GRAVITY.contains(&share(unit)));
    let found = match right {
        Some(right) => Finding::of(Kind::GRAVITY_IN_OTHER_UNIT)
            .detail("right", right.name())
            .only_remedies([Remedy::set_to(OptionName::AccelUnit, right.name())]),
        // Readings about zero are those of a sensor without gravity, which is said elsewhere.
        None if by_rests.is_none() || in_unit < LEAST.get() / 4.0 => return Ok(()),
        None => {
            let ratio = in_unit / STANDARD_GRAVITY;
            Finding::of(Kind::GRAVITY_OFF).detail("ratio", format!("{ratio:.2}"))
        }
    };
    Err(in_file(
        name,
        found
            .detail("radius", format!("{radius:.4}"))
            .detail("unit", unit.name())
            .detail("by", if given { "the option" } else { "the file" }),
    ))
}

/// True where the readings of most rows have about one length.
fn keeps_its_length(values: &[nalgebra::Vector3<f64>]) -> bool {
    let length = |k: usize| {
        let norms = values.iter().map(nalgebra::Vector3::norm);
        nth_smallest(norms, values.len() * k / 4).unwrap_or(0.0)
    };
    values.len() >= values::ENOUGH.get() && length(1) > STEADY.get() * length(3)
}

/// Refuses a unit that is written in the file and not known, where the samples do not tell it either.
fn unknown_unit(
    name: &str,
    sensor: Sensor,
    unit: &str,
    (option, example): (OptionName, &str),
    column: &str,
) -> Error {
    let factor = format!("{column}=NAME*0.001");
    in_file(
        name,
        Finding::of(Kind::UNIT_STRANGE)
            .of_sensor(sensor)
            .detail("unit", shown(unit))
            .only_remedies([Remedy::examples([
                (option, example),
                (OptionName::Columns, &factor),
            ])]),
    )
}

/// False where one reading in two hundred is faster than a hand turns; spikes are fewer.
fn turns_as_a_hand(stream: &Stream, unit: GyroUnit) -> bool {
    let limit = FASTEST.get() / unit.scale();
    let faster = stream.values.iter().filter(|rate| rate.amax() > limit);
    unit == GyroUnit::Counts || 200 * faster.count() <= stream.len()
}

/// The gyroscope's unit and what tells it: stated, or told by the turns between rests, else assumed to be rad/s unless a hand
/// could not turn that fast.
///
/// # Errors
/// [`Error::Input`] where the file states a unit in which the turns are not those that the accelerometer saw.
pub(crate) fn gyro_unit(
    name: &str,
    stream: &Stream,
    accel: Option<&Stream>,
    said: Said<'_, GyroUnit>,
    warnings: &mut Findings,
) -> Result<(GyroUnit, UnitBy), Error> {
    let stated = said.given.or(said.stated);
    if let Some(change) = accel.and_then(|accel| unit_change(accel, stream)) {
        let ([from, to], [until, since]) = (change.units, change.between);
        let changes = told(Kind::RATE_UNIT_CHANGES, name, Sensor::Gyroscope)
            .detail("from", from.name())
            .detail("to", to.name())
            .number("until", until, "s")
            .number("since", since, "s");
        return Err(in_file(name, changes));
    }
    let by_turns = accel.and_then(|accel| turn_unit(accel, stream));
    if let Some(unit) = stated {
        let by = match said.given {
            Some(_) => "the option says",
            None => "the file states",
        };
        refuse_other_turns(name, stream, accel, by_turns, (unit, by))?;
        if by_turns.is_none() {
            refuse_restless_rest(name, stream, accel, unit)?;
        }
    }
    if let Some(unit) = said.given {
        return Ok((unit, UnitBy::Option));
    }
    if let Some(unit) = stated {
        return match turns_as_a_hand(stream, unit) {
            true => Ok((unit, UnitBy::File)),
            false => Err(in_file(
                name,
                Finding::of(Kind::TURNS_IMPOSSIBLE)
                    .detail("unit", unit.name())
                    .detail("fastest", format!("{} rad/s", FASTEST.get())),
            )),
        };
    }
    if let Some(strange) = said.strange.filter(|_| by_turns.is_none()) {
        let unit = (OptionName::GyroUnit, "deg/s");
        return Err(unknown_unit(name, Sensor::Gyroscope, strange, unit, "gx"));
    }
    let fastest = stream
        .values
        .iter()
        .map(nalgebra::Vector3::amax)
        .fold(0.0, f64::max);
    let integers = values::are_integers(stream.values.iter());
    let si = GyroUnit::RadiansPerSecond;
    let as_counts = || {
        told(Kind::READ_AS_COUNTS, name, Sensor::Gyroscope)
            .remedy(Remedy::if_wrong([OptionName::GyroUnit]))
    };
    if by_turns.is_none()
        && integers
        && let Some([bias, noise]) = rate_at_restless_rest(stream, accel, si)
    {
        warnings.push(as_counts().number("at_rest", bias.max(noise), "1"));
        return Ok((GyroUnit::Counts, UnitBy::Nothing));
    }
    if by_turns.is_none() {
        refuse_restless_rest(name, stream, accel, si)?;
    }
    let of = |kind: Kind, unit: GyroUnit| {
        told(kind, name, Sensor::Gyroscope).detail("unit", unit.name())
    };
    // Another unit, as mrad/s: in degrees the turns are not those that the accelerometer saw.
    let is_wrong = |unit| accel.is_some_and(|accel| wrong_by(accel, stream, unit).is_some());
    let (unit, told) = match (by_turns, fastest) {
        (Some(GyroUnit::RadiansPerSecond), _) => return Ok((si, UnitBy::Data)),
        (None, fastest) if fastest < FASTEST.get() => return Ok((si, UnitBy::Nothing)),
        (Some(GyroUnit::Counts), _) => (GyroUnit::Counts, as_counts()),
        (Some(unit), _) => (unit, of(Kind::UNIT_BY_TURNS, unit)),
        (None, ..5000.0) if !integers && !is_wrong(GyroUnit::DegreesPerSecond) => {
            let unit = GyroUnit::DegreesPerSecond;
            (
                unit,
                of(Kind::UNIT_BY_SIZE, unit).number("fastest", fastest, "1"),
            )
        }
        (None, _) => (
            GyroUnit::Counts,
            as_counts().number("fastest", fastest, "1"),
        ),
    };
    warnings.push(told);
    let by = match by_turns {
        Some(_) => UnitBy::Data,
        None => UnitBy::Nothing,
    };
    Ok((unit, by))
}

/// Refuses a unit in which the turns are not those that the accelerometer saw; `by` says who states it.
fn refuse_other_turns(
    name: &str,
    stream: &Stream,
    accel: Option<&Stream>,
    by_turns: Option<GyroUnit>,
    (unit, by): (GyroUnit, &str),
) -> Result<(), Error> {
    let Some(accel) = accel.filter(|_| unit.is_told()) else {
        return Ok(());
    };
    let found = match by_turns {
        Some(told) if told == unit => return Ok(()),
        Some(told) => Finding::of(Kind::TURNS_IN_OTHER_UNIT)
            .detail("told", told.name())
            .only_remedies([Remedy::such_as(OptionName::GyroUnit, told.name())]),
        None => match wrong_by(accel, stream, unit) {
            None => return Ok(()),
            Some(factor) => Finding::of(Kind::TURNS_OFF).number("factor", factor, "1"),
        },
    };
    let found = found.detail("by", by).detail("unit", unit.name());
    Err(in_file(name, found))
}

/// Returns true if an accelerometer is static from beginning to end: its noise is a small part of gravity.
fn lies_still(values: &[nalgebra::Vector3<f64>]) -> bool {
    rest_throughout(values).is_some_and(|(noise, mean)| noise < SHAKEN.get() * mean.norm())
}

/// Noise and bias in rad/s of a gyroscope that rests throughout, as the accelerometer beside it does, and would be no gyroscope
/// in `unit`.
fn rate_at_restless_rest(
    stream: &Stream,
    accel: Option<&Stream>,
    unit: GyroUnit,
) -> Option<[f64; 2]> {
    let lies_still = || accel.is_some_and(|accel| lies_still(&accel.values));
    if unit == GyroUnit::Counts || stream.len() < ENOUGH_OF_A_REST.get() || !lies_still() {
        return None;
    }
    let (noise, mean) = rest_throughout(&stream.values)?;
    let found = [noise, mean.amax()].map(|raw| raw * unit.scale());
    Some(found).filter(|[noise, bias]| *noise > NOISIEST.get() || *bias > MOST_BIASED.get())
}

/// Returns true if readings of a device that rests throughout are no gyroscope's in rad/s.
pub fn are_no_rates_at_rest(gyroscope: &Stream, accelerometer: &Stream) -> bool {
    rate_at_restless_rest(gyroscope, Some(accelerometer), GyroUnit::RadiansPerSecond).is_some()
}

/// Refuses such a gyroscope: no turn tells its unit.
fn refuse_restless_rest(
    name: &str,
    stream: &Stream,
    accel: Option<&Stream>,
    unit: GyroUnit,
) -> Result<(), Error> {
    let Some([noise, bias]) = rate_at_restless_rest(stream, accel, unit) else {
        return Ok(());
    };
    let other = match unit {
        GyroUnit::RadiansPerSecond => GyroUnit::DegreesPerSecond,
        _ => GyroUnit::Counts,
    };
    Err(in_file(
        name,
        Finding::of(Kind::RESTLESS_REST)
            .detail("unit", unit.name())
            .number("noise", noise, "rad/s")
            .number("bias", bias, "rad/s")
            .only_remedies([Remedy::such_as(OptionName::GyroUnit, other.name())]),
    ))
}

fn median_norm(values: &[nalgebra::Vector3<f64>]) -> f64 {
    let norms = values.iter().map(nalgebra::Vector3::norm);
    nth_smallest(norms, values.len() / 2).unwrap_or(0.0)
}

/// The length that most readings keep, where it is that of gravity in m/s² or in g.
pub(crate) fn length_of_gravity(values: &[nalgebra::Vector3<f64>]) -> Option<f64> {
    let length = median_norm(values);
    let is_gravity = KNOWN[..2].iter().any(|range| range.contains(&length));
    (is_gravity && keeps_its_length(values)).then_some(length)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn gravity_in_feet_is_known_by_its_length() {
        let noise = |k: usize| 1e-2 * (((k * k * 31 + 7 * k) % 101) as f64 / 50.0 - 1.0);
        let mut values = Vec::new();
        for place in 0..10 {
            let angle = f64::from(place);
            let up = Vector3::new(angle.sin(), (2.3 * angle).cos(), 0.4 - 0.1 * angle).normalize();
            for k in 0..500 {
                let turning = if k < 100 { (k as f64).sin() } else { 0.0 };
                let noise = Vector3::new(noise(k), noise(k + 7), noise(k + 31));
                values.push(32.17 * up + noise + Vector3::repeat(5.0 * turning));
            }
        }
        let stream = Stream {
            t: (0..values.len()).map(|k| 0.01 * k as f64).collect(),
            values,
        };
        let said = Said {
            given: None,
            stated: None,
            strange: None,
        };
        let refused = accel_unit("a.csv", &stream, said, &mut Findings::new()).unwrap_err();
        let text = refused.text(findings::Front::CommandLine);
        assert!(text.contains("--accel-unit ft/s^2"), "{text}");
        let given = Said {
            given: Some(AccelUnit::FeetPerSecondSquared),
            ..said
        };
        assert!(accel_unit("a.csv", &stream, given, &mut Findings::new()).is_ok());
    }
}
