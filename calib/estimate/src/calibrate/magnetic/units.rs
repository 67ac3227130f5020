//! Units of the numbers of a magnetometer.

use recording::FieldUnit;

/// Unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millionths of a tesla.
    Microtesla,
    /// The unit of the readings, which nobody states.
    OfReadings,
}

impl Unit {
    fn where_known(is_known: bool) -> Self {
        if is_known {
            Self::Microtesla
        } else {
            Self::OfReadings
        }
    }

    /// Its name in findings.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Microtesla => "µT",
            Self::OfReadings => "units of its readings",
        }
    }

    /// Its name in files.
    pub fn in_files(self) -> &'static str {
        match self {
            Self::Microtesla => "uT",
            Self::OfReadings => "reading",
        }
    }
}

/// Units of the readings and of the field.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Unit of the readings.
    pub reading: Unit,
    /// Unit of the field, to which a given strength brings readings of any unit.
    pub field: Unit,
}

impl Units {
    /// By the unit that the files state, and whether the strength of the field was given.
    pub fn of(unit: Option<FieldUnit>, strength_given: bool) -> Self {
        Self {
            reading: Unit::where_known(unit.is_some()),
            field: Unit::where_known(unit.is_some() || strength_given),
        }
    }
}
