//! Weights of the rows: levels of noise, and disturbances.

use sensor::Sensor;

use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::noise::weights::{Component, NoiseLevel, Whitening};
use crate::methods::joint::orientation::Shown;

/// Weights of the rows, with the disturbances that have parameters of their own.
pub(crate) struct Weights {
    /// Sizes of the components.
    pub levels: Vec<NoiseLevel>,
    /// The disturbances.
    pub flagged: Vec<Suspect>,
    /// Kinds of noise beside the white one, as covariances of the rows.
    pub components: Vec<Component>,
    /// True if the walk of the accelerometer's bias begins anew in every static interval.
    pub walk_ends_with_rests: bool,
    /// Whitening of the rows.
    pub whitening: Whitening,
    /// Columns of errors that depend on the orientation: they enlarge the covariance and have no part in the weights;
    /// whitened by the white noise (`m × q`).
    pub carried: Columns,
    /// Columns of the vertical part of the earth's rotation, one per recording, because the weights take it as
    /// independent in each; whitened by the white noise (`m × recordings`).
    pub of_place: Columns,
    /// Patterns by which the residuals depend on the orientation, with the sensor of each.
    pub shown: Vec<(Sensor, Shown)>,
}

impl Weights {
    /// The columns of the disturbances.
    pub fn columns(&self) -> Vec<Column> {
        let of = |s: &Suspect| s.columns.clone();
        self.flagged.iter().flat_map(of).collect()
    }
}
