//! A walk with the device held in front, as in reading a text.

use std::f64::consts::TAU;

use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::path::Path;
use super::placements::{Surroundings, place};
use super::profile::Profile;
use super::segment::{Move, Rest, Twist};
use crate::random::{Purpose, Random};

/// Still, a straight walk, still again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Walking {
    /// Length of the walk, m.
    pub distance: f64,
    /// Duration of the walk, s.
    pub duration: f64,
    /// Time for which the walker stands before, s; 5 s after.
    pub rest: f64,
    /// Angle of the device's y axis above the horizon, rad.
    pub pitch: f64,
    /// Steps per second.
    pub cadence: f64,
    /// Amplitude of the body's bobbing up and down, m.
    pub bob: f64,
}

impl Default for Walking {
    fn default() -> Self {
        Self {
            distance: 4.095,
            duration: 6.4,
            rest: 30.0,
            pitch: 0.54,
            cadence: 1.8,
            bob: 0.02,
        }
    }
}

/// Time for which the walker stands at the end, s.
const LAST_REST: f64 = 5.0;

impl Walking {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        let mut random = Random::new(around.seed, Purpose::Motion);
        let attitude = UnitQuaternion::from_scaled_axis(Vector3::x() * self.pitch);
        let mut path = Path::starting_at(attitude);
        let rest = Rest::called("before the walk");
        place(&mut path, 0, self.rest, rest, around);
        let (twists, moves) = self.steps(path.end(), &mut random);
        path.movement(self.duration, twists, moves);
        let rest = Rest::called("after the walk");
        place(&mut path, 1, LAST_REST, rest, around);
        path
    }

    /// Forward in one blend; up and down and nodding with every step, sideways and rolling with every
    /// other.
    fn steps(&self, start: f64, random: &mut Random) -> (Vec<Twist>, Vec<Move>) {
        let end = start + self.duration;
        let mut wave = |frequency: f64| {
            let phase = random.uniform(0.0..TAU);
            Profile::Tremor {
                start,
                end,
                frequency,
                phase,
            }
        };
        let (step, stride) = (wave(self.cadence), wave(0.5 * self.cadence));
        let heel = wave(4.0 * self.cadence);
        let moves = vec![
            Move::new(Vector3::y() * self.distance, Profile::Blend { start, end }),
            Move::new(Vector3::z() * self.bob, step),
            Move::new(Vector3::z() * (0.04 * self.bob), heel),
            Move::new(Vector3::x() * self.bob, stride),
        ];
        let nod = self.bob / 0.6;
        let twists = vec![
            Twist::new(Vector3::x() * nod, step),
            Twist::new(Vector3::y() * nod, stride),
            Twist::new(Vector3::z() * nod, wave(0.5 * self.cadence)),
        ];
        (twists, moves)
    }
}
