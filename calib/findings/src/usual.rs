//! A finding as its kind usually is.

use crate::finding::{Consequence, Finding, Place};
use crate::kind::Kind;
use crate::words::entry;

impl Finding {
    /// Builds a finding of a kind, with the usual level and remedies of that kind.
    pub fn of(kind: Kind) -> Self {
        let usual = entry(kind);
        Self {
            kind,
            level: usual.level,
            place: Place::default(),
            numbers: Vec::new(),
            details: Vec::new(),
            consequence: Vec::new(),
            remedies: usual.remedies,
            because: Vec::new(),
        }
    }

    /// Builds a finding of a kind, with the reason of a system error. If the error itself carries a finding, returns
    /// that one.
    pub fn of_system(kind: Kind, reason: &std::io::Error) -> Self {
        let own = reason.get_ref().and_then(|own| own.downcast_ref::<Self>());
        own.cloned()
            .unwrap_or_else(|| Self::of(kind).detail("reason", reason.to_string()))
    }

    /// Size of the error that it makes, as an angle in degrees by which a corrected device would be oriented wrongly: the
    /// largest of its consequences, else what is usual for its kind.
    ///
    /// | consequence | angle |
    /// |---|---|
    /// | specific force, m/s² | `f / g` |
    /// | rate, rad/s | turned in ten seconds |
    /// | angle, rad | itself |
    pub fn severity(&self) -> f64 {
        let angle = |c: &Consequence| match c.unit.as_ref() {
            "m/s^2" => Some((c.value / GRAVITY).to_degrees()),
            "rad/s" => Some((c.value * TEN_SECONDS).to_degrees()),
            "rad" => Some(c.value.to_degrees()),
            _ => None,
        };
        let known = self.consequence.iter().filter_map(angle);
        let largest = known.map(f64::abs).reduce(f64::max);
        largest.unwrap_or_else(|| entry(self.kind).severity)
    }
}

/// Standard gravity, m/s² (ISO 80000-3).
const GRAVITY: f64 = 9.80665;
/// Time over which a rate is integrated where angles are compared, s.
const TEN_SECONDS: f64 = 10.0;
