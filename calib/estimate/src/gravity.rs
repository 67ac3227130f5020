//! Local gravity: given, worked out from the place, or assumed with what that leaves unknown.

use findings::OptionName;
use serde::{Deserialize, Serialize};

/// Standard gravity, m/s².
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Gravity on the earth's surface lies between these, m/s²: mountains near the equator to the poles.
pub const ON_EARTH: std::ops::RangeInclusive<f64> = 9.764..=9.834;

/// A given gravity is refused beyond these, m/s².
pub const ACCEPTED: std::ops::RangeInclusive<f64> = 9.76..=9.84;

/// A latitude is refused beyond these, °.
pub const LATITUDES: std::ops::RangeInclusive<f64> = -90.0..=90.0;

/// A height is refused beyond these, m.
pub const ALTITUDES: std::ops::RangeInclusive<f64> = -500.0..=9000.0;

findings::tuning! {
    /// Standard deviation of gravity about [`STANDARD_GRAVITY`] where nothing is known of the place, m/s²: the
    /// root mean square distance of a value that lies anywhere in [`ON_EARTH`] with the same chance.
    ANYWHERE: f64 = 0.021_6;

    /// Height above the ellipsoid where only the latitude is given: the standard deviation about sea level, m.
    SOME_HEIGHT: f64 = 500.0;

    /// Standard deviation of gravity about the normal one, m/s²: 30 mGal, the root mean square free-air anomaly
    /// of the earth (Heiskanen & Moritz, Physical Geodesy, 1967, section 7-3).
    ANOMALY: f64 = 3e-4;
}

/// Gravity falls by so much per metre of height, 1/s² (free air).
const BY_HEIGHT: f64 = 3.086e-6;

/// Source of the value of gravity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum GravitySource {
    /// Given as a number: taken as exact.
    #[default]
    Given,
    /// Normal gravity at a place.
    Place {
        /// Latitude, degrees north.
        latitude: f64,
        /// Height above the ellipsoid, m; sea level assumed where it is not given.
        altitude: Option<f64>,
    },
    /// Nothing is known of the place.
    Assumed,
}

/// Local gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    /// Its value, m/s².
    pub value: f64,
    /// Source of the value.
    pub source: GravitySource,
}

/// Something that is nowhere on the earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotOnEarth {
    /// Gravity, m/s², not in [`ACCEPTED`].
    Gravity(f64),
    /// Latitude, °, not in [`LATITUDES`].
    Latitude(f64),
    /// Height, m, not in [`ALTITUDES`].
    Altitude(f64),
    /// Gravity and a latitude that has it at no height on which people live.
    Place {
        /// Gravity that was given, m/s².
        gravity: f64,
        /// Latitude that was given, °.
        latitude: f64,
        /// Normal gravity there, m/s².
        normal: f64,
    },
}

findings::tuning! {
    /// A gravity that is given beside a latitude may be larger than the normal one by this, m/s²: standard gravity is given at any
    /// latitude, and an error of 0.1 % of every scale factor is one too many.
    LARGER: f64 = 0.01;

    /// It may be smaller by this, m/s²: it is at a height of 6 km.
    SMALLER: f64 = 0.02;
}

impl Gravity {
    /// [`Gravity::of`] what can be so.
    ///
    /// # Errors
    /// The first of the three that is nowhere on the earth, and a gravity that the latitude has nowhere.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_estimate::gravity::{Gravity, NotOnEarth};
    ///
    /// assert_eq!(Gravity::checked(Some(981.0), None, None), Err(NotOnEarth::Gravity(981.0)));
    /// assert!(Gravity::checked(Some(9.80665), Some(48.1), None).is_ok());
    /// let tropics = Gravity::checked(Some(9.80665), Some(1.3), None);
    /// assert!(matches!(tropics, Err(NotOnEarth::Place { .. })));
    /// ```
    pub fn checked(
        value: Option<f64>,
        latitude: Option<f64>,
        altitude: Option<f64>,
    ) -> Result<Self, NotOnEarth> {
        let beyond = |given: Option<f64>, range: &std::ops::RangeInclusive<f64>| {
            given.filter(|given| !range.contains(given))
        };
        if let Some(latitude) = beyond(latitude, &LATITUDES) {
            return Err(NotOnEarth::Latitude(latitude));
        }
        if let Some(altitude) = beyond(altitude, &ALTITUDES) {
            return Err(NotOnEarth::Altitude(altitude));
        }
        if let Some(gravity) = beyond(value, &ACCEPTED) {
            return Err(NotOnEarth::Gravity(gravity));
        }
        if let (Some(gravity), Some(latitude)) = (value, latitude) {
            let normal = normal_gravity(latitude, altitude.unwrap_or(0.0));
            if gravity > normal + LARGER.get() || gravity < normal - SMALLER.get() {
                return Err(NotOnEarth::Place {
                    gravity,
                    latitude,
                    normal,
                });
            }
        }
        Ok(Self::of(value, latitude, altitude))
    }

    /// A value that is known.
    pub fn given(value: f64) -> Self {
        Self {
            value,
            source: GravitySource::Given,
        }
    }

    /// From what is known: a value, else a place, else neither.
    pub fn of(value: Option<f64>, latitude: Option<f64>, altitude: Option<f64>) -> Self {
        match (value, latitude) {
            (Some(value), _) => Self::given(value),
            (None, Some(latitude)) => Self {
                value: normal_gravity(latitude, altitude.unwrap_or(0.0)),
                source: GravitySource::Place { latitude, altitude },
            },
            (None, None) => Self {
                value: STANDARD_GRAVITY,
                source: GravitySource::Assumed,
            },
        }
    }
}

impl GravitySource {
    /// Standard deviation of the value, m/s²: zero of a given one.
    pub fn std(&self) -> f64 {
        match self {
            Self::Given => 0.0,
            Self::Place {
                altitude: Some(_), ..
            } => ANOMALY.get(),
            Self::Place { altitude: None, .. } => {
                ANOMALY.get().hypot(SOME_HEIGHT.get() * BY_HEIGHT)
            }
            Self::Assumed => ANYWHERE.get(),
        }
    }

    /// Options that give the same `gravity` (m/s²) again, each with its number.
    pub fn options(&self, gravity: f64) -> Vec<(OptionName, f64)> {
        match *self {
            Self::Given => vec![(OptionName::Gravity, gravity)],
            Self::Place { latitude, altitude } => {
                let altitude = altitude.map(|height| (OptionName::Altitude, height));
                let latitude = (OptionName::Latitude, latitude);
                [latitude].into_iter().chain(altitude).collect()
            }
            Self::Assumed => Vec::new(),
        }
    }
}

/// Normal gravity `γ` (m/s²) at a latitude (°) and a height `h` above the ellipsoid (m), WGS 84: Somigliana's
/// formula `γ₀ = γ_e (1 + k sin²φ)/√(1 − e² sin²φ)` with
/// `γ = γ₀ [1 − 2 (1 + f + m − 2 f sin²φ) h/a + 3 h²/a²]`.
///
/// Source: NGA.STND.0036, World Geodetic System 1984, 2014, equations 4-1 and 4-3, tables 3.5 and 3.6.
pub fn normal_gravity(latitude: f64, altitude: f64) -> f64 {
    const EQUATOR: f64 = 9.780_325_335_9;
    const K: f64 = 1.931_852_652_41e-3;
    const E2: f64 = 6.694_379_990_14e-3;
    const F: f64 = 1.0 / 298.257_223_563;
    const M: f64 = 3.449_786_506_84e-3;
    const A: f64 = 6_378_137.0;
    let sin2 = latitude.to_radians().sin().powi(2);
    let surface = EQUATOR * (1.0 + K * sin2) / (1.0 - E2 * sin2).sqrt();
    let h = altitude / A;
    surface * (1.0 - 2.0 * (1.0 + F + M - 2.0 * F * sin2) * h + 3.0 * h * h)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_gravity_has_its_published_values() {
        // WGS 84, table 3.6: theoretical gravity at the equator and at the poles.
        assert!((normal_gravity(0.0, 0.0) - 9.780_325_335_9).abs() < 1e-12);
        assert!((normal_gravity(90.0, 0.0) - 9.832_184_937_9).abs() < 2e-9);
        assert_eq!(normal_gravity(-52.0, 80.0), normal_gravity(52.0, 80.0));
        // The free-air gradient at 45°: 0.3086 mGal per metre.
        let gradient = (normal_gravity(45.0, 0.0) - normal_gravity(45.0, 100.0)) / 100.0;
        assert!((gradient - 3.086e-6).abs() < 2e-9);
    }

    #[test]
    fn what_is_known_best_counts_and_the_rest_is_uncertainty() {
        let given = Gravity::of(Some(9.81), Some(10.0), None);
        assert_eq!((given.value, given.source.std()), (9.81, 0.0));
        let place = Gravity::of(None, Some(48.1), Some(520.0));
        assert!((place.value - 9.8073).abs() < 5e-4 && place.source.std() < 5e-4);
        let sea = Gravity::of(None, Some(48.1), None);
        assert!(sea.source.std() > 1e-3);
        let assumed = Gravity::of(None, None, None);
        // 95 % intervals reach over the whole earth.
        for g in [ON_EARTH.start(), ON_EARTH.end()] {
            assert!((g - assumed.value).abs() < 2.0 * assumed.source.std());
        }
    }
}
