//! Turns between placements, and how an error of the gyroscope carries gravity through them.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, SMatrix, Vector3};
use serde::Serialize;

use crate::direction::Words;

/// One rotation about a fixed axis of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Leg {
    /// Unit axis, body frame, right-handed.
    #[serde(serialize_with = "components")]
    pub axis: Vector3<f64>,
    /// rad, positive.
    pub angle: f64,
}

fn components<S: serde::Serializer>(v: &Vector3<f64>, out: S) -> Result<S::Ok, S::Error> {
    <[f64; 3]>::from(*v).serialize(out)
}

/// By which way a turn goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// The shortest.
    Short,
    /// About the same axis the other way round.
    Long,
    /// The shortest, and once all the way round.
    Round,
    /// Half a turn on the spot about the vertical, anticlockwise from above, then the shortest.
    SpinLeft,
    /// The same clockwise.
    SpinRight,
}

/// How fast a turn goes beside the pace of its plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Speed {
    /// A third of it.
    Slow,
    /// As it is.
    #[default]
    Usual,
    /// Twice it.
    Fast,
}

impl Speed {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Slow, Self::Usual, Self::Fast];

    fn factor(self) -> f64 {
        match self {
            Self::Slow => 1.0 / 3.0,
            Self::Usual => 1.0,
            Self::Fast => 2.0,
        }
    }
}

/// A turn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Turn {
    /// By which way.
    pub way: Way,
    /// How fast.
    pub speed: Speed,
    /// One after the other.
    pub legs: Vec<Leg>,
}

/// How fast a hand turns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pace {
    /// Mean rate of a turn, rad/s; its peak is about twice that.
    pub rate: f64,
    /// Shortest turn, s.
    pub shortest: f64,
}

impl Default for Pace {
    /// A quarter turn in a second.
    fn default() -> Self {
        Self {
            rate: 0.5 * PI,
            shortest: 1.0,
        }
    }
}

impl Pace {
    /// How long a rotation takes, s.
    pub fn duration(&self, leg: &Leg) -> f64 {
        (leg.angle / self.rate).max(self.shortest)
    }

    /// The pace of turns that go faster or slower.
    #[must_use]
    pub fn at(&self, speed: Speed) -> Self {
        Self {
            rate: self.rate * speed.factor(),
            shortest: self.shortest / speed.factor(),
        }
    }
}

/// Directions closer than this to each other or to opposite are taken for that.
const SAME: f64 = 1e-6;

/// The ways from `from` up to `to` up.
pub fn ways(from: &Vector3<f64>, to: &Vector3<f64>) -> Vec<Turn> {
    let across = to.cross(from);
    let angle = across.norm().atan2(from.dot(to));
    let mut all = Vec::new();
    if angle < SAME {
        // Only what ends where it began: once round about an axis that lies level.
        for axis in level_axes(from) {
            all.push(turn(Way::Round, &[(axis, TAU)]));
        }
        return all;
    }
    let axes = if across.norm() < SAME {
        level_axes(from)
    } else {
        vec![across.normalize()]
    };
    for axis in axes {
        all.push(turn(Way::Short, &[(axis, angle)]));
        all.push(turn(Way::Long, &[(-axis, TAU - angle)]));
        all.push(turn(Way::Round, &[(axis, angle + TAU)]));
        all.push(turn(Way::SpinLeft, &[(*from, PI), (axis, angle)]));
        all.push(turn(Way::SpinRight, &[(-*from, PI), (axis, angle)]));
    }
    all
}

fn turn(way: Way, legs: &[(Vector3<f64>, f64)]) -> Turn {
    let leg = |(axis, angle): &(Vector3<f64>, f64)| Leg {
        axis: *axis,
        angle: *angle,
    };
    Turn {
        way,
        speed: Speed::Usual,
        legs: legs.iter().map(leg).collect(),
    }
}

/// Two axes of the body that lie level when `up` is up, the body's own where they do.
fn level_axes(up: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let mut own: Vec<usize> = vec![0, 1, 2];
    own.sort_by(|a, b| up[*a].abs().total_cmp(&up[*b].abs()));
    let first = Vector3::ith(own[0], 1.0);
    let first = (first - up * up.dot(&first)).normalize();
    vec![first, up.cross(&first)]
}

/// What a turn does to the direction of gravity and what an error of the gyroscope adds to it.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// `v_after = R v_before` in body frames.
    pub rotation: Matrix3<f64>,
    /// The small rotation at the end (rad) by the nine of `T` in the order of the published list and the three of
    /// the bias: `Σ Φ J(θ) δT n − Σ Φ J(θ) τ/θ δb`.
    pub by_parameter: SMatrix<f64, 3, 12>,
    /// s.
    pub duration: f64,
}

impl Turn {
    /// How long every leg takes, s.
    pub fn durations(&self, pace: &Pace) -> impl Iterator<Item = f64> {
        let pace = pace.at(self.speed);
        self.legs.iter().map(move |leg| pace.duration(leg))
    }

    /// Carries the direction of gravity through the turn.
    ///
    /// A leg about `n` by `θ` has `Φ(s) = exp(−s [n]×)` and `J = ∫₀^θ Φ = n nᵀ θ + (I − n nᵀ) sin θ − [n]× (1 − cos θ)`:
    /// along the axis errors add up, across it they turn with the body and cancel after a full turn.
    pub fn carry(&self, pace: &Pace) -> Carried {
        let pace = pace.at(self.speed);
        let mut rotation = Matrix3::identity();
        let mut by_parameter = SMatrix::<f64, 3, 12>::zeros();
        let mut duration = 0.0;
        for leg in &self.legs {
            let n = leg.axis;
            let (sin, cos) = leg.angle.sin_cos();
            let along = n * n.transpose();
            let across = Matrix3::identity() - along;
            let phi = along + across * cos - n.cross_matrix() * sin;
            let j = along * leg.angle + across * sin - n.cross_matrix() * (1.0 - cos);
            let time = pace.duration(leg);
            by_parameter = phi * by_parameter;
            for (k, (row, column)) in sensor::PLACES.iter().enumerate() {
                let mut own = by_parameter.column_mut(k);
                own += j.column(*row) * n[*column];
            }
            for k in 0..3 {
                let mut own = by_parameter.column_mut(9 + k);
                own -= j.column(k) * (time / leg.angle);
            }
            rotation = phi * rotation;
            duration += time;
        }
        Carried {
            rotation,
            by_parameter,
            duration,
        }
    }

    /// The turn as an instruction.
    pub fn words(&self, words: Words) -> String {
        let way = self.way_words(words);
        match self.speed {
            Speed::Usual => way,
            Speed::Slow => format!("slowly {way}"),
            Speed::Fast => format!("fast {way}"),
        }
    }

    fn way_words(&self, words: Words) -> String {
        let last = self.legs.last();
        let degrees = last.map_or(0.0, |leg| leg.angle.to_degrees());
        let about = last.map_or(String::new(), |leg| about(&leg.axis, words));
        match self.way {
            Way::Short => format!("the short way over, {degrees:.0}°{about}"),
            Way::Long => format!("the long way round, {degrees:.0}°{about}"),
            Way::Round if degrees < 361.0 => format!("once all the way round{about}"),
            Way::Round => {
                format!("the short way, but once all the way round first, {degrees:.0}°{about}")
            }
            Way::SpinLeft => {
                format!("half a turn to the left on the spot, then over, {degrees:.0}°{about}")
            }
            Way::SpinRight => {
                format!("half a turn to the right on the spot, then over, {degrees:.0}°{about}")
            }
        }
    }
}

/// ` about its long axis`; empty where the axis is none of the body's.
fn about(axis: &Vector3<f64>, words: Words) -> String {
    let names = match words {
        Words::Phone => [
            "its short axis",
            "its long axis",
            "the axis through the screen",
        ],
        Words::Axes => ["its x axis", "its y axis", "its z axis"],
    };
    let own = (0..3).find(|k| axis[*k].abs() > 0.999);
    own.map_or(String::new(), |k| format!(" about {}", names[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::faces_edges_corners;

    #[test]
    fn every_way_ends_where_it_should() {
        let all = faces_edges_corners();
        for from in &all {
            for to in &all {
                for turn in ways(from, to) {
                    let carried = turn.carry(&Pace::default());
                    assert!((carried.rotation * from - to).norm() < 1e-9, "{turn:?}");
                }
            }
        }
    }

    #[test]
    fn the_derivative_is_that_of_many_small_rotations() {
        let (from, to) = (Vector3::z(), Vector3::new(0.6, 0.0, 0.8));
        let pace = Pace::default();
        for turn in ways(&from, &to) {
            let carried = turn.carry(&pace);
            let through = |t: &Matrix3<f64>, b: &Vector3<f64>| {
                let mut u = from;
                for leg in &turn.legs {
                    let steps = 20_000;
                    let dt = pace.duration(leg) / f64::from(steps);
                    let w = t * leg.axis * (leg.angle / pace.duration(leg)) - b;
                    let step = nalgebra::Rotation3::from_scaled_axis(-w * dt);
                    for _ in 0..steps {
                        u = step * u;
                    }
                }
                u
            };
            for k in 0..12 {
                let at = |size: f64| {
                    let (mut t, mut b) = (Matrix3::identity(), Vector3::zeros());
                    match sensor::PLACES.get(k) {
                        Some(place) => t[*place] += size,
                        None => b[k - 9] = size,
                    }
                    through(&t, &b)
                };
                let difference = (at(1e-4) - at(-1e-4)) / 2e-4;
                let own = to.cross(&carried.by_parameter.column(k).into_owned());
                assert!((difference - own).norm() < 1e-5, "{:?} {k}", turn.way);
            }
        }
    }
}
