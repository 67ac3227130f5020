//! A change part of the way through a recording.

use findings::Finding;
use sensor::Sensor;

/// Kind of a change at some time of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::calibrate) enum Kind {
    /// The bias of an axis is larger by this, m/s² or the gyroscope's unit.
    Bias(Sensor, usize, f64),
    /// The biases of the axes are larger by a vector of this size.
    Biases(Sensor, f64),
    /// The readings of an axis, or of all, are larger by this share.
    Scale(Sensor, Option<usize>, f64),
    /// The axes are turned by this angle, rad.
    Turned(Sensor, f64),
    /// An axis has the other sign.
    Flipped(Sensor, usize),
    /// Two axes are exchanged.
    Swapped(Sensor, [usize; 2]),
    /// The one turn there misses gravity by this angle, rad, which all the others meet.
    Turn(f64),
    /// The direction of the one static interval there is off by this angle, rad, by the turns before and after it.
    Rest(f64),
}

impl Kind {
    /// True for a single turn or static interval, after which all is as it was.
    pub fn is_single(self) -> bool {
        matches!(self, Self::Turn(_) | Self::Rest(_))
    }
}

/// Place of a change: after one static interval and before another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::calibrate) struct Place {
    /// The last static interval before, from 0, and its end, s.
    pub after: (usize, f64),
    /// The first static interval behind, from 0, and its begin, s.
    pub before: (usize, f64),
}

/// A change part of the way through a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::calibrate) struct Change {
    pub kind: Kind,
    pub place: Place,
}

fn axis_name(axis: usize) -> &'static str {
    ["x", "y", "z"][axis.min(2)]
}

/// With the size of a step of the bias on some axis, or on all.
fn bias(found: Finding, sensor: Sensor, axis: &'static str, size: f64) -> Finding {
    let unit = match sensor {
        Sensor::Accelerometer => "m/s^2",
        Sensor::Gyroscope => "rad/s",
        Sensor::Magnetometer => "",
    };
    found
        .detail("axis", axis)
        .number("size", size, unit)
        .affects("corrected_reading", size.abs(), unit)
}

impl Change {
    /// The change as a finding.
    pub fn finding(&self) -> Finding {
        use findings::Kind as Found;
        let Place { after, before } = self.place;
        let of = |kind, sensor| {
            Finding::of(kind)
                .of_sensor(sensor)
                .between(after.1, before.1)
                .count("after", after.0 + 1)
                .count("before", before.0 + 1)
        };
        match self.kind {
            Kind::Bias(sensor, axis, size) => {
                bias(of(Found::BIAS_STEP, sensor), sensor, axis_name(axis), size)
            }
            Kind::Biases(sensor, size) => {
                bias(of(Found::BIAS_STEP, sensor), sensor, "all axes", size)
            }
            Kind::Scale(sensor, axis, share) => {
                let cause = match (sensor, axis) {
                    (_, Some(_)) => None,
                    (Sensor::Accelerometer, None) => Some("force"),
                    (_, None) => Some("rate"),
                };
                let found = of(Found::SCALE_CHANGE, sensor)
                    .detail("axis", axis.map_or("all axes", axis_name))
                    .number("size", share, "share");
                match cause {
                    Some(cause) => found.detail(cause, sensor.name()),
                    None => found,
                }
            }
            Kind::Turned(sensor, angle) => of(Found::AXES_TURN_PART_WAY, sensor)
                .number("size", angle, "rad")
                .affects("turn", angle, "rad"),
            Kind::Flipped(sensor, axis) => {
                of(Found::SIGN_CHANGE, sensor).detail("axis", axis_name(axis))
            }
            Kind::Swapped(sensor, [one, other]) => {
                let axes = format!("{} and {}", axis_name(one), axis_name(other));
                of(Found::COLUMNS_SWAP_PART_WAY, sensor).detail("axis", axes)
            }
            Kind::Rest(angle) => Finding::of(Found::INTERVAL_OFF)
                .at_interval(after.0)
                .between(after.1, before.1)
                .number("size", angle, "rad")
                .affects("turn", angle, "rad"),
            Kind::Turn(angle) => Finding::of(Found::TURN_OFF)
                .at_turn(after.0)
                .between(after.1, before.1)
                .number("size", angle, "rad")
                .affects("turn", angle, "rad"),
        }
    }
}
