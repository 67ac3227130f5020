//! The equations of motion, integrated through one motion.

use nalgebra::Vector3;
use sensor::attitude::Attitude;

use super::ending::{Ending, level_the_end, shortest_rotation, stop_at_the_end};
use super::motion::Motion;
use crate::error::Error;
use crate::intervals::{Moments, Span};
use crate::recording::{Recording, Stream};

/// Where the attitude comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// From the gyroscope.
    #[default]
    Full,
    /// It stays that of the rest before the motion.
    Level,
}

/// Velocity and position through a motion.
///
/// The frame is that of the body at the start, turned by the least that makes the axis which points
/// up most vertical: `x` of a flat device stays its horizontal `x`.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Time stamps, s.
    pub t: Vec<f64>,
    /// Velocity, m/s.
    pub velocity: Vec<Vector3<f64>>,
    /// Position since the start of the motion, m.
    pub position: Vec<Vector3<f64>>,
    /// The axis that points up (unit).
    pub up: Vector3<f64>,
    /// Modulus of the specific force in the rest before, m/s².
    pub gravity: f64,
    /// Velocity at the end before any correction, m/s.
    pub end_velocity: Vector3<f64>,
    /// Angle by which the attitude at the end was corrected, rad.
    pub end_tilt: Option<f64>,
}

impl Track {
    /// Where the motion ended, m.
    pub fn displacement(&self) -> Vector3<f64> {
        self.position.last().copied().unwrap_or_else(Vector3::zeros)
    }

    /// How far the motion went in the horizontal plane, and how far up, m.
    pub fn distance(&self) -> (f64, f64) {
        let end = self.displacement();
        let height = end.dot(&self.up);
        ((end - self.up * height).norm(), height)
    }
}

/// Solves `v' = T f + g, p' = v, T' = T [ω×]` from rest, without the earth's rotation, for a
/// corrected recording.
///
/// The first attitude and the bias of the gyroscope are those of the rest before the motion, and so
/// is the modulus of gravity: an accelerometer's error along the vertical then cancels. Attitude by
/// the exponential map on mean rates, velocity and position by the trapezoidal rule, all with the
/// stamps' own steps. An ending other than [`Ending::Free`] needs a rest after the motion and is
/// left out where there is none; [`Mode::Level`] never turns, so that of [`Ending::Attitude`] only
/// the velocity is left.
///
/// # Errors
/// A recording without accelerometer, without gyroscope in [`Mode::Full`], or without samples in the
/// rest or the motion.
pub fn reckon(
    corrected: &Recording,
    motion: &Motion,
    mode: Mode,
    ending: Ending,
) -> Result<Track, Error> {
    let missing = |what: &str| Error::NotEnough(format!("{}: {what}", corrected.name));
    let force = corrected
        .accelerometer
        .as_ref()
        .ok_or_else(|| missing("no accelerometer"))?;
    let rest = mean(force, motion.before).ok_or_else(|| missing("no samples at rest"))?;
    let samples = force.between(motion.span.from, motion.span.to);
    if samples.len() < 2 {
        return Err(missing(
            "fewer than two accelerometer samples in the motion",
        ));
    }
    let (t, f) = (&force.t[samples.clone()], &force.values[samples]);
    let up = nearest_axis(&rest);
    let first = Attitude::exp(&shortest_rotation(&rest, &up));
    let mut attitudes = match mode {
        Mode::Level => vec![first; t.len()],
        Mode::Full => {
            let rate = corrected
                .gyroscope
                .as_ref()
                .ok_or_else(|| missing("no gyroscope"))?;
            let bias = mean(rate, motion.before).ok_or_else(|| missing("no gyroscope at rest"))?;
            turned(first, t, |t| rate.at(t).unwrap_or(bias) - bias)
        }
    };
    let length = t[t.len() - 1] - t[0];
    let share: Vec<f64> = t.iter().map(|stamp| (stamp - t[0]) / length).collect();
    let after = motion.after.and_then(|span| mean(force, span));
    let end_tilt = after
        .filter(|_| ending == Ending::Attitude && mode == Mode::Full)
        .map(|resting| level_the_end(&mut attitudes, &share, &resting, &up));
    let acceleration: Vec<Vector3<f64>> = attitudes
        .iter()
        .zip(f)
        .map(|(attitude, f)| attitude.into_reference(f) - up * rest.norm())
        .collect();
    let mut velocity = integral(t, &acceleration);
    let end_velocity = velocity[velocity.len() - 1];
    if after.is_some() && ending != Ending::Free {
        stop_at_the_end(&mut velocity, &share);
    }
    let position = integral(t, &velocity);
    Ok(Track {
        t: t.to_vec(),
        velocity,
        position,
        up,
        gravity: rest.norm(),
        end_velocity,
        end_tilt,
    })
}

fn mean(stream: &Stream, span: Span) -> Option<Vector3<f64>> {
    Moments::of(&stream.values[stream.between(span.from, span.to)]).map(|m| m.mean)
}

/// The signed unit axis nearest to a direction.
fn nearest_axis(direction: &Vector3<f64>) -> Vector3<f64> {
    let k = direction.iamax();
    let mut axis = Vector3::zeros();
    axis[k] = direction[k].signum();
    axis
}

/// The attitudes at the stamps, from the first one and the rate between neighbouring stamps.
fn turned(
    first: Attitude<f64>,
    t: &[f64],
    rate: impl Fn(f64) -> Vector3<f64>,
) -> Vec<Attitude<f64>> {
    let mut attitude = first;
    let mut attitudes = vec![first];
    for step in t.windows(2) {
        let mean = (rate(step[0]) + rate(step[1])) * 0.5;
        attitude = attitude.then(&Attitude::exp(&(mean * (step[1] - step[0]))));
        attitudes.push(attitude);
    }
    attitudes
}

/// The integral from the first stamp on, by the trapezoidal rule.
fn integral(t: &[f64], y: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut sum = Vector3::zeros();
    let mut sums = vec![sum];
    for (t, y) in t.windows(2).zip(y.windows(2)) {
        sum += (y[0] + y[1]) * (0.5 * (t[1] - t[0]));
        sums.push(sum);
    }
    sums
}
