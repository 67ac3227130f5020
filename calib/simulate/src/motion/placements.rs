//! Placements one after the other, with turns by hand between them.

use effects::covariates::last_change;
use nalgebra::{UnitQuaternion, Vector3};

use super::path::Path;
use super::profile::Profile;
use super::segment::{Move, Rest, Twist};
use super::turn::{Hand, turn_to};
use super::unsteady::unsteady;
use crate::random::{Purpose, Random};
use crate::surroundings::{Fault, Unsteady, Vibration};

/// One placement and the turn that leads to it.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    /// Words for it.
    pub label: String,
    /// Body to reference.
    pub attitude: UnitQuaternion<f64>,
    /// Duration of the static interval, s.
    pub rest: f64,
    /// Duration of the turn before it, s.
    pub turn: f64,
}

/// Surroundings of placements, whatever the motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surroundings<'a> {
    /// Seed of the simulation.
    pub seed: u64,
    /// Norm of gravity, m/s².
    pub gravity: f64,
    /// Table that vibrates.
    pub vibration: Option<&'a Vibration>,
    /// Motion during placements, where the device should be at rest.
    pub unsteady: Option<&'a Unsteady>,
    /// Faults of the recording.
    pub faults: &'a [Fault],
}

/// The path through all placements.
pub(crate) fn path_through(
    placements: &[Placement],
    hand: &Hand,
    around: &Surroundings,
    random: &mut Random,
) -> Path {
    let first = placements
        .first()
        .map_or_else(UnitQuaternion::identity, |p| p.attitude);
    let mut path = Path::starting_at(first);
    let mut shocks = Random::new(around.seed, Purpose::Shock);
    let mut knocks = Random::new(around.seed, Purpose::Knocks);
    let mut table = Random::new(around.seed, Purpose::Table);
    let mut change = Vector3::zeros();
    let mut before: Option<Vector3<f64>> = None;
    for (k, placement) in placements.iter().enumerate() {
        if k > 0 {
            turn_to(
                &mut path,
                &placement.attitude,
                placement.turn,
                hand,
                random,
                [&mut shocks, &mut knocks],
            );
        }
        let force = placement.attitude.inverse() * (Vector3::z() * around.gravity);
        change = before.map_or(change, |b| last_change(&change, &b, &force));
        before = Some(force);
        let rest = Rest {
            label: placement.label.clone(),
            last_change: change,
            vibration: around
                .vibration
                .map_or_else(Vector3::zeros, |v| v.draw(&mut table)),
            ..Rest::default()
        };
        place(&mut path, k, placement.rest, rest, around);
    }
    path
}

/// Longest duration of a touch, s.
const TOUCH_LENGTH: f64 = 1.0;
/// Frequency of a touch, Hz.
const TOUCH_FREQUENCY: f64 = 5.0;

/// Appends a rest, disturbed by the faults that name interval `k`.
pub(crate) fn place(path: &mut Path, k: usize, length: f64, mut rest: Rest, around: &Surroundings) {
    let mut held = Random::new(around.seed, Purpose::Unsteady(k));
    let (start, end) = (path.end(), path.end() + length);
    let (mut twists, mut moves) = match around.unsteady {
        Some(spec) => unsteady(spec, path, length, &mut held),
        None => (Vec::new(), Vec::new()),
    };
    for (place, fault) in around.faults.iter().enumerate() {
        let mut random = Random::new(around.seed, Purpose::Fault(place));
        match *fault {
            Fault::Slip { interval, angle } if interval == k => {
                let rotation = random.direction() * angle;
                twists.push(Twist::new(rotation, Profile::Blend { start, end }));
                rest.faults.push("mount_slip".into());
            }
            Fault::Touch { interval, size } if interval == k => {
                let rate = std::f64::consts::TAU * TOUCH_FREQUENCY;
                let displacement = random.direction() * (size / (rate * rate));
                moves.push(Move::new(displacement, touch(start, end, &mut random)));
                rest.faults.push("disturbed_interval".into());
            }
            Fault::Disturbed { interval, size } if interval == k => {
                rest.push += random.direction() * size;
                rest.faults.push("disturbed_interval".into());
            }
            _ => {}
        }
    }
    path.rest(length, rest, twists, moves);
}

/// A tremor somewhere inside the interval.
fn touch(start: f64, end: f64, random: &mut Random) -> Profile {
    let length = TOUCH_LENGTH.min(0.5 * (end - start));
    let start = random.uniform(start..end - length);
    Profile::Tremor {
        start,
        end: start + length,
        frequency: TOUCH_FREQUENCY,
        phase: 0.0,
    }
}
