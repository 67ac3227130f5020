//! A device that is not quite at rest where it should be.

use serde::{Deserialize, Serialize};

/// Motion of the device during placements. It is true motion: both sensors see it.
///
/// | key | meaning | unit |
/// |---|---|---|
/// | `tremor` | angular rate at 6 to 12 Hz, root mean square of its norm; the hand also shakes by 3 m/s² per rad/s | rad/s |
/// | `sway` | angle at 0.1 to 0.5 Hz, root mean square of its norm | rad |
/// | `yaw` | constant rate about the vertical | rad/s |
/// | `settling` | largest angle turned in the first second; a placement has between 0.3 and 1 of it | rad |
/// | `share` | share of the placements this happens to | 1 |
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Unsteady {
    /// Root mean square of the hand's tremor, rad/s.
    pub tremor: f64,
    /// Root mean square of the hand's sway, rad.
    pub sway: f64,
    /// Rate about the vertical, rad/s.
    pub yaw: f64,
    /// Angle still turned in the first second, rad.
    pub settling: f64,
    /// Share of the placements.
    pub share: f64,
}

impl Default for Unsteady {
    fn default() -> Self {
        Self {
            tremor: 0.0,
            sway: 0.0,
            yaw: 0.0,
            settling: 0.0,
            share: 1.0,
        }
    }
}
