//! A simulation that was run, in memory.

use findings::{Finding, Kind};
use recording::watch::{Stage, Watch};
use recording::{Error, Magnetometer, Recording, Stream};
use sensor::Sensor;

use super::samples::Samples;
use super::simulation::Simulation;
use super::spec::Spec;
use super::truth::Truth;

/// Most samples of a sensor that are kept in memory: 32 bytes each.
pub const MOST_SAMPLES: f64 = 5e7;

/// Samples between two looks at whether the work is to end.
const BETWEEN_STEPS: usize = 1 << 15;

/// A simulated recording and the truth behind it.
#[derive(Clone, Debug)]
pub struct Session {
    /// Recording of the device.
    pub recording: Recording,
    /// Truth that the estimator does not know.
    pub truth: Truth,
}

impl Simulation {
    /// The samples of one sensor, made while they are asked for.
    pub fn samples(&self, sensor: Sensor) -> Samples<'_> {
        Samples::new(self, sensor)
    }

    /// Runs it to its end, in memory.
    ///
    /// # Errors
    /// [`Error::Usage`] where it has more than [`MOST_SAMPLES`]: [`Simulation::samples`] and
    /// [`Simulation::write`] need no memory.
    pub fn run(&self) -> Result<Session, Error> {
        self.run_under(&Watch::default())
    }

    /// The same under a watch.
    ///
    /// # Errors
    /// As [`Simulation::run`]; that the watch ended it.
    pub fn run_under(&self, watch: &Watch) -> Result<Session, Error> {
        for sensor in Sensor::ALL.into_iter().filter(|&sensor| self.has(sensor)) {
            let rate = self
                .spec()
                .sensor(sensor)
                .clock
                .rate
                .unwrap_or(self.spec().rate);
            let samples = self.duration() * rate;
            if samples > MOST_SAMPLES {
                let found =
                    Finding::of(Kind::TOO_LONG_FOR_MEMORY).number("samples", samples, "count");
                return Err(Error::usage(found.of_sensor(sensor)));
            }
        }
        let mut drift = self.drift_means();
        let mut stream = |sensor: Sensor| {
            let mut stream = Stream::default();
            for sample in self.samples(sensor) {
                if stream.len() % BETWEEN_STEPS == 0 {
                    watch.step(Stage::Simulating)?;
                }
                drift.add(sensor, sample.true_time, &sample.drift);
                stream.t.push(sample.t);
                stream.values.push(sample.value);
            }
            Ok::<_, Error>(Some(stream))
        };
        let accelerometer = stream(Sensor::Accelerometer)?;
        let gyroscope = stream(Sensor::Gyroscope)?;
        let magnetometer = match self.has(Sensor::Magnetometer) {
            true => stream(Sensor::Magnetometer)?.map(Magnetometer::in_microtesla),
            false => None,
        };
        let recording = Recording {
            name: format!("simulated, seed {}", self.spec().seed),
            accelerometer,
            gyroscope,
            magnetometer,
            temperature: self.thermometer(),
            warnings: findings::Findings::new(),
            ..Recording::default()
        };
        Ok(Session {
            recording,
            truth: self.truth(&drift),
        })
    }
}

impl Spec {
    /// Plans, draws and runs it.
    ///
    /// # Errors
    /// [`Error::Usage`] where the spec contradicts itself, or is too long for the memory.
    pub fn run(&self) -> Result<Session, Error> {
        Simulation::new(self)?.run()
    }
}
