//! Directions that a hand can hold up, and what they are called.

use std::fmt::Write as _;

use nalgebra::Vector3;

/// Components below this count as zero, in a unit vector: sin 4°.
const ZERO: f64 = 0.07;

/// Angles in words are rounded to this, °.
const ROUNDED: f64 = 5.0;

/// Sides of a box in the words for it: `(up, the side it lies on)` of +x, −x, +y, −y, +z, −z.
type Sides = [(&'static str, &'static str); 6];

/// A phone: x to the right, y to the top, z out of the screen.
const PHONE: Sides = [
    ("right edge", "left long edge"),
    ("left edge", "right long edge"),
    ("top", "bottom edge"),
    ("bottom", "top edge"),
    ("screen", "back"),
    ("back", "screen"),
];

const AXES: Sides = [
    ("+x side", "-x side"),
    ("-x side", "+x side"),
    ("+y side", "-y side"),
    ("-y side", "+y side"),
    ("+z side", "-z side"),
    ("-z side", "+z side"),
];

/// Naming of the faces of a box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Words {
    /// Screen, back, top, bottom, left and right long edge.
    #[default]
    Phone,
    /// By the axes of the sensor.
    Axes,
}

impl Words {
    fn sides(self) -> &'static Sides {
        match self {
            Self::Phone => &PHONE,
            Self::Axes => &AXES,
        }
    }

    /// The side along an axis direction (0 to 5: +x, −x, +y, −y, +z, −z).
    pub fn side(self, k: usize) -> &'static str {
        self.sides()[k].0
    }

    /// The placement with `up` (unit, body frame) pointing up, as an instruction.
    ///
    /// ```
    /// use nalgebra::Vector3;
    /// use stillpoint_plan::Words;
    ///
    /// let edge = Vector3::new(1.0, 0.0, 1.0).normalize();
    /// assert_eq!(Words::Phone.placement(&edge), "on its left long edge, then tilt the screen up by 45°");
    /// ```
    pub fn placement(self, up: &Vector3<f64>) -> String {
        let mut axes: [usize; 3] = [0, 1, 2];
        // Of equal components a phone stands better on a long edge than on a short one, and best on its back.
        let preference = [2, 0, 1];
        axes.sort_by(|a, b| {
            let size = |k: usize| (1e6 * up[k].abs()).round();
            size(*b)
                .total_cmp(&size(*a))
                .then(preference[*b].cmp(&preference[*a]))
        });
        let [p, q, r] = axes;
        // The first of two equal ones is where it stands, as in 'on its left long edge, the screen half up'.
        let (p, q) = if (up[p].abs() - up[q].abs()).abs() < 1e-6 && p == 2 {
            (q, p)
        } else {
            (p, q)
        };
        let side = |k: usize| 2 * k + usize::from(up[k] < 0.0);
        let mut words = format!("on its {}", self.sides()[side(p)].1);
        if p == 2 && up[q].abs() < ZERO {
            words = match (self, up[2] > 0.0) {
                (Self::Phone, screen_up) => findings::turns::flat(screen_up).into(),
                (Self::Axes, _) => words,
            };
        }
        let tilts = [(q, up[q].abs().atan2(up[p].abs())), (r, up[r].abs().asin())];
        let mut then = ", then tilt";
        for (k, angle) in tilts.into_iter().filter(|(k, _)| up[*k].abs() >= ZERO) {
            let degrees = ROUNDED * (angle.to_degrees() / ROUNDED).round();
            let _ = write!(
                words,
                "{then} the {} up by {degrees:.0}°",
                self.side(side(k))
            );
            then = " and";
        }
        words
    }
}

/// `z up`, `x up and y down`, `x up, y up and z down`: the axes that have a part in what points up.
pub fn axes_up(up: &Vector3<f64>) -> String {
    let parts: Vec<String> = (0..3)
        .filter(|k| up[*k].abs() >= ZERO)
        .map(|k| {
            let axis = ["x", "y", "z"][k];
            format!("{axis} {}", if up[k] > 0.0 { "up" } else { "down" })
        })
        .collect();
    match parts.as_slice() {
        [first, second, third] => format!("{first}, {second} and {third}"),
        parts => parts.join(" and "),
    }
}

/// The six directions of the axes: +x, −x, +y, −y, +z, −z.
pub fn faces() -> [Vector3<f64>; 6] {
    std::array::from_fn(|k| Vector3::ith(k / 2, if k % 2 == 0 { 1.0 } else { -1.0 }))
}

/// The twelve directions half-way between two neighbouring faces.
pub fn edges() -> Vec<Vector3<f64>> {
    lattice(2)
}

/// The eight directions half-way between three faces.
pub fn corners() -> Vec<Vector3<f64>> {
    lattice(3)
}

/// Faces, edges and corners: the 26 placements of the experiment's article.
pub fn faces_edges_corners() -> Vec<Vector3<f64>> {
    [faces().to_vec(), edges(), corners()].concat()
}

/// Faces, edges, corners, and tilts between them by 15° and 30°: what a hand can hold by the eye.
pub fn tilts() -> Vec<Vector3<f64>> {
    let mut all = faces_edges_corners();
    let degrees = |tilt: f64, raise: f64| {
        let (sin, cos) = f64::to_radians(tilt).sin_cos();
        let (up, level) = f64::to_radians(raise).sin_cos();
        Vector3::new(cos * level, sin * level, up)
    };
    let shapes = [
        (30.0, 0.0),
        (15.0, 0.0),
        (45.0, 15.0),
        (30.0, 30.0),
        (15.0, 15.0),
    ];
    for (tilt, raise) in shapes {
        for place in [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ] {
            for signs in 0..8 {
                let v = degrees(tilt, raise);
                let mut u = Vector3::zeros();
                for k in 0..3 {
                    u[place[k]] = if signs >> k & 1 == 0 { v[k] } else { -v[k] };
                }
                if all.iter().all(|other| (other - u).norm() > 1e-6) {
                    all.push(u);
                }
            }
        }
    }
    all
}

/// Every direction whose words have no rounding: both tilts whole multiples of 5°, the larger component first.
pub fn whole_angles() -> Vec<Vector3<f64>> {
    let mut all = Vec::new();
    for (p, q, r) in [
        (0, 1, 2),
        (0, 2, 1),
        (1, 0, 2),
        (1, 2, 0),
        (2, 0, 1),
        (2, 1, 0),
    ] {
        for (tilt, raise) in (0..=9).flat_map(|a| (0..=7).map(move |b| (a, b))) {
            let (q_part, p_part) = (ROUNDED * f64::from(tilt)).to_radians().sin_cos();
            let (r_part, level) = (ROUNDED * f64::from(raise)).to_radians().sin_cos();
            if r_part > q_part * level {
                continue;
            }
            for signs in 0..8 {
                let sign = |k: usize| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
                let mut u = Vector3::zeros();
                u[p] = sign(0) * p_part * level;
                u[q] = sign(1) * q_part * level;
                u[r] = sign(2) * r_part;
                all.push(u);
            }
        }
    }
    all
}

fn lattice(nonzero: usize) -> Vec<Vector3<f64>> {
    (0..27)
        .map(|k| Vector3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1))
        .filter(|v| v.iter().filter(|c| **c != 0).count() == nonzero)
        .map(|v| v.map(f64::from).normalize())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_edges_and_corners_are_26_and_tilts_contain_them() {
        assert_eq!(faces_edges_corners().len(), 26);
        let all = tilts();
        assert!(all.len() > 100 && all.iter().all(|u| (u.norm() - 1.0).abs() < 1e-12));
    }

    #[test]
    fn every_placement_of_a_phone_has_words_of_its_own() {
        let mut words: Vec<String> = tilts().iter().map(|u| Words::Phone.placement(u)).collect();
        let count = words.len();
        words.sort();
        words.dedup();
        assert_eq!(words.len(), count);
    }

    /// The device lies flat with its screen up, is stood on the side named first, and every side named then is raised.
    fn followed(words: &str, called: Words) -> Vector3<f64> {
        use nalgebra::{Rotation3, Unit};
        let axis = |k: usize| Vector3::ith(k / 2, if k.is_multiple_of(2) { 1.0 } else { -1.0 });
        let place =
            |of: &dyn Fn(usize) -> &'static str, name: &str| (0..6).find(|k| of(*k) == name);
        let stood = words.split(',').next().unwrap();
        let stood = stood
            .trim_start_matches("flat ")
            .trim_start_matches("on its ");
        let up = axis(place(&|k| called.sides()[k].1, stood).unwrap());
        let rotation = Rotation3::rotation_between(&up, &Vector3::z());
        // Face down there is no shortest way; any half turn will do.
        let half = Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
        let mut room = rotation
            .filter(|r| (r * up - Vector3::z()).norm() < 1e-9)
            .unwrap_or(half);
        let (_, tilts) = words.split_once(", then tilt ").unwrap_or(("", ""));
        for tilt in tilts.split(" and ").filter(|tilt| !tilt.is_empty()) {
            let (side, degrees) = tilt
                .trim_start_matches("the ")
                .split_once(" up by ")
                .unwrap();
            let side = room * axis(place(&|k| called.side(k), side).unwrap());
            assert!(
                side.z.abs() < 1e-9,
                "{words}: {tilt} is not level before it is raised"
            );
            let angle: f64 = degrees.trim_end_matches('°').parse().unwrap();
            let about = Unit::new_normalize(side.cross(&Vector3::z()));
            room = Rotation3::from_axis_angle(&about, angle.to_radians()) * room;
        }
        room.inverse() * Vector3::z()
    }

    #[test]
    fn who_follows_the_words_from_flat_with_the_screen_up_gets_the_direction() {
        for (all, within) in [(tilts(), 3.6), (whole_angles(), 1e-4)] {
            for (up, called) in all
                .iter()
                .flat_map(|u| [(u, Words::Phone), (u, Words::Axes)])
            {
                let words = called.placement(up);
                let off = followed(&words, called).angle(up).to_degrees();
                assert!(off < within, "{words}: {off}° off {up:?}");
            }
        }
    }

    #[test]
    fn a_corner_is_two_tilts_from_a_face() {
        let up = Vector3::new(-1.0, 1.0, -1.0).normalize();
        let words = Words::Phone.placement(&up);
        assert!(words.starts_with("on its "), "{words}");
        assert!(
            words.contains("up by 45° and the") && words.ends_with("up by 35°"),
            "{words}"
        );
        assert_eq!(axes_up(&up), "x down, y up and z down");
    }
}
