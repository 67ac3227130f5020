//! Shapes of a disagreement that no effect of the catalogue has.

use effects::{relaxation, room_field};
use estimate::methods::joint::Instant;
use findings::Kind;
use nalgebra::Vector3;
use sensor::{EffectRef, Sensor};

/// A shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Spherical harmonics of third and fourth degree of the direction of specific force.
    FineOrientation,
    /// Slow cosines of time.
    SlowTime,
    /// A period.
    Periodic,
    /// A direction fixed in the horizontal plane of the world.
    Heading,
    /// The rotation of the last turn, and what is left of it some time after.
    LastTurn,
    /// Products of the rates of two axes.
    RateProducts,
    /// A bias that drifts, or steps once, in one of several recordings.
    OneRecording,
}

/// Error vectors at an instant.
pub(super) type Errors<'a> = Box<dyn Fn(&Instant<'_>, &mut Vec<Vector3<f64>>) + 'a>;

/// One way of a shape: a few error vectors at every instant.
pub(super) type Way<'a> = (usize, Errors<'a>, Option<f64>);

impl Shape {
    /// All.
    pub(super) const ALL: [Self; 7] = [
        Self::FineOrientation,
        Self::SlowTime,
        Self::Periodic,
        Self::Heading,
        Self::LastTurn,
        Self::RateProducts,
        Self::OneRecording,
    ];

    /// The effect of the catalogue that has this shape. It is described and not named, as it has a time constant, a period or a heading
    /// to itself.
    pub fn effect(self, sensor: Sensor) -> Option<EffectRef> {
        match self {
            Self::Heading => room_field(sensor),
            Self::LastTurn => relaxation(sensor),
            _ => None,
        }
    }

    /// The kind of finding.
    pub fn kind(self) -> Kind {
        match self {
            Self::FineOrientation => Kind::FINE_ORIENTATION,
            Self::SlowTime => Kind::SLOW_CHANGE,
            Self::Periodic => Kind::PERIODIC_IN_TIME,
            Self::Heading => Kind::ROOM_DIRECTION,
            Self::LastTurn => Kind::RELAXATION_AFTER_TURN,
            Self::RateProducts => Kind::RATE_PRODUCTS,
            Self::OneRecording => Kind::BIAS_MOVES,
        }
    }
}
