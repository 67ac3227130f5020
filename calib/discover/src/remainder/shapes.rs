//! Shapes of a disagreement that no effect of the catalogue has.
//!
//! They tell what is left, in words: none is put into the model as if it were physics.

use std::f64::consts::PI;

use estimate::methods::joint::{Instant, Mean, Place, Sampling, error_columns};
use nalgebra::Vector3;
use sensor::Sensor;

use super::harmonics::fine_orientation;
use super::shape::{Errors, Shape, Way};
use crate::family::{Claim, Family, Hypothesis, beside, by_heading};
use crate::state::State;

findings::tuning! {
    /// Cosines of time tried.
    COSINES: usize = 6;

    /// Periods tried at most; a period shorter than two rests is not seen in their means.
    PERIODS: usize = 80;

    /// Full periods that a recording must hold: of fewer, a walk looks the same.
    LEAST_PERIODS: f64 = 2.0;
}

/// Time constants of a relaxation after a turn, s.
const RELAXATIONS: [f64; 3] = [1.0, 3.0, 10.0];

/// Time constants of a bias that settles in one recording, s.
const SETTLINGS: [f64; 3] = [25.0, 75.0, 225.0];

/// Typical sizes of an unknown bias, m/s² and rad/s.
const TYPICAL: [f64; 2] = [5e-3, 1e-4];

/// All shapes for both sensors.
pub fn shapes(state: &State) -> Vec<Family> {
    let mut sensors = vec![Sensor::Accelerometer];
    if state.fit.has_gyroscope() {
        sensors.push(Sensor::Gyroscope);
    }
    let scene = Scene::of(state);
    sensors
        .into_iter()
        .flat_map(|sensor| Shape::ALL.map(|shape| (shape, sensor)))
        .filter(|(shape, sensor)| *shape != Shape::RateProducts || *sensor == Sensor::Gyroscope)
        .map(|(shape, sensor)| family(state, &scene, shape, sensor))
        .collect()
}

fn family(state: &State, scene: &Scene<'_>, shape: Shape, sensor: Sensor) -> Family {
    let typical = TYPICAL[usize::from(sensor == Sensor::Gyroscope)];
    let mut hypotheses = Vec::new();
    let mut parts = Vec::new();
    let mut first = 0;
    for ((mut count, errors, value), place) in ways(scene, shape, sensor) {
        let sampling = match shape {
            Shape::SlowTime | Shape::Periodic | Shape::LastTurn | Shape::OneRecording => {
                Sampling::Middle
            }
            _ => Sampling::Every,
        };
        let mut columns = error_columns(
            &state.sensitivities,
            state.rows(),
            (sensor, sampling),
            count,
            errors,
        );
        columns *= faer::Scale(typical);
        if shape == Shape::Heading {
            columns = by_heading(state, columns, count);
            count = columns.ncols();
        }
        parts.push(columns);
        hypotheses.push(Hypothesis {
            shape: value.map(|v| (0, v)),
            place,
            columns: first..first + count,
        });
        first += count;
    }
    Family {
        claim: Claim::Shape(shape, sensor),
        log_places: (hypotheses.len().max(1) as f64).ln(),
        hypotheses,
        columns: state.cut(state.whitened(beside(&parts, state.rows()))),
        typical,
        shape_dof: 0.0,
    }
}

/// The ways of a shape, and the recording of one that is in one alone.
fn ways<'a>(scene: &'a Scene<'a>, shape: Shape, sensor: Sensor) -> Vec<(Way<'a>, Option<usize>)> {
    if shape == Shape::OneRecording {
        let ways = scene.of_one_recording().into_iter();
        return ways
            .map(|(recording, way)| (way, Some(recording)))
            .collect();
    }
    let ways = ways_of_all(scene, shape, sensor).into_iter();
    ways.map(|way| (way, None)).collect()
}

fn ways_of_all<'a>(scene: &'a Scene<'a>, shape: Shape, sensor: Sensor) -> Vec<Way<'a>> {
    match shape {
        Shape::OneRecording => Vec::new(),
        Shape::FineOrientation => fine_orientation(sensor),
        Shape::SlowTime => vec![(
            3 * COSINES.get(),
            Box::new(|i, out| scene.cosines(i, out)),
            None,
        )],
        Shape::Periodic => scene.periods(),
        Shape::Heading => vec![
            (2, Box::new(horizontal), None),
            (6, Box::new(heading), None),
        ],
        Shape::LastTurn => {
            let mut ways: Vec<Way<'a>> =
                vec![(9, Box::new(|i, out| scene.after_turn(i, None, out)), None)];
            for tau in RELAXATIONS {
                ways.push((
                    3,
                    Box::new(move |i, out| scene.relaxation(i, tau, out)),
                    Some(tau),
                ));
            }
            ways
        }
        Shape::RateProducts => vec![(9, Box::new(rate_products), None)],
    }
}

/// Unit vectors times each of some factors: an error of any axis.
fn on_every_axis(factors: &[f64], out: &mut Vec<Vector3<f64>>) {
    for factor in factors {
        for axis in 0..3 {
            let mut e = Vector3::zeros();
            e[axis] = *factor;
            out.push(e);
        }
    }
}

/// The two horizontal axes of the world, seen from the body.
fn horizontal(i: &Instant<'_>, out: &mut Vec<Vector3<f64>>) {
    out.push(i.truth.attitude.into_body(&Vector3::x()));
    out.push(i.truth.attitude.into_body(&Vector3::y()));
}

/// Cosine and sine of the heading on every axis.
fn heading(i: &Instant<'_>, out: &mut Vec<Vector3<f64>>) {
    let forward = i.truth.attitude.into_reference(&Vector3::x());
    let angle = forward.y.atan2(forward.x);
    on_every_axis(&[angle.cos(), angle.sin()], out);
}

fn rate_products(i: &Instant<'_>, out: &mut Vec<Vector3<f64>>) {
    let w = i.truth.angular_rate;
    on_every_axis(&[w.x * w.y, w.y * w.z, w.z * w.x], out);
}

/// Data of the whole session that shapes need.
struct Scene<'a> {
    state: &'a State,
    /// The rotation vector of the turn before every rest, rad; zero where there is none.
    last_turn: Vec<Vector3<f64>>,
    /// First and last time.
    ends: (f64, f64),
}

impl<'a> Scene<'a> {
    fn of(state: &'a State) -> Self {
        let mut last_turn = vec![Vector3::zeros(); state.fit.data.rests.len()];
        for turn in &state.sensitivities.turns {
            let rotation: Vector3<f64> = turn
                .truth
                .iter()
                .zip(&state.fit.data.turns[turn.turn].lengths)
                .map(|(truth, length)| truth.angular_rate * *length)
                .sum();
            last_turn[state.fit.data.turns[turn.turn].from + 1] = rotation;
        }
        let times = state.sensitivities.means.iter().map(|m| m.truth.time);
        let ends = times.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| {
            (a.min(t), b.max(t))
        });
        Self {
            state,
            last_turn,
            ends,
        }
    }

    fn length(&self) -> f64 {
        (self.ends.1 - self.ends.0).max(1.0)
    }

    fn cosines(&self, i: &Instant<'_>, out: &mut Vec<Vector3<f64>>) {
        let phase = PI * (i.truth.time - self.ends.0) / self.length();
        let factors: Vec<f64> = (1..=COSINES.get())
            .map(|k| (k as f64 * phase).cos())
            .collect();
        on_every_axis(&factors, out);
    }

    /// Frequencies from two periods to one per rest, two thirds of the resolution apart.
    fn periods(&self) -> Vec<Way<'_>> {
        let rests = self.state.fit.data.rests.len() as f64;
        let (lowest, highest) = (LEAST_PERIODS.get() / self.length(), rests / self.length());
        let count = ((highest - lowest) * self.length() * 1.5) as usize;
        (0..=count.min(PERIODS.get()))
            .map(|k| -> Way<'_> {
                let f =
                    lowest + (highest - lowest) * k as f64 / count.clamp(1, PERIODS.get()) as f64;
                (
                    6,
                    Box::new(move |i: &Instant<'_>, out: &mut Vec<Vector3<f64>>| {
                        let damping = self.averaged(i, f);
                        let phase = 2.0 * PI * f * i.truth.time;
                        on_every_axis(&[damping * phase.cos(), damping * phase.sin()], out);
                    }),
                    Some(1.0 / f),
                )
            })
            .collect()
    }

    /// Returns the factor by which averaging over a chunk reduces a cosine of this `frequency`, Hz.
    fn averaged(&self, i: &Instant<'_>, frequency: f64) -> f64 {
        let x = PI * frequency * self.mean(i).map_or(0.0, |m| m.span.length());
        if x.abs() < 1e-6 { 1.0 } else { x.sin() / x }
    }

    fn mean(&self, i: &Instant<'_>) -> Option<&Mean> {
        let Place::Chunk(k) = i.place else {
            return None;
        };
        let chunk = &self.state.fit.data.chunks[k];
        chunk.gyroscope.as_ref().or(chunk.accelerometer.as_ref())
    }

    /// Builds the shapes of single recordings, where there are several: a drift, exponential settling and a step at each
    /// boundary. Biases begin anew in every recording.
    fn of_one_recording(&self) -> Vec<(usize, Way<'_>)> {
        let count = self.state.fit.data.sources.len();
        let recordings = if count > 1 { 0..count } else { 0..0 };
        let of = |recording: usize| {
            let by_time = move |law: fn(f64, f64) -> f64, length: f64| -> Way<'_> {
                let moved: Errors<'_> = Box::new(move |i, out| {
                    let is_in = f64::from(u8::from(self.is_in(i, recording)));
                    on_every_axis(&[is_in * law(i.truth.time, length)], out);
                });
                (3, moved, None)
            };
            let drift = by_time(|t, length| t / length, self.length());
            let settles = SETTLINGS.map(|tau| by_time(|t, tau| (-t / tau).exp(), tau));
            let step = move |t: f64| -> Way<'_> {
                let moved: Errors<'_> = Box::new(move |i, out| {
                    let is_after = self.is_in(i, recording) && i.truth.time > t;
                    on_every_axis(&[f64::from(u8::from(is_after))], out);
                });
                (3, moved, Some(t))
            };
            let steps = self.state.boundaries_in(recording).into_iter().map(step);
            let ways = std::iter::once(drift).chain(settles).chain(steps);
            ways.map(move |way| (recording, way)).collect::<Vec<_>>()
        };
        recordings.flat_map(of).collect()
    }

    fn is_in(&self, i: &Instant<'_>, recording: usize) -> bool {
        let data = &self.state.fit.data;
        match i.place {
            Place::Chunk(k) => data.rests[data.chunks[k].rest].recording == recording,
            Place::Turn(k) => data.turns[k].recording == recording,
        }
    }

    fn rest(&self, i: &Instant<'_>) -> Option<usize> {
        match i.place {
            Place::Chunk(k) => Some(self.state.fit.data.chunks[k].rest),
            Place::Turn(_) => None,
        }
    }

    /// The rotation vector of the last turn, on every axis.
    fn after_turn(&self, i: &Instant<'_>, decay: Option<f64>, out: &mut Vec<Vector3<f64>>) {
        let v = self
            .rest(i)
            .map_or_else(Vector3::zeros, |k| self.last_turn[k]);
        let factor = decay.unwrap_or(1.0);
        on_every_axis(&[factor * v.x, factor * v.y, factor * v.z], out);
    }

    /// The sign of the last turn about the own axis, decaying since its end.
    fn relaxation(&self, i: &Instant<'_>, tau: f64, out: &mut Vec<Vector3<f64>>) {
        let (mut v, mut decay) = (Vector3::zeros(), 0.0);
        if let (Some(k), Some(mean)) = (self.rest(i), self.mean(i)) {
            v = self.last_turn[k].map(|a| if a.abs() > 0.1 { a.signum() } else { 0.0 });
            let since = mean.span.from - self.state.fit.data.rests[k].span.from;
            let length = mean.span.length().max(1e-3);
            decay = (-since / tau).exp() * (1.0 - (-length / tau).exp()) * tau / length;
        }
        for axis in 0..3 {
            let mut e = Vector3::zeros();
            e[axis] = v[axis] * decay;
            out.push(e);
        }
    }
}
