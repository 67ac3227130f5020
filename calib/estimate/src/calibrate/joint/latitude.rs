//! Whether the recordings refute the latitude.

use gyroscope::EARTH_RATE;

use crate::methods::earth::{vertical_rate, vertical_rate_at};
use crate::methods::joint::JointFit;

/// A latitude whose vertical part of the earth's rotation is off by so many standard errors is doubted.
const REFUTED: f64 = 4.0;

/// A vertical part of the earth's rotation that the latitude does not give.
#[derive(Clone, Copy, Debug)]
pub struct LatitudeDoubt {
    latitude: f64,
    /// What the latitude gives, rad/s.
    given: f64,
    /// What the recordings show with its standard error, rad/s.
    seen: f64,
    std: f64,
}

impl LatitudeDoubt {
    /// Where the data refute the vertical part of the earth's rotation that the latitude gives.
    pub fn of(fit: &JointFit, latitude: f64) -> Option<Self> {
        Self::by(fit.pull_of_held(&vertical_rate())?, latitude)
    }

    /// The same by how far the data move the vertical part, and its standard error, rad/s.
    pub fn by((pull, std): (f64, f64), latitude: f64) -> Option<Self> {
        let given = vertical_rate_at(latitude);
        (pull.abs() > REFUTED * std).then_some(Self {
            latitude,
            given,
            seen: given + pull,
            std,
        })
    }

    /// Whether some latitude on the earth makes what the recordings show.
    pub fn is_of_the_earth(&self) -> bool {
        self.seen.abs() < EARTH_RATE + REFUTED * self.std
    }

    /// What to tell a user.
    pub fn words(&self) -> String {
        let sine = (self.seen / EARTH_RATE).clamp(-1.0, 1.0);
        format!(
            "--latitude {}: the earth's rotation would have a vertical part of {:.2e} rad/s, the recording shows {:.2e} ± {:.0e} \
             rad/s, as at a latitude of {:.0}°: is {} right?",
            self.latitude,
            self.given,
            self.seen,
            self.std,
            sine.asin().to_degrees(),
            if self.given * self.seen < 0.0 {
                "its sign"
            } else {
                "it"
            }
        )
    }
}
