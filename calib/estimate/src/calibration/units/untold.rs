//! The gyroscope's unit in a recording that does not tell it, by the recordings of the calibration.

use std::borrow::Cow;

use findings::{Finding, Kind, OptionName, Remedy};
use recording::{Error, GyroUnit, Recording, UnitBy};
use sensor::Sensor;

use crate::calibration::{Calibration, SensorInput};

/// Carries the gyroscope of a recording whose unit nothing tells to the unit that the calibration's recordings had. A logger
/// that names no unit writes all its files in the same.
///
/// # Errors
/// [`Error::Input`] where the files of the calibration named another unit than this one was assumed to have: it is of another
/// kind, and its unit may be either.
pub fn in_unit_of<'a>(
    calibration: &Calibration,
    recording: Cow<'a, Recording>,
) -> Result<Cow<'a, Recording>, Error> {
    let mut sensors = recording.description.sensors.iter();
    let untold =
        sensors.position(|own| own.sensor == Sensor::Gyroscope && own.unit_by == UnitBy::Nothing);
    let (Some(place), Some((unit, by))) = (untold, unit_of_files(calibration)) else {
        return Ok(recording);
    };
    let assumed = recording.description.sensors[place].unit;
    if by == UnitBy::File.name() && assumed != unit.name() {
        let remedy = Remedy::set_to(OptionName::GyroUnit, unit.name());
        let found = found(Kind::UnitUntold, &recording, unit).only_remedies([remedy]);
        return Err(Error::input(found));
    }
    let factor = unit.scale() / assumed.parse().map_or(1.0, GyroUnit::scale);
    Ok(Cow::Owned(taken_as(
        unit,
        recording.into_owned(),
        (place, factor),
    )))
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

/// The recording with a gyroscope in `unit`, which is described at `place`; its readings grow by `factor`.
fn taken_as(unit: GyroUnit, mut recording: Recording, (place, factor): (usize, f64)) -> Recording {
    let guesses = [Kind::UnitAssumed, Kind::UnitBySize, Kind::ReadAsCounts];
    recording.warnings.retain(|own| {
        !(guesses.contains(&own.kind) && own.place.sensor == Some(Sensor::Gyroscope))
    });
    let described = &mut recording.description.sensors[place];
    described.unit_by = UnitBy::Data;
    if described.unit != unit.name() {
        described.unit = unit.name();
        let said = found(Kind::UnitOfCalibration, &recording, unit);
        recording.warnings.push(said);
    }
    if let Some(stream) = &mut recording.gyroscope {
        let values = stream.values.iter_mut();
        values.for_each(|rate| *rate *= factor);
    }
    recording
}

fn found(kind: Kind, recording: &Recording, unit: GyroUnit) -> Finding {
    let found = Finding::of(kind).in_recording(&recording.name);
    found
        .of_sensor(Sensor::Gyroscope)
        .detail("unit", unit.name())
}
