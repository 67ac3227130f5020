//! Corrections of readings one by one, as they come from a device: base model plus effects.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::Error;
use sensor::{Quantity, Sensor};

use super::{Models, unneeded};
use crate::calibration::Calibration;

/// Readings of one instant: raw ones to correct, or corrected ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time, s, on any clock that goes on.
    pub t: f64,
    /// Specific force, m/s² or in the unit of the calibration's readings.
    pub accelerometer: Option<Vector3<f64>>,
    /// Angular rate, rad/s or in the unit of the calibration's readings.
    pub gyroscope: Option<Vector3<f64>>,
    /// Temperature, °C.
    pub temperature: Option<f64>,
}

/// Corrects readings one by one.
///
/// Effects see the readings of the same instant, the temperature and the time since the first sample. Of a recording in which both
/// sensors share their stamps this gives what [`apply`](crate::calibration::apply) gives.
#[derive(Clone, Debug)]
pub struct Corrector {
    models: Models,
    start: Option<f64>,
    temperature: Option<f64>,
}

impl Corrector {
    /// Builds it from a calibration.
    ///
    /// # Errors
    /// [`Error::NotEnough`] for an effect that looks at more than one instant; it names effect and quantity.
    pub fn of(calibration: &Calibration) -> Result<Self, Error> {
        calibration.knows_its_effects()?;
        let models = Models::of(calibration);
        for effect in models.effects() {
            let needs = effect.needs();
            if let Some(quantity) = needs.iter().find(|quantity| !is_of_an_instant(**quantity)) {
                let found = Finding::of(Kind::WHOLE_RECORDING_NEEDED)
                    .detail("effect", effect.name())
                    .detail("quantity", quantity.to_string());
                return Err(Error::not_enough(found));
            }
        }
        Ok(Self {
            models,
            start: None,
            temperature: None,
        })
    }

    /// The signals behind one sample. A sensor that was not calibrated stays as it reads; a temperature holds until the next one.
    pub fn correct(&mut self, sample: &Sample) -> Sample {
        let start = *self.start.get_or_insert(sample.t);
        self.temperature = sample.temperature.or(self.temperature);
        let mut known = unneeded();
        known.time = sample.t - start;
        known.temperature = self.temperature.unwrap_or(known.temperature);
        let near =
            |sensor, raw: Option<Vector3<f64>>| Some(self.models.get(sensor)?.unit.to_si(&raw?));
        let force = near(Sensor::Accelerometer, sample.accelerometer);
        let rate = near(Sensor::Gyroscope, sample.gyroscope);
        self.models.correct(&mut known, force, rate);
        Sample {
            accelerometer: force.map(|_| known.specific_force).or(sample.accelerometer),
            gyroscope: rate.map(|_| known.angular_rate).or(sample.gyroscope),
            ..*sample
        }
    }
}

/// Returns true if a single instant determines the quantity.
fn is_of_an_instant(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::SpecificForce | Quantity::AngularRate | Quantity::Time | Quantity::Temperature
    )
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::calibrate::{Request, calibrate};
    use crate::calibration::apply;

    fn calibrated(effect: &str) -> (recording::Recording, Calibration) {
        let spec = Spec::hand_held(31).with_effect(effect, 1.0);
        let recording = spec.run().unwrap().recording;
        let catalogue = effects::catalogue();
        let effects = catalogue.filter(|own| own.name() == effect);
        let request = Request {
            effects: effects.collect(),
            gravity: spec.gravity,
            ..Request::default()
        };
        let outcome = calibrate(std::slice::from_ref(&recording), &[], &request).unwrap();
        (recording, outcome.calibration)
    }

    #[test]
    fn one_by_one_gives_what_the_whole_recording_gives() {
        for effect in ["gyro_g_sensitivity", "accel_quadratic"] {
            let (recording, calibration) = calibrated(effect);
            assert_eq!(calibration.effects.len(), 1);
            let whole = apply(&calibration, &recording).unwrap();
            let mut corrector = Corrector::of(&calibration).unwrap();
            let [force, rate] = [&recording.accelerometer, &recording.gyroscope];
            let [force, rate] = [force.as_ref().unwrap(), rate.as_ref().unwrap()];
            for (k, t) in force.t.iter().enumerate() {
                let corrected = corrector.correct(&Sample {
                    t: *t,
                    accelerometer: Some(force.values[k]),
                    gyroscope: Some(rate.values[k]),
                    temperature: None,
                });
                let expected = [&whole.accelerometer, &whole.gyroscope];
                let expected = expected.map(|stream| stream.as_ref().unwrap().values[k]);
                let own = [corrected.accelerometer, corrected.gyroscope].map(Option::unwrap);
                assert!((own[0] - expected[0]).norm() < 1e-9, "{effect} {k}");
                assert!((own[1] - expected[1]).norm() < 1e-9, "{effect} {k}");
            }
        }
    }

    #[test]
    fn an_effect_with_a_memory_is_refused_by_name() {
        let (_, calibration) = calibrated("accel_hysteresis");
        let refused = Corrector::of(&calibration).unwrap_err().to_string();
        assert!(refused.contains("accel_hysteresis"), "{refused}");
    }
}
