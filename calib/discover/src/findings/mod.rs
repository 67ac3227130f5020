//! Findings of `discover`: the contents of findings.json.

pub(super) mod assembled;
pub(super) mod beside;
pub(super) mod late;
pub(super) mod latitude;
pub(super) mod named;
pub(super) mod room;
pub(super) mod typed;

use ::findings::{Front, Remedy};
use estimate::calibration::{Calibration, EffectParameter};
use serde::{Serialize, Serializer};

use self::beside::Beside;
use crate::fault::integrity::Integrity;
use crate::gap::channel::Channel;
use crate::gap::localise::Disagreement;
use crate::propose::Proposal;
use crate::remainder::unexplained::Unexplained;
use crate::separation::Rivalry;

pub use estimate::calibration::FINDINGS_SCHEMA;

/// The verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// The model explains the data to within the measured noise.
    #[serde(rename = "none")]
    Nothing,
    /// Something was named.
    #[serde(rename = "named")]
    Named,
    /// A significant disagreement that no effect of the catalogue fits.
    #[serde(rename = "unexplained")]
    Unexplained,
    /// Both.
    #[serde(rename = "named+unexplained")]
    NamedAndUnexplained,
}

impl Verdict {
    /// Returns the name of the verdict in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nothing => "none",
            Self::Named => "named",
            Self::Unexplained => "unexplained",
            Self::NamedAndUnexplained => "named+unexplained",
        }
    }
}

fn remedy_in_words<S: Serializer>(remedy: &Option<Remedy>, to: S) -> Result<S::Ok, S::Error> {
    remedy.as_ref().map(|r| r.text(Front::Plain)).serialize(to)
}

/// An effect that was missing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EffectFinding {
    /// Its name in the catalogue.
    pub name: String,
    /// Likelihood ratio, everything else that is named being in the model.
    pub statistic: f64,
    /// Its degrees of freedom in this recording.
    pub dof: f64,
    /// Chance of so much by this one test.
    pub p_value: f64,
    /// Chance of so much by any test of the catalogue.
    pub adjusted_p_value: f64,
    /// Names of effects that these recordings cannot tell from it.
    pub indistinguishable_from: Vec<String>,
    /// Share `ρ²` of this effect's contribution that each of those explains too.
    pub shared: Vec<f64>,
    /// Separation from each of those that is an effect, too.
    pub rivals: Vec<Rivalry>,
    /// Forms that are in no catalogue and explain about as much.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forms: Vec<String>,
    /// Recording that would tell them apart.
    #[serde(serialize_with = "remedy_in_words")]
    pub told_apart_by: Option<Remedy>,
    /// Effects that may exist too and would change its parameters by several standard errors.
    pub may_be_beside: Vec<Beside>,
    /// Its parameters after the refit.
    pub parameters: Vec<EffectParameter>,
    /// The channel that it lives in.
    pub channel: Channel,
    /// `√(χ²/dof)` of the channel without it.
    pub gap_before: f64,
    /// With it.
    pub gap_after: f64,
    /// Between which nine gaps of ten lie where nothing is missing; `None` of a channel without rows in the joint fit.
    pub gap_by_chance: Option<[f64; 2]>,
    /// Root mean square of what the channel leaves without it, in m/s², rad/s or rad.
    pub rms_before: Option<f64>,
    /// With everything named.
    pub rms_after: Option<f64>,
    /// On intervals that the fit did not see, without it.
    pub held_out_gap_before: f64,
    /// With it.
    pub held_out_gap_after: f64,
}

/// A claim with its evidence.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RankedClaim {
    /// Its name.
    pub name: String,
    /// Likelihood ratio.
    pub statistic: f64,
    /// Its degrees of freedom.
    pub dof: f64,
    /// Chance of so much by any test of the catalogue.
    pub adjusted_p_value: f64,
}

/// The gap on a recording that the fit did not see.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validation {
    /// The recording.
    pub recording: String,
    /// The channel.
    pub channel: Channel,
    /// `√(χ²/dof)` with the base models.
    pub gap_before: f64,
    /// With everything named.
    pub gap_after: f64,
    /// With the proposed formula too, in the channel that it is judged by.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap_with_formula: Option<f64>,
    /// Degrees of freedom of the channel: of a complete model `gap_after²` is 1 within `±2 √(2/dof)`.
    pub dof: f64,
}

/// A verdict on a named effect by a recording that the fit did not see.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Confirmation {
    /// The recording.
    pub recording: String,
    /// The effect.
    pub effect: String,
    /// Share of what the effect was found to do that the recording shows: 1 where it is as it was named, 0 where there is none.
    pub share: f64,
    /// Its standard error, the calibration's own errors in it.
    pub std: f64,
    /// The verdict.
    pub says: Says,
}

/// A verdict of a recording on an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Says {
    /// The share differs from 0, and has the sign of the effect.
    Confirms,
    /// It differs from 1, and not from 0.
    SpeaksAgainst,
    /// It differs from neither.
    CannotTell,
}

impl Says {
    /// Standard errors by which a share differs from 0 or from 1: by chance one in a hundred does, as of names.
    const DIFFERS: f64 = 2.326;

    /// By a share and its standard error.
    pub fn of(share: f64, std: f64) -> Self {
        if share > Self::DIFFERS * std {
            Self::Confirms
        } else if 1.0 - share > Self::DIFFERS * std {
            Self::SpeaksAgainst
        } else {
            Self::CannotTell
        }
    }
}

/// Findings of one search: the document findings.json.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// [`FINDINGS_SCHEMA`].
    pub schema: &'static str,
    /// The verdict.
    pub verdict: Verdict,
    /// Effects that were named, most evident first.
    pub effects: Vec<EffectFinding>,
    /// Faults of the recording.
    pub integrity: Vec<Integrity>,
    /// A disagreement that remains.
    pub unexplained: Option<Unexplained>,
    /// A formula for it, where one closes the gap on intervals that the fit did not see.
    pub proposed: Option<Proposal>,
    /// Channels in which the base models disagree with the data.
    pub disagreement: Vec<Disagreement>,
    /// The best of the catalogue against the base models.
    pub ranking: Vec<RankedClaim>,
    /// Effects of the catalogue that this recording cannot show at ten times their typical size.
    pub not_observable: Vec<String>,
    /// Errors that no recording of this kind can show.
    #[serde(with = "::findings::texts::of_warnings")]
    pub never_visible: ::findings::Findings,
    /// Gaps on recordings that the fit did not see.
    pub validation: Vec<Validation>,
    /// Verdicts on each named effect by recordings that the fit did not see.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub confirmations: Vec<Confirmation>,
    /// Random walk densities of the biases in the final model, m/s²/√s and rad/s/√s.
    pub walks: [f64; 2],
    /// Bias instability `B` of every axis in the final model, m/s² and rad/s: the Allan deviation is flat at `0.664 B`.
    pub bias_instability: [[f64; 3]; 2],
    /// White noise densities of accelerometer and gyroscope, m/s²/√Hz and rad/s/√Hz.
    pub white: [f64; 2],
    /// The calibration of the final model.
    pub calibration: Calibration,
}
