//! Noise-free readings of the device's sensors.

use nalgebra::Vector3;
use sensor::attitude::Attitude;
use sensor::{Kinematics, REFERENCE_TEMPERATURE, Sensor, Since};

use super::device::Device;
use super::hidden::{Instant, Placed};
use super::motion::{Motion, mean_over};
use super::surroundings::{PlacedField, Temperature};

/// The true motion of the device and what surrounds it.
#[derive(Clone, Debug)]
pub(crate) struct World {
    /// Motion of the sensor.
    pub motion: Motion,
    /// Norm of gravity, m/s².
    pub gravity: f64,
    /// Temperature; constant where there is none.
    pub temperature: Option<Temperature>,
    /// The magnetic field, where there is one.
    pub field: Option<PlacedField>,
    /// Hidden disturbances of readings.
    pub disturbances: Vec<Placed>,
}

impl World {
    /// The truth at time `t`: `f = Rᵀ(a + g z)`, rate and acceleration relative to the earth.
    ///
    /// The derivative of specific force is left at zero: the effect that needs it is a delay, and simulated
    /// as such (see [`Delays`]).
    pub fn kinematics(&self, t: f64) -> Kinematics<f64> {
        let state = self.motion.at(t);
        let up = Vector3::z() * self.gravity;
        let force = state
            .attitude
            .inverse_transform_vector(&(state.acceleration + up));
        let rest = self.motion.segment_at(t).rest.as_ref();
        let temperature_rate = self.temperature.as_ref().map_or(0.0, |c| c.rate_at(t));
        let (ended, last_turn) = self.motion.last_turn(t);
        Kinematics {
            time: t,
            temperature: self.temperature_at(t),
            temperature_rate,
            warming: if temperature_rate == 0.0 {
                0.0
            } else {
                temperature_rate.signum()
            },
            last_turn,
            since_turn: Since::at(t - ended),
            angular_acceleration: state.angular_acceleration,
            last_change: self.motion.last_change(t),
            vibration: rest.map_or_else(Vector3::zeros, |r| r.vibration),
            attitude: Attitude {
                w: state.attitude.w,
                v: state.attitude.imag(),
            },
            magnetic_field: self.field.as_ref().map_or_else(Vector3::zeros, |field| {
                state.attitude.inverse_transform_vector(&field.at(t))
            }),
            ..Kinematics::new(
                force + rest.map_or_else(Vector3::zeros, |r| r.push),
                state.rate,
            )
        }
    }

    /// Computes the error that hidden disturbances add to the reading of `device` at time `t`, s.
    fn disturbance(&self, device: &Device, t: f64) -> Vector3<f64> {
        let sensor = device.model.sensor();
        let mut own = self
            .disturbances
            .iter()
            .filter(|d| d.sensor == sensor)
            .peekable();
        if own.peek().is_none() {
            return Vector3::zeros();
        }
        let (state, truth) = (self.motion.at(t), self.kinematics(t));
        let at = Instant {
            time: t,
            force: truth.specific_force,
            rate: state.rate,
            angular_acceleration: state.angular_acceleration,
            attitude: state.attitude,
        };
        own.map(|placed| placed.disturbance.error(&at)).sum()
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
        let read = |t: f64| device.read(&self.kinematics(t)) + self.disturbance(device, t);
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
        Self {
            stamps: accelerometer.delay().map_or(0.0, |d| d[0]),
            gyroscope: gyroscope
                .delay()
                .map_or_else(Vector3::zeros, |d| Vector3::from_column_slice(&d[..3])),
        }
    }

    /// Returns the delay of each axis of a sensor, s.
    pub fn of_axes(&self, sensor: Sensor) -> Vector3<f64> {
        match sensor {
            Sensor::Accelerometer | Sensor::Magnetometer => Vector3::zeros(),
            Sensor::Gyroscope => self.gyroscope,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::draw_device;
    use crate::{HandHeld, Motion as MotionSpec, Simulation, Spec};

    fn shaken() -> Simulation {
        let hand = HandHeld {
            placements: Some(4),
            shock: 20.0,
            tremor: 2.0,
            ..HandHeld::default()
        };
        let motion = MotionSpec::HandHeld(hand);
        Simulation::new(&Spec {
            motion,
            ..Spec::hand_held(5)
        })
        .unwrap()
    }

    /// The middle of the first turn.
    fn turning(simulation: &Simulation) -> f64 {
        let turn = simulation
            .world()
            .motion
            .segments()
            .iter()
            .find(|s| s.rest.is_none())
            .unwrap();
        0.5 * (turn.start + turn.end)
    }

    /// Mean over `n` instants in the middles of equal parts.
    fn mean_of_instants(
        n: u32,
        from: f64,
        to: f64,
        f: impl Fn(f64) -> Vector3<f64>,
    ) -> Vector3<f64> {
        let part = (to - from) / f64::from(n);
        let instants = (0..n).map(|j| from + (f64::from(j) + 0.5) * part);
        instants.map(f).sum::<Vector3<f64>>() / f64::from(n)
    }

    #[test]
    fn a_window_mean_is_the_mean_of_very_many_instants() {
        let simulation = shaken();
        let world = simulation.world();
        let middle = turning(&simulation);
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            let device = simulation.device(sensor);
            for k in -200..200 {
                let (from, to) = (
                    middle + 0.01 * f64::from(k),
                    middle + 0.01 * f64::from(k + 1),
                );
                let read = |t: f64| device.read(&world.kinematics(t));
                let (coarse, fine) = (
                    mean_of_instants(500, from, to, read),
                    mean_of_instants(1000, from, to, read),
                );
                // Their error goes with the square of the step: this takes it away.
                let limit = (fine * 4.0 - coarse) / 3.0;
                let error = (world.mean_reading(device, from, to) - limit).norm();
                // Where a knock begins the force has a kink, and the limit itself is off by the step
                // squared times the jump of its derivative (1e-10 s² · 1.5e4 m/s³) over the window.
                let smooth = !world.motion.knots().iter().any(|t| (from..to).contains(t));
                assert!(error < if smooth { 1e-12 } else { 2e-6 }, "{k}: {error}");
            }
        }
    }

    #[test]
    fn a_device_in_the_hand_feels_more_than_gravity() {
        let simulation = shaken();
        let middle = turning(&simulation);
        let extra = (0..100)
            .map(|k| middle + 0.005 * f64::from(k))
            .map(|t| (simulation.world().kinematics(t).specific_force.norm() - 9.80665).abs())
            .fold(0.0, f64::max);
        assert!((0.2..10.0).contains(&extra), "{extra}");
    }

    #[test]
    fn a_late_axis_reads_what_the_others_read_before() {
        let simulation = shaken();
        let (world, device) = (simulation.world(), simulation.device(Sensor::Gyroscope));
        let t = turning(&simulation);
        let delay = Vector3::new(0.0, 0.004, 0.0);
        let late = world.delayed_reading(device, t, t + 0.01, &delay);
        assert_eq!(late.x, world.mean_reading(device, t, t + 0.01).x);
        assert_eq!(late.y, world.mean_reading(device, t - 0.004, t + 0.006).y);
    }

    #[test]
    fn delays_are_read_from_the_effects_that_are_delays() {
        let mut spec = Spec::hand_held(1);
        let values =
            |pairs: &[(&str, f64)]| pairs.iter().map(|(k, v)| (k.to_string(), *v)).collect();
        spec.effects
            .insert("time_offset".into(), values(&[("d", 0.01)]));
        spec.effects
            .insert("gyro_delay".into(), values(&[("y", 5e-4)]));
        let device = |sensor| draw_device(&spec, sensor, 1, 100.0).unwrap();
        let delays = Delays::of(&device(Sensor::Accelerometer), &device(Sensor::Gyroscope));
        assert_eq!(delays.stamps, 0.01);
        assert_eq!(delays.gyroscope, Vector3::new(0.0, 5e-4, 0.0));
    }
}
