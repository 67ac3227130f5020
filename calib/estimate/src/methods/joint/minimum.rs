//! The minimum of a joint fit under some weights.

use std::borrow::Cow;

use nalgebra::Vector3;
use recording::Error;
use recording::watch::Stage;
use sensor::{Base, BasePart, Sensor, base_part};
use solver::{Mask, Parameters};

use super::approach::{Weighted, approach};
use super::data::Data;
use super::graph::solve_rows;
use super::request::JointRequest;
use super::start::Start;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::disturbance::belief::Weights;
use crate::methods::joint::noise::weights::Whitening;
use crate::methods::joint::rows::chart::Chart;
use crate::methods::joint::rows::{Linear, Rows};

/// A joint fit on its way: data and coordinates stay the same over all rounds of weighting.
pub(crate) struct Run<'a> {
    /// Request of the fit.
    pub request: &'a JointRequest<'a>,
    /// Means of the rests and turns.
    pub data: Data,
    /// Coordinates of the direction in each rest.
    pub charts: Vec<Chart>,
    /// First values.
    pub start: Start,
}

/// The minimum under some weights.
#[derive(Clone)]
pub(crate) struct Point {
    /// Parameters at the minimum.
    pub parameters: Parameters,
    /// Mask of the free parameters.
    pub mask: Mask,
    /// The rows there.
    pub linear: Linear,
    /// Number of parameters before those of disturbances.
    pub plain: usize,
}

impl Point {
    /// The rows as they would be without the disturbances.
    pub fn undisturbed(&self) -> Linear {
        self.linear
            .without_disturbances(self.parameters.values(), self.plain)
    }

    /// The parameters before those of disturbances.
    pub fn plain_values(&self) -> &[f64] {
        &self.parameters.values()[..self.plain]
    }
}

impl Run<'_> {
    /// The rows, with columns of disturbances.
    pub fn rows<'b>(&'b self, disturbances: &'b [Column]) -> Rows<'b> {
        let models = (&self.request.accelerometer, &self.request.gyroscope);
        Rows::new(
            &self.data,
            models,
            self.request.gravity,
            &self.charts,
            (self.start.own_force_bias, disturbances),
        )
    }

    /// Near the minimum under these weights: by few Gauss–Newton steps, and by the solver where those lead nowhere.
    pub fn approach(&self, weights: &Weights, before: Option<&Point>) -> Result<Point, Error> {
        self.request.watch.step(Stage::Fitting)?;
        let columns = weights.columns();
        let rows = self.rows(&columns);
        let mut parameters = self.begin_at(&rows);
        let plain = rows.layout.disturbance(0);
        if let Some(before) = before {
            parameters.values_mut()[..plain].copy_from_slice(before.plain_values());
        }
        set(&mut parameters, &self.request.held);
        let mask = self.mask(&parameters);
        let weighted = Weighted {
            rows: &rows,
            whitening: &weights.whitening,
        };
        let quick = approach(&weighted, parameters.values(), &mask.free_indices());
        let linear = match quick {
            Some(near) => {
                self.start.steps.took(near.taken);
                parameters.values_mut().copy_from_slice(&near.x);
                near.linear
            }
            None => {
                let steps = &self.start.steps;
                let most = steps.on_the_way(self.data.cost_of_a_step());
                let free = mask.free_indices();
                let ended = solve_rows(&weighted, parameters.values(), &free, most)?;
                steps.took(ended.linearisations);
                parameters.values_mut().copy_from_slice(&ended.x);
                rows.linearize(&ended.x)
            }
        };
        Ok(Point {
            parameters,
            mask,
            linear,
            plain,
        })
    }

    /// Returns the nonlinearity from `point` to `next`: the distance of the rows at `next` from their prediction by the
    /// Jacobian at `point`, in standard deviations of white noise (root of the sum of squares).
    pub fn bend(&self, point: &Point, next: &Point, whitening: &Whitening) -> f64 {
        let (a, b) = (point.undisturbed(), next.undisturbed());
        let step = next.plain_values().iter().zip(point.plain_values());
        let predicted = a
            .jacobian
            .times(&step.map(|(b, a)| b - a).collect::<Vec<_>>());
        let moved = b.residuals.iter().zip(&a.residuals).zip(predicted);
        let bend: Vec<f64> = moved.map(|((b, a), by)| b - a - by).collect();
        let white = whitening.white.whiten(&bend);
        white.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    /// The values of the parameters at a point, or else at the start.
    pub fn values_near<'p>(&self, rows: &Rows<'_>, point: Option<&'p Point>) -> Cow<'p, [f64]> {
        match point {
            Some(point) => Cow::Borrowed(point.plain_values()),
            None => Cow::Owned(self.first_values(rows).values().to_vec()),
        }
    }

    /// The parameters at the start.
    pub fn first_values(&self, rows: &Rows<'_>) -> Parameters {
        let accelerometer = self.request.accelerometer.parameters();
        let gyroscope = (rows.layout.gyroscope > 0).then(|| self.request.gyroscope.parameters());
        let mut parameters = rows
            .layout
            .parameters(&accelerometer, gyroscope.as_ref(), &self.data);
        for (recording, p) in self.start.accelerometer.iter().enumerate() {
            let columns = rows.layout.columns(Sensor::Accelerometer, (recording, 0));
            for (column, value) in columns.into_iter().zip(p) {
                parameters.values_mut()[column] = *value;
            }
        }
        if rows.layout.gyroscope > 0 {
            let mounted = Base {
                t: self.start.axes,
                bias: Vector3::zeros(),
            };
            let columns = rows.layout.columns(Sensor::Gyroscope, (0, 0));
            for (column, value) in columns.into_iter().zip(mounted.parameters()).take(9) {
                parameters.values_mut()[column] = value;
            }
        }
        parameters
    }

    /// Returns the parameters at which the search begins: the first values or those of the fit before, then the
    /// request's start values and held values.
    pub fn begin_at(&self, rows: &Rows<'_>) -> Parameters {
        let mut parameters = self.first_values(rows);
        if let Some(before) = self.request.minimum_before() {
            let plain = rows.layout.disturbance(0);
            let known = before
                .parameters
                .names()
                .iter()
                .zip(before.parameters.values());
            for (name, value) in known {
                if let Some(place) = parameters.index(name).filter(|&place| place < plain) {
                    parameters.values_mut()[place] = *value;
                }
            }
        }
        set(&mut parameters, &self.request.starts);
        set(&mut parameters, &self.request.held);
        parameters
    }

    /// Everything but what the triangular frame holds, and the gyroscope's `T` where nothing turns.
    fn mask(&self, parameters: &Parameters) -> Mask {
        let turns = !self.data.turns.is_empty();
        parameters.free_where(|name| {
            accelerometer::is_free_in_triangular_frame(name)
                && self.request.held.iter().all(|(held, _)| held != name)
                && (turns || !is_of_axes(name))
        })
    }
}

/// Returns true for an element of the gyroscope's `T`.
fn is_of_axes(name: &str) -> bool {
    let part = base_part(name);
    part.is_some_and(|(sensor, part)| sensor == Sensor::Gyroscope && part != BasePart::Bias)
}

fn set(parameters: &mut Parameters, values: &[(String, f64)]) {
    for (name, value) in values {
        if let Some(place) = parameters.index(name) {
            parameters.values_mut()[place] = *value;
        }
    }
}
