//! One recording's turns, directions of gravity and static rates, for the gyroscope's fit.

use nalgebra::{DMatrix, Vector3};
use sensor::{Kinematics, Model};

use super::{GyroBias, Request};
use crate::intervals::{Segmentation, StaticInterval, Turn};
use crate::methods::{AccelerometerFit, GyroscopeData, known_of};
use crate::recording::Recording;
use crate::residuals::{StaticMean, TurnData};

/// Where the data come from.
pub(super) struct Source<'a> {
    pub recording: &'a Recording,
    pub segmentation: &'a Segmentation,
    /// Place of the recording in the accelerometer's fit; `None` if it was not in it.
    pub place: Option<usize>,
    pub accelerometer: &'a AccelerometerFit,
    pub request: &'a Request,
}

impl Source<'_> {
    /// Corrected specific force of a raw reading, m/s².
    fn force(&self, raw: &Vector3<f64>, rest: &Kinematics<f64>) -> Vector3<f64> {
        let model = &self.accelerometer.model;
        let shared = model.parameters().len();
        let fitted = &self.accelerometer.fitted;
        let p = match self.place {
            Some(k) => fitted.local(shared, k),
            None => fitted.parameters.values()[..shared].to_vec(),
        };
        model.correct(raw, rest, &p)
    }

    /// The accelerometer's parameters for this recording moved by independent combinations of their errors, each with a
    /// variance of one.
    fn moved(&self) -> Vec<Vec<f64>> {
        let fitted = &self.accelerometer.fitted;
        let n = fitted.free.len();
        let covariance = DMatrix::from_fn(n, n, |i, k| fitted.covariance[i][k]);
        let Some(factor) = covariance.cholesky() else {
            return Vec::new();
        };
        let lower = factor.l();
        let shared = self.accelerometer.model.parameters().len();
        let mode = |k: usize| {
            let mut fitted = fitted.clone();
            for (name, step) in fitted.free.clone().iter().zip(lower.column(k).iter()) {
                if let Some(place) = fitted.parameters.index(name) {
                    fitted.parameters.values_mut()[place] += step;
                }
            }
            match self.place {
                Some(k) => fitted.local(shared, k),
                None => fitted.parameters.values()[..shared].to_vec(),
            }
        };
        (0..n).map(mode).collect()
    }

    /// The direction of specific force in a rest by these parameters.
    fn direction(&self, rest: &StaticInterval, p: &[f64]) -> Option<Vector3<f64>> {
        let known = known_of(self.recording, rest, Vector3::zeros());
        let force = self
            .accelerometer
            .model
            .correct(&rest.accelerometer?.mean, &known, p);
        Some(force.normalize())
    }

    /// Corrected mean specific force of a rest, m/s².
    fn force_at_rest(&self, rest: &StaticInterval) -> Option<Vector3<f64>> {
        let known = known_of(self.recording, rest, Vector3::zeros());
        Some(self.force(&rest.accelerometer?.mean, &known))
    }
}

/// Collects the sound turns and names the others in `warnings`.
pub(super) fn collect(
    source: &Source<'_>,
    model: &Model,
    warnings: &mut Vec<String>,
) -> GyroscopeData {
    let Source {
        recording,
        segmentation,
        ..
    } = source;
    let mut data = GyroscopeData {
        name: recording.name.clone(),
        turns: Vec::new(),
        turn_bias: Vec::new(),
        moved: Vec::new(),
        statics: Vec::new(),
    };
    for rest in &segmentation.statics {
        let (Some(gyroscope), Some(force)) = (rest.gyroscope, source.force_at_rest(rest)) else {
            continue;
        };
        let known = known_of(recording, rest, force);
        data.statics.push(StaticMean {
            raw: gyroscope.mean,
            rest: known,
            white: gyroscope.white_of_mean(),
        });
    }
    let moved = source.moved();
    for turn in &segmentation.turns {
        if let Some(fault) = &turn.fault {
            warnings.push(format!(
                "{}: turn {} (t = {:.2} to {:.2} s) is not used: {fault}",
                recording.name,
                turn.from + 1,
                turn.span.from,
                turn.span.to
            ));
            continue;
        }
        if let Some((samples, bias)) = one_turn(source, model, turn) {
            let ends = [turn.from, turn.from + 1].map(|k| &segmentation.statics[k]);
            let here = [samples.before, samples.after];
            let by = |p: &Vec<f64>| -> Option<[Vector3<f64>; 2]> {
                let [before, after] = ends.map(|rest| source.direction(rest, p));
                Some([before? - here[0], after? - here[1]])
            };
            data.moved.push(moved.iter().filter_map(by).collect());
            data.turns.push(samples);
            data.turn_bias.push(bias);
        }
    }
    data
}

fn one_turn(source: &Source<'_>, model: &Model, turn: &Turn) -> Option<(TurnData, Vector3<f64>)> {
    let statics = &source.segmentation.statics;
    let (before, after) = (statics.get(turn.from)?, statics.get(turn.from + 1)?);
    let stream = source.recording.gyroscope.as_ref()?;
    let stamps = &stream.t[turn.samples.clone()];
    let bias = match source.request.gyro_bias {
        GyroBias::Adjacent => 0.5 * (before.gyroscope?.mean + after.gyroscope?.mean),
        GyroBias::Initial => statics.first()?.gyroscope?.mean,
    };
    let t: Vec<f64> = match source.request.nominal_step {
        Some(step) => (0..stamps.len()).map(|k| k as f64 * step).collect(),
        None => stamps.to_vec(),
    };
    let rest = if model.effects().is_empty() {
        Vec::new()
    } else {
        stamps.iter().map(|&t| moving(source, t)).collect()
    };
    let data = TurnData {
        t,
        readings: stream.values[turn.samples.clone()].to_vec(),
        rest,
        before: source.force_at_rest(before)?.normalize(),
        after: source.force_at_rest(after)?.normalize(),
    };
    Some((data, bias))
}

/// What is known besides the gyroscope at time `t` of a turn.
fn moving(source: &Source<'_>, t: f64) -> Kinematics<f64> {
    let recording = source.recording;
    let mut known = Kinematics::at_rest(Vector3::zeros());
    known.time = t - recording.start();
    if let Some(celsius) = recording.temperature.as_ref().and_then(|c| c.at(t)) {
        known.temperature = celsius;
    }
    if let Some(raw) = recording
        .accelerometer
        .as_ref()
        .and_then(|stream| stream.at(t))
    {
        known.specific_force = source.force(&raw, &known);
    }
    known
}
