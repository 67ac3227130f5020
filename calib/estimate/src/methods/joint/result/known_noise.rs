//! Noise of a known form beside the white: what depends on the orientation, and what is carried from elsewhere.

use faer::Mat;
use sensor::Sensor;

use super::analysis::Analysis;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::noise::weights::{Component, ComponentKind, Form, NoiseLevel};
use crate::methods::joint::rows::Rows;

impl Analysis {
    /// Adds what depends on the orientation to what the noise may have: `errors` (3 × q for every rest) of unit size
    /// in the readings of a sensor.
    pub fn allow_orientation(
        &mut self,
        rows: &Rows<'_>,
        sensor: Sensor,
        errors: &[nalgebra::DMatrix<f64>],
    ) {
        let count = errors.first().map_or(0, |e| e.ncols());
        let (kind, columns) = match sensor {
            Sensor::Accelerometer => {
                let mut columns = Mat::zeros(rows.count(), count);
                for own in rows.means(sensor) {
                    for i in 0..3 {
                        for c in 0..count {
                            columns[(own.row + i, c)] = errors[own.chunk.rest][(i, c)];
                        }
                    }
                }
                self.white.apply(columns.as_mut());
                (ComponentKind::ForceOfOrientation, columns)
            }
            Sensor::Gyroscope | Sensor::Magnetometer => {
                let shifts = self.rate_shifts(rows);
                let mut columns = Mat::zeros(rows.count(), count);
                for c in 0..count {
                    let errors = errors.iter().flat_map(|e| (0..3).map(move |i| e[(i, c)]));
                    let moved = shifts.times(&errors.collect::<Vec<_>>());
                    columns
                        .col_mut(c)
                        .iter_mut()
                        .zip(moved)
                        .for_each(|(v, m)| *v = m);
                }
                (ComponentKind::RateOfOrientation, columns)
            }
        };
        let columns = Columns::cut(&columns, rows.groups());
        self.components.push(Component {
            kind,
            covariance: Covariance::none(rows.count()),
            form: Form::Columns(columns.clone()),
        });
        self.orientation.push((kind, columns));
    }

    /// Adds to the noise what `columns` (`m × q`, not whitened) do to the rows by unit sizes.
    pub fn carry(&mut self, kind: ComponentKind, columns: &Columns) {
        let mut whitened = columns.clone();
        whitened.apply(|rows, a| self.white.apply_rows(rows, a));
        self.components.push(Component {
            kind,
            covariance: Covariance::of_columns(&whitened),
            form: Form::Columns(whitened.clone()),
        });
        self.carried.push(whitened);
    }

    /// Returns the columns of the vertical part of the earth's rotation, one per recording and of the size that it may
    /// have, whitened by the white noise (`m × recordings`); `earth` begins with a column of it for every recording.
    pub fn of_place(&self, earth: Option<&Columns>) -> Columns {
        let Some(earth) = earth else {
            return Columns::none(self.white.groups());
        };
        let vertical: Vec<usize> = (0..self.white.groups().iter().len()).collect();
        let mut columns = earth.select(&vertical);
        let variance = ComponentKind::EarthRotation.known_variance();
        columns.scale(variance.unwrap_or(0.0).sqrt());
        columns.apply(|rows, a| self.white.apply_rows(rows, a));
        columns
    }

    /// Returns the columns of the errors that depend on the orientation at these levels, whitened by the white noise
    /// (`m × q`).
    pub fn carried(&self, levels: &[NoiseLevel]) -> Columns {
        let none = Columns::none(self.white.groups());
        self.orientation.iter().fold(none, |sum, (kind, columns)| {
            let level = levels.iter().find(|level| level.kind == *kind);
            let mut columns = columns.clone();
            columns.scale(level.map_or(0.0, |level| level.size));
            sum.beside(&columns)
        })
    }
}
