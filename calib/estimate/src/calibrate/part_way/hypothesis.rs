//! The changes that an accelerometer may have, and from which static interval on.

use nalgebra::{Rotation3, Vector3};
use sensor::Sensor;

use super::change::Kind;

/// Most parameters of a change.
pub(super) const OWN: usize = 3;

/// Change to try.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum What {
    Nothing,
    Scale(usize),
    AllScales,
    Bias(usize),
    Turned,
    Flipped(usize),
    Swapped([usize; 2]),
    /// The biases of all axes step.
    Biases,
    /// The biases of all axes drift from the first static interval to the last.
    Drift,
}

/// Changes that are claimed.
pub(super) const CHANGES: [What; 14] = [
    What::Scale(0),
    What::Scale(1),
    What::Scale(2),
    What::AllScales,
    What::Bias(0),
    What::Bias(1),
    What::Bias(2),
    What::Turned,
    What::Flipped(0),
    What::Flipped(1),
    What::Flipped(2),
    What::Swapped([0, 1]),
    What::Swapped([1, 2]),
    What::Swapped([0, 2]),
];

impl What {
    pub fn parameters(self) -> usize {
        match self {
            Self::Turned | Self::Biases | Self::Drift => 3,
            Self::Nothing | Self::Flipped(_) | Self::Swapped(_) => 0,
            _ => 1,
        }
    }

    /// The reading of a static interval with the change taken off, and its derivative by each parameter, zeros beyond these; `passed`
    /// is the share of the intervals before it.
    pub fn undone(
        self,
        raw: &Vector3<f64>,
        passed: f64,
        p: &[f64],
    ) -> (Vector3<f64>, [Vector3<f64>; OWN]) {
        let unit = |axis: usize| Vector3::ith(axis, 1.0);
        let none = [Vector3::zeros(); OWN];
        let one = |slope: Vector3<f64>| [slope, none[0], none[0]];
        match self {
            Self::Nothing => (*raw, none),
            Self::Scale(k) => (raw + unit(k) * (p[0] * raw[k]), one(unit(k) * raw[k])),
            Self::AllScales => (raw * (1.0 + p[0]), one(*raw)),
            Self::Bias(k) => (raw + unit(k) * p[0], one(unit(k))),
            Self::Turned => {
                let turned = Rotation3::new(Vector3::new(p[0], p[1], p[2])) * raw;
                (turned, [0, 1, 2].map(|k| unit(k).cross(&turned)))
            }
            Self::Biases => {
                let slopes = [0, 1, 2].map(unit);
                (raw + Vector3::new(p[0], p[1], p[2]), slopes)
            }
            Self::Drift => {
                let slopes = [0, 1, 2].map(|k| unit(k) * passed);
                (raw + Vector3::new(p[0], p[1], p[2]) * passed, slopes)
            }
            Self::Flipped(k) => (raw - unit(k) * (2.0 * raw[k]), none),
            Self::Swapped([a, b]) => {
                let mut swapped = *raw;
                swapped.swap_rows(a, b);
                (swapped, none)
            }
        }
    }

    /// The change as it is claimed; `None` where none is.
    pub fn kind(self, p: &[f64]) -> Option<Kind> {
        let share = |p: f64| 1.0 / (1.0 + p) - 1.0;
        let sensor = Sensor::Accelerometer;
        Some(match self {
            Self::Nothing | Self::Drift => return None,
            Self::Scale(k) => Kind::Scale(sensor, Some(k), share(p[0])),
            Self::AllScales => Kind::Scale(sensor, None, share(p[0])),
            Self::Bias(k) => Kind::Bias(sensor, k, -p[0]),
            Self::Turned => Kind::Turned(sensor, Vector3::new(p[0], p[1], p[2]).norm()),
            Self::Biases => Kind::Biases(sensor, Vector3::new(p[0], p[1], p[2]).norm()),
            Self::Flipped(k) => Kind::Flipped(sensor, k),
            Self::Swapped(axes) => Kind::Swapped(sensor, axes),
        })
    }
}

/// From which row on what has changed; the row itself may be mixed and is then left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hypothesis {
    pub what: What,
    pub at: usize,
    pub mixed: bool,
}
