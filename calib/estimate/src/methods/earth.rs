//! The rotation of the earth in what a gyroscope measures, where the latitude is known.

use effects::earth_rotation;
use gyroscope::EARTH_RATE;
use sensor::{EffectRef, Model, Nature};

/// Returns true if the rotation of the earth is among the effects.
pub fn is_among(effects: &[EffectRef]) -> bool {
    let mut natures = effects.iter().map(|effect| effect.nature());
    natures.any(|nature| nature == Nature::EarthRotation)
}

/// The gyroscope with the rotation of the earth, and the vertical part of that by its name, which the latitude (°) gives.
pub fn on_the_earth(gyroscope: Model, latitude: f64) -> (Model, (String, f64)) {
    let gyroscope = if is_among(gyroscope.effects()) {
        gyroscope
    } else {
        gyroscope.with(earth_rotation())
    };
    (gyroscope, (vertical_rate(), vertical_rate_at(latitude)))
}

/// The name of the vertical part.
pub fn vertical_rate() -> String {
    format!("{}.z", earth_rotation().name())
}

/// The vertical part at a latitude (°), rad/s.
pub fn vertical_rate_at(latitude: f64) -> f64 {
    EARTH_RATE * latitude.to_radians().sin()
}
