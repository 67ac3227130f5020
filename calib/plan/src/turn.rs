//! Turns between placements, and how an error of the gyroscope carries gravity through them.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, SMatrix, Vector3};
use serde::Serialize;

use crate::direction::faces;

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
    /// The shortest, about one axis.
    Short,
    /// About the same axis the other way round.
    Long,
    /// Once all the way round, then on as the shortest.
    Round,
    /// Half a turn on the spot about the vertical, anticlockwise from above, then the shortest.
    SpinLeft,
    /// The same clockwise.
    SpinRight,
    /// First to a face, then on from there.
    Via,
}

/// Speed of a turn relative to the pace of its plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Speed {
    /// A third of it.
    Slow,
    /// The pace itself.
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
    /// Speed.
    pub speed: Speed,
    /// One after the other.
    pub legs: Vec<Leg>,
}

/// Pace of turns by hand.
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
    /// Returns the duration of a rotation, s.
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

findings::tuning! {
    /// Directions closer than this to each other or to opposite are taken for that.
    SAME: f64 = 1e-6;
}

/// The ways from `from` up to `to` up that a hand can follow: about the body's own axes, through a face where no single one
/// of them leads there. The easiest comes first.
pub fn ways(from: &Vector3<f64>, to: &Vector3<f64>) -> Vec<Turn> {
    if (from - to).norm() < SAME.get() {
        // Only what ends where it began: once round about an axis that lies level.
        return level_axes(from)
            .into_iter()
            .map(|axis| turn(Way::Round, &[(axis, TAU)]))
            .collect();
    }
    let straight = about_own_axes(from, to);
    if !straight.is_empty() {
        let (mut all, mut harder) = (Vec::new(), Vec::new());
        for (axis, angle) in straight {
            all.push(turn(Way::Short, &[(axis, angle)]));
            if (angle - 0.5 * PI).abs() < SAME.get() {
                harder.push(turn(Way::Long, &[(-axis, TAU - angle)]));
            }
            harder.push(turn(Way::Round, &[(axis, angle + TAU)]));
            harder.push(turn(Way::SpinLeft, &[(*from, PI), (axis, angle)]));
            harder.push(turn(Way::SpinRight, &[(-*from, PI), (axis, angle)]));
        }
        all.append(&mut harder);
        return all;
    }
    let mut all: Vec<(f64, Turn)> = faces()
        .iter()
        .flat_map(|face| {
            let first = about_own_axes(from, face);
            let second = about_own_axes(face, to);
            let pairs = first
                .into_iter()
                .flat_map(move |a| second.clone().into_iter().map(move |b| (a, b)));
            pairs.map(|(a, b)| (a.1 + b.1, turn(Way::Via, &[a, b])))
        })
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    if all.is_empty() {
        let across = to.cross(from);
        let angle = across.norm().atan2(from.dot(to));
        // Opposite directions that are neither faces nor edges.
        let axis = across
            .try_normalize(SAME.get())
            .unwrap_or_else(|| level_axes(from)[0]);
        let short = (axis, angle);
        return vec![
            turn(Way::Short, &[short]),
            turn(Way::SpinLeft, &[(*from, PI), short]),
            turn(Way::SpinRight, &[(-*from, PI), short]),
        ];
    }
    all.into_iter().map(|(_, turn)| turn).collect()
}

/// The body's axes about which a turn of at most half a turn leads from `from` to `to`, with the angle.
fn about_own_axes(from: &Vector3<f64>, to: &Vector3<f64>) -> Vec<(Vector3<f64>, f64)> {
    let of = |k: usize| {
        let axis = Vector3::ith(k, 1.0);
        let level = |v: &Vector3<f64>| v - axis * v[k];
        let (a, b) = (level(from), level(to));
        let leads = (from[k] - to[k]).abs() < SAME.get()
            && a.norm() > SAME.get()
            && (a - b).norm() > SAME.get();
        // What points up turns in the body the other way than the body does.
        let angle = b.cross(&a)[k].atan2(a.dot(&b));
        leads.then(|| (axis * if angle < 0.0 { -1.0 } else { 1.0 }, angle.abs()))
    };
    (0..3).filter_map(of).collect()
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

/// Effect of a turn on the direction of gravity, and its derivatives with respect to the gyroscope's parameters.
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
    /// Returns the duration of each leg, s.
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
