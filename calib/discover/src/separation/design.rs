//! A recording that is made to tell tied effects apart, and what it would say of them.

use estimate::methods::joint::BiasNoise;
use nalgebra::Vector3;
use plan::{Timing, Turn};
use recording::watch::Watch;
use sensor::EffectRef;
use simulate::{Grade, Motion, Planned, PlannedStep, Sampling, SensorSpec, Spec, Temperature};

use super::information::Information;
use super::rivalry::Rivalry;
use crate::request::{Request, Session};
use crate::state::{Extension, State};

findings::tuning! {
    /// Half of what temperature rises and falls by, K.
    SWING: f64 = 8.0;

    /// Samples per second of a recording that is tried: the noise is given by its density, so that more tell the same. They are
    /// points of a smooth motion, not means: a third of the time, and what errors would do there is the same.
    RATE: f64 = 50.0;
}

/// Properties of the device, and the constraints on a recording.
#[derive(Clone, Debug)]
pub struct Conditions {
    /// White noise densities, m/s²/√Hz and rad/s/√Hz.
    pub white: [f64; 2],
    /// Noise of the biases.
    pub noise: BiasNoise,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Rests and pace.
    pub timing: Timing,
    /// True if the device is warmed while it records.
    pub warmed: bool,
    /// The effects.
    pub catalogue: Vec<EffectRef>,
    /// Told of every step.
    pub watch: Watch,
}

/// A recording to make.
#[derive(Clone, Debug)]
pub struct Design {
    /// Directions that point up, one placement after the other.
    pub ups: Vec<Vector3<f64>>,
    /// From each to the next.
    pub turns: Vec<Turn>,
    /// Durations of the static intervals and pace of the turns.
    pub timing: Timing,
    /// True if the device is warmed for half of the time and then left to cool.
    pub warmed: bool,
}

impl Design {
    /// Returns its duration, s.
    pub fn duration(&self) -> f64 {
        let turns = self.turns.iter();
        let turning: f64 = turns
            .flat_map(|turn| turn.durations(&self.timing.pace))
            .sum();
        let rests = self.ups.len().saturating_sub(1) as f64;
        self.timing.first_rest + rests * self.timing.rest + turning
    }

    /// Builds its motion for the simulator.
    pub fn motion(&self) -> Planned {
        let step = |turn| PlannedStep::of([turn], &self.timing.pace, self.timing.rest);
        Planned {
            up: self.ups.first().map_or([0.0, 0.0, 1.0], |up| (*up).into()),
            first_rest: self.timing.first_rest,
            steps: self.turns.iter().map(step).collect(),
            ..Planned::default()
        }
    }

    /// Returns the temperature during the recording; `None` where the device is not warmed.
    pub fn temperature(&self) -> Option<Temperature> {
        self.warmed.then(|| Temperature {
            swing: 2.0 * SWING.get(),
            period: 2.0 * self.duration(),
            self_heating: 0.0,
            ..Temperature::default()
        })
    }

    fn spec(&self, conditions: &Conditions) -> Spec {
        let white = |k: usize| SensorSpec {
            white: Some(conditions.white[k]),
            ..SensorSpec::default()
        };
        Spec {
            rate: RATE.get(),
            sampling: Sampling::Point,
            gravity: conditions.gravity,
            motion: Motion::Planned(Planned {
                tremor: 0.0,
                ..self.motion()
            }),
            grade: Grade::Perfect,
            accelerometer: white(0),
            gyroscope: white(1),
            temperature: self.temperature(),
            ..Spec::default()
        }
    }

    /// Computes its information on every rivalry; `None` where the session cannot be calibrated.
    fn seen(&self, rivalries: &[Rivalry], conditions: &Conditions) -> Option<Vec<Information>> {
        let recordings = [self.spec(conditions).run().ok()?.recording];
        let request = Request {
            noise: Some(conditions.noise),
            ..Request::new(conditions.gravity)
        };
        let session = Session::new(&recordings, &request).ok()?;
        let state = State::fit(&session, Extension::default()).ok()?;
        let catalogue = &conditions.catalogue;
        let of = |rivalry: &Rivalry| rivalry.seen_by(&state, conditions.noise, catalogue);
        Some(rivalries.iter().map(of).collect())
    }

    /// `λ (1 − ρ²)` of every rivalry, by what was recorded and this together.
    pub(super) fn separations(&self, rivalries: &[Rivalry], conditions: &Conditions) -> Vec<f64> {
        match self.seen(rivalries, conditions) {
            Some(seen) => rivalries
                .iter()
                .zip(&seen)
                .map(|(rivalry, new)| rivalry.separation_with(&rivalry.recorded.plus(new)))
                .collect(),
            None => vec![0.0; rivalries.len()],
        }
    }
}
