//! Placements and turns as a plan says, followed by a hand that is a little off.

use effects::covariates::last_change;
use nalgebra::{UnitQuaternion, UnitVector3, Vector3};
use plan::{Pace, Turn};
use serde::{Deserialize, Serialize};

use super::orientation::upright;
use super::path::Path;
use super::placements::{Surroundings, place};
use super::profile::Profile;
use super::segment::{Rest, Twist};
use super::turn::{Hand, hand_moves};
use crate::random::{Purpose, Random};

/// A rotation about a fixed axis of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub struct PlannedLeg {
    /// Axis, body frame.
    pub axis: [f64; 3],
    /// rad.
    pub angle: f64,
    /// Duration of the turn, s.
    pub duration: f64,
}

/// Turns one after the other and the rest at their end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub struct PlannedStep {
    /// Turns of the device, one after the other.
    pub legs: Vec<PlannedLeg>,
    /// Duration of the static interval after them, s.
    pub rest: f64,
}

impl PlannedStep {
    /// These turns of a plan at this pace, and a rest of so many seconds.
    pub fn of<'a>(turns: impl IntoIterator<Item = &'a Turn>, pace: &Pace, rest: f64) -> Self {
        let turns = turns.into_iter();
        let legs = turns.flat_map(|turn| turn.legs.iter().zip(turn.durations(pace)));
        let legs = legs.map(|(leg, duration)| PlannedLeg {
            axis: leg.axis.into(),
            angle: leg.angle,
            duration,
        });
        Self {
            legs: legs.collect(),
            rest,
        }
    }
}

/// A session that follows a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Planned {
    /// Body direction that points up at first.
    pub up: [f64; 3],
    /// Duration of the first static interval, s.
    pub first_rest: f64,
    /// Steps after the first static interval.
    pub steps: Vec<PlannedStep>,
    /// Deviation of a placement from the plan, rad (standard deviation per axis).
    pub scatter: f64,
    /// Height by which the hand lifts the device, m.
    pub lift: f64,
    /// Tremor of the hand: 1 is 0.3 m/s² and 0.1 rad/s at 6 to 10 Hz.
    pub tremor: f64,
}

impl Default for Planned {
    fn default() -> Self {
        Self {
            up: [0.0, 0.0, 1.0],
            first_rest: 60.0,
            steps: Vec::new(),
            scatter: 0.05,
            lift: 0.12,
            tremor: 1.0,
        }
    }
}

impl Planned {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        let mut random = Random::new(around.seed, Purpose::Motion);
        let off = |random: &mut Random| random.normal3() * self.scatter;
        let hand = Hand {
            lift: self.lift,
            tremor: self.tremor,
            ..Hand::default()
        };
        let mut missed = off(&mut random);
        let mut planned = upright(&Vector3::from(self.up).normalize());
        let first = planned * UnitQuaternion::from_scaled_axis(missed);
        let mut path = Path::starting_at(first);
        let force = |path: &Path| path.attitude().inverse() * (Vector3::z() * around.gravity);
        let mut change = Vector3::zeros();
        let mut before = force(&path);
        let mut table = Random::new(around.seed, Purpose::Table);
        let first = rest(&change, 0, around, &mut table);
        place(&mut path, 0, self.first_rest, first, around);
        for (k, step) in self.steps.iter().enumerate() {
            let length: f64 = step.legs.iter().map(|leg| leg.duration).sum();
            let (start, end) = (path.end(), path.end() + length);
            let whole = Profile::Blend { start, end };
            let next = off(&mut random);
            let mut twists = vec![Twist::new(-missed, whole)];
            let mut from = start;
            for leg in &step.legs {
                let axis = UnitVector3::new_normalize(Vector3::from(leg.axis));
                let rotation = axis.scale(leg.angle);
                let to = from + leg.duration;
                twists.push(Twist::new(
                    rotation,
                    Profile::Blend {
                        start: from,
                        end: to,
                    },
                ));
                planned *= UnitQuaternion::from_scaled_axis(rotation);
                from = to;
            }
            twists.push(Twist::new(next, whole));
            missed = next;
            let moves = hand_moves(&hand, (start, end), &mut random, &mut twists);
            path.movement(length, twists, moves);
            let now = force(&path);
            change = last_change(&change, &before, &now);
            before = now;
            let next = rest(&change, k + 1, around, &mut table);
            place(&mut path, k + 1, step.rest, next, around);
        }
        path
    }
}

fn rest(change: &Vector3<f64>, k: usize, around: &Surroundings, table: &mut Random) -> Rest {
    Rest {
        label: format!("planned {}", k + 1),
        last_change: *change,
        vibration: around
            .vibration
            .map_or_else(Vector3::zeros, |v| v.draw(table)),
        ..Rest::default()
    }
}
