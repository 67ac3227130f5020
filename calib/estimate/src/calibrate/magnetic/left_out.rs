//! Effects that the model of a magnetometer leaves out.

use sensor::Model;

use super::units::Unit;
use super::write::fitted;
use crate::calibrate::left_out::left_out_of_magnetometer;
use crate::calibration::LeftOut;
use crate::methods::magnetic::{MagneticFit, MagneticRequest, fit_at};

findings::tuning! {
    /// Strength of the earth's field, µT, where readings have no unit: what it is where people live, to within a third.
    EARTH: f64 = 45.0;
}

/// The errors that each would add to the parameters of a fit: by the same placements at the same unevenness, its field in this unit.
pub fn left_out(request: MagneticRequest<'_>, fit: &MagneticFit, field: Unit) -> Vec<LeftOut> {
    let model = request.model;
    let request = MagneticRequest {
        placements: fit.placements.clone(),
        ..request
    };
    let larger = |model: &Model| {
        let fit = fit_at(&request.clone().with_model(model), fit.unevenness).ok()?;
        Some((fit.model.values, fit.model.covariance))
    };
    let strength = fit.fields.last().map(|own| own.strength);
    let microtesla = match (field, strength) {
        (Unit::OfReadings, Some(strength)) => EARTH.get() / strength,
        _ => 1.0,
    };
    left_out_of_magnetometer(model, &fitted(fit, model), microtesla, larger)
}
