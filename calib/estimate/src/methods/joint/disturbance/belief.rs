//! What the rows are believed to hold: levels of noise, and disturbances.

use faer::Mat;
use sensor::Sensor;

use crate::methods::joint::disturbance::Suspect;
use crate::methods::joint::noise::weights::{Component, NoiseLevel, Whitening};
use crate::methods::joint::orientation::Shown;

/// How rows are believed.
pub(crate) struct Weights {
    /// Sizes of the components.
    pub levels: Vec<NoiseLevel>,
    /// The disturbances.
    pub accused: Vec<Suspect>,
    /// Kinds of noise beside the white one, as covariances of the rows.
    pub components: Vec<Component>,
    /// Whether the walk of the accelerometer's bias begins anew in every rest.
    pub walk_ends_with_rests: bool,
    /// What makes the rows white.
    pub whitening: Whitening,
    /// What the errors are larger by and the weights do not know, whitened by the white noise (`m × q`).
    pub carried: Mat<f64>,
    /// What depends on the orientation and should not.
    pub shown: Vec<(Sensor, Shown)>,
}

impl Weights {
    /// The columns of the disturbances.
    pub fn columns(&self) -> Vec<Vec<f64>> {
        let of = |s: &Suspect| s.columns.clone();
        self.accused.iter().flat_map(of).collect()
    }
}
