//! Columns of the Jacobian for errors that the model lacks.

use faer::Mat;
use nalgebra::{Matrix2x3, Vector2, Vector3};
use sensor::{EffectRef, Kinematics, Sensor};

use super::by_parameters::ByParameters;
use super::sensitivity::{MeanSensitivity, Sensitivities};

/// Instant at which an error is evaluated.
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

/// Instants of a turn at which the error is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// At every sample.
    Every,
    /// In its middle: for errors that hardly change within a turn.
    Middle,
}

/// `∂r/∂c` (`m × count`) of an error `Σ c_j e_j` of a sensor; `errors` pushes the `e_j` at one instant.
///
/// At rest the instant is the middle of a chunk. The accelerometer has no part in turns.
pub fn error_columns(
    sensitivities: &Sensitivities,
    m: usize,
    (sensor, sampling): (Sensor, Sampling),
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
    if sensor == Sensor::Accelerometer {
        return out;
    }
    for turn in &sensitivities.turns {
        let place = Place::Turn(turn.turn);
        let mut sums = vec![Vector2::zeros(); count];
        let mut add = |by_error: &Matrix2x3<f64>, truth: &Kinematics<f64>| {
            e.clear();
            errors(&Instant { truth, place }, &mut e);
            for (sum, e) in sums.iter_mut().zip(&e) {
                *sum += by_error * e;
            }
        };
        match (sampling, turn.truth.get(turn.truth.len() / 2)) {
            (Sampling::Middle, Some(truth)) => add(&turn.by_error.iter().sum(), truth),
            _ => turn
                .by_error
                .iter()
                .zip(&turn.truth)
                .for_each(|(g, truth)| add(g, truth)),
        }
        for (j, sum) in sums.iter().enumerate() {
            out[(turn.row, j)] = sum[0];
            out[(turn.row + 1, j)] = sum[1];
        }
    }
    out
}

/// `∂r/∂p` (`m × wanted`) of some parameters of an effect at its values `p`.
pub fn effect_columns(
    sensitivities: &Sensitivities,
    m: usize,
    effect: &EffectRef,
    p: &[f64],
    wanted: &[usize],
) -> Mat<f64> {
    let (sensor, slopes) = (effect.sensor(), ByParameters::new(effect, p, wanted));
    error_columns(
        sensitivities,
        m,
        (sensor, Sampling::Every),
        wanted.len(),
        |instant, out| slopes.at(instant.truth, out),
    )
}

/// The columns of an effect that begins at an instant, for all `instants` (s since the start of the recording)
/// side by side (`m × wanted · instants`): what it would be had it always been there, from then on.
pub fn step_columns(
    sensitivities: &Sensitivities,
    m: usize,
    effect: &EffectRef,
    (p, wanted): (&[f64], &[usize]),
    instants: &[f64],
) -> Mat<f64> {
    let (q, slopes) = (wanted.len(), ByParameters::new(effect, p, wanted));
    let mut out = Mat::zeros(m, q * instants.len());
    let mut e = Vec::with_capacity(q);
    let of_sensor = |s: &&MeanSensitivity| s.sensor == effect.sensor();
    for mean in sensitivities.means.iter().filter(of_sensor) {
        e.clear();
        slopes.at(&mean.truth, &mut e);
        for (k, _) in instants
            .iter()
            .enumerate()
            .filter(|(_, t)| mean.truth.time > **t)
        {
            for (j, e) in e.iter().enumerate() {
                let shift = mean.by_error * e;
                for i in 0..3 {
                    out[(mean.row + i, q * k + j)] = shift[i];
                }
            }
        }
    }
    if effect.sensor() == Sensor::Accelerometer {
        return out;
    }
    for turn in &sensitivities.turns {
        // From the last sample backwards: `sums` is what the samples after the instant add up to.
        let mut sums = vec![Vector2::zeros(); q];
        let mut samples = turn.by_error.iter().zip(&turn.truth).rev().peekable();
        for (k, instant) in instants.iter().enumerate().rev() {
            while let Some((by_error, truth)) = samples.next_if(|(_, truth)| truth.time > *instant)
            {
                e.clear();
                slopes.at(truth, &mut e);
                for (sum, e) in sums.iter_mut().zip(&e) {
                    *sum += by_error * e;
                }
            }
            for (j, sum) in sums.iter().enumerate() {
                out[(turn.row, q * k + j)] = sum[0];
                out[(turn.row + 1, q * k + j)] = sum[1];
            }
        }
    }
    out
}

/// Pushes `∂e/∂p` of the parameters `wanted`.
pub fn effect_slopes(
    effect: &EffectRef,
    truth: &Kinematics<f64>,
    p: &[f64],
    wanted: &[usize],
    out: &mut Vec<Vector3<f64>>,
) {
    ByParameters::new(effect, p, wanted).at(truth, out);
}
