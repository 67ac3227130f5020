//! The rotation of the earth in what a gyroscope measures, where the latitude is known.

use effects::earth_rotation;
use gyroscope::EARTH_RATE;
use nalgebra::Vector3;
use sensor::{EffectRef, Model, Nature};

/// Standard deviation of a component of the earth's rotation where nothing is known of its direction, rad/s.
pub const EARTH_COMPONENT: f64 = EARTH_RATE / 1.732_050_807_568_877_2;

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

/// The rotation of the earth in what a gyroscope reads at rest, rad/s.
#[derive(Clone, Copy, Debug)]
pub struct AtRest {
    /// The part that the latitude gives: the vertical one.
    pub known: Vector3<f64>,
    /// Standard deviation of the rest: the horizontal part points anywhere, and without a latitude all of it does.
    pub std: Vector3<f64>,
}

/// The rotation of the earth at rest, by the latitude (°) and by up in the axes of the sensor, a unit vector.
///
/// `known = Ω sin φ up`, and the variance along an axis is `½ (Ω cos φ)² (1 - up²)`; `Ω²/3` where either is not known.
pub fn at_rest(latitude: Option<f64>, up: Option<Vector3<f64>>) -> AtRest {
    let (Some(latitude), Some(up)) = (latitude, up) else {
        return AtRest {
            known: Vector3::zeros(),
            std: Vector3::repeat(EARTH_COMPONENT),
        };
    };
    let horizontal = EARTH_RATE * latitude.to_radians().cos();
    AtRest {
        known: up * vertical_rate_at(latitude),
        std: up.map(|up| horizontal * (0.5 * (1.0 - up * up).max(0.0)).sqrt()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_all_headings_and_its_spread_are_those_stated() {
        let up = Vector3::new(0.6, 0.0, 0.8);
        let (east, north) = (Vector3::y(), Vector3::new(0.8, 0.0, -0.6));
        let latitude = 48.0_f64;
        let horizontal = EARTH_RATE * latitude.to_radians().cos();
        let rates: Vec<Vector3<f64>> = (0..360)
            .map(|k| {
                let (sin, cos) = f64::from(k).to_radians().sin_cos();
                up * vertical_rate_at(latitude) + (north * cos + east * sin) * horizontal
            })
            .collect();
        let mean = rates.iter().sum::<Vector3<f64>>() / 360.0;
        let squares = rates.iter().map(|rate| (rate - mean).map(|d| d * d));
        let spread = (squares.sum::<Vector3<f64>>() / 360.0).map(f64::sqrt);
        let stated = at_rest(Some(latitude), Some(up));
        assert!((stated.known - mean).norm() < 1e-9 * EARTH_RATE);
        assert!((stated.std - spread).norm() < 1e-6 * EARTH_RATE);
    }
}
