//! Promised accuracy of a session, and the shortfall from it.

use serde::{Deserialize, Serialize};

use crate::running::{Errors, Estimate};

/// The largest standard errors that a session ends with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Promise {
    /// Standard error of the scale factors of both sensors.
    pub scale: f64,
    /// Standard error of the misalignments of both sensors, rad.
    pub misalignment: f64,
}

/// Half a per cent, and 5 mrad (0.3°): half a degree in a quarter turn.
pub const PROMISE: Promise = Promise {
    scale: 0.005,
    misalignment: 0.005,
};

/// Standard error that is larger than promised.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shortfall {
    /// True for the gyroscope, false for the accelerometer.
    pub gyroscope: bool,
    /// A misalignment (rad), not a scale factor.
    pub misalignment: bool,
    /// Its standard error.
    pub error: f64,
    /// The standard error that was promised.
    pub promised: f64,
}

impl Promise {
    /// Returns the shortfall with the largest ratio of error to promise; `None` if the promise is kept. An undetermined
    /// sensor counts as infinitely far.
    pub fn shortfall(&self, estimate: &Estimate) -> Option<Shortfall> {
        let sensors = [
            (false, &estimate.accelerometer),
            (true, &estimate.gyroscope),
        ];
        let of = |(gyroscope, errors): (bool, &Option<Errors>)| {
            let known = errors.map_or([f64::INFINITY; 2], |e| [e.scale, e.misalignment]);
            let promised = [self.scale, self.misalignment];
            [false, true].map(|misalignment| Shortfall {
                gyroscope,
                misalignment,
                error: known[usize::from(misalignment)],
                promised: promised[usize::from(misalignment)],
            })
        };
        let all = sensors.into_iter().flat_map(of);
        let worst = all.max_by(|a, b| (a.error / a.promised).total_cmp(&(b.error / b.promised)));
        worst.filter(|worst| worst.error > worst.promised)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misalignment_of_41_mrad_keeps_no_promise() {
        let good = Errors {
            scale: 2e-3,
            misalignment: 1e-3,
            bias: 1e-3,
        };
        let estimate = |gyroscope| Estimate {
            accelerometer: Some(good),
            gyroscope,
            ..Estimate::default()
        };
        assert_eq!(PROMISE.shortfall(&estimate(Some(good))), None);
        let bad = Errors {
            misalignment: 0.041,
            ..good
        };
        let short = PROMISE.shortfall(&estimate(Some(bad))).unwrap();
        assert!(short.gyroscope && short.misalignment && short.error == 0.041);
        assert!(PROMISE.shortfall(&estimate(None)).is_some());
    }
}
