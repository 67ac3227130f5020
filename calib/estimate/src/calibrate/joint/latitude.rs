//! Test of the given latitude against the recordings.

use findings::{Finding, Kind};
use gyroscope::EARTH_RATE;

use crate::methods::earth::{vertical_rate, vertical_rate_at};
use crate::methods::joint::JointFit;

findings::tuning! {
    /// A latitude whose vertical part of the earth's rotation is off by so many standard errors is doubted.
    REFUTED: f64 = 4.0;
}

/// A vertical part of the earth's rotation that the latitude does not give.
#[derive(Clone, Copy, Debug)]
pub struct LatitudeDoubt {
    latitude: f64,
    /// Vertical part by the latitude, rad/s.
    given: f64,
    /// Vertical part by the recordings with its standard error, rad/s.
    seen: f64,
    std: f64,
}

impl LatitudeDoubt {
    /// Tests the vertical part of the earth's rotation at this latitude; `None` where the data do not refute it.
    pub fn of(fit: &JointFit, latitude: f64) -> Option<Self> {
        Self::by(fit.pull_of_held(&vertical_rate())?, latitude)
    }

    /// The same by how far the data move the vertical part, and its standard error, rad/s.
    pub fn by((pull, std): (f64, f64), latitude: f64) -> Option<Self> {
        let given = vertical_rate_at(latitude);
        (pull.abs() > REFUTED.get() * std).then_some(Self {
            latitude,
            given,
            seen: given + pull,
            std,
        })
    }

    /// Returns true if some latitude on the earth is consistent with the recordings.
    pub fn is_of_the_earth(&self) -> bool {
        self.seen.abs() < EARTH_RATE + REFUTED.get() * self.std
    }

    /// The latitude that the recordings show, degrees north.
    pub fn shown(&self) -> f64 {
        let sine = (self.seen / EARTH_RATE).clamp(-1.0, 1.0);
        sine.asin().to_degrees()
    }

    /// The finding.
    pub fn finding(&self) -> Finding {
        let other_sign = self.given * self.seen < 0.0;
        Finding::of(Kind::LATITUDE_DOUBTFUL)
            .number("given", self.latitude, "°")
            .number("expected", self.given, "rad/s")
            .number("shown", self.seen, "rad/s")
            .number("error", self.std, "rad/s")
            .number("seen", self.shown(), "°")
            .detail("what", if other_sign { "Its sign" } else { "It" })
    }
}
