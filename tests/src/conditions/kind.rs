//! What a warning, a failed gate or a refusal is about.

use serde::Serialize;

/// What words name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A static interval was touched or pushed.
    Touched,
    /// The device crept.
    Crept,
    /// A turn misses gravity.
    BadTurn,
    /// A static interval shakes, or the device was in the hand.
    Shakes,
    /// A static interval disagrees with the others.
    Disagrees,
    /// The device turned about the vertical, or turned while it should be at rest.
    Turning,
    /// More misfit than noise: something beyond the model.
    Misfit,
    /// Samples are missing.
    Missing,
    /// A turn or interval could not be used for another reason.
    Unused,
    /// Stamps, clock or rate.
    Clock,
    /// Sampling too slow or without a filter for the motion.
    Undersampled,
    /// Gravity or the earth's rotation.
    Earth,
    /// A bias that moves.
    Drift,
    /// Quantisation, dead zone, stuck, clipped or held values.
    Values,
    /// Single values far off.
    Spikes,
    /// Intervals too short, too few, in too few orientations; what a parameter hangs on.
    Geometry,
    /// One static interval carries much.
    Influence,
    /// Units and other statements that name no cause.
    Statement,
    /// Words that no pattern knows: to be added here.
    Unknown,
}

/// Words by which a kind is told, lower case; the first that fits decides.
const PATTERNS: &[(&str, Kind)] = &[
    ("measured noise explains", Kind::Misfit),
    ("times the noise", Kind::Misfit),
    ("no rest was found", Kind::Geometry),
    ("in steps of", Kind::Values),
    ("exactly zero", Kind::Values),
    ("sets its zero", Kind::Values),
    ("erased", Kind::Values),
    ("single readings", Kind::Spikes),
    ("touched", Kind::Touched),
    ("mount_slip", Kind::Crept),
    ("crept", Kind::Crept),
    ("slowly slips", Kind::Crept),
    ("noisier", Kind::Shakes),
    ("would change by", Kind::Influence),
    ("undersampled", Kind::Undersampled),
    ("sample faster", Kind::Undersampled),
    ("in the hand", Kind::Shakes),
    ("lay it down", Kind::Shakes),
    ("vibrat", Kind::Shakes),
    ("shak", Kind::Shakes),
    ("tremor", Kind::Shakes),
    ("disagree", Kind::Disagrees),
    ("about the vertical", Kind::Turning),
    ("the device tilts", Kind::Turning),
    ("turns while", Kind::Turning),
    ("turned while", Kind::Turning),
    ("rotation in it", Kind::Turning),
    ("rate of the earth", Kind::Earth),
    ("earth's rotation", Kind::Earth),
    ("earth's rate", Kind::Earth),
    ("latitude", Kind::Earth),
    ("standard gravity", Kind::Earth),
    ("--gravity", Kind::Earth),
    ("lost sample", Kind::Missing),
    ("samples are missing", Kind::Missing),
    ("samples missing", Kind::Missing),
    ("missing samples", Kind::Missing),
    ("interruption", Kind::Missing),
    ("gap", Kind::Missing),
    ("stamp", Kind::Clock),
    ("clock", Kind::Clock),
    ("time base", Kind::Clock),
    ("time offset", Kind::Clock),
    ("quantis", Kind::Values),
    ("least significant", Kind::Values),
    ("coarse", Kind::Values),
    ("resolution", Kind::Values),
    ("dead zone", Kind::Values),
    ("stuck", Kind::Values),
    ("constant value", Kind::Values),
    ("repeat", Kind::Values),
    ("saturat", Kind::Values),
    ("clipped", Kind::Values),
    ("held values", Kind::Values),
    ("spike", Kind::Spikes),
    ("outlier", Kind::Spikes),
    ("drift", Kind::Drift),
    ("bias moved", Kind::Drift),
    ("bias changes", Kind::Drift),
    ("flicker", Kind::Drift),
    ("missed by far more", Kind::BadTurn),
    ("beyond the base model", Kind::Misfit),
    ("beyond the model", Kind::Misfit),
    ("misfit", Kind::Misfit),
    ("what the noise", Kind::Misfit),
    ("than the noise", Kind::Misfit),
    ("no static interval", Kind::Geometry),
    ("all static", Kind::Geometry),
    ("min-static", Kind::Geometry),
    ("hold still", Kind::Geometry),
    ("placement", Kind::Geometry),
    ("orientation", Kind::Geometry),
    ("determine", Kind::Geometry),
    ("is known to", Kind::Geometry),
    ("turn the device", Kind::Geometry),
    ("raw counts", Kind::Statement),
    ("units of g", Kind::Statement),
    ("degrees per second", Kind::Statement),
    ("is not used", Kind::Unused),
    ("does not use", Kind::Unused),
];

impl Kind {
    /// The kind of some words.
    pub fn of(words: &str) -> Self {
        let words = words.to_lowercase();
        let found = PATTERNS.iter().find(|(pattern, _)| words.contains(pattern));
        found.map_or(Self::Unknown, |(_, kind)| *kind)
    }

    /// True where the words name no cause: what they say is so in any recording, or is a figure.
    pub fn names_nothing(self) -> bool {
        matches!(self, Self::Statement | Self::Influence | Self::Geometry)
    }

    /// Its name in tables.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_pattern_decides_and_what_none_knows_is_unknown() {
        let touched = "static interval 3: something touched or pushed the device; its clock";
        assert_eq!(Kind::of(touched), Kind::Touched);
        assert_eq!(
            Kind::of("Without static interval 3 s_x would change by 5"),
            Kind::Influence
        );
        assert_eq!(Kind::of("abracadabra"), Kind::Unknown);
        assert!(Kind::Influence.names_nothing() && !Kind::Touched.names_nothing());
    }
}
