//! The clock of the turns: the stamps, an even clock behind them, or between.
//!
//! With even clock `e_k`, stamps `s_k` and `d = s − e` the clock is `e + λ d`: `λ = 0` where the sensor samples
//! evenly and the stamps scatter, 1 where the sampling is uneven and the stamps are right. `λ` is one more
//! parameter of the fit; it comes out as `σ_J²/(σ_J² + σ_S²)`, the weight that leaves the least.

pub(crate) mod coning;
mod decided;
pub(crate) mod fit;
mod instants;
pub(crate) mod sampling;
mod turn_residuals;
pub(crate) mod undersampled;
pub(crate) mod windows;

use nalgebra::{Matrix2, Vector2};
use recording::{EvenClock, Stamps, Stream, even_clock};

use crate::methods::joint::clock::sampling::Share;

/// Clock by which the turns are integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClockMode {
    /// Clock that the data support best.
    #[default]
    Auto,
    /// The stamps as they are.
    Stamps,
    /// An even clock behind them, where there is one.
    Even,
}

/// Result of the choice of a recording's clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClockState {
    /// The stamps are even: there is nothing to choose.
    #[default]
    Exact,
    /// They scatter by so much that steps cannot be counted: the stamps are taken as they are.
    Uncountable,
    /// The request gave the clock.
    Given,
    /// The share was fitted and is as good as 0 or 1.
    Snapped,
    /// The share was fitted.
    Fitted,
    /// The turns say nothing of it: the share is the likelier one by the stamps alone.
    Undecided,
}

/// The clock of one recording.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SourceClock {
    /// Result of the choice.
    pub state: ClockState,
    /// `λ`: the share of the scatter that belongs to the samples; 1 for the stamps as they are.
    pub share: f64,
    /// Fitted share before it was rounded, and its standard error; `None` where it was not fitted.
    pub fitted: Option<(f64, f64)>,
    /// Root mean square of stamps less the even clock, s.
    pub scatter: f64,
    /// Median step, s.
    pub step: f64,
    /// Steps of the even clock that were counted.
    pub ticks: u64,
    /// Places where steps passed without a sample.
    pub gaps: usize,
    /// Steps without a sample.
    pub lost: u64,
    /// `χ²` per degree of freedom of the turns' directions with this clock; `None` where nothing was fitted.
    pub misfit: Option<f64>,
    /// True if the samples are instantaneous values, and not means over their windows; means where the turns do not tell.
    pub instants: bool,
    /// Share of the jumps between samples that is missing in the angles.
    pub sampling: Share,
    /// The even clock among those of a turn that the turns go by.
    pub base: usize,
    /// Variance of the times of the samples about the clock, s².
    pub timing: f64,
    /// Scatter of the turns that is allowed for while the clock is fitted, rad.
    pub floor: f64,
}

/// One clock for a turn: an even one and what the stamps add.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnClock {
    /// The even clock at the samples, s.
    pub even: Vec<f64>,
    /// Stamps less that, s.
    pub scatter: Vec<f64>,
    /// Lengths of the samples' windows by the even clock, s.
    pub lengths: Vec<f64>,
    /// Change of the windows' lengths by the scatter, s.
    pub slack: Vec<f64>,
}

impl TurnClock {
    /// Builds the clock of the samples in `range`, from stamps and even times (s).
    pub(crate) fn of(stamps: &[f64], even: &[f64], range: std::ops::Range<usize>) -> Self {
        let scatter: Vec<f64> = stamps.iter().zip(even).map(|(s, e)| s - e).collect();
        let windows = |t: &[f64]| range.clone().map(|k| window(t, k)).collect();
        Self {
            even: even[range.clone()].to_vec(),
            lengths: windows(even),
            slack: windows(&scatter),
            scatter: scatter[range.clone()].to_vec(),
        }
    }
}

/// Length of the window of sample `k`: half the way to either neighbour.
pub(crate) fn window(t: &[f64], k: usize) -> f64 {
    let after = t.get(k + 1).map(|next| next - t[k]);
    let before = k.checked_sub(1).map(|j| t[k] - t[j]);
    match (before, after) {
        (Some(a), Some(b)) => 0.5 * (a + b),
        (Some(a), None) | (None, Some(a)) => a,
        (None, None) => 0.0,
    }
}

/// The clocks that may be behind the stamps of a gyroscope, and what is known of them.
pub(crate) fn clocks_behind(rate: &Stream, mode: ClockMode) -> (SourceClock, Vec<Vec<f64>>) {
    let stamps = SourceClock {
        share: 1.0,
        ..SourceClock::default()
    };
    if mode == ClockMode::Stamps {
        let state = ClockState::Given;
        return (SourceClock { state, ..stamps }, Vec::new());
    }
    match even_clock(&rate.t) {
        Stamps::Exact => (stamps, Vec::new()),
        Stamps::Uncountable { share, step } => {
            let clock = SourceClock {
                state: ClockState::Uncountable,
                scatter: share * step,
                step,
                ..stamps
            };
            (clock, Vec::new())
        }
        Stamps::Scattered(EvenClock {
            even,
            following,
            step,
            scatter,
            ticks,
            gaps,
            lost,
        }) => {
            let clock = SourceClock {
                state: ClockState::Given,
                share: 0.0,
                scatter,
                step,
                ticks,
                gaps,
                lost,
                ..SourceClock::default()
            };
            (clock, std::iter::once(even).chain(following).collect())
        }
    }
}

/// The two rows of a turn as a symmetric outer product.
pub(crate) fn outer(v: &Vector2<f64>) -> Matrix2<f64> {
    v * v.transpose()
}
