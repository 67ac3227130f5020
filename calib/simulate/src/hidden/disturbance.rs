//! Disturbances of readings that no model knows.

use std::collections::BTreeMap;
use std::fmt;

use nalgebra::{UnitQuaternion, Vector3};

/// True state of the device at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instant {
    /// s.
    pub time: f64,
    /// Specific force, body frame, m/s².
    pub force: Vector3<f64>,
    /// Angular rate, body frame, rad/s.
    pub rate: Vector3<f64>,
    /// Its derivative, rad/s².
    pub angular_acceleration: Vector3<f64>,
    /// Body to reference.
    pub attitude: UnitQuaternion<f64>,
}

/// A disturbance of one sensor in one simulation, with everything random in it drawn.
pub(crate) trait Disturbance: fmt::Debug + Send + Sync {
    /// Returns the error that is added to the reading, in the sensor's unit.
    fn error(&self, at: &Instant) -> Vector3<f64>;

    /// Returns the random values that were drawn, by name.
    fn drawn(&self) -> BTreeMap<String, Vec<f64>> {
        BTreeMap::new()
    }
}
