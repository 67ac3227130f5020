//! Stand-ins for robust losses.

use crate::loss::{Loss, LossScale};

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
