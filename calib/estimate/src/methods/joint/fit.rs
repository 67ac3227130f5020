//! The fit and its data, to be looked at from any side.

use nalgebra::Vector3;
use sensor::{Model, Sensor};
use solver::Parameters;

use super::data::Data;
use super::faults::Flagged;
use super::orientation::Shown;
use crate::methods::Ending;
use crate::methods::RawUnit;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::noise::weights::{Component, NoiseLevel, Whitening};
use crate::methods::joint::result::marginal::reduced;
use crate::methods::joint::rows::Rows;
use crate::methods::joint::rows::chart::Chart;

/// The joint fit, near SI units.
#[derive(Clone, Debug)]
pub struct JointFit {
    /// The models of accelerometer and gyroscope.
    pub models: [Model; 2],
    /// The data.
    pub data: Data,
    /// Coordinates of the directions.
    pub charts: Vec<Chart>,
    /// All parameters with names: models, own biases, directions, disturbances.
    pub parameters: Parameters,
    /// Places of the free parameters, the columns of the Jacobian.
    pub free: Vec<usize>,
    /// Number of parameters before the directions.
    pub shared: usize,
    /// First row of the gyroscope's means, first row of the turns.
    pub first_rows: [usize; 2],
    /// Rest of each row (a turn's: the one before it).
    pub rest_of_row: Vec<usize>,
    /// Residuals at the minimum, whitened by everything (`m`).
    pub residuals: Vec<f64>,
    /// Jacobian there (`m × n`), whitened by everything.
    pub jacobian: Columns,
    /// The columns of the shared parameters less what all others can take of them (`m × k`), whitened by everything.
    pub reduced: Columns,
    /// Columns of errors that depend on the orientation: they enlarge the covariance and have no part in the weights;
    /// whitened by everything (`m × q`).
    pub carried: Columns,
    /// Columns of the vertical part of the earth's rotation, one per recording, because the weights take it as
    /// independent in each; whitened by everything (`m × recordings`).
    pub of_place: Columns,
    /// Residuals whitened by white noise alone.
    pub white_residuals: Vec<f64>,
    /// Jacobian whitened by white noise alone.
    pub white_jacobian: Columns,
    /// The whitening: by white noise, then by everything else.
    pub whitening: Whitening,
    /// `∂r/∂d` of what was found disturbed, one column per parameter, not whitened.
    pub disturbance_columns: Vec<Column>,
    /// Components of the noise beside the white one, whitened by white noise: `Ca`, `Cg` …
    pub components: Vec<Component>,
    /// Levels of these components.
    pub levels: Vec<NoiseLevel>,
    /// Work of the fit: linearisations times the cost of a step, in samples of turns.
    pub work: usize,
    /// Disturbances that were found.
    pub flagged: Vec<Flagged>,
    /// Patterns by which the residuals at the static intervals depend on the orientation, with the sensor of each.
    pub shown: Vec<(Sensor, Shown)>,
    /// True if the accelerometer has a bias of its own in every recording.
    pub own_force_bias: bool,
    /// Unit of the accelerometer.
    pub force_unit: RawUnit,
    /// Unit of the gyroscope.
    pub rate_unit: RawUnit,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Ending of the solver's last run.
    pub ending: Ending,
    /// Turns' misses before any fit (unit scales), rad.
    pub chords_before: Vec<f64>,
    /// Turns' misses, rad.
    pub chords: Vec<f64>,
    /// `|f| − g` of every rest, m/s².
    pub norms: Vec<f64>,
}

impl JointFit {
    /// The rows that were fitted, to be evaluated anywhere.
    pub fn rows(&self) -> Rows<'_> {
        self.rows_beside(&self.disturbance_columns)
    }

    /// Another whitening of the same rows: uncertainties are those of this Jacobian since.
    pub fn set_jacobian(&mut self, jacobian: Columns) {
        self.reduced = reduced(&jacobian, &self.free, self.shared);
        self.jacobian = jacobian;
    }

    /// The same without the columns of what was disturbed.
    pub fn plain_rows(&self) -> Rows<'_> {
        self.rows_beside(&[])
    }

    fn rows_beside<'a>(&'a self, disturbances: &'a [Column]) -> Rows<'a> {
        Rows::new(
            &self.data,
            (&self.models[0], &self.models[1]),
            self.gravity,
            &self.charts,
            (self.own_force_bias, disturbances),
        )
    }

    /// The direction of specific force in every rest, body frame.
    pub fn directions(&self) -> Vec<Vector3<f64>> {
        let x = &self.parameters.values()[self.shared..];
        self.charts
            .iter()
            .enumerate()
            .map(|(k, chart)| chart.direction(&x[2 * k..2 * k + 2]))
            .collect()
    }
}
