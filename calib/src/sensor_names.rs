//! Sensors and axes as files write them; for `#[serde(with = …)]`.

use sensor::{Axis, Sensor};
use serde::{Deserialize, Serialize};

/// `accelerometer` or `gyroscope`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Sensor", rename_all = "snake_case")]
pub(crate) enum SensorName {
    Accelerometer,
    Gyroscope,
}

/// `x`, `y` or `z`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Axis", rename_all = "snake_case")]
pub(crate) enum AxisName {
    X,
    Y,
    Z,
}
