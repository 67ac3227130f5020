//! Check that a recording has the signs that a calibration is for.

use findings::{Finding, Kind, OptionName, Remedy};
use recording::{Error, Recording};
use sensor::Sensor;

use crate::calibration::Calibration;

impl Calibration {
    /// Returns the axes of a sensor that its recordings were read with the other sign, as `gx`; `None` where they differ, or
    /// where nobody wrote down how they were read.
    pub fn flipped(&self, sensor: Sensor) -> Option<&[String]> {
        let inputs = self.provenance.inputs.iter();
        let mut inputs = inputs.filter_map(|input| input.sensor(sensor));
        let first = inputs.next()?;
        let is_known = first.file_unit.is_some();
        let is_same = inputs.all(|input| input.flipped == first.flipped);
        (is_known && is_same).then_some(&first.flipped[..])
    }

    /// Says that the calibration is for readings with flipped axes.
    pub fn for_flipped_axes(&self) -> Option<Finding> {
        let axes = [Sensor::Accelerometer, Sensor::Gyroscope].map(|sensor| self.flipped(sensor));
        let axes = axes.map(Option::unwrap_or_default).concat();
        (!axes.is_empty())
            .then(|| Finding::of(Kind::FOR_FLIPPED_AXES).detail("axes", axes.join(", ")))
    }
}

/// Refuses a recording with other axes flipped than those of the calibration: no reading shows it of a gyroscope.
pub(super) fn check(calibration: &Calibration, recording: &Recording) -> Result<(), Error> {
    for described in &recording.description.sensors {
        let own = calibration.flipped(described.sensor);
        let own = own.filter(|own| *own != described.flipped);
        let Some(own) = own.filter(|_| calibration.triad(described.sensor).is_some()) else {
            continue;
        };
        let said = |axes: &[String]| match axes {
            [] => "none".to_owned(),
            axes => axes.join(", "),
        };
        let other: Vec<String> = described.flipped.iter().map(|&axis| axis.into()).collect();
        let found = Finding::of(Kind::FLIPPED_OTHERWISE)
            .in_recording(&recording.name)
            .of_sensor(described.sensor)
            .detail("own", said(own))
            .detail("other", said(&other));
        let flip = Remedy::set_to(OptionName::Flip, own.join(","));
        let way_out = Some(flip).filter(|_| !own.is_empty());
        let way_out = way_out
            .into_iter()
            .chain([Remedy::set(OptionName::ForceDevice)]);
        return Err(Error::input(found.only_remedies(way_out)));
    }
    Ok(())
}
