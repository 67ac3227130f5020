//! One recording's turns, directions of gravity and static rates, for the gyroscope's fit.

use findings::{Finding, Findings, Kind};
use nalgebra::{DMatrix, Matrix3, Vector3};
use recording::Recording;
use recording::intervals::{Segmentation, Turn};
use sensor::Model;

use crate::calibrate::request::{GyroBias, Request};
use crate::methods::{AccelerometerFit, GyroscopeData, RawUnit, gyroscope_guess};
use crate::residuals::{StaticMean, TurnData};
use crate::truth::{Models, Sensing, Truth};

/// Source of the data: a recording, its segmentation and the accelerometer's fit.
pub(super) struct Source<'a> {
    pub recording: &'a Recording,
    pub segmentation: &'a Segmentation,
    /// Place of the recording in the accelerometer's fit; `None` if it was not in it.
    pub place: Option<usize>,
    pub accelerometer: &'a AccelerometerFit,
    pub request: &'a Request,
}

impl<'a> Source<'a> {
    /// Builds the truth of the recording from the models of accelerometer and gyroscope so far.
    fn truth(&self, rate: Option<&Sensing>) -> Truth<'a> {
        let model = &self.accelerometer.model;
        let shared = model.parameter_count();
        let fitted = &self.accelerometer.fitted;
        let p = match self.place {
            Some(k) => fitted.local(shared, k),
            None => fitted.parameters.values()[..shared].to_vec(),
        };
        let models = Models {
            accelerometer: Some(Sensing::new(model.clone(), p)),
            gyroscope: rate.cloned(),
            ..Models::default()
        };
        Truth::as_far_as_known(self.recording, Some(self.segmentation), models)
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
        let shared = self.accelerometer.model.parameter_count();
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

    /// The direction of specific force in static interval `k` by these parameters.
    fn direction(&self, truth: &Truth<'_>, k: usize, p: &[f64]) -> Option<Vector3<f64>> {
        let mean = self.segmentation.statics.get(k)?.accelerometer?.mean;
        let model = &self.accelerometer.model;
        Some(model.correct(&mean, &truth.at_rest(k), p).normalize())
    }
}

/// The data of all sources for a gyroscope of this model, and what is named in `warnings`.
///
/// What its effects look at takes a first gyroscope: the unit and the axes that the turns show.
pub(super) fn collect_all(
    sources: &[Source<'_>],
    model: &Model,
    warnings: &mut Findings,
) -> Vec<GyroscopeData> {
    let bare: Vec<GyroscopeData> = sources
        .iter()
        .map(|source| collect(source, None, warnings))
        .collect();
    if model.effects().is_empty() {
        return bare;
    }
    let first = first_gyroscope(&bare, model);
    sources
        .iter()
        .map(|source| collect(source, Some(&first), &mut Findings::new()))
        .collect()
}

/// The same by a gyroscope that was fitted to them.
pub(super) fn collect_by(sources: &[Source<'_>], fitted: &Sensing) -> Vec<GyroscopeData> {
    let data = sources
        .iter()
        .map(|source| collect(source, Some(fitted), &mut Findings::new()));
    data.collect()
}

/// The gyroscope that the turns show at first: unit and axes, the bias from the static intervals.
fn first_gyroscope(bare: &[GyroscopeData], model: &Model) -> Sensing {
    let unbiased: Vec<TurnData> = bare
        .iter()
        .flat_map(|data| data.turns.iter().zip(&data.turn_bias))
        .map(|(turn, bias)| TurnData {
            readings: turn.readings.iter().map(|w| w - bias).collect(),
            ..turn.clone()
        })
        .collect();
    let guess = gyroscope_guess(&unbiased);
    let rests: Vec<&StaticMean> = bare.iter().flat_map(|data| &data.statics).collect();
    let zero = rests.iter().map(|mean| mean.raw).sum::<Vector3<f64>>() / rests.len().max(1) as f64;
    let mut first = Sensing::first(model.clone(), RawUnit { zero, ..guess.unit });
    let axes: Matrix3<f64> = guess.axes;
    for (value, (i, j)) in first.parameters.iter_mut().zip(sensor::PLACES) {
        *value = axes[(i, j)];
    }
    first
}

/// Collects the sound turns and names the others in `warnings`. What effects look at is known with a gyroscope so far.
fn collect(source: &Source<'_>, rate: Option<&Sensing>, warnings: &mut Findings) -> GyroscopeData {
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
    let truth = source.truth(rate);
    for (k, rest) in segmentation.statics.iter().enumerate() {
        let (Some(gyroscope), Some(_)) = (rest.gyroscope, rest.accelerometer) else {
            continue;
        };
        data.statics.push(StaticMean {
            raw: gyroscope.mean,
            rest: truth.at_rest(k),
            white: gyroscope.white_of_mean(),
        });
    }
    let moved = source.moved();
    for turn in &segmentation.turns {
        if let Some(fault) = &turn.fault {
            warnings.push(
                Finding::of(Kind::TURN_LOST)
                    .in_recording(&recording.name)
                    .at_turn(turn.from)
                    .between(turn.span.from, turn.span.to)
                    .detail("fault", fault.to_string()),
            );
            continue;
        }
        if let Some((samples, bias)) = one_turn(source, &truth, rate, turn) {
            let ends = [turn.from, turn.from + 1];
            let here = [samples.before, samples.after];
            let by = |p: &Vec<f64>| -> Option<[Vector3<f64>; 2]> {
                let [before, after] = ends.map(|k| source.direction(&truth, k, p));
                Some([before? - here[0], after? - here[1]])
            };
            data.moved.push(moved.iter().filter_map(by).collect());
            data.turns.push(samples);
            data.turn_bias.push(bias);
        }
    }
    data
}

fn one_turn(
    source: &Source<'_>,
    truth: &Truth<'_>,
    rate: Option<&Sensing>,
    turn: &Turn,
) -> Option<(TurnData, Vector3<f64>)> {
    let statics = &source.segmentation.statics;
    let (before, after) = (statics.get(turn.from)?, statics.get(turn.from + 1)?);
    let stream = source.recording.gyroscope.as_ref()?;
    let stamps = &stream.t[turn.samples.clone()];
    let readings = stream.values[turn.samples.clone()].to_vec();
    let bias = match source.request.gyro_bias {
        GyroBias::Adjacent => 0.5 * (before.gyroscope?.mean + after.gyroscope?.mean),
        GyroBias::Initial => statics.first()?.gyroscope?.mean,
    };
    let t: Vec<f64> = match source.request.nominal_step {
        Some(step) => (0..stamps.len()).map(|k| k as f64 * step).collect(),
        None => stamps.to_vec(),
    };
    let rest = rate.map_or_else(Vec::new, |rate| {
        let near_si: Vec<_> = readings.iter().map(|w| rate.unit.to_si(w)).collect();
        truth.along(stamps, &near_si)
    });
    let ends = [(turn.from, before), (turn.from + 1, after)];
    let [before, after] = ends.map(|(k, rest)| {
        rest.accelerometer?;
        Some(truth.at_rest(k).specific_force.normalize())
    });
    let data = TurnData {
        t,
        readings,
        rest,
        before: before?,
        after: after?,
    };
    Some((data, bias))
}
