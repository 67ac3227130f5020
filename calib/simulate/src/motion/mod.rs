//! True motion in closed form: rests and movements, one after the other.
//!
//! The reference frame is level: x east, y north, z up. Nothing here integrates: attitude, rate and
//! acceleration are formulas of time.

mod cart;
mod hand_held;
mod orientation;
mod path;
mod placements;
mod planned;
mod profile;
mod quadrature;
mod segment;
mod six_position;
mod still;
mod turn;
mod unsteady;
mod walking;

use nalgebra::Vector3;

pub use cart::Cart;
pub use hand_held::HandHeld;
pub use planned::{Planned, PlannedLeg, PlannedStep};
pub use six_position::SixPosition;
pub use still::Still;
pub use walking::Walking;

pub(crate) use path::Path;
pub(crate) use placements::Surroundings;
pub(crate) use quadrature::mean_over;
pub(crate) use segment::{Rest, Segment, State};

/// A motion from time 0 to its end, without holes.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    segments: Vec<Segment>,
    knots: Vec<f64>,
    lever_arm: Vector3<f64>,
    /// End and rotation vector of every turn, in order, s and rad.
    turns: Vec<(f64, Vector3<f64>)>,
}

/// Instants at which the rate of a turn is looked at.
const INSTANTS: u32 = 200;

impl Motion {
    /// The motion along `path` of a sensor at `lever_arm` (body frame, m) from the hand's centre of
    /// rotation.
    pub fn new(path: Path, lever_arm: Vector3<f64>) -> Self {
        let segments = path.into_segments();
        let mut knots: Vec<f64> = segments.iter().flat_map(Segment::knots).collect();
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        let turns = segments.iter().filter(|s| s.rest.is_none());
        let turns = turns.map(|turn| (turn.end, rotation(turn))).collect();
        Self {
            turns,
            segments,
            knots,
            lever_arm,
        }
    }

    /// The segments, in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Returns the times at which a mean has to be split, ascending, s: the motion is analytic between them.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The end, s.
    pub fn end(&self) -> f64 {
        self.segments.last().map_or(0.0, |s| s.end)
    }

    /// The segment at time `t`; before the begin and after the end, the first and the last.
    pub fn segment_at(&self, t: f64) -> &Segment {
        let after = self.segments.partition_point(|s| s.end <= t);
        &self.segments[after.min(self.segments.len() - 1)]
    }

    /// Sign of the last change of specific force at `t`: that of the placement, or of the last one before.
    pub fn last_change(&self, t: f64) -> Vector3<f64> {
        let after = self.segments.partition_point(|s| s.end <= t);
        let past = &self.segments[..=after.min(self.segments.len() - 1)];
        let rest = past.iter().rev().find_map(|s| s.rest.as_ref());
        rest.map_or_else(Vector3::zeros, |rest| rest.last_change)
    }

    /// End (s) and rotation vector (rad) of every turn, in order.
    pub fn turns(&self) -> &[(f64, Vector3<f64>)] {
        &self.turns
    }

    /// End and rotation vector of the last turn that is over at `t`; the begin and none before the first.
    pub fn last_turn(&self, t: f64) -> (f64, Vector3<f64>) {
        let over = self.turns.partition_point(|(end, _)| *end <= t);
        over.checked_sub(1)
            .map_or((0.0, Vector3::zeros()), |k| self.turns[k])
    }

    /// True if nothing moves between `from` and `to`, s.
    pub fn is_still(&self, from: f64, to: f64) -> bool {
        let segment = self.segment_at(from);
        segment.is_still() && (to <= segment.end || segment.end >= self.end())
    }

    /// State of the sensor at `t`: that of the hand carried over by the lever arm `l`,
    /// `a ← a + R (ω̇ × l + ω × (ω × l))`.
    pub fn at(&self, t: f64) -> State {
        let mut state = self.segment_at(t).at(t);
        let (l, w) = (self.lever_arm, state.rate);
        let swing = w.cross(&l);
        let spin = state.angular_acceleration.cross(&l) + w.cross(&swing);
        state.position += state.attitude * l;
        state.velocity += state.attitude * swing;
        state.acceleration += state.attitude * spin;
        state
    }
}

/// `∫ω dt` over a turn, rad.
fn rotation(turn: &Segment) -> Vector3<f64> {
    let part = (turn.end - turn.start) / f64::from(INSTANTS);
    let middles = (0..INSTANTS).map(|k| turn.start + (f64::from(k) + 0.5) * part);
    middles.map(|t| turn.at(t).rate * part).sum()
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;

    fn session() -> Motion {
        let around = Surroundings {
            seed: 11,
            gravity: 9.8,
            vibration: None,
            unsteady: None,
            faults: &[],
        };
        let hand = HandHeld {
            placements: Some(8),
            shock: 20.0,
            ..HandHeld::default()
        };
        Motion::new(hand.path(&around), Vector3::new(0.02, -0.03, 0.01))
    }

    fn turns(motion: &Motion) -> Vec<(f64, f64)> {
        let turns = motion.segments().iter().filter(|s| s.rest.is_none());
        turns.map(|s| (s.start, s.end)).collect()
    }

    #[test]
    fn rate_and_acceleration_are_the_derivatives_of_attitude_and_position() {
        let motion = session();
        let h = 1e-5;
        for (start, end) in turns(&motion) {
            for k in 1..50 {
                let t = start + (end - start) * f64::from(k) / 50.0;
                let (before, at, after) = (motion.at(t - h), motion.at(t), motion.at(t + h));
                let turned = (before.attitude.inverse() * after.attitude).scaled_axis() / (2.0 * h);
                // h²/6 of the third derivative; that of a knock is about 1e5 rad/s³.
                assert!((turned - at.rate).norm() < 1e-5);
                let spin = (after.rate - before.rate) / (2.0 * h);
                assert!((spin - at.angular_acceleration).norm() < 1e-3);
                let velocity = (after.position - before.position) / (2.0 * h);
                assert!((velocity - at.velocity).norm() < 1e-5);
                let acceleration = (after.velocity - before.velocity) / (2.0 * h);
                assert!((acceleration - at.acceleration).norm() < 1e-3);
            }
        }
    }

    #[test]
    fn the_rate_carries_one_placement_into_the_next() {
        let motion = session();
        for (start, end) in turns(&motion) {
            let steps = 40_000;
            let h = (end - start) / f64::from(steps);
            let mut attitude = motion.at(start).attitude;
            for k in 0..steps {
                let rate = motion.at(start + (f64::from(k) + 0.5) * h).rate;
                attitude *= UnitQuaternion::from_scaled_axis(rate * h);
            }
            // Midpoint rule: the error is of the order of h² ≈ 6e-9 times the curvature of the rate.
            assert!(attitude.angle_to(&motion.at(end).attitude) < 3e-7);
        }
    }

    #[test]
    fn a_placement_is_at_rest_to_the_last_bit() {
        let motion = session();
        for segment in motion.segments().iter().filter(|s| s.rest.is_some()) {
            let (first, last) = (motion.at(segment.start), motion.at(segment.end - 1e-9));
            assert_eq!(first.attitude, last.attitude);
            assert_eq!(last.rate, Vector3::zeros());
            assert_eq!(last.acceleration, Vector3::zeros());
        }
    }

    #[test]
    fn the_axis_of_a_turn_changes() {
        let motion = session();
        let changes = turns(&motion).into_iter().filter(|(start, end)| {
            let at = |share: f64| motion.at(start + share * (end - start)).rate.normalize();
            at(0.2).angle(&at(0.8)) > 0.1
        });
        assert_eq!(changes.count(), 7);
    }
}
