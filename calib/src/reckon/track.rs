//! The equations of motion, integrated through one motion.

use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;
use sensor::attitude::Attitude;

use super::ending::{Ending, level_the_end, shortest_rotation, stop_at_the_end};
use super::motion::Motion;
use recording::Error;
use recording::intervals::{Moments, Span};
use recording::{Recording, Stream};

/// Source of the attitude.
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
    /// Norm of the specific force in the rest before, m/s².
    pub gravity: f64,
    /// Velocity at the end before any correction, m/s.
    pub end_velocity: Vector3<f64>,
    /// Angle by which the attitude at the end was corrected, rad.
    pub end_tilt: Option<f64>,
}

impl Track {
    /// Returns the position at the end of the motion, m.
    pub fn displacement(&self) -> Vector3<f64> {
        self.position.last().copied().unwrap_or_else(Vector3::zeros)
    }

    /// Returns the horizontal distance and the height of the end of the motion, m.
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
/// is the norm of gravity: an accelerometer's error along the vertical then cancels. Attitude by
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
    let force = stream(corrected, Sensor::Accelerometer)?;
    let rest = resting(corrected, force, motion.before)?;
    let samples = force.between(motion.span.from, motion.span.to);
    if samples.len() < 2 {
        return Err(Error::not_enough(
            Finding::of(Kind::SAMPLES_TOO_FEW)
                .in_recording(&corrected.name)
                .of_sensor(Sensor::Accelerometer)
                .count("count", samples.len())
                .count("least", 2),
        ));
    }
    let (t, f) = (&force.t[samples.clone()], &force.values[samples]);
    let up = nearest_axis(&rest);
    let first = Attitude::exp(&shortest_rotation(&rest, &up));
    let mut attitudes = match mode {
        Mode::Level => vec![first; t.len()],
        Mode::Full => {
            let rate = stream(corrected, Sensor::Gyroscope)?;
            let bias = resting(corrected, rate, motion.before)?;
            turned(first, t, |t| rate.at(t).unwrap_or(bias) - bias)
        }
    };
    let length = t[t.len() - 1] - t[0];
    let share: Vec<f64> = t.iter().map(|stamp| (stamp - t[0]) / length).collect();
    let after = motion.after.and_then(|span| mean(force, span));
    let end_tilt = after
        .filter(|_| ending == Ending::Attitude && mode == Mode::Full)
        .map(|resting| level_the_end(&mut attitudes, &share, &resting, &up));
    let gravity = up * rest.norm();
    let rotated = attitudes
        .iter()
        .zip(f)
        .map(|(attitude, f)| attitude.into_reference(f));
    let acceleration: Vec<Vector3<f64>> = rotated.map(|f| f - gravity).collect();
    let mut velocity = integral(t, &acceleration);
    let end_velocity = velocity[velocity.len() - 1];
    if after.is_some() && ending != Ending::Free {
        stop_at_the_end(&mut velocity, &share);
    }
    let position = integral(t, &velocity);
    let gravity = rest.norm();
    Ok(Track {
        t: t.to_vec(),
        velocity,
        position,
        up,
        gravity,
        end_velocity,
        end_tilt,
    })
}

/// A sensor of the recording.
fn stream(recording: &Recording, sensor: Sensor) -> Result<&Stream, Error> {
    recording.stream(sensor).ok_or_else(|| {
        Error::not_enough(
            Finding::of(Kind::SENSOR_NOT_RECORDED)
                .in_recording(&recording.name)
                .of_sensor(sensor),
        )
    })
}

/// The mean of a sensor in the rest before the motion.
fn resting(recording: &Recording, stream: &Stream, span: Span) -> Result<Vector3<f64>, Error> {
    mean(stream, span).ok_or_else(|| {
        Error::not_enough(
            Finding::of(Kind::NO_SAMPLES_AT_REST)
                .in_recording(&recording.name)
                .between(span.from, span.to),
        )
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

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.81;
    const STEP: f64 = 0.01;
    /// Two seconds at rest, four of motion, two at rest.
    const MOTION: Motion = Motion {
        before: Span { from: 0.0, to: 2.0 },
        span: Span {
            from: 2.0,
            to: 6.005,
        },
        after: Some(Span {
            from: 6.005,
            to: 8.0,
        }),
    };

    /// A device that turns about the vertical by `turn` rad during the motion (smoothly, at a constant
    /// rate) while it moves along the reference x axis with `a = A sin(π (t − 2)/2)`: at rest again
    /// after 4 s, `8 A/π` away. Its gyroscope has a bias, `tilt_rate` besides while it moves, and it
    /// lies tilted.
    fn recording(turn: f64, tilt_rate: Vector3<f64>) -> Recording {
        let tilted = Attitude::exp(&Vector3::new(0.1, -0.05, 0.0));
        let (mut force, mut rate) = (Stream::default(), Stream::default());
        for k in 0..800 {
            let t = f64::from(k) * STEP;
            let tau = (t - 2.0).clamp(0.0, 4.0);
            let moving = (2.0..=6.0).contains(&t);
            let yaw = Attitude::exp(&Vector3::new(0.0, 0.0, turn * tau / 4.0));
            let attitude = yaw.then(&tilted);
            let a = (std::f64::consts::FRAC_PI_2 * tau).sin();
            let up = Vector3::new(0.0, 0.0, G);
            force.t.push(t);
            force
                .values
                .push(attitude.into_body(&(Vector3::new(a, 0.0, 0.0) + up)));
            let omega = Vector3::new(0.0, 0.0, if moving { turn / 4.0 } else { 0.0 });
            let extra = if moving { tilt_rate } else { Vector3::zeros() };
            rate.t.push(t);
            rate.values
                .push(tilted.into_body(&omega) + extra + Vector3::new(0.01, 0.02, -0.03));
        }
        Recording {
            accelerometer: Some(force),
            gyroscope: Some(rate),
            ..Recording::default()
        }
    }

    fn end(recording: &Recording, mode: Mode, ending: Ending) -> Vector3<f64> {
        reckon(recording, &MOTION, mode, ending)
            .unwrap()
            .displacement()
    }

    /// `∫∫ sin(π t/2) = 8/π` after 4 s. The frame is the body's, levelled: turned by what the tilt of
    /// 0.1 and −0.05 rad turns the levelled x axis, 0.0025 rad.
    #[test]
    fn a_push_along_a_line_ends_where_it_ended_whatever_the_device_turned() {
        let truth = 8.0 / std::f64::consts::PI;
        for turn in [0.0, 1.0, -3.0] {
            let recording = recording(turn, Vector3::zeros());
            let found = end(&recording, Mode::Full, Ending::Free);
            // Trapezoidal rule: a relative error of (π/2 · 0.01)²/12, and the start of the turn lies
            // within a step of the stamps.
            assert!(
                (found.norm() / truth - 1.0).abs() < 0.01,
                "{turn}: {found:?}"
            );
            assert!(
                (found.y / found.x).abs() < 0.01 && found.z.abs() < 0.01,
                "{turn}: {found:?}"
            );
        }
    }

    #[test]
    fn level_mode_is_right_without_turning_and_wrong_with_it() {
        let truth = 8.0 / std::f64::consts::PI;
        let straight = end(&recording(0.0, Vector3::zeros()), Mode::Level, Ending::Free);
        assert!((straight.norm() / truth - 1.0).abs() < 1e-3, "{straight:?}");
        let turned = end(&recording(3.0, Vector3::zeros()), Mode::Level, Ending::Free);
        assert!((turned - straight).norm() > 0.5, "{turned:?}");
    }

    /// A rate of 1 mrad/s that is not there tilts the attitude by 4 mrad in the end: left alone it costs
    /// `g ω t³/6 = 0.10 m`; the rest after the motion takes it off.
    #[test]
    fn a_rest_at_the_end_takes_off_a_bias_that_came_with_the_motion() {
        let truth = end(&recording(0.0, Vector3::zeros()), Mode::Full, Ending::Free);
        let drifting = recording(0.0, Vector3::new(0.0, 1e-3, 0.0));
        let error = |ending| (end(&drifting, Mode::Full, ending) - truth).norm();
        assert!((error(Ending::Free) / (G * 1e-3 * 64.0 / 6.0) - 1.0).abs() < 0.02);
        assert!(error(Ending::Velocity) < 0.6 * error(Ending::Free));
        assert!(
            error(Ending::Attitude) < 1e-3,
            "{}",
            error(Ending::Attitude)
        );
        let track = reckon(&drifting, &MOTION, Mode::Full, Ending::Attitude).unwrap();
        assert!(
            (track.end_tilt.unwrap() / 4e-3 - 1.0).abs() < 0.01,
            "{:?}",
            track.end_tilt
        );
    }

    #[test]
    fn without_a_rest_after_the_motion_every_ending_is_free() {
        let recording = recording(1.0, Vector3::new(1e-3, 0.0, 0.0));
        let motion = Motion {
            after: None,
            ..MOTION
        };
        let free = reckon(&recording, &motion, Mode::Full, Ending::Free).unwrap();
        assert_eq!(
            reckon(&recording, &motion, Mode::Full, Ending::Attitude).unwrap(),
            free
        );
    }

    #[test]
    fn a_missing_sensor_or_rest_is_named() {
        let mut recording = recording(0.0, Vector3::zeros());
        recording.name = "run".into();
        let early = Motion {
            before: Span {
                from: -2.0,
                to: -1.0,
            },
            ..MOTION
        };
        let message = |r: Result<Track, Error>| r.unwrap_err().to_string();
        let found = message(reckon(&recording, &early, Mode::Full, Ending::Free));
        assert!(
            found.starts_with("run: no samples between -2.00"),
            "{found}"
        );
        recording.gyroscope = None;
        let found = message(reckon(&recording, &MOTION, Mode::Full, Ending::Free));
        assert_eq!(found, "run: the recording has no gyroscope; record it too");
        assert!(reckon(&recording, &MOTION, Mode::Level, Ending::Free).is_ok());
    }
}
