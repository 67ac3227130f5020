//! What the rows are believed to hold: levels of noise, and disturbances.

use sensor::Sensor;

use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::disturbance::Suspect;
use crate::methods::joint::noise::weights::{Component, NoiseLevel, Whitening};
use crate::methods::joint::orientation::Shown;

/// How rows are believed.
pub(crate) struct Weights {
    /// Sizes of the components.
    pub levels: Vec<NoiseLevel>,
    /// The disturbances.
    pub flagged: Vec<Suspect>,
    /// Kinds of noise beside the white one, as covariances of the rows.
    pub components: Vec<Component>,
    /// Whether the walk of the accelerometer's bias begins anew in every rest.
    pub walk_ends_with_rests: bool,
    /// What makes the rows white.
    pub whitening: Whitening,
    /// What the errors are larger by and the weights do not know, whitened by the white noise (`m × q`).
    pub carried: Columns,
    /// What the vertical part of the earth's rotation, which the weights take for another in every recording, does to the rows
    /// of each, whitened by the white noise (`m × recordings`).
    pub of_place: Columns,
    /// What depends on the orientation and should not.
    pub shown: Vec<(Sensor, Shown)>,
}

impl Weights {
    /// The columns of the disturbances.
    pub fn columns(&self) -> Vec<Column> {
        let of = |s: &Suspect| s.columns.clone();
        self.flagged.iter().flat_map(of).collect()
    }
}
