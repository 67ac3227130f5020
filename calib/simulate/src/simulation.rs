//! A simulation that is ready to run.

use std::ops::Range;

use nalgebra::Vector3;
use recording::{Error, Temperature};
use sensor::{Kinematics, Sensor};
use solver::Parameters;

use super::device::Device;
use super::drift::DriftMeans;
use super::effects::draw_device;
use super::hidden::{HiddenTruth, Placed};
use super::motion::{Motion, Rest, Segment};
use super::random::{Purpose, Random};
use super::sampling::{ClockChange, ZERO_COUNT};
use super::spec::Spec;
use super::surroundings::Fault;
use super::truth::{StaticInterval, TRUTH_SCHEMA, Truth};
use super::world::{Delays, World};

/// A drawn device on a planned motion. Its samples can be had as often as wanted and are the same
/// every time.
#[derive(Clone, Debug)]
pub struct Simulation {
    spec: Spec,
    world: World,
    accelerometer: Device,
    gyroscope: Device,
    magnetometer: Device,
    delays: Delays,
    lost_spans: Vec<Range<f64>>,
    /// One for each of the spec's `hidden`.
    disturbances: Vec<Option<Placed>>,
}

impl Simulation {
    /// Plans the motion and draws the device that `spec` asks for.
    ///
    /// # Errors
    /// [`Error::Usage`] where the spec contradicts itself; the message names the key.
    pub fn new(spec: &Spec) -> Result<Self, Error> {
        spec.check()?;
        let path = spec.motion.path(&spec.surroundings());
        let motion = Motion::new(path, Vector3::from(spec.lever_arm));
        let rests = motion.segments().iter().filter(|s| s.rest.is_some());
        let (placements, segments) = (rests.count(), motion.segments().len());
        spec.check_faults(placements, segments - placements)?;
        let (seed, end) = (spec.seed, motion.end());
        let disturbances: Vec<Option<Placed>> = spec
            .hidden
            .iter()
            .enumerate()
            .map(|(place, hidden)| hidden.place(seed, place, &motion))
            .collect();
        let device = |sensor| draw_device(spec, sensor, seed, end);
        let accelerometer = device(Sensor::Accelerometer)?;
        let gyroscope = device(Sensor::Gyroscope)?;
        let magnetometer = device(Sensor::Magnetometer)?;
        let delays = Delays::of(&accelerometer, &gyroscope);
        let (gravity, temperature) = (spec.true_gravity(), spec.temperature.clone());
        let lost_spans = lost_spans(spec, &motion);
        let field = spec.magnetic_field.map(|field| field.place(seed, &motion));
        let world = World {
            motion,
            gravity,
            temperature,
            field,
            disturbances: disturbances.iter().flatten().cloned().collect(),
        };
        Ok(Self {
            spec: spec.clone(),
            world,
            accelerometer,
            gyroscope,
            magnetometer,
            delays,
            disturbances,
            lost_spans,
        })
    }

    /// The request.
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// Length of the recording, s.
    pub fn duration(&self) -> f64 {
        self.world.motion.end()
    }

    /// Begin and end of every placement, s.
    pub fn placements(&self) -> Vec<(f64, f64)> {
        self.rests()
            .map(|(segment, _)| (segment.start, segment.end))
            .collect()
    }

    /// The thermometer's readings; `None` without a thermometer.
    pub fn thermometer(&self) -> Option<Temperature> {
        let temperature = self.spec.temperature.as_ref()?;
        let mut random = Random::new(self.spec.seed, Purpose::Thermometer);
        let count = (self.duration() * temperature.rate).floor() as usize + 1;
        let fast = 1.0 + self.spec.clock_rate_error();
        let changes = clock_changes(&self.spec.faults);
        let (t, celsius) = (0..count)
            .map(|k| {
                let t = k as f64 / temperature.rate;
                let celsius = temperature.at(t) + temperature.noise * random.normal();
                let late = |change: &ClockChange| (t - change.start).max(0.0) * change.rate_error;
                (t * fast + changes.iter().map(late).sum::<f64>(), celsius)
            })
            .unzip();
        Some(Temperature { t, celsius })
    }

    /// Computes the true motion and surroundings of the device at time `t`, s.
    ///
    /// ```
    /// use stillpoint_simulate::{Simulation, Spec};
    ///
    /// let simulation = Simulation::new(&Spec::still(1, 2.0))?;
    /// assert_eq!(simulation.kinematics(1.0).angular_rate.norm(), 0.0);
    /// # Ok::<(), recording::Error>(())
    /// ```
    pub fn kinematics(&self, t: f64) -> Kinematics<f64> {
        self.world.kinematics(t)
    }

    pub(crate) fn world(&self) -> &World {
        &self.world
    }

    pub(crate) fn device(&self, sensor: Sensor) -> &Device {
        match sensor {
            Sensor::Accelerometer => &self.accelerometer,
            Sensor::Gyroscope => &self.gyroscope,
            Sensor::Magnetometer => &self.magnetometer,
        }
    }

    /// Returns true if the device has the sensor. It has a magnetometer if there is a magnetic field.
    pub fn has(&self, sensor: Sensor) -> bool {
        sensor != Sensor::Magnetometer || self.spec.magnetic_field.is_some()
    }

    /// When samples are lost that leave no gap in the stamps, s.
    pub(crate) fn lost_spans(&self) -> &[Range<f64>] {
        &self.lost_spans
    }

    pub(crate) fn delays(&self) -> &Delays {
        &self.delays
    }

    pub(crate) fn drift_means(&self) -> DriftMeans {
        let rests = self
            .rests()
            .map(|(segment, _)| (segment.start, segment.end));
        DriftMeans::new(rests.collect())
    }

    pub(crate) fn truth(&self, drift: &DriftMeans) -> Truth {
        let sensors = Sensor::ALL.into_iter().filter(|&sensor| self.has(sensor));
        let models = sensors.map(|sensor| &self.device(sensor).model);
        let effects = models
            .flat_map(|m| m.effects())
            .map(|e| e.name().to_owned());
        Truth {
            schema: TRUTH_SCHEMA.into(),
            spec: self.spec.clone(),
            accelerometer: self.in_recorded_units(Sensor::Accelerometer),
            gyroscope: self.in_recorded_units(Sensor::Gyroscope),
            magnetometer: match self.has(Sensor::Magnetometer) {
                true => self.in_recorded_units(Sensor::Magnetometer),
                false => Parameters::default(),
            },
            accelerometer_noise: self.spec.noise(Sensor::Accelerometer),
            gyroscope_noise: self.spec.noise(Sensor::Gyroscope),
            effects: effects.collect(),
            hidden: self.hidden_truth(),
            static_intervals: self
                .rests()
                .enumerate()
                .map(|(k, (segment, rest))| self.static_interval(segment, rest, k, drift))
                .collect(),
        }
    }

    fn hidden_truth(&self) -> Vec<HiddenTruth> {
        let hidden = self.spec.hidden.iter().zip(&self.disturbances);
        hidden
            .map(|(hidden, placed)| HiddenTruth {
                name: hidden.name().to_owned(),
                amplitude: hidden.amplitude(),
                drawn: placed
                    .as_ref()
                    .map(|p| p.disturbance.drawn())
                    .unwrap_or_default(),
            })
            .collect()
    }

    fn rests(&self) -> impl Iterator<Item = (&Segment, &Rest)> {
        let segments = self.world.motion.segments().iter();
        segments.filter_map(|segment| Some((segment, segment.rest.as_ref()?)))
    }

    fn static_interval(
        &self,
        segment: &Segment,
        rest: &Rest,
        k: usize,
        drift: &DriftMeans,
    ) -> StaticInterval {
        let in_units = |sensor: Sensor| {
            (drift.mean(sensor, k) / self.spec.sensor(sensor).unit_per_count()).into()
        };
        let q = segment.attitude;
        StaticInterval {
            label: rest.label.clone(),
            start: segment.start,
            end: segment.end,
            attitude: [q.w, q.i, q.j, q.k],
            specific_force: self.world.resting_force(segment.start).into(),
            temperature: self
                .world
                .temperature_at(0.5 * (segment.start + segment.end)),
            vibration: rest.vibration.map(f64::sqrt).into(),
            accelerometer_drift: in_units(Sensor::Accelerometer),
            gyroscope_drift: in_units(Sensor::Gyroscope),
            faults: rest.faults.clone(),
        }
    }

    /// The true parameters for what is written down: with counts `c = raw/lsb + zero`,
    /// `T (raw − b) = T lsb (c − zero − b/lsb)`.
    fn in_recorded_units(&self, sensor: Sensor) -> Parameters {
        let mut parameters = self.device(sensor).parameters.clone();
        let own = self.spec.sensor(sensor);
        if own.counts {
            let (t, bias) = parameters.values_mut()[..12].split_at_mut(9);
            t.iter_mut().for_each(|v| *v *= own.step);
            bias.iter_mut()
                .for_each(|v| *v = ZERO_COUNT + *v / own.step);
        }
        parameters
    }
}

/// The middles of the turns in which samples are lost without a trace.
fn lost_spans(spec: &Spec, motion: &Motion) -> Vec<Range<f64>> {
    let turns = || motion.segments().iter().filter(|s| s.rest.is_none());
    let span = |fault: &Fault| match *fault {
        Fault::Lost { turn, length } => turns().nth(turn).map(|segment| {
            let middle = 0.5 * (segment.start + segment.end);
            middle - 0.5 * length..middle + 0.5 * length
        }),
        _ => None,
    };
    spec.faults.iter().filter_map(span).collect()
}

/// Returns the changes of the device's clock among the faults.
pub(super) fn clock_changes(faults: &[Fault]) -> Vec<ClockChange> {
    let change = |fault: &Fault| match *fault {
        Fault::ClockChange { start, rate_error } => Some(ClockChange { start, rate_error }),
        _ => None,
    };
    faults.iter().filter_map(change).collect()
}
