//! Units of a magnetic field.

use std::str::FromStr;

use findings::{Finding, Kind};

/// Unit of a magnetic field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldUnit {
    /// Tesla.
    Tesla,
    /// Thousandths of a tesla.
    Millitesla,
    /// Millionths of a tesla; the earth's field is 25 to 65 of them.
    Microtesla,
    /// Thousandths of those.
    Nanotesla,
    /// Gauss, 1e-4 T.
    Gauss,
    /// Thousandths of a gauss.
    Milligauss,
    /// Raw counts: kept as they are, in a unit that nobody knows.
    Counts,
}

impl FieldUnit {
    /// Its size in millionths of a tesla; 1 for counts.
    pub fn in_microtesla(self) -> f64 {
        match self {
            Self::Tesla => 1e6,
            Self::Millitesla => 1e3,
            Self::Microtesla | Self::Counts => 1.0,
            Self::Nanotesla => 1e-3,
            Self::Gauss => 100.0,
            Self::Milligauss => 0.1,
        }
    }

    /// The usual spelling.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tesla => "T",
            Self::Millitesla => "mT",
            Self::Microtesla => "µT",
            Self::Nanotesla => "nT",
            Self::Gauss => "gauss",
            Self::Milligauss => "mgauss",
            Self::Counts => "counts",
        }
    }

    /// The unit, unless it is counts.
    pub fn known(self) -> Option<Self> {
        (self != Self::Counts).then_some(self)
    }
}

/// The usual spellings.
const KNOWN: &str = "T, mT, µT, uT, nT, G, gauss, mG, mgauss, counts";

impl FromStr for FieldUnit {
    type Err = Box<Finding>;

    fn from_str(text: &str) -> Result<Self, Box<Finding>> {
        match text.trim().replace('μ', "µ").to_lowercase().as_str() {
            "t" | "tesla" => Ok(Self::Tesla),
            "mt" | "millitesla" => Ok(Self::Millitesla),
            "µt" | "ut" | "microtesla" | "microteslas" => Ok(Self::Microtesla),
            "nt" | "nanotesla" | "nanoteslas" => Ok(Self::Nanotesla),
            "gauss" | "g" | "gs" => Ok(Self::Gauss),
            "mgauss" | "mg" | "milligauss" => Ok(Self::Milligauss),
            "counts" | "lsb" | "raw" | "adc" => Ok(Self::Counts),
            _ => Err(Finding::of(Kind::UNIT_UNKNOWN)
                .detail("known", KNOWN)
                .into()),
        }
    }
}
