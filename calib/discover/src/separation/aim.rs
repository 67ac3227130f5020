//! A recording to make, and how far apart it brings tied effects.

use super::design::Design;

/// Effects this far apart (`λ (1 − ρ²)`) are told apart 20 to 1 in 95 of 100 recordings.
pub const SETTLED: f64 = 21.0;

/// The design and what it buys.
#[derive(Clone, Debug)]
pub struct Aim {
    /// The recording to make.
    pub design: Design,
    /// Every tie.
    pub ties: Vec<Separated>,
}

/// Separation of a named effect from one that it is tied to.
#[derive(Clone, Debug)]
pub struct Separated {
    /// The named effect.
    pub named: String,
    /// The effect that it is tied to.
    pub other: String,
    /// `λ (1 − ρ²)` by what was recorded.
    pub before: f64,
    /// With the design.
    pub after: f64,
    /// With the design, the device being warmed.
    pub if_warmed: f64,
    /// With the design, rests of 20 s and the first of five minutes.
    pub if_longer: f64,
    /// True if one of them belongs to an instant.
    pub of_an_instant: bool,
    /// True if one of them settles after switching on: the recording has to begin then.
    pub settles: bool,
}

/// Remedy that would separate a tie where placements and turns do not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownBy {
    /// Warming the device and letting it cool.
    Temperature,
    /// Longer rests.
    Time,
    /// The instant of the recording that it was seen in.
    Instant,
    /// Nothing of these.
    Nothing,
}

impl Separated {
    /// Returns the remedy that would separate the two, the easier before the harder.
    pub fn shown_by(&self) -> ShownBy {
        match self {
            _ if self.of_an_instant => ShownBy::Instant,
            _ if self.if_longer >= SETTLED => ShownBy::Time,
            _ if self.if_warmed >= SETTLED => ShownBy::Temperature,
            _ => ShownBy::Nothing,
        }
    }
}
