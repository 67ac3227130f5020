//! Orientations of a placed device.

use std::f64::consts::TAU;

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use crate::random::Random;

/// A body direction that points up.
#[derive(Clone, Debug)]
pub(crate) struct Orientation {
    /// `face +z`, `edge +x-y`, `corner +x+y+z` or `random`.
    pub label: String,
    /// Body direction that points up, unit length.
    pub up: Vector3<f64>,
}

impl Orientation {
    /// A direction without a name.
    pub fn random(random: &mut Random) -> Self {
        Self {
            label: "random".into(),
            up: random.direction(),
        }
    }

    /// A direction in the body's x-y plane.
    pub fn in_plane(random: &mut Random) -> Self {
        let (sin, cos) = random.uniform(0.0..TAU).sin_cos();
        Self {
            label: "random in the x-y plane".into(),
            up: Vector3::new(cos, sin, 0.0),
        }
    }

    /// The attitude (body to reference) with this direction up, a random heading, and a hand that is
    /// `scatter` rad (standard deviation per axis) off.
    pub fn attitude(&self, scatter: f64, random: &mut Random) -> UnitQuaternion<f64> {
        let heading = UnitQuaternion::from_scaled_axis(Vector3::z() * random.uniform(0.0..TAU));
        let off = UnitQuaternion::from_scaled_axis(random.normal3() * scatter);
        heading * off * upright(&self.up)
    }
}

/// The shortest rotation that carries `up` to the z axis.
pub(crate) fn upright(up: &Vector3<f64>) -> UnitQuaternion<f64> {
    let rotation = Rotation3::rotation_between(up, &Vector3::z())
        .unwrap_or_else(|| Rotation3::from_scaled_axis(Vector3::x() * (TAU / 2.0)));
    UnitQuaternion::from_rotation_matrix(&rotation)
}

/// All directions whose components are −1, 0 or 1, with `nonzero` of them not 0: 6 faces (1),
/// 12 edges (2), 8 corners (3).
pub(crate) fn lattice(nonzero: usize) -> Vec<Orientation> {
    let kind = match nonzero {
        1 => "face",
        2 => "edge",
        _ => "corner",
    };
    (0..27)
        .map(|k| Vector3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1))
        .filter(|v| v.iter().filter(|&&c| c != 0).count() == nonzero)
        .map(|v| Orientation {
            label: format!("{kind} {}", signed_axes(&v)),
            up: v.map(f64::from).normalize(),
        })
        .collect()
}

fn signed_axes(v: &Vector3<i32>) -> String {
    let names = ["x", "y", "z"];
    let parts = v.iter().zip(names).filter(|(c, _)| **c != 0);
    parts
        .map(|(c, name)| format!("{}{name}", if *c > 0 { '+' } else { '-' }))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;

    #[test]
    fn a_cube_has_six_faces_twelve_edges_and_eight_corners() {
        assert_eq!([1, 2, 3].map(|n| lattice(n).len()), [6, 12, 8]);
    }

    #[test]
    fn without_scatter_the_named_direction_points_up() {
        let mut random = Random::new(1, Purpose::Motion);
        for n in 1..=3 {
            for orientation in lattice(n) {
                let attitude = orientation.attitude(0.0, &mut random);
                assert!((attitude * orientation.up - Vector3::z()).norm() < 1e-14);
            }
        }
    }
}
