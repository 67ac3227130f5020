//! A change and its sentence.

use std::fmt;

use sensor::Sensor;

/// What is otherwise from some time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::calibrate) enum Kind {
    /// The bias of an axis is larger by this, m/s² or the gyroscope's unit.
    Bias(Sensor, usize, f64),
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

/// Where: behind the interval before it and in front of the one after it.
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

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Place { after, before } = self.place;
        let place = format!(
            "between static intervals {} and {} (t = {:.2} to {:.2} s)",
            after.0 + 1,
            before.0 + 1,
            after.1,
            before.1
        );
        match self.kind {
            Kind::Bias(sensor, axis, size) => write!(
                f,
                "the {}'s bias on {} steps by {size:+.2e} {place}",
                sensor.name(),
                axis_name(axis)
            ),
            Kind::Scale(sensor, Some(axis), share) => write!(
                f,
                "the {}'s scale factor on {} changes by {:+.2} % {place}",
                sensor.name(),
                axis_name(axis),
                100.0 * share
            ),
            Kind::Scale(Sensor::Accelerometer, None, share) => write!(
                f,
                "the accelerometer's scale factor on all axes changes by {:+.2} % {place}: another unit or range",
                100.0 * share
            ),
            Kind::Scale(Sensor::Gyroscope | Sensor::Magnetometer, None, share) => write!(
                f,
                "the gyroscope's scale factor on all axes changes by {:+.2} % {place}: another range, or a clock \
                 that runs at another rate from there on",
                100.0 * share
            ),
            Kind::Turned(sensor, angle) => write!(
                f,
                "the {}'s axes turn by {:.2}° against its own errors {place}",
                sensor.name(),
                angle.to_degrees()
            ),
            Kind::Flipped(sensor, axis) => write!(
                f,
                "the {}'s {} axis changes its sign {place}",
                sensor.name(),
                axis_name(axis)
            ),
            Kind::Swapped(sensor, [one, other]) => write!(
                f,
                "the {}'s columns {} and {} are exchanged {place}",
                sensor.name(),
                axis_name(one),
                axis_name(other)
            ),
            Kind::Rest(angle) => {
                return write!(
                    f,
                    "static interval {} (t = {:.2} to {:.2} s) lies {:.2}° off where the turns before and after it carry \
                     gravity: was the device touched, or did it slip?",
                    after.0 + 1,
                    after.1,
                    before.1,
                    angle.to_degrees()
                );
            }
            Kind::Turn(angle) => {
                return write!(
                    f,
                    "turn {} (t = {:.2} to {:.2} s) misses gravity by {:.2}° where the others meet it: rows lost, \
                     repeated or moved there, or a clock that jumped; leave it out, or record again",
                    after.0 + 1,
                    after.1,
                    before.1,
                    angle.to_degrees()
                );
            }
        }?;
        write!(
            f,
            ": one calibration does not hold for both parts; split the recording there, or record again"
        )
    }
}
