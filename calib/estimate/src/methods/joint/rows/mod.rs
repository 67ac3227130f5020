//! The rows of the joint problem and their Jacobian.

pub(crate) mod attitudes;
mod by_parameters;
pub(crate) mod chart;
pub(crate) mod earth;
pub(crate) mod error_columns;
pub(crate) mod knowledge;
pub(crate) mod layout;
mod rounding;
pub(crate) mod sensitivity;
pub(crate) mod slopes;
pub(crate) mod turn;
mod turn_rows;
pub(crate) mod values;

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Base, Kinematics, Model, PLACES, Sensor, Since, inverse};

use super::data::{Chunk, Data, Mean, TurnSamples};
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::{Columns, Part};
use crate::methods::joint::blocks::groups::RowGroups;
use crate::methods::joint::clock::coning::Coning;
use crate::methods::joint::rows::chart::Chart;
use crate::methods::joint::rows::layout::Layout;
use crate::methods::joint::rows::slopes::ModelSlopes;

/// The models and the data, before any weight.
#[derive(Clone, Debug)]
pub struct Rows<'a> {
    /// Rests and turns.
    pub data: &'a Data,
    /// The accelerometer.
    pub accelerometer: &'a Model,
    /// The gyroscope.
    pub gyroscope: &'a Model,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Places of the parameters among the columns.
    pub layout: Layout,
    /// Coordinates of the direction of every rest.
    pub charts: &'a [Chart],
    /// `∂r/∂d` of the disturbances, one column each: rows that are known to be off.
    pub disturbances: &'a [Column],
    /// The rows of the recordings.
    groups: RowGroups,
    /// Coning terms for samples that are means over their windows, and for samples at instants.
    conings: [Coning; 2],
}

/// Residuals and Jacobian at a point.
#[derive(Clone, Debug)]
pub struct Linear {
    /// `r` (`m`).
    pub residuals: Vec<f64>,
    /// `∂r/∂x` (`m × n`), all columns.
    pub jacobian: Columns,
}

/// The mean of a sensor over a chunk, three rows.
#[derive(Clone, Copy, Debug)]
pub struct MeanRows<'a> {
    /// The first of its rows.
    pub row: usize,
    /// Place of the chunk among all.
    pub place: usize,
    /// The chunk.
    pub chunk: &'a Chunk,
    /// The mean.
    pub mean: Mean,
}

impl<'a> Rows<'a> {
    /// Builds the rows of these data and models.
    pub fn new(
        data: &'a Data,
        (accelerometer, gyroscope): (&'a Model, &'a Model),
        gravity: f64,
        charts: &'a [Chart],
        (own_force_bias, disturbances): (bool, &'a [Column]),
    ) -> Self {
        let rate = data.chunks.iter().any(|c| c.gyroscope.is_some());
        let gyroscope_parameters = if rate { gyroscope.parameter_count() } else { 0 };
        Self {
            data,
            accelerometer,
            gyroscope,
            gravity,
            layout: Layout {
                accelerometer: accelerometer.parameter_count(),
                gyroscope: gyroscope_parameters,
                own_force_bias,
                recordings: data.sources.len(),
                rests: data.rests.len(),
                of_heading: [
                    accelerometer.references(),
                    if rate {
                        gyroscope.references()
                    } else {
                        Vec::new()
                    },
                ],
                headings: data.headings(),
                disturbances: disturbances.len(),
            },
            charts,
            disturbances,
            groups: data.row_groups(),
            conings: [Coning::new(), Coning::at_instants()],
        }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        3 * self.means(Sensor::Accelerometer).count()
            + 3 * self.means(Sensor::Gyroscope).count()
            + 2 * self.data.turns.len()
    }

    /// The rows of the recordings.
    pub fn groups(&self) -> &RowGroups {
        &self.groups
    }

    /// The columns that may differ from zero in the rows of every group, which is of whole recordings.
    pub(crate) fn columns_of(&self, groups: &RowGroups) -> Vec<Vec<usize>> {
        let mut of_group = vec![Vec::new(); groups.iter().len()];
        for (recording, rows) in self.groups.iter().enumerate() {
            let Some(&first) = rows.first() else { continue };
            let own = &mut of_group[groups.of(first)];
            let rests = self.data.rests.iter().enumerate();
            let mut heading = None;
            for (k, rest) in rests.filter(|(_, rest)| rest.recording == recording) {
                if heading.replace(rest.heading) != Some(rest.heading) {
                    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
                        own.extend(self.layout.columns(sensor, (recording, rest.heading)));
                    }
                }
                let direction = self.layout.direction(k);
                own.extend([direction, direction + 1]);
            }
        }
        for (k, column) in self.disturbances.iter().enumerate() {
            let place = self.layout.disturbance(k);
            let rows = column.entries().iter().map(|(row, _)| *row);
            rows.for_each(|row| of_group[groups.of(row)].push(place));
        }
        for columns in &mut of_group {
            columns.sort_unstable();
            columns.dedup();
        }
        of_group
    }

    /// Static intervals beyond those that the norm of specific force needs for the accelerometer's parameters, of which the
    /// frame holds three.
    pub(crate) fn spare_placements(&self) -> usize {
        let biases = match self.layout.own_force_bias {
            true => 3 * self.data.sources.len().saturating_sub(1),
            false => 0,
        };
        let parameters = (self.layout.accelerometer + biases).saturating_sub(3);
        self.data.rests.len().saturating_sub(parameters)
    }

    /// First row of the turns.
    pub fn first_turn_row(&self) -> usize {
        self.count() - 2 * self.data.turns.len()
    }

    /// The turns in their order, each with the first of its two rows.
    pub fn turns(&self) -> impl Iterator<Item = (usize, &TurnSamples)> {
        let rows = (self.first_turn_row()..).step_by(2);
        rows.zip(&self.data.turns)
    }

    /// First row of a sensor's means.
    pub fn first_row(&self, sensor: Sensor) -> usize {
        match sensor {
            Sensor::Accelerometer => 0,
            Sensor::Gyroscope | Sensor::Magnetometer => self.first_rate_row(),
        }
    }

    /// First row of the gyroscope's means.
    pub fn first_rate_row(&self) -> usize {
        3 * self.means(Sensor::Accelerometer).count()
    }

    /// The means of a sensor in the order of their rows.
    pub fn means(&self, sensor: Sensor) -> impl Iterator<Item = MeanRows<'a>> {
        let first = self.first_row(sensor);
        let chunks = self.data.chunks.iter().enumerate();
        let means = chunks.filter_map(move |(place, chunk)| {
            let mean = chunk.mean(sensor)?;
            Some((place, chunk, mean))
        });
        means
            .enumerate()
            .map(move |(k, (place, chunk, mean))| MeanRows {
                row: first + 3 * k,
                place,
                chunk,
                mean,
            })
    }

    /// The model of a sensor.
    pub(crate) fn model(&self, sensor: Sensor) -> &'a Model {
        match sensor {
            Sensor::Accelerometer => self.accelerometer,
            Sensor::Gyroscope | Sensor::Magnetometer => self.gyroscope,
        }
    }

    /// The columns of a model's parameters at a rest, and in the turn after it.
    pub(crate) fn columns_at(&self, sensor: Sensor, rest: usize) -> Vec<usize> {
        let rest = &self.data.rests[rest];
        self.layout.columns(sensor, (rest.recording, rest.heading))
    }

    /// The model's parameters at a rest, and in the turn after it.
    pub fn local(&self, x: &[f64], sensor: Sensor, rest: usize) -> Vec<f64> {
        let columns = self.columns_at(sensor, rest);
        columns.iter().map(|&c| x[c]).collect()
    }

    /// The same with which the static means of a rest are predicted: a gyroscope's `T` is that of the data.
    pub(crate) fn local_at_rest(&self, x: &[f64], sensor: Sensor, rest: usize) -> Vec<f64> {
        let mut p = self.local(x, sensor, rest);
        if sensor == Sensor::Gyroscope {
            for (value, place) in p.iter_mut().zip(PLACES) {
                *value = self.data.axes_at_rest[place];
            }
        }
        p
    }

    /// The direction of a rest.
    pub fn direction(&self, x: &[f64], rest: usize) -> Vector3<f64> {
        let at = self.layout.direction(rest);
        self.charts[rest].direction(&x[at..at + 2])
    }

    /// Residuals and Jacobian.
    pub fn linearize(&self, x: &[f64]) -> Linear {
        let of_group = self.columns_of(&self.groups);
        let mut jacobian = Columns::zeros(&self.groups, self.layout.count(), of_group);
        let mut residuals = vec![0.0; self.count()];
        for group in 0..jacobian.parts().len() {
            let part = jacobian.part_mut(group);
            let own = self.linearize_part(x, part);
            part.rows
                .iter()
                .zip(own)
                .for_each(|(&row, r)| residuals[row] = r);
        }
        Linear {
            residuals,
            jacobian,
        }
    }

    /// The residuals of the rows of a part, whose Jacobian is filled.
    pub(crate) fn linearize_part(&self, x: &[f64], part: &mut Part) -> Vec<f64> {
        let mut residuals = Vec::with_capacity(part.rows.len());
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            for mean in self.means(sensor) {
                if part.rows.get(residuals.len()) == Some(&mean.row) {
                    let own = self.mean_rows(x, sensor, &mean, (residuals.len(), part));
                    residuals.extend(own.iter());
                }
            }
        }
        for (row, turn) in self.turns() {
            if part.rows.get(residuals.len()) == Some(&row) {
                let own = self.turn_rows(x, turn, (residuals.len(), part));
                residuals.extend(own.iter());
            }
        }
        for (k, column) in self.disturbances.iter().enumerate() {
            let place = self.layout.disturbance(k);
            let Some(own) = part.place(place) else {
                continue;
            };
            for &(row, slope) in column.entries() {
                if let Ok(i) = part.rows.binary_search(&row) {
                    residuals[i] += slope * x[place];
                    part.values[(i, own)] = slope;
                }
            }
        }
        residuals
    }

    /// The residuals of some rows, whole recordings in ascending order.
    pub(crate) fn residuals_of(&self, x: &[f64], rows: &[usize]) -> Vec<f64> {
        let mut residuals = Vec::with_capacity(rows.len());
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            for mean in self.means(sensor) {
                if rows.get(residuals.len()) == Some(&mean.row) {
                    residuals.extend(self.mean_residual(x, sensor, &mean).iter());
                }
            }
        }
        for (row, turn) in self.turns() {
            if rows.get(residuals.len()) == Some(&row) {
                residuals.extend(self.turn_residual(x, turn).iter());
            }
        }
        for (k, column) in self.disturbances.iter().enumerate() {
            let value = x[self.layout.disturbance(k)];
            for &(row, slope) in column.entries() {
                if let Ok(i) = rows.binary_search(&row) {
                    residuals[i] += slope * value;
                }
            }
        }
        residuals
    }

    /// `r = distort(g u) − mean` of one chunk: the reading that the model predicts at rest, less the one
    /// that was measured.
    fn mean_rows(
        &self,
        x: &[f64],
        sensor: Sensor,
        MeanRows { chunk, mean, .. }: &MeanRows<'_>,
        (row, part): (usize, &mut Part),
    ) -> Vector3<f64> {
        let model = self.model(sensor);
        let columns = self.columns_at(sensor, chunk.rest);
        let p = self.local_at_rest(x, sensor, chunk.rest);
        let base = Base::from_parameters(&p);
        let inverse = inverse(&base.t).unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        let at = self.layout.direction(chunk.rest);
        let u = self.direction(x, chunk.rest);
        let by_direction = self.charts[chunk.rest].slope(&x[at..at + 2]) * self.gravity;
        let truth = self.at_rest(chunk, mean, u);
        let mut by_parameters = Vec::with_capacity(p.len() - BASE_PARAMETERS);
        let effects =
            ModelSlopes::new(model, &p, Sensor::Accelerometer).at(&truth, &mut by_parameters);
        let signal = truth.signal(sensor) + effects.value;
        let reading = inverse * signal;
        let own = if sensor == Sensor::Accelerometer {
            Matrix3::identity()
        } else {
            Matrix3::zeros()
        };
        let by_force = inverse * (own + effects.by_signal) * by_direction;
        let places = part.places(&columns);
        let by_direction = part.places(&[at, at + 1]);
        for i in 0..3 {
            let fitted = PLACES.iter().filter(|_| sensor == Sensor::Accelerometer);
            for (k, (a, b)) in fitted.enumerate() {
                part.values[(row + i, places[k])] = -inverse[(i, *a)] * reading[*b];
            }
            part.values[(row + i, places[9 + i])] = 1.0;
            for (j, place) in by_direction.iter().enumerate() {
                part.values[(row + i, *place)] = by_force[(i, j)];
            }
        }
        let own = places.iter().skip(BASE_PARAMETERS);
        for (slope, place) in by_parameters.iter().zip(own) {
            let carried = inverse * slope;
            for i in 0..3 {
                part.values[(row + i, *place)] = carried[i];
            }
        }
        reading + base.bias - mean.value
    }

    /// The truth in a chunk of a rest: time that of the mean's middle.
    pub(crate) fn at_rest(&self, chunk: &Chunk, mean: &Mean, u: Vector3<f64>) -> Kinematics<f64> {
        let rest = &self.data.rests[chunk.rest];
        let mut truth = rest
            .known
            .with_signal(Sensor::Accelerometer, u * self.gravity);
        truth.time += 0.5 * (mean.span.from + mean.span.to - rest.span.from - rest.span.to);
        truth.temperature = chunk.temperature.unwrap_or(truth.temperature);
        [truth.temperature_rate, truth.warming] = chunk.thermal;
        truth.since_turn = Since {
            from: mean.span.from - rest.turned,
            to: mean.span.to - rest.turned,
        };
        truth
    }
}
