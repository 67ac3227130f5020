//! What a sensor of the device would read without noise.

use nalgebra::Vector3;
use sensor::attitude::Attitude;
use sensor::{Kinematics, REFERENCE_TEMPERATURE, Sensor};

use super::device::Device;
use super::environment::Temperature;
use super::motion::{Motion, mean_over};

/// The true motion of the device and what surrounds it.
#[derive(Clone, Debug)]
pub(crate) struct World {
    /// Motion of the sensor.
    pub motion: Motion,
    /// Modulus of gravity, m/s².
    pub gravity: f64,
    /// Temperature; constant where there is none.
    pub temperature: Option<Temperature>,
}

impl World {
    /// The truth at time `t`: `f = Rᵀ(a + g z)`, rate and acceleration relative to the earth.
    pub fn kinematics(&self, t: f64) -> Kinematics<f64> {
        let state = self.motion.at(t);
        let up = Vector3::z() * self.gravity;
        let force = state
            .attitude
            .inverse_transform_vector(&(state.acceleration + up));
        let rest = self.motion.segment_at(t).rest.as_ref();
        Kinematics {
            time: t,
            temperature: self.temperature_at(t),
            angular_acceleration: state.angular_acceleration,
            last_change: rest.map_or_else(Vector3::zeros, |r| r.last_change),
            vibration: rest.map_or_else(Vector3::zeros, |r| r.vibration),
            attitude: Attitude {
                w: state.attitude.w,
                v: state.attitude.imag(),
            },
            ..Kinematics::new(
                force + rest.map_or_else(Vector3::zeros, |r| r.push),
                state.rate,
            )
        }
    }

    /// Temperature at time `t`, °C.
    pub fn temperature_at(&self, t: f64) -> f64 {
        self.temperature
            .as_ref()
            .map_or(REFERENCE_TEMPERATURE, |c| c.at(t))
    }

    /// Mean reading of the device over the window `[from, to]`.
    ///
    /// The sensor distorts first and averages then, as the electronics do. At rest one instant stands
    /// for the window: what still changes (temperature, drift) is linear over it.
    pub fn mean_reading(&self, device: &Device, from: f64, to: f64) -> Vector3<f64> {
        let read = |t: f64| device.read(&self.kinematics(t));
        if self.motion.is_still(from, to) {
            return read(0.5 * (from + to));
        }
        mean_over(self.motion.knots(), from, to, read)
    }

    /// [`World::mean_reading`] of a sensor whose axis `i` is late by `delay[i]`, s.
    pub fn delayed_reading(
        &self,
        device: &Device,
        from: f64,
        to: f64,
        delay: &Vector3<f64>,
    ) -> Vector3<f64> {
        if *delay == Vector3::zeros() {
            return self.mean_reading(device, from, to);
        }
        Vector3::from_fn(|i, _| self.mean_reading(device, from - delay[i], to - delay[i])[i])
    }

    /// The specific force of a device at rest with the attitude of time `t`, body frame, m/s².
    pub fn resting_force(&self, t: f64) -> Vector3<f64> {
        let up = Vector3::z() * self.gravity;
        self.motion.at(t).attitude.inverse_transform_vector(&up)
    }
}

/// The effects that are delays. The catalogue has them to first order (`−d` times a derivative); the
/// simulation reads the motion at the earlier time instead.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Delays {
    /// Accelerometer stamps are late by this, s.
    pub stamps: f64,
    /// Axis `i` of the gyroscope is late by this, s.
    pub gyroscope: Vector3<f64>,
}

impl Delays {
    /// The delays of the device with these two sensors.
    pub fn of(accelerometer: &Device, gyroscope: &Device) -> Self {
        let axes = gyroscope.effect("gyro_delay");
        Self {
            stamps: accelerometer.effect("time_offset").map_or(0.0, |p| p[0]),
            gyroscope: axes.map_or_else(Vector3::zeros, |p| Vector3::from_column_slice(&p[..3])),
        }
    }

    /// Of which sensor, on which axes.
    pub fn of_axes(&self, sensor: Sensor) -> Vector3<f64> {
        match sensor {
            Sensor::Accelerometer => Vector3::zeros(),
            Sensor::Gyroscope => self.gyroscope,
        }
    }
}
