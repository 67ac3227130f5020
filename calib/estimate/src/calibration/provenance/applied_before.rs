//! Corrections that a system had applied to the readings before the calibration, which is on top of them.

use findings::{Finding, Kind};
use recording::{AppliedBefore, Recording};
use sensor::Sensor;

use crate::calibration::Calibration;

/// The readings of a sensor that a calibration is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Readings<'a> {
    /// Nothing is stated of them.
    NotStated,
    /// Those of the sensor: what the system had applied was taken off again.
    Restored {
        /// The system.
        by: &'a str,
    },
    /// Corrected by a system.
    CorrectedBy(&'a str),
    /// Corrected in some recordings by this system, and in others not, or by another.
    Mixed(&'a str),
}

/// Returns the name of a system for display.
pub fn system_name(by: &str) -> &str {
    match by {
        "px4" => "PX4",
        "ardupilot" => "ArduPilot",
        "ios" => "iOS",
        AppliedBefore::UNKNOWN => "the recording software",
        other => other,
    }
}

/// The claim of a recording about one of its sensors.
fn claim(applied: &[AppliedBefore], sensor: Sensor) -> Readings<'_> {
    let found = applied.iter().find(|claim| claim.sensor == sensor.name());
    match found {
        Some(claim) if claim.undone => Readings::Restored { by: &claim.by },
        Some(claim) => Readings::CorrectedBy(&claim.by),
        None => Readings::NotStated,
    }
}

impl Calibration {
    /// Returns the statement of its recordings about the correction of a sensor's readings.
    pub fn readings(&self, sensor: Sensor) -> Readings<'_> {
        let inputs = self.provenance.inputs.iter();
        let inputs =
            inputs.filter(|input| sensor == Sensor::Magnetometer || input.sensor(sensor).is_some());
        let claims: Vec<Readings<'_>> = inputs.map(|i| claim(&i.applied_before, sensor)).collect();
        let Some(first) = claims.first().copied() else {
            return Readings::NotStated;
        };
        let corrected = claims.iter().find_map(|claim| match claim {
            Readings::CorrectedBy(by) => Some(*by),
            _ => None,
        });
        match corrected {
            Some(by) if claims.iter().any(|claim| *claim != first) => Readings::Mixed(by),
            _ => first,
        }
    }

    /// Warns if the readings of `recording` were corrected before in another way than those of the calibration.
    pub fn doubts_corrections_of(&self, recording: &Recording) -> Option<Finding> {
        let other = &recording.description.applied_before;
        let differ = |sensor: &Sensor| {
            self.triad(*sensor)?;
            match (self.readings(*sensor), claim(other, *sensor)) {
                (Readings::CorrectedBy(own), Readings::Restored { .. }) => Some((*sensor, own, "")),
                (Readings::CorrectedBy(own), Readings::CorrectedBy(by)) if own != by => {
                    Some((*sensor, own, by))
                }
                (Readings::Restored { .. } | Readings::NotStated, Readings::CorrectedBy(by)) => {
                    Some((*sensor, "", by))
                }
                _ => None,
            }
        };
        let named =
            |(_, own, by): &(Sensor, &str, &str)| ![*own, *by].contains(&AppliedBefore::UNKNOWN);
        let (sensor, own, by) = Sensor::ALL.iter().filter_map(differ).find(named)?;
        let of = |by: &str| match by {
            "" => "no system".to_owned(),
            by => system_name(by).to_owned(),
        };
        let own = match (own, self.readings(sensor)) {
            ("", Readings::NotStated) => "no stated system".to_owned(),
            (own, _) => of(own),
        };
        Some(
            Finding::of(Kind::CORRECTED_OTHERWISE)
                .in_recording(&recording.name)
                .of_sensor(sensor)
                .detail("by", of(by))
                .detail("own", own),
        )
    }

    /// Warns if the readings of its own recordings were not all corrected in the same way before.
    pub fn mixed_corrections(&self) -> Option<Finding> {
        let mixed = Sensor::ALL
            .into_iter()
            .find_map(|sensor| match self.readings(sensor) {
                Readings::Mixed(by) if by != AppliedBefore::UNKNOWN => Some((sensor, by)),
                _ => None,
            });
        let (sensor, by) = mixed?;
        let [corrected, others] = self.corrected_by(sensor, by);
        Some(
            Finding::of(Kind::CORRECTED_IN_PART)
                .in_recording(corrected)
                .of_sensor(sensor)
                .detail("by", system_name(by))
                .detail("others", others),
        )
    }

    /// Names of the recordings whose readings of a sensor this system had corrected, and of the others.
    pub fn corrected_by(&self, sensor: Sensor, by: &str) -> [String; 2] {
        let inputs = self.provenance.inputs.iter();
        let (corrected, others): (Vec<_>, Vec<_>) = inputs
            .partition(|input| claim(&input.applied_before, sensor) == Readings::CorrectedBy(by));
        [corrected, others].map(|inputs| {
            let names: Vec<&str> = inputs.iter().map(|i| i.recording.as_str()).collect();
            names.join(", ")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::Input;

    fn input(name: &str, by: Option<(&str, bool)>) -> Input {
        let claim = by.map(|(by, undone)| AppliedBefore {
            undone,
            ..AppliedBefore::by(by, Sensor::Accelerometer)
        });
        let stream = recording::Stream {
            t: vec![0.0, 0.01],
            values: vec![nalgebra::Vector3::z() * 9.8; 2],
        };
        let mut made = Recording {
            name: name.into(),
            accelerometer: Some(stream),
            ..Recording::default()
        };
        made.description.applied_before = claim.into_iter().collect();
        Input::of(&made, None, [Some(1.0), None])
    }

    fn of(inputs: Vec<Input>) -> Calibration {
        let mut calibration = crate::calibration::gravity::tests::perfect();
        calibration.provenance.inputs = inputs;
        calibration
    }

    #[test]
    fn a_claim_is_that_of_all_recordings_or_mixed() {
        let px4 = Some(("px4", false));
        let readings = |inputs| {
            let calibration = of(inputs);
            (
                calibration.readings(Sensor::Accelerometer) == Readings::CorrectedBy("px4"),
                calibration.mixed_corrections(),
            )
        };
        assert_eq!(
            readings(vec![input("a", px4), input("b", px4)]),
            (true, None)
        );
        let (alike, said) = readings(vec![input("a", px4), input("b", None)]);
        assert!(
            !alike
                && said
                    .map(|said| said.to_string())
                    .is_some_and(|said| said.contains("a: PX4") && said.contains("those of b"))
        );
        let restored = of(vec![input("a", Some(("px4", true)))]);
        assert_eq!(
            restored.readings(Sensor::Accelerometer),
            Readings::Restored { by: "px4" }
        );
        assert_eq!(
            of(vec![]).readings(Sensor::Accelerometer),
            Readings::NotStated
        );
    }

    #[test]
    fn another_state_of_the_readings_is_said_and_the_same_is_not() {
        let recording = |by: Option<(&str, bool)>| {
            let mut made = Recording::default();
            let claims = input("a", by).applied_before;
            made.description.applied_before = claims;
            made
        };
        let (px4, restored) = (Some(("px4", false)), Some(("px4", true)));
        let said = |own, other| of(vec![input("a", own)]).doubts_corrections_of(&recording(other));
        assert!(
            said(px4, px4).is_none() && said(None, None).is_none() && said(px4, None).is_none()
        );
        assert!(said(None, restored).is_none());
        assert!(said(px4, restored).is_some() && said(None, px4).is_some());
        assert!(said(restored, px4).is_some() && said(px4, Some(("ardupilot", false))).is_some());
    }
}
