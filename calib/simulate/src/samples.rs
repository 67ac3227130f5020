//! The samples of one sensor, one after the other, in constant memory.

use nalgebra::Vector3;
use sensor::Sensor;

use super::noise::NoiseSource;
use super::random::{Purpose, Random};
use super::sampling::{Clock, Readout, Resampler, Sampling, Tick, Ticks};
use super::simulation::{Simulation, clock_changes};
use super::surroundings::Fault;

/// One sample as the device gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Stamp by the sensor's clock, s.
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
    converter: Converter<'a>,
    ticks: Ticks,
    resampler: Option<Resampler>,
    lost: Option<(f64, Random)>,
}

impl<'a> Samples<'a> {
    pub(crate) fn new(simulation: &'a Simulation, sensor: Sensor) -> Self {
        let spec = simulation.spec();
        let own = spec.sensor(sensor);
        let mut clock = own.clock.clone();
        if sensor == Sensor::Accelerometer {
            clock.offset += simulation.delays().stamps;
        }
        clock.rate_error += spec.clock_rate_error();
        let ticks = |clock: &Clock, rate| Ticks::new(clock, rate, spec.stamp, spec.seed, sensor);
        let resampler = own.resampled.map(|r| {
            let even = Clock::default();
            Resampler::new(r.by, ticks(&even, r.rate))
        });
        let share = own.clock.lost;
        Self {
            converter: Converter::new(simulation, sensor),
            ticks: ticks(&clock, spec.rate).with_changes(clock_changes(&spec.faults)),
            resampler,
            lost: (share > 0.0).then(|| (share, Random::new(spec.seed, Purpose::Lost(sensor)))),
        }
    }

    /// Returns true if the sample is missing and the stamps do not show it.
    fn is_closed_up(&self, tick: &Tick) -> bool {
        let mut lost = self.converter.simulation.lost_spans().iter();
        lost.any(|span| span.contains(&tick.time))
    }

    fn is_lost(&mut self, tick: &Tick) -> bool {
        let by_chance = match &mut self.lost {
            Some((share, random)) => random.uniform(0.0..1.0) < *share,
            None => false,
        };
        let mut faults = self.converter.simulation.spec().faults.iter();
        by_chance
            || faults.any(|fault| match *fault {
                Fault::Gap { start, length } => (start..start + length).contains(&tick.time),
                _ => false,
            })
    }
}

impl Iterator for Samples<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        let end = self.converter.simulation.world().motion.end();
        loop {
            let tick = self.ticks.tick();
            if tick.time > end {
                return None;
            }
            let noise = match self.resampler {
                None => Some(self.converter.noise(tick.time)),
                Some(_) => None,
            };
            if self.is_closed_up(&tick) {
                self.ticks.close_up();
                continue;
            }
            if self.is_lost(&tick) {
                continue;
            }
            let [value, drift] = match (&mut self.resampler, noise) {
                (Some(resampler), _) => {
                    let converter = &mut self.converter;
                    resampler.at(tick.time, |own| {
                        let noise = converter.noise(own.time);
                        converter.read(own, noise)
                    })
                }
                (None, noise) => self
                    .converter
                    .read(&tick, noise.unwrap_or([Vector3::zeros(); 2])),
            };
            return Some(Sample {
                t: tick.stamp,
                value,
                true_time: tick.time,
                drift,
            });
        }
    }
}

/// From the truth in a window to a number.
#[derive(Clone, Debug)]
struct Converter<'a> {
    simulation: &'a Simulation,
    sensor: Sensor,
    noise: NoiseSource,
    vibration: Random,
    readout: Readout,
    delay: Vector3<f64>,
}

/// Error that is added to a clean reading, and the drift in it.
type Noise = [Vector3<f64>; 2];

impl<'a> Converter<'a> {
    fn new(simulation: &'a Simulation, sensor: Sensor) -> Self {
        let spec = simulation.spec();
        let (own, seed) = (spec.sensor(sensor), spec.seed);
        let recorded = own.clock.rate.unwrap_or(spec.rate);
        let rate = own.resampled.map_or(recorded, |r| r.rate);
        let noise = NoiseSource::new(&spec.noise(sensor), rate, seed, sensor);
        let purpose = match sensor {
            Sensor::Accelerometer => Purpose::Vibration,
            Sensor::Gyroscope | Sensor::Magnetometer => Purpose::Rocking,
        };
        Self {
            simulation,
            sensor,
            noise: noise.shaped(own, rate, simulation.duration(), seed, sensor),
            vibration: Random::new(seed, purpose),
            readout: own.readout(),
            delay: simulation.delays().of_axes(sensor),
        }
    }

    /// The noise of the sample at true time `time`.
    fn noise(&mut self, time: f64) -> Noise {
        let noise = self.noise.draw();
        [noise.total + self.shake(time), noise.drift]
    }

    /// The reading in the recording's unit.
    fn read(&self, tick: &Tick, [noise, drift]: Noise) -> [Vector3<f64>; 2] {
        let world = self.simulation.world();
        let device = self.simulation.device(self.sensor);
        let (from, to) = match self.simulation.spec().sampling {
            Sampling::Average => (tick.from, tick.to),
            Sampling::Point => (tick.time, tick.time),
        };
        let clean = world.delayed_reading(device, from, to, &self.delay);
        [self.readout.read(clean + noise), drift]
    }

    /// Vibration of the table, as the sensor sees it.
    fn shake(&mut self, time: f64) -> Vector3<f64> {
        let spec = self.simulation.spec().vibration.as_ref();
        let rest = &self.simulation.world().motion.segment_at(time).rest;
        let (Some(spec), Some(rest)) = (spec, rest) else {
            return Vector3::zeros();
        };
        if rest.vibration == Vector3::zeros() {
            return Vector3::zeros();
        }
        let size = match self.sensor {
            Sensor::Accelerometer => rest.vibration.map(f64::sqrt),
            Sensor::Gyroscope => rest.vibration.map(f64::sqrt) * spec.rocking,
            Sensor::Magnetometer => Vector3::zeros(),
        };
        size.component_mul(&match spec.frequency {
            None => self.vibration.normal3(),
            Some(frequency) => spec.machine(frequency, time, self.sensor),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Between, Resampled, Spec, Stamp};

    /// Samples of a gyroscope without noise or errors, and the truth at the time each stamp names.
    fn against_the_truth(sampling: Sampling, clock: Clock, stamp: Stamp) -> f64 {
        let mut spec = Spec::hand_held(3).noise_free();
        spec.grade = crate::Grade::Perfect;
        (spec.sampling, spec.stamp) = (sampling, stamp);
        spec.gyroscope.clock = clock;
        let simulation = Simulation::new(&spec).unwrap();
        let samples = simulation.samples(Sensor::Gyroscope);
        samples
            .map(|s| (s.value - simulation.world().kinematics(s.t).angular_rate).norm())
            .fold(0.0, f64::max)
    }

    #[test]
    fn jittered_stamps_are_true_the_sample_is_the_signal_at_its_stamp() {
        let clock = Clock {
            sampling_jitter: 2e-3,
            ..Clock::default()
        };
        let worst = against_the_truth(Sampling::Point, clock, Stamp::Centre);
        assert!(worst < 1e-12, "{worst}");
    }

    #[test]
    fn noisy_stamps_are_not_true() {
        let clock = Clock {
            jitter: 2e-3,
            ..Clock::default()
        };
        assert!(against_the_truth(Sampling::Point, clock, Stamp::Centre) > 1e-3);
    }

    #[test]
    fn a_sensor_without_step_or_window_gives_points_where_averages_differ() {
        let clock = Clock::default();
        assert!(against_the_truth(Sampling::Average, clock, Stamp::Centre) > 1e-5);
    }

    #[test]
    fn as_many_samples_are_missing_as_were_asked_for_and_the_stamps_show_it() {
        let mut spec = Spec::still(1, 200.0);
        spec.gyroscope.clock.lost = 0.02;
        let session = spec.run().unwrap();
        let stream = session.recording.gyroscope.unwrap();
        let missing = 20_001 - stream.len();
        // √(20,000 · 0.02) = 20; four of them.
        assert!(missing.abs_diff(400) < 80, "{missing}");
        let steps: Vec<f64> = stream.t.windows(2).map(|w| w[1] - w[0]).collect();
        let holes: f64 = steps.iter().map(|s| (s * 100.0).round() - 1.0).sum();
        assert!((holes - missing as f64).abs() <= 1.0);
    }

    #[test]
    fn a_slow_sensor_is_held_in_a_fast_recording() {
        let mut spec = Spec::still(1, 10.0);
        spec.gyroscope.resampled = Some(Resampled {
            rate: 25.0,
            by: Between::Hold,
        });
        let session = spec.run().unwrap();
        let values = session.recording.gyroscope.unwrap().values;
        let changes = values.windows(2).filter(|w| w[0] != w[1]).count();
        assert!(changes.abs_diff(250) <= 2, "{changes}");
    }
}
