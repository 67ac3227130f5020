//! Inputs of the effects, stored in the data for the rows.

use sensor::{Model, Sensor};

use crate::methods::RawUnit;
use crate::methods::joint::data::{Cut, Data};
use crate::truth::{Models, Sensing, Truth};

/// A model near SI units and its parameters.
pub type NearSi<'a> = (&'a Model, &'a [f64]);

/// Builds the true signals of a recording from the units of its readings alone.
pub fn by_units<'a>(cut: &Cut<'a>) -> Truth<'a> {
    let first = |sensor, unit: RawUnit| Some(Sensing::first(Model::base(sensor), unit));
    let models = Models {
        accelerometer: first(Sensor::Accelerometer, cut.force_unit),
        ..Models::default()
    };
    Truth::as_far_as_known(cut.recording, Some(cut.segmentation), models)
}

/// Builds the true signals of a recording from models of its sensors.
pub fn by_models<'a>(cut: &Cut<'a>, force: NearSi<'_>, rate: NearSi<'_>) -> Truth<'a> {
    let sensing = |(model, p): NearSi<'_>, unit: RawUnit| {
        Some(Sensing {
            model: model.clone(),
            parameters: p.to_vec(),
            unit,
        })
    };
    let models = Models {
        accelerometer: sensing(force, cut.force_unit),
        gyroscope: sensing(rate, cut.rate_unit),
        ..Models::default()
    };
    Truth::as_far_as_known(cut.recording, Some(cut.segmentation), models)
}

impl Data {
    /// Writes down what is known of the static intervals and turns of a recording that begins at `start`.
    pub fn know(&mut self, recording: usize, truth: &Truth<'_>, start: f64) {
        let own = self.rests.iter_mut().filter(|r| r.recording == recording);
        for (k, rest) in own.enumerate() {
            rest.known = truth.at_rest(k);
            rest.known.time = 0.5 * (rest.span.from + rest.span.to) - start;
        }
        for turn in self.turns.iter_mut().filter(|t| t.recording == recording) {
            turn.known = truth.along(&turn.t, &turn.readings);
        }
    }
}
