//! One stretch of motion: rest, or a turn made of overlapping rotations and displacements.

use nalgebra::{UnitQuaternion, Vector3};

use super::profile::Profile;

/// A rotation about a fixed axis of the body frame as it is when the rotation before it is done.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twist {
    /// Rotation vector at profile value 1, rad.
    pub rotation: Vector3<f64>,
    /// Factor of the rotation over time.
    pub profile: Profile,
}

impl Twist {
    pub fn new(rotation: Vector3<f64>, profile: Profile) -> Self {
        Self { rotation, profile }
    }
}

/// A displacement along a fixed direction of the reference frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Move {
    /// Displacement at profile value 1, m.
    pub displacement: Vector3<f64>,
    /// Factor of the displacement over time.
    pub profile: Profile,
}

impl Move {
    pub fn new(displacement: Vector3<f64>, profile: Profile) -> Self {
        Self {
            displacement,
            profile,
        }
    }
}

/// Properties of a static interval.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rest {
    /// Words for the placement, such as `face +z`.
    pub label: String,
    /// Sign of the last change of specific force, per axis.
    pub last_change: Vector3<f64>,
    /// Mean square of the vibration, per axis, (m/s²)².
    pub vibration: Vector3<f64>,
    /// Specific force that something else adds, body frame, m/s².
    pub push: Vector3<f64>,
    /// Names of what disturbs it.
    pub faults: Vec<String>,
}

impl Rest {
    /// A rest at which nothing happens.
    pub fn called(label: &str) -> Self {
        Self {
            label: label.into(),
            ..Self::default()
        }
    }
}

/// One stretch of motion. The attitude is `attitude · exp(r₁ s₁(t)) · exp(r₂ s₂(t)) ⋯`.
#[derive(Clone, Debug)]
pub(crate) struct Segment {
    /// Begin, s.
    pub start: f64,
    /// End, s.
    pub end: f64,
    /// Body to reference at the begin.
    pub attitude: UnitQuaternion<f64>,
    /// Position of the hand at the begin, m.
    pub position: Vector3<f64>,
    /// Rotations, in the order of the product.
    pub twists: Vec<Twist>,
    /// Displacements, added up.
    pub moves: Vec<Move>,
    /// Set where the segment is a placement.
    pub rest: Option<Rest>,
}

/// Motion at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    /// Body to reference.
    pub attitude: UnitQuaternion<f64>,
    /// Angular rate in the body frame, rad/s.
    pub rate: Vector3<f64>,
    /// Its derivative, rad/s².
    pub angular_acceleration: Vector3<f64>,
    /// Position in the reference frame, m.
    pub position: Vector3<f64>,
    /// m/s.
    pub velocity: Vector3<f64>,
    /// m/s².
    pub acceleration: Vector3<f64>,
}

impl Segment {
    /// True if nothing moves in it.
    pub fn is_still(&self) -> bool {
        self.twists.is_empty() && self.moves.is_empty()
    }

    /// Attitude, position and their derivatives at `t`.
    ///
    /// With `E = exp(r s)` one more rotation makes `ω ← Eᵀω + r ṡ` and
    /// `ω̇ ← Eᵀω̇ − r ṡ × Eᵀω + r s̈`.
    pub fn at(&self, t: f64) -> State {
        let mut state = State {
            attitude: self.attitude,
            rate: Vector3::zeros(),
            angular_acceleration: Vector3::zeros(),
            position: self.position,
            velocity: Vector3::zeros(),
            acceleration: Vector3::zeros(),
        };
        for twist in &self.twists {
            let s = twist.profile.at(t);
            let turn = UnitQuaternion::from_scaled_axis(twist.rotation * s.value);
            let before = turn.inverse_transform_vector(&state.rate);
            let own = twist.rotation * s.first;
            state.angular_acceleration = turn.inverse_transform_vector(&state.angular_acceleration)
                - own.cross(&before)
                + twist.rotation * s.second;
            state.rate = before + own;
            state.attitude *= turn;
        }
        for shift in &self.moves {
            let s = shift.profile.at(t);
            state.position += shift.displacement * s.value;
            state.velocity += shift.displacement * s.first;
            state.acceleration += shift.displacement * s.second;
        }
        state
    }

    /// Returns the times at which a mean has to be split, s: the ends of the segment and the knots of its profiles.
    pub fn knots(&self) -> Vec<f64> {
        let twists = self.twists.iter().map(|w| w.profile);
        let profiles = twists.chain(self.moves.iter().map(|m| m.profile));
        let mut knots: Vec<f64> = profiles.flat_map(|p| p.knots()).collect();
        knots.retain(|&t| t > self.start && t < self.end);
        knots.extend([self.start, self.end]);
        knots
    }
}
