//! Columns of the Jacobian for errors that the model lacks.

use faer::Mat;
use nalgebra::Vector3;
use sensor::{AnyEffect, Kinematics, Sensor};
use solver::scalar::{derivatives, variable};
use solver::{Jet, LANES, lit};

use crate::methods::joint::Sensitivities;

/// Where an error is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// The truth; of a rest that in the middle of a chunk.
    pub truth: &'a Kinematics<f64>,
    /// The chunk, or the turn.
    pub place: Place,
}

/// A stretch of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A chunk of a rest, by its place in the data.
    Chunk(usize),
    /// A turn, by its place in the data.
    Turn(usize),
}

/// `∂r/∂c` (`m × count`) of an error `Σ c_j e_j` of a sensor; `errors` pushes the `e_j` at one instant.
///
/// At rest the instant is the middle of a chunk. A turn is that of its samples; the accelerometer has
/// no part in it.
pub fn error_columns(
    sensitivities: &Sensitivities,
    m: usize,
    sensor: Sensor,
    count: usize,
    errors: impl Fn(&Instant<'_>, &mut Vec<Vector3<f64>>),
) -> Mat<f64> {
    let mut out = Mat::zeros(m, count);
    let mut e = Vec::with_capacity(count);
    for mean in sensitivities.means.iter().filter(|s| s.sensor == sensor) {
        e.clear();
        let place = Place::Chunk(mean.chunk);
        let truth = &mean.truth;
        errors(&Instant { truth, place }, &mut e);
        for (j, e) in e.iter().enumerate() {
            let shift = mean.by_error * e;
            for i in 0..3 {
                out[(mean.row + i, j)] = shift[i];
            }
        }
    }
    if sensor == Sensor::Gyroscope {
        for turn in &sensitivities.turns {
            let place = Place::Turn(turn.turn);
            for (by_error, truth) in turn.by_error.iter().zip(&turn.truth) {
                e.clear();
                errors(&Instant { truth, place }, &mut e);
                for (j, e) in e.iter().enumerate() {
                    let shift = by_error * e;
                    out[(turn.row, j)] += shift[0];
                    out[(turn.row + 1, j)] += shift[1];
                }
            }
        }
    }
    out
}

/// `∂r/∂p` (`m × wanted`) of some parameters of an effect at its values `p`.
pub fn effect_columns(
    sensitivities: &Sensitivities,
    m: usize,
    effect: &dyn AnyEffect,
    p: &[f64],
    wanted: &[usize],
) -> Mat<f64> {
    let sensor = effect.sensor();
    error_columns(sensitivities, m, sensor, wanted.len(), |instant, out| {
        let lifted = instant.truth.lift();
        for group in wanted.chunks(LANES) {
            let mut point: Vec<Jet> = p.iter().map(|&v| lit(v)).collect();
            for (lane, &k) in group.iter().enumerate() {
                point[k] = variable(p[k], lane);
            }
            let error = effect.error_jet(&lifted, &point);
            let slopes = [0, 1, 2].map(|i| derivatives(&error[i]));
            out.extend((0..group.len()).map(|lane| Vector3::from_fn(|i, _| slopes[i][lane])));
        }
    })
}
