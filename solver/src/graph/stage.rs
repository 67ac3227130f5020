//! Stand-ins for robust losses.

use crate::loss::{Loss, LossScale};

/// By how much the scales of a stage are at least narrower than those of the one before, as in the dense solver: of 500
/// starts with 30 % of outliers on one side 469 and 472 (Tukey, Geman–McClure) so lead to the right minimum, by
/// halves 463 and 441.
const NARROWER: f64 = 10.0;

/// Most stages.
const STAGES: usize = 20;

/// Stand-in for the losses of a graph for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stage {
    /// Nothing does.
    Meant,
    /// The same with scales so many times as large.
    Wide(f64),
    /// Least absolute values, nearly: Huber's with a third of the scale.
    Absolute,
}

impl Stage {
    /// Ever narrower losses, from so many times their scales down to the scales.
    pub fn narrowing(mut widening: f64) -> Vec<Self> {
        let ratio = widening.powf(1.0 / STAGES as f64).max(NARROWER);
        let mut stages = Vec::new();
        while widening > 1.0 && widening.is_finite() {
            stages.push(Self::Wide(widening));
            widening /= ratio;
        }
        stages
    }

    /// Stand-in for a loss.
    pub fn of(self, loss: Loss) -> Loss {
        match (self, loss.scale()) {
            (Self::Wide(widening), Some(LossScale::Given(scale))) => {
                loss.with_scale(widening * scale)
            }
            (Self::Absolute, Some(LossScale::Given(scale))) => {
                Loss::Huber(LossScale::Given(scale / 3.0))
            }
            _ => loss,
        }
    }
}
