//! Fit, measure the noise, look for disturbances, fit again.

use faer::Mat;
use sensor::{AnyEffect, Quantity, Sensor};
use solver::{Mask, Options, Parameters, Variant, solve};

use super::approach::{Weighted, approach};
use super::chart::Chart;
use super::clock_fit::settle_clock;
use super::data::{Cut, Data};
use super::fit::JointFit;
use super::judgement::Weights;
use super::knowledge::by_models;
use super::problem::{Linear, Rows};
use super::request::JointRequest;
use super::start::{Start, charts, start};
use super::weights::Whitening;
use crate::error::Error;
use crate::watch::{Stage, step};

/// Rounds of weighting at most; one suffices where nothing was disturbed.
const ROUNDS: usize = 6;

/// Bends of the rows between two points below this, in standard deviations, change no judgement: all
/// that is judged is what the Jacobian's columns leave, and that is the same at both.
const STRAIGHT: f64 = 0.2;

/// Fits everything at once.
///
/// # Errors
/// Means that lie on no sphere, rests without a direction, and what the solver refuses.
pub fn fit_joint(request: &JointRequest<'_>) -> Result<JointFit, Error> {
    let start = start(request)?;
    let cuts: Vec<Cut<'_>> = request
        .recordings
        .iter()
        .map(|(recording, segmentation)| Cut {
            recording,
            segmentation,
            force_unit: &start.force_unit,
            rate_unit: &start.rate_unit,
            clock: request.clock,
        })
        .collect();
    let mut data = Data::default();
    for cut in &cuts {
        data.add(cut);
    }
    let look = |effect: &&'static dyn AnyEffect| {
        let needs = effect.needs();
        needs.contains(&Quantity::LastChange) || needs.contains(&Quantity::Vibration)
    };
    let covariates = request.covariates
        || !request.gyroscope.effects().is_empty()
        || request.accelerometer.effects().iter().any(look);
    for k in data.with_scatter() {
        data.set_clock(k, 0, 0.0);
    }
    let charts = charts(&data, &request.accelerometer, &start)?;
    let known = |data: &mut Data| know(request, data, &cuts, &charts, &start);
    if covariates {
        known(&mut data)?;
    }
    let point = settle_clock(request, &mut data, &charts, &start)?;
    // What effects ask for is asked for at the samples' times.
    if covariates && point.is_some() {
        known(&mut data)?;
    }
    Run {
        request,
        data: &data,
        charts: &charts,
        start: &start,
    }
    .run(point)
}

/// Works out what effects look at: by the models at first, then by those of a first fit.
fn know(
    request: &JointRequest<'_>,
    data: &mut Data,
    cuts: &[Cut<'_>],
    charts: &[Chart],
    start: &Start,
) -> Result<(), Error> {
    let perfect = request.gyroscope.parameters();
    let first = start.accelerometer.iter();
    let first = first.map(|p| (p.clone(), perfect.values().to_vec()));
    write_down(request, data, cuts, &first.collect::<Vec<_>>());
    let run = Run {
        request,
        data,
        charts,
        start,
    };
    let fitted = run.first_models()?;
    write_down(request, data, cuts, &fitted);
    Ok(())
}

/// Parameters of the accelerometer and the gyroscope in each recording.
type ByRecording = Vec<(Vec<f64>, Vec<f64>)>;

fn write_down(request: &JointRequest<'_>, data: &mut Data, cuts: &[Cut<'_>], models: &ByRecording) {
    for (k, (cut, (force, rate))) in cuts.iter().zip(models).enumerate() {
        let (force, rate) = (
            (&request.accelerometer, force.as_slice()),
            (&request.gyroscope, rate.as_slice()),
        );
        let truth = by_models(cut, force, rate);
        data.know(k, &truth, cut.recording.start());
    }
}

/// What stays the same over all rounds.
pub(super) struct Run<'a> {
    /// What is asked.
    pub request: &'a JointRequest<'a>,
    /// Means of the rests and turns.
    pub data: &'a Data,
    /// Coordinates of the direction in each rest.
    pub charts: &'a [Chart],
    /// First values.
    pub start: &'a Start,
}

/// The minimum under some weights.
#[derive(Clone)]
pub(super) struct Point {
    /// Where it is.
    pub parameters: Parameters,
    /// What is free.
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
    pub fn rows<'b>(&'b self, disturbances: &'b [Vec<f64>]) -> Rows<'b> {
        let models = (&self.request.accelerometer, &self.request.gyroscope);
        Rows::new(
            self.data,
            models,
            self.request.gravity,
            self.charts,
            (self.start.own_force_bias, disturbances),
        )
    }

    /// The models by a first fit: what effects look at depends on them in second order only.
    fn first_models(&self) -> Result<ByRecording, Error> {
        let point = self.approach(&self.first_weights(), None)?;
        let (rows, x) = (self.rows(&[]), point.parameters.values());
        let perfect = self.request.gyroscope.parameters();
        let of = |k: usize| {
            let rate = match rows.layout.gyroscope {
                0 => perfect.values().to_vec(),
                _ => rows.local(x, Sensor::Gyroscope, k),
            };
            (rows.local(x, Sensor::Accelerometer, k), rate)
        };
        Ok((0..self.data.sources.len()).map(of).collect())
    }

    fn run(&self, before: Option<Point>) -> Result<JointFit, Error> {
        let mut weights = match &before {
            Some(point) => self.weights_at(point.plain_values()),
            None => self.first_weights(),
        };
        let mut point = self.approach(&weights, before.as_ref())?;
        let earth = self.request.earth.then(|| {
            let rows = self.rows(&[]);
            rows.earth_columns(point.plain_values())
        });
        for _ in 0..ROUNDS {
            weights = self.judge(&point, earth.as_ref());
            let next = self.approach(&weights, Some(&point))?;
            let bend = self.bend(&point, &next, &weights.whitening);
            point = next;
            // Readings that no model fits are not judged over and over.
            let spent = self.start.steps.are_spent(self.data.cost_of_a_step());
            if bend < STRAIGHT || spent {
                break;
            }
        }
        self.finish(&point, weights)
    }

    /// The minimum under these weights: by plain Gauss–Newton steps, and by the solver where those do not
    /// lead there.
    pub fn approach(&self, weights: &Weights, before: Option<&Point>) -> Result<Point, Error> {
        step(Stage::Fitting)?;
        let columns = weights.columns();
        let rows = self.rows(&columns);
        let mut parameters = self.first_values(&rows);
        let plain = rows.layout.disturbance(0);
        set(&mut parameters, &self.request.starts);
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
                parameters.values_mut().copy_from_slice(&near.x);
                near.linear
            }
            None => {
                let steps = &self.start.steps;
                let options = options(steps.on_the_way(self.data.cost_of_a_step()));
                let report = solve(&weighted, &parameters, &mask, &options)?;
                steps.took(report.jacobian_evaluations);
                parameters = report.parameters;
                rows.linearize(parameters.values())
            }
        };
        Ok(Point {
            parameters,
            mask,
            linear,
            plain,
        })
    }

    /// How far the rows at `next` are from where the Jacobian at `point` has them, in standard deviations
    /// of white noise (root of the sum of squares).
    fn bend(&self, point: &Point, next: &Point, whitening: &Whitening) -> f64 {
        let (a, b) = (point.undisturbed(), next.undisturbed());
        let m = a.residuals.len();
        let step = Mat::from_fn(point.plain, 1, |k, _| {
            next.plain_values()[k] - point.plain_values()[k]
        });
        let foretold = &a.jacobian * &step;
        let mut bend = Mat::from_fn(m, 1, |i, _| {
            b.residuals[i] - a.residuals[i] - foretold[(i, 0)]
        });
        whitening.white.apply(bend.as_mut());
        bend.norm_l2()
    }

    /// The parameters at the start.
    pub fn first_values(&self, rows: &Rows<'_>) -> Parameters {
        let accelerometer = self.request.accelerometer.parameters();
        let gyroscope = (rows.layout.gyroscope > 0).then(|| self.request.gyroscope.parameters());
        let mut parameters = rows
            .layout
            .parameters(&accelerometer, gyroscope.as_ref(), self.data);
        for (recording, p) in self.start.accelerometer.iter().enumerate() {
            let columns = rows.layout.columns(Sensor::Accelerometer, recording);
            for (column, value) in columns.into_iter().zip(p) {
                parameters.values_mut()[column] = *value;
            }
        }
        parameters
    }

    /// Everything but what the triangular frame holds, and the gyroscope's `T` where nothing turns.
    fn mask(&self, parameters: &Parameters) -> Mask {
        let turns = !self.data.turns.is_empty();
        parameters.free_where(|name| {
            accelerometer::is_free_in_triangular_frame(name)
                && self.request.held.iter().all(|(held, _)| held != name)
                && (turns || !(name.starts_with("gyro.s_") || name.starts_with("gyro.beta_")))
        })
    }
}

fn set(parameters: &mut Parameters, values: &[(String, f64)]) {
    for (name, value) in values {
        if let Some(place) = parameters.index(name) {
            parameters.values_mut()[place] = *value;
        }
    }
}

/// Of the solver, near the minimum.
pub(super) fn options(most_steps: usize) -> Options {
    Options {
        variant: Variant::GaussNewton,
        max_iterations: most_steps,
        ..Options::default()
    }
}
