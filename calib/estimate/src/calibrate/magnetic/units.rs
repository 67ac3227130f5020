//! Units of the numbers of a magnetometer, as findings have them.

use recording::FieldUnit;

/// Units of the numbers of a magnetometer, as findings have them.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Of its readings.
    pub reading: &'static str,
    /// Of the field, to which a given strength brings readings of any unit.
    pub field: &'static str,
}

/// Millionths of a tesla.
pub const MICROTESLA: &str = "µT";

/// A unit that nobody states.
const OF_READINGS: &str = "units of its readings";

impl Units {
    /// By the unit that the files state, and whether the strength of the field was given.
    pub fn of(unit: Option<FieldUnit>, strength_given: bool) -> Self {
        let word = |is_known| if is_known { MICROTESLA } else { OF_READINGS };
        Self {
            reading: word(unit.is_some()),
            field: word(unit.is_some() || strength_given),
        }
    }
}
