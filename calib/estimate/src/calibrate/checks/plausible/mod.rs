//! A sensor's unit, scale, axes and hand against gravity and the turns, for every method and command.
//!
//! ```text
//! static means ──► ellipsoid of gravity ──► unit, scale of an axis or of all, gravity taken off    `force`
//! turns ─────────► gravity carried ───────► unit, scale, axes, hand                                `rate`
//! magnetic field ─► above or below the horizontal ► axes, hand                                     `field`
//! recordings ────► biases and scale factors ► axes of one recording turned against another's       `turned`
//! ```
//! Every cause is named with the option that reads the recording rightly. What is beyond any sensor fails a gate; what a sensor
//! might be is a warning. Units that the file or the user states wrongly are refused by the reader.

mod apart;
mod axes;
mod columns;
mod field;
mod force;
mod odd_axis;
mod rate;
mod readings;
mod scales;
mod ticked;
mod turned;

pub(in crate::calibrate) use apart::{ForceFit, RateFit};
pub(in crate::calibrate) use field::turned_field;
pub use readings::{implausible, implausible_base};
pub(in crate::calibrate) use turned::none_is_turned;

use findings::{Finding, Findings, Level};
use nalgebra::Matrix3;

/// The axes in every order with every sign.
pub(in crate::calibrate) fn signed_axes() -> Vec<Matrix3<f64>> {
    axes::SignedAxes::all()
        .iter()
        .map(axes::SignedAxes::matrix)
        .collect()
}

/// Findings on sensors that cannot be as they are read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Said {
    /// Reasons not to use a result as it stands.
    pub gates: Findings,
    /// Findings that a user should know.
    pub warnings: Findings,
}

impl Said {
    fn gate(&mut self, found: Finding) {
        self.gates.push(found.at_level(Level::Bad));
    }

    fn warn(&mut self, found: Finding) {
        let level = found.level.min(Level::Care);
        self.warnings.push(found.at_level(level));
    }

    /// Takes what another one says after it.
    pub fn append(&mut self, other: Self) {
        other.add_to(&mut self.gates, &mut self.warnings);
    }

    /// Adds to the gates and the warnings of a calibration.
    pub fn add_to(self, gates: &mut Findings, warnings: &mut Findings) {
        gates.extend(self.gates);
        warnings.extend(self.warnings);
    }
}
