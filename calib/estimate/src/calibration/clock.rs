//! By which clock the turns of a recording were integrated.

use serde::{Deserialize, Serialize};

use crate::methods::joint::{ClockState, JointFit, SourceClock, Undersampled};

/// Milliseconds in a second.
const MILLI: f64 = 1e3;

/// The clock of the gyroscope of one recording.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingClock {
    /// The recording, as the user named it.
    pub recording: String,
    /// `stamps`, `even` or `between`.
    pub clock: String,
    /// `exact` (stamps are even by themselves), `data`, `undecided` (the turns do not tell, so that it hardly
    /// matters), `uncountable` (steps cannot be counted) or `request`.
    pub chosen_by: String,
    /// The share of the scatter that belongs to the samples: 0 of an even clock, 1 of the stamps.
    pub share: f64,
    /// Fitted value of that share.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share_fitted: Option<f64>,
    /// Its standard error.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share_std: Option<f64>,
    /// Root mean square of the stamps about the even clock, ms.
    pub scatter_ms: f64,
    /// Median step, ms.
    pub step_ms: f64,
    /// Steps of the even clock.
    pub ticks: u64,
    /// Places where steps passed without a sample.
    pub gaps: usize,
    /// Steps without a sample.
    pub lost: u64,
    /// Angle that is missing between samples, where any is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between_samples: Option<BetweenSamples>,
}

/// Error of an angle that is summed from samples times steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BetweenSamples {
    /// The share of each jump of the rate that is missing.
    pub share: f64,
    /// Bounds of the share at which its log-likelihood is half a unit lower.
    pub share_between: [f64; 2],
    /// Angle missing per turn, root mean square over the turns, °.
    pub degrees: f64,
}

impl RecordingClock {
    /// The stamps or the even clock, as asked for.
    pub fn given(recording: &str, even: bool) -> Self {
        let clock = SourceClock {
            state: ClockState::Given,
            share: if even { 0.0 } else { 1.0 },
            ..SourceClock::default()
        };
        Self::new(recording, &clock, None)
    }

    /// Those of a joint fit.
    pub fn of(fit: &JointFit) -> Vec<Self> {
        let missing = fit.undersampled();
        let sources = fit.data.sources.iter().enumerate();
        sources
            .filter(|(_, source)| source.gyroscope.is_some())
            .map(|(k, source)| {
                let missing = missing.iter().find(|m| m.recording == k);
                Self::new(&source.name, &source.clock, missing)
            })
            .collect()
    }

    fn new(recording: &str, clock: &SourceClock, missing: Option<&Undersampled>) -> Self {
        let name = match clock.share {
            0.0 => "even",
            1.0 => "stamps",
            _ => "between",
        };
        let chosen_by = match clock.state {
            ClockState::Exact => "exact",
            ClockState::Uncountable => "uncountable",
            ClockState::Given => "request",
            ClockState::Undecided => "undecided",
            ClockState::Snapped | ClockState::Fitted => "data",
        };
        Self {
            recording: recording.into(),
            clock: name.into(),
            chosen_by: chosen_by.into(),
            share: clock.share,
            share_fitted: clock.fitted.map(|(share, _)| share),
            share_std: clock.fitted.map(|(_, std)| std),
            scatter_ms: clock.scatter * MILLI,
            step_ms: clock.step * MILLI,
            ticks: clock.ticks,
            gaps: clock.gaps,
            lost: clock.lost,
            between_samples: missing.map(|missing| BetweenSamples {
                share: missing.share.value,
                share_between: missing.share.between,
                degrees: missing.rms.to_degrees(),
            }),
        }
    }
}
