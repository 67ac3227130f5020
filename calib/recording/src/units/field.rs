//! Units of a magnetic field.

use std::str::FromStr;

/// Unit of a magnetic field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldUnit {
    /// Tesla.
    Tesla,
    /// Millionths of a tesla; the earth's field is 25 to 65 of them.
    Microtesla,
    /// Thousandths of those.
    Nanotesla,
    /// Gauss, 1e-4 T.
    Gauss,
    /// Thousandths of a gauss.
    Milligauss,
}

impl FieldUnit {
    /// Its size in millionths of a tesla.
    pub fn in_microtesla(self) -> f64 {
        match self {
            Self::Tesla => 1e6,
            Self::Microtesla => 1.0,
            Self::Nanotesla => 1e-3,
            Self::Gauss => 100.0,
            Self::Milligauss => 0.1,
        }
    }

    /// The usual spelling.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tesla => "T",
            Self::Microtesla => "µT",
            Self::Nanotesla => "nT",
            Self::Gauss => "gauss",
            Self::Milligauss => "mgauss",
        }
    }
}

impl FromStr for FieldUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.trim().replace('μ', "µ").to_lowercase().as_str() {
            "t" | "tesla" => Ok(Self::Tesla),
            "µt" | "ut" | "microtesla" => Ok(Self::Microtesla),
            "nt" | "nanotesla" => Ok(Self::Nanotesla),
            "gauss" | "g" | "gs" => Ok(Self::Gauss),
            "mgauss" | "mg" | "milligauss" => Ok(Self::Milligauss),
            _ => Err("unknown unit; known: T, µT, nT, gauss, mgauss".to_owned()),
        }
    }
}
