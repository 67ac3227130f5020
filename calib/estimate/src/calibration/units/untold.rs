//! The gyroscope's unit in a recording that does not tell it, by the recordings of the calibration.

use std::borrow::Cow;

use findings::{Finding, Kind, OptionName, Remedy};
use nalgebra::Vector3;
use recording::averages::median;
use recording::{Described, Error, GyroUnit, Recording, UnitBy};
use sensor::Sensor;

use crate::calibration::{Calibration, SensorInput};

findings::tuning! {
    /// The usual largest range of a gyroscope is 2000 °/s: beyond this, rad/s, a unit that nothing told is another.
    FASTEST: f64 = 40.0;

    /// Readings at rest that differ by less than this share of a bias are that bias.
    SAME_BIAS: f64 = 0.3;
}

/// Reads a recording for a calibration. `read` takes the unit of the gyroscope that is to be assumed.
///
/// # Errors
/// As `read` and [`in_unit_of`].
pub fn read_in_unit_of(
    calibration: &Calibration,
    read: impl Fn(Option<GyroUnit>) -> Result<Recording, Error>,
) -> Result<Recording, Error> {
    let error = match read(None) {
        Ok(recording) => {
            let mut recording = in_unit_of(calibration, Cow::Owned(recording))?.into_owned();
            let assumed = recording.unit_assumed();
            recording.warnings.extend(assumed);
            return Ok(recording);
        }
        Err(error) => error,
    };
    // A device that only rests is refused where its rates are none in rad/s.
    let (true, Some((unit, by))) = (
        error.finding().kind == Kind::RESTLESS_REST,
        unit_of_files(calibration),
    ) else {
        return Err(error);
    };
    let mut recording = read(Some(unit))?;
    if by == UnitBy::File.name() || !is_of_same_logger(calibration, &recording) {
        return Err(error);
    }
    let said = found(Kind::UNIT_OF_CALIBRATION, &recording, unit);
    recording.warnings.push(said);
    Ok(recording)
}

/// Carries the gyroscope of a recording whose unit nothing tells to the unit that the calibration's recordings had, where it is
/// of the same logger: one that names no unit writes all its files in the same.
///
/// # Errors
/// [`Error::Input`] where the recording is of another kind and the unit of the calibration's files is not the assumed one: it may be
/// either.
pub fn in_unit_of<'a>(
    calibration: &Calibration,
    recording: Cow<'a, Recording>,
) -> Result<Cow<'a, Recording>, Error> {
    let described = recording.description.of(Sensor::Gyroscope);
    let untold = described.filter(|own| own.unit_by == UnitBy::Nothing);
    let (Some(untold), Some((unit, by))) = (untold, unit_of_files(calibration)) else {
        return Ok(recording);
    };
    if by != UnitBy::File.name() && is_of_same_logger(calibration, &recording) {
        let taken = taken_as(unit, recording.into_owned());
        let untold = || found(Kind::UNIT_UNTOLD, &taken, unit);
        if fastest(calibration, &taken) > FASTEST.get() {
            return Err(Error::input(untold().detail("faster", unit.name())));
        }
        if rests_in_degrees(calibration, &taken) {
            let degrees = GyroUnit::DegreesPerSecond.name();
            return Err(Error::input(untold().detail("still", degrees)));
        }
        return Ok(Cow::Owned(taken));
    }
    if untold.unit == unit.name() {
        return Ok(recording);
    }
    let remedy = Remedy::set_to(OptionName::GyroUnit, unit.name());
    let found = found(Kind::UNIT_UNTOLD, &recording, unit).detail("other", unit.name());
    Err(Error::input(found.only_remedies([remedy])))
}

/// The largest rate by the calibration, rad/s: its `T` carries counts to rates.
fn fastest(calibration: &Calibration, recording: &Recording) -> f64 {
    let own = calibration.triad(Sensor::Gyroscope);
    let scale = own.map_or(1.0, |own| own.base().scale());
    let rates = recording.gyroscope.iter().flat_map(|stream| &stream.values);
    scale * rates.map(Vector3::amax).fold(0.0, f64::max)
}

/// Returns true if the middle readings are those of the calibration's bias in °/s where it is in rad/s: of a device that mostly rests.
fn rests_in_degrees(calibration: &Calibration, recording: &Recording) -> bool {
    let (Some(own), Some(stream)) = (calibration.triad(Sensor::Gyroscope), &recording.gyroscope)
    else {
        return false;
    };
    let axes = [0, 1, 2].map(|axis| median(stream.values.iter().map(|value| value[axis])));
    let [Some(x), Some(y), Some(z)] = axes else {
        return false;
    };
    let (bias, middle) = (own.base().bias, Vector3::new(x, y, z));
    (middle.map(f64::to_radians) - bias).norm() < SAME_BIAS.get() * bias.norm()
}

/// The unit of the gyroscope in the files that a calibration was made from, and what told it there; `None` where they differ.
fn unit_of_files(calibration: &Calibration) -> Option<(GyroUnit, &str)> {
    let inputs = calibration.provenance.inputs.iter();
    let mut own = inputs.filter_map(|input| input.sensor(Sensor::Gyroscope));
    let unit_of = |input: &SensorInput| input.file_unit.as_deref()?.parse::<GyroUnit>().ok();
    let first = own.next()?;
    let unit = unit_of(first)?;
    let by = first.file_unit_by.as_deref()?;
    own.all(|input| unit_of(input) == Some(unit))
        .then_some((unit, by))
}

/// True where the files of a calibration have the format of this one and the same names of the gyroscope's columns.
fn is_of_same_logger(calibration: &Calibration, recording: &Recording) -> bool {
    let description = &recording.description;
    let Some(axes) = description.of(Sensor::Gyroscope).map(Described::axes) else {
        return false;
    };
    calibration.provenance.inputs.iter().all(|input| {
        let own = input.sensor(Sensor::Gyroscope);
        let same_format = input.format.as_deref() == Some(description.format);
        own.is_none_or(|own| same_format && own.columns == axes)
    })
}

/// The recording with a gyroscope in `unit` instead of the assumed one.
fn taken_as(unit: GyroUnit, mut recording: Recording) -> Recording {
    let guesses = [Kind::UNIT_BY_SIZE, Kind::READ_AS_COUNTS];
    recording.warnings.retain(|own| {
        !(guesses.contains(&own.kind) && own.place.sensor == Some(Sensor::Gyroscope))
    });
    let said = found(Kind::UNIT_OF_CALIBRATION, &recording, unit);
    let mut sensors = recording.description.sensors.iter_mut();
    let Some(own) = sensors.find(|own| own.sensor == Sensor::Gyroscope) else {
        return recording;
    };
    let assumed = std::mem::replace(&mut own.unit, unit.name());
    own.unit_by = UnitBy::Data;
    if assumed != unit.name() {
        let factor = unit.scale() / assumed.parse().map_or(1.0, GyroUnit::scale);
        let rates = recording.gyroscope.iter_mut();
        let rates = rates.flat_map(|stream| &mut stream.values);
        rates.for_each(|rate| *rate *= factor);
        recording.warnings.push(said);
    }
    recording
}

fn found(kind: Kind, recording: &Recording, unit: GyroUnit) -> Finding {
    let found = Finding::of(kind).in_recording(&recording.name);
    found
        .of_sensor(Sensor::Gyroscope)
        .detail("unit", unit.name())
}
