//! A cart pushed along one axis of the device.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::path::Path;
use super::placements::{Surroundings, place};
use super::profile::Profile;
use super::segment::{Move, Rest, Twist};
use crate::random::{Purpose, Random};

/// Still, a straight run on a level floor, still again. The device's x axis points up where the run is
/// along z, else its z axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "snake_case")]
pub struct Cart {
    /// Length of the run, m.
    pub distance: f64,
    /// Body direction of the run.
    pub along: [f64; 3],
    /// Duration of the run, s.
    pub duration: f64,
    /// Time at rest before and after the run, s.
    pub rest: f64,
    /// Rattle of the floor while rolling, m/s² (amplitude of each of four sines of 5 to 25 Hz).
    pub rattle: f64,
}

impl Default for Cart {
    fn default() -> Self {
        Self {
            distance: 4.095,
            along: [1.0, 0.0, 0.0],
            duration: 8.0,
            rest: 10.0,
            rattle: 0.3,
        }
    }
}

impl Cart {
    pub(crate) fn path(&self, around: &Surroundings) -> Path {
        let mut random = Random::new(around.seed, Purpose::Motion);
        let along = Vector3::from(self.along)
            .try_normalize(0.0)
            .unwrap_or_else(Vector3::x);
        let mut path = Path::starting_at(facing_east(&along));
        let rest = Rest::called("before the run");
        place(&mut path, 0, self.rest, rest, around);
        let (start, end) = (path.end(), path.end() + self.duration);
        let mut twists = Vec::new();
        let run = Vector3::x() * self.distance;
        let mut moves = vec![Move::new(run, Profile::Blend { start, end })];
        for _ in 0..if self.rattle > 0.0 { 4 } else { 0 } {
            let frequency = random.uniform(5.0..25.0);
            let rate = std::f64::consts::TAU * frequency;
            let phase = random.uniform(0.0..std::f64::consts::TAU);
            let profile = Profile::Tremor {
                start,
                end,
                frequency,
                phase,
            };
            let displacement = random.direction() * (self.rattle / (rate * rate));
            moves.push(Move::new(displacement, profile));
            // A rattling cart also rocks: over a base of about 0.3 m.
            let rotation = random.direction() * (displacement.norm() / 0.3);
            twists.push(Twist::new(rotation, profile));
        }
        path.movement(self.duration, twists, moves);
        let rest = Rest::called("after the run");
        place(&mut path, 1, self.rest, rest, around);
        path
    }
}

/// The attitude in which the body direction `along` points east and another axis points up.
fn facing_east(along: &Vector3<f64>) -> UnitQuaternion<f64> {
    let up = if along.z.abs() < 0.7 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let side = up.cross(along).normalize();
    let up = along.cross(&side);
    // Rows: what east, north and up are in the body.
    let rows = [along.transpose(), side.transpose(), up.transpose()];
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(
        nalgebra::Matrix3::from_rows(&rows),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_run_goes_east_whichever_axis_it_is_along() {
        for along in [
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ] {
            let attitude = facing_east(&Vector3::from(along));
            assert!((attitude * Vector3::from(along) - Vector3::x()).norm() < 1e-15);
        }
    }
}
