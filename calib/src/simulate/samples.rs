//! The samples of one sensor, one after the other, in constant memory.

use nalgebra::Vector3;
use sensor::Sensor;

use super::clock::{Tick, Ticks};
use super::fault::Fault;
use super::noise::NoiseSource;
use super::random::{Purpose, Random};
use super::readout::Readout;
use super::simulation::Simulation;

/// One sample as the device gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// What the sensor's clock says, s.
    pub t: f64,
    /// The reading, in the recording's unit.
    pub value: Vector3<f64>,
    /// True time of the stamp, s.
    pub true_time: f64,
    /// The bias less its value at the first sample, in the unit of the sensor.
    pub drift: Vector3<f64>,
}

/// Iterator over the samples of one sensor; made by [`Simulation::samples`].
#[derive(Clone, Debug)]
pub struct Samples<'a> {
    simulation: &'a Simulation,
    sensor: Sensor,
    ticks: Ticks,
    noise: NoiseSource,
    vibration: Random,
    readout: Readout,
    delay: Vector3<f64>,
}

impl<'a> Samples<'a> {
    pub(crate) fn new(simulation: &'a Simulation, sensor: Sensor) -> Self {
        let spec = simulation.spec();
        let own = spec.sensor(sensor);
        let rate = own.clock.rate.unwrap_or(spec.rate);
        let mut clock = own.clock.clone();
        if sensor == Sensor::Accelerometer {
            clock.offset += simulation.delays().stamps;
        }
        clock.rate_error += spec.clock_rate_error();
        Self {
            simulation,
            sensor,
            ticks: Ticks::new(&clock, spec.rate, spec.stamp, spec.seed, sensor),
            noise: NoiseSource::new(&spec.noise(sensor), rate, spec.seed, sensor),
            vibration: Random::new(spec.seed, Purpose::Vibration),
            readout: own.readout(),
            delay: simulation.delays().of_axes(sensor),
        }
    }

    /// Vibration of the table, as the accelerometer sees it.
    fn shake(&mut self, time: f64) -> Vector3<f64> {
        if self.sensor == Sensor::Gyroscope {
            return Vector3::zeros();
        }
        match &self.simulation.world().motion.segment_at(time).rest {
            Some(rest) if rest.vibration != Vector3::zeros() => rest
                .vibration
                .map(f64::sqrt)
                .component_mul(&self.vibration.normal3()),
            _ => Vector3::zeros(),
        }
    }

    /// Whether the sample is missing and the stamps do not show it.
    fn is_closed_up(&self, tick: &Tick) -> bool {
        let mut lost = self.simulation.lost_spans().iter();
        lost.any(|span| span.contains(&tick.time))
    }

    fn is_lost(&self, tick: &Tick) -> bool {
        self.simulation
            .spec()
            .faults
            .iter()
            .any(|fault| match *fault {
                Fault::Gap { start, length } => (start..start + length).contains(&tick.time),
                _ => false,
            })
    }
}

impl Iterator for Samples<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        let world = self.simulation.world();
        loop {
            let tick = self.ticks.tick();
            if tick.time > world.motion.end() {
                return None;
            }
            let noise = self.noise.draw();
            let shake = self.shake(tick.time);
            if self.is_closed_up(&tick) {
                self.ticks.close_up();
                continue;
            }
            if self.is_lost(&tick) {
                continue;
            }
            let device = self.simulation.device(self.sensor);
            let clean = world.delayed_reading(device, tick.from, tick.to, &self.delay);
            return Some(Sample {
                t: tick.stamp,
                value: self.readout.read(clean + noise.total + shake),
                true_time: tick.time,
                drift: noise.drift,
            });
        }
    }
}
