//! A turn as a person would make it, in at most fifteen words.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use findings::turns;
use nalgebra::{Rotation3, Unit, Vector3};

use crate::turn::{Leg, Speed, Turn, Way};

/// Angles and components closer than this to a whole one are taken for it.
const NEAR: f64 = 1e-3;
/// Elevations in words are rounded to this, °.
const ROUNDED: f64 = 5.0;

impl Turn {
    /// The turn from `from` up as an instruction: `turn it a quarter about x until y points up`.
    ///
    /// ```
    /// use nalgebra::Vector3;
    /// use stillpoint_plan::ways;
    ///
    /// let turn = &ways(&Vector3::z(), &Vector3::y())[0];
    /// assert_eq!(turn.words(&Vector3::z()), "turn it a quarter about x until y points up");
    /// ```
    pub fn words(&self, from: &Vector3<f64>) -> String {
        let way = self.way_words(from);
        match self.speed {
            Speed::Usual => way,
            Speed::Slow => format!("slowly {way}"),
            Speed::Fast => format!("fast {way}"),
        }
    }

    fn way_words(&self, from: &Vector3<f64>) -> String {
        let Some(last) = self.legs.last() else {
            return turns::leave().into();
        };
        let before = self.legs[..self.legs.len() - 1]
            .iter()
            .fold(*from, |up, leg| carried(&up, leg));
        let after = carried(&before, last);
        let until = until(&before, &after);
        let Some(axis) = own_axis(&last.axis) else {
            return aslant(self.way, &after);
        };
        let amount = |angle: f64| -> String {
            match angle {
                a if (a - FRAC_PI_2).abs() < NEAR => "a quarter".into(),
                a if (a - PI).abs() < NEAR => "over".into(),
                a if (a - 1.5 * PI).abs() < NEAR => "three quarters".into(),
                a => format!("{:.0}°", a.to_degrees()),
            }
        };
        match self.way {
            Way::Short | Way::Long => turns::turn(&amount(last.angle), axis, &until),
            Way::Round if last.angle < TAU + NEAR => turns::turn_round(Some(axis)),
            Way::Round => {
                let more: String = match amount(last.angle - TAU) {
                    over if over == "over" => "half".into(),
                    other => other,
                };
                turns::turn_round_and(axis, &more, &until)
            }
            Way::SpinLeft | Way::SpinRight => turns::spin_and(&amount(last.angle), axis, &until),
            Way::Via => turns::turn_by_way_of(&self::until(from, &before), axis, &until),
        }
    }
}

/// Returns the direction that points up after a leg.
fn carried(up: &Vector3<f64>, leg: &Leg) -> Vector3<f64> {
    let axis = Unit::new_normalize(leg.axis);
    Rotation3::from_axis_angle(&axis, leg.angle).inverse() * up
}

/// `x`, where the axis is the body's own.
fn own_axis(axis: &Vector3<f64>) -> Option<&'static str> {
    let own = (0..3).find(|k| axis[*k].abs() > 1.0 - NEAR);
    own.map(|k| ["x", "y", "z"][k])
}

/// A turn about an axis that has no name; where it leads is said by the placement.
fn aslant(way: Way, after: &Vector3<f64>) -> String {
    let is_corner = after.iter().all(|c| c.abs() > 0.5);
    match way {
        Way::Round => turns::turn_round(None),
        way => turns::turn_aslant(is_corner, matches!(way, Way::SpinLeft | Way::SpinRight)),
    }
}

/// `until x points up`: the axis that the turn brings up or down, else the one that it moves most.
fn until(before: &Vector3<f64>, after: &Vector3<f64>) -> String {
    let whole = (0..3).find(|k| after[*k].abs() > 1.0 - NEAR);
    let most = (0..3).max_by(|a, b| {
        let moved = |k: usize| (1e6 * (after[k] - before[k]).abs()).round();
        // Of two that move as far the one that ends further from level.
        let end = |k: usize| (1e6 * after[k].abs()).round();
        (moved(*a), end(*a))
            .partial_cmp(&(moved(*b), end(*b)))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let k = whole.or(most).unwrap_or(2);
    let name = ["x", "y", "z"][k];
    let side = if after[k] > 0.0 { "up" } else { "down" };
    let degrees = ROUNDED * (after[k].abs().min(1.0).asin().to_degrees() / ROUNDED).round();
    match degrees {
        d if d > 89.0 => format!("until {name} points {side}"),
        d if (d - 45.0).abs() < 1.0 => format!("until {name} points half {side}"),
        d if d < 1.0 => format!("until {name} lies level"),
        d => format!("until {name} points {d:.0}° {side}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::{faces_edges_corners, tilts, whole_angles};
    use crate::turn::ways;

    fn words_of(from: [f64; 3], to: [f64; 3]) -> Vec<String> {
        let [from, to] = [from, to].map(|v| Vector3::from(v).normalize());
        ways(&from, &to).iter().map(|t| t.words(&from)).collect()
    }

    #[test]
    fn every_turn_is_said_in_at_most_fifteen_words_and_no_angle_of_half_a_turn_or_more() {
        let (plain, tilts) = (faces_edges_corners(), tilts());
        let whole: Vec<_> = whole_angles().into_iter().step_by(37).collect();
        for (some, all) in [(&plain, &plain), (&tilts, &plain), (&plain, &whole)] {
            for (from, to) in some
                .iter()
                .flat_map(|from| all.iter().map(move |to| (from, to)))
            {
                for mut turn in ways(from, to) {
                    turn.speed = Speed::Slow;
                    let words = turn.words(from);
                    let count = words.split_whitespace().count();
                    assert!(count <= 15, "{count}: {words}");
                    let degrees = words
                        .split_whitespace()
                        .filter_map(|word| word.strip_suffix('°'));
                    let largest = degrees
                        .map(|d| d.parse::<f64>().unwrap())
                        .fold(0.0, f64::max);
                    assert!(largest < 180.0, "{words}");
                }
            }
        }
    }

    #[test]
    fn turns_between_faces_edges_and_corners_are_said_as_a_person_makes_them() {
        let first = |from, to| words_of(from, to).remove(0);
        let (z, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
        assert_eq!(first(z, down), "turn it over about x until z points down");
        assert_eq!(
            first(down, [1.0, 0.0, 0.0]),
            "turn it a quarter about y until x points up"
        );
        assert_eq!(
            first([0.0, -1.0, 0.0], [0.0, -1.0, 1.0]),
            "turn it 45° about x until z points half up"
        );
        assert_eq!(
            first([1.0, 0.0, 1.0], [1.0, 1.0, 0.0]),
            "turn it a quarter about x until y points half up"
        );
        assert_eq!(
            first(z, [1.0, 1.0, 0.0]),
            "turn it until x points up, then about z until y points half up"
        );
        assert_eq!(first(z, [1.0, -1.0, 1.0]), "turn it onto a corner");
        let all = words_of(z, [0.0, 1.0, 0.0]);
        assert!(
            all.contains(&"turn once round about x, then a quarter more until y points up".into()),
            "{all:?}"
        );
    }

    #[test]
    fn who_follows_the_words_about_one_axis_ends_where_the_plan_does() {
        // Of the directions on the circle about the axis only one has the axis named so far up.
        for (from, to) in [
            ([0.0, -1.0, 1.0], [0.0, 1.0, 1.0]),
            ([1.0, 0.0, 1.0], [1.0, 0.0, -1.0]),
        ] {
            let said = words_of(from, to).remove(0);
            let k = (0..3).find(|k| (from[*k] - to[*k]).abs() > 1.0).unwrap();
            let name = ["x", "y", "z"][k];
            assert!(
                said.contains(&format!("until {name} points half")),
                "{said}"
            );
        }
    }
}
