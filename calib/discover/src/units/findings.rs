//! Findings about several units of one type.

use estimate::calibration::EffectParameter;
use serde::Serialize;

use crate::fault::integrity::Integrity;
use crate::findings::Verdict;
use crate::gap::channel::Channel;

/// The schema of the document.
pub const UNITS_SCHEMA: &str = "stillpoint.unit_findings/1";

/// Effects that the models of several units of one type lack.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnitFindings {
    /// [`UNITS_SCHEMA`].
    pub schema: &'static str,
    /// Effects that the units share: their type has them.
    pub shared: Vec<SharedEffect>,
    /// Effects of one unit alone.
    pub own: Vec<OwnEffect>,
    /// The units, and what each says alone.
    pub units: Vec<UnitAlone>,
}

/// An effect that units share.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SharedEffect {
    /// Its name in the catalogue.
    pub name: String,
    /// Chance of so much in all units together, by any effect of the catalogue.
    pub adjusted_p_value: f64,
    /// Names of effects that all the units together cannot tell from it.
    pub indistinguishable_from: Vec<String>,
    /// Agreement of its sizes; `None` where they cannot be compared, as for a direction of the room.
    pub agreement: Option<Agreement>,
    /// Its size in every unit.
    pub sizes: Vec<UnitSize>,
}

/// An effect of one unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OwnEffect {
    /// Its name in the catalogue.
    pub name: String,
    /// True if another unit would show an effect of this size, and shows a different size.
    pub others_would_show_it: bool,
    /// Its size.
    pub size: UnitSize,
}

/// An effect in one unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnitSize {
    /// The unit's recording.
    pub unit: String,
    /// Chance of so much in this unit alone, in this one test; `None` where it cannot show the effect.
    pub p_value: Option<f64>,
    /// Its parameters; none where this unit does not determine them.
    pub parameters: Vec<EffectParameter>,
    /// The channel that the effect lives in.
    pub channel: Channel,
    /// `√(χ²/dof)` of the channel without it.
    pub gap_before: f64,
    /// With it.
    pub gap_after: f64,
}

/// Test for equal sizes in all units: `Q = Σ (xᵢ − x̄)ᵀ Cᵢ⁻¹ (xᵢ − x̄)`, `x̄` their weighted mean.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// `Q`.
    pub chi2: f64,
    /// `(n − 1) p` of `n` units and `p` parameters.
    pub dof: f64,
    /// Chance of so much where the sizes are one.
    pub p_value: f64,
    /// `x̄` with its standard errors: the size of the type, where the sizes agree.
    pub mean: Vec<EffectParameter>,
}

/// Findings about one unit by itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnitAlone {
    /// Its recording.
    pub recording: String,
    /// The verdict of `discover` on it.
    pub verdict: Verdict,
    /// The effects that it names.
    pub effects: Vec<String>,
    /// The faults of its recording, by name.
    pub integrity: Vec<String>,
    /// The same with intervals, times and sizes.
    pub faults: Vec<Integrity>,
    /// Disagreement that remains unexplained.
    pub unexplained: Option<String>,
    /// Why its evidence is not counted for the type, where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<String>,
    /// Warnings of its calibration.
    pub warnings: Vec<String>,
    /// Why its calibration is not to be used as it is.
    pub failed_gates: Vec<String>,
}
