//! Fit, measure the noise, look for disturbances, fit again.

use faer::Mat;
use sensor::Sensor;
use solver::{Mask, Options, Parameters, Termination, Variant, solve};

use super::analysis::{Analysis, walks};
use super::approach::{Weighted, approach};
use super::centred::centred;
use super::chart::Chart;
use super::data::{Cut, Data, MOST_DISTURBED};
use super::disturbance::{Disturbance, Suspect, pushed_chunk, suspects};
use super::fit::JointFit;
use super::knowledge::Attitudes;
use super::marginal::orthonormal;
use super::problem::{Linear, Rows};
use super::request::{Accused, JointRequest, Known};
use super::start::{Start, charts, start};
use super::weights::{Component, NoiseLevel, White, Whitening};
use crate::error::Error;

/// Rounds of weighting at most; one suffices where nothing was disturbed.
const ROUNDS: usize = 6;

/// Bends of the rows between two points below this, in standard deviations, change no judgement: all
/// that is judged is what the Jacobian's columns leave, and that is the same at both.
const STRAIGHT: f64 = 0.2;

/// A minimum nearer than this, in standard errors, is reached.
const NEAR: f64 = 0.01;

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
        })
        .collect();
    let mut data = Data::default();
    for cut in &cuts {
        data.add(cut);
    }
    let covariates = request.covariates || !request.gyroscope.effects().is_empty();
    if covariates {
        for (k, p) in start.accelerometer.iter().enumerate() {
            data.know_turns(k, &cuts[k], &request.accelerometer, p);
        }
    }
    let charts = charts(&data, &request.accelerometer, &start)?;
    if covariates {
        let first = Run {
            request,
            data: &data,
            charts: &charts,
            start: &start,
        };
        let attitudes = first.attitudes()?;
        data.know_attitudes(&attitudes);
    }
    Run {
        request,
        data: &data,
        charts: &charts,
        start: &start,
    }
    .run()
}

/// What stays the same over all rounds.
struct Run<'a> {
    request: &'a JointRequest<'a>,
    data: &'a Data,
    charts: &'a [Chart],
    start: &'a Start,
}

/// How rows are believed.
struct Weights {
    levels: Vec<NoiseLevel>,
    accused: Vec<Suspect>,
    components: Vec<Component>,
    whitening: Whitening,
}

impl Weights {
    fn columns(&self) -> Vec<Vec<f64>> {
        let of = |s: &Suspect| s.columns.clone();
        self.accused.iter().flat_map(of).collect()
    }
}

/// The minimum under some weights.
struct Point {
    parameters: Parameters,
    mask: Mask,
    linear: Linear,
    /// Number of parameters before those of disturbances.
    plain: usize,
}

impl Point {
    /// The rows as they would be without the disturbances.
    fn undisturbed(&self) -> Linear {
        self.linear
            .without_disturbances(self.parameters.values(), self.plain)
    }

    /// The parameters before those of disturbances.
    fn plain_values(&self) -> &[f64] {
        &self.parameters.values()[..self.plain]
    }
}

impl Run<'_> {
    fn rows<'b>(&'b self, disturbances: &'b [Vec<f64>]) -> Rows<'b> {
        let models = (&self.request.accelerometer, &self.request.gyroscope);
        Rows::new(
            self.data,
            models,
            self.request.gravity,
            self.charts,
            (self.start.own_force_bias, disturbances),
        )
    }

    /// The attitudes by a first fit: they matter in second order only.
    fn attitudes(&self) -> Result<Attitudes, Error> {
        let point = self.approach(&self.first_weights(), None)?;
        Ok(self.rows(&[]).attitudes(point.parameters.values()))
    }

    fn run(&self) -> Result<JointFit, Error> {
        let mut weights = self.first_weights();
        let mut point = self.approach(&weights, None)?;
        for _ in 0..ROUNDS {
            weights = self.judge(&point);
            let next = self.approach(&weights, Some(&point))?;
            let bend = self.bend(&point, &next, &weights.whitening);
            point = next;
            if bend < STRAIGHT {
                break;
            }
        }
        self.finish(&point, weights)
    }

    /// White noise at the start, and the walks where they are given.
    fn first_weights(&self) -> Weights {
        let rows = self.rows(&[]);
        let parameters = self.first_values(&rows);
        let x = parameters.values();
        let noise = rows.noise(x);
        let white = White::new(&noise, rows.first_turn_row());
        let components = walks(&noise, &white);
        let levels = self.request.walk.map(NoiseLevel::walks).unwrap_or_default();
        Weights {
            whitening: Whitening::new(white, &components, &levels),
            components,
            levels,
            accused: Vec::new(),
        }
    }

    /// The minimum under these weights: by plain Gauss–Newton steps, and by the solver where those do not
    /// lead there.
    fn approach(&self, weights: &Weights, before: Option<&Point>) -> Result<Point, Error> {
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
                parameters = solve(&weighted, &parameters, &mask, &options())?.parameters;
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

    fn first_values(&self, rows: &Rows<'_>) -> Parameters {
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

    /// Levels of noise and disturbances at a point.
    fn judge(&self, point: &Point) -> Weights {
        let rows = self.rows(&[]);
        let x = point.plain_values();
        let mut free = point.mask.free_indices();
        free.retain(|&k| k < point.plain);
        let mut analysis = Analysis::new(&rows, &point.undisturbed(), &rows.noise(x), &free);
        let (levels, accused) = if self.request.disturbances {
            self.accuse(&rows, x, &mut analysis)
        } else {
            let known = self.known(&rows, x);
            let levels = self.measured(&analysis, &known.iter().collect::<Vec<_>>());
            (levels, known)
        };
        Weights {
            whitening: analysis.whitening(&levels),
            components: analysis.components,
            levels,
            accused,
        }
    }

    fn measured(&self, analysis: &Analysis, known: &[&Suspect]) -> Vec<NoiseLevel> {
        match self.request.walk {
            Some(walk) => NoiseLevel::walks(walk),
            None => analysis.levels(known, self.request.biases_walk),
        }
    }

    /// What the request knows to be disturbed.
    fn known(&self, rows: &Rows<'_>, x: &[f64]) -> Vec<Suspect> {
        if self.request.known.is_empty() {
            return Vec::new();
        }
        let is_known = |s: &Suspect| {
            let same = |k: &Known| k.kind == s.kind && k.place == s.place;
            self.request.known.iter().any(same)
        };
        suspects(rows, x).into_iter().filter(is_known).collect()
    }

    /// Levels of noise and disturbances: what was seen to shake, then what the rows accuse.
    fn accuse(
        &self,
        rows: &Rows<'_>,
        x: &[f64],
        analysis: &mut Analysis,
    ) -> (Vec<NoiseLevel>, Vec<Suspect>) {
        let mut candidates = suspects(rows, x);
        let touched = self.touched(rows, x);
        let given: Vec<usize> = (candidates.len()..candidates.len() + touched.len()).collect();
        candidates.extend(touched);
        let most = given.len() + (MOST_DISTURBED * self.data.rests.len() as f64).ceil() as usize;
        let all = |places: &[usize]| places.iter().map(|&k| &candidates[k]).collect::<Vec<_>>();
        let misfit = analysis.allow_scatter_where_misfit(rows, &all(&given));
        let columns = analysis.columns(&candidates);
        let mut found = given.clone();
        if !misfit {
            let trial = analysis.trial(&candidates, &columns, &[]);
            found = trial.accuse(&given, most).unwrap_or(given.clone());
        }
        let mut levels = self.measured(analysis, &all(&found));
        for _ in 0..3 {
            let trial = analysis.trial(&candidates, &columns, &levels);
            let mut doubtful = found.clone();
            doubtful.retain(|k| !given.contains(k));
            let mut kept = given.clone();
            kept.extend(trial.confirm(&found, &doubtful));
            let next = trial.accuse(&kept, most).unwrap_or(kept);
            if next == found {
                break;
            }
            found = next;
            levels = self.measured(analysis, &all(&found));
        }
        found.sort_unstable();
        let found = found.iter().map(|&k| candidates[k].clone()).collect();
        (levels, found)
    }

    /// The chunks that were seen to shake: their force may be off and the device may have moved. None where
    /// shaking is how the recording is: the rows are believed by their own noise then.
    fn touched(&self, rows: &Rows<'_>, x: &[f64]) -> Vec<Suspect> {
        if self.data.shakes_throughout().is_some() {
            return Vec::new();
        }
        self.data
            .shaken
            .iter()
            .filter_map(|(chunk, shake)| pushed_chunk(rows, x, *chunk, shake))
            .collect()
    }

    /// The same weights for biases that are means over the rests.
    fn about_the_means(&self, point: &Point, weights: Weights) -> Weights {
        let rows = self.rows(&[]);
        let white = &weights.whitening.white;
        let noise = rows.noise(point.plain_values());
        let components = centred(&rows, &noise, white, &weights.components);
        Weights {
            whitening: Whitening::new(white.clone(), &components, &weights.levels),
            components,
            ..weights
        }
    }

    /// The last steps, to what double precision allows.
    fn finish(&self, point: &Point, weights: Weights) -> Result<JointFit, Error> {
        let weights = self.about_the_means(point, weights);
        let columns = weights.columns();
        let rows = self.rows(&columns);
        let weighted = Weighted {
            rows: &rows,
            whitening: &weights.whitening,
        };
        let free = point.mask.free_indices();
        let mut parameters = point.parameters.clone();
        if let Some(near) = approach(&weighted, parameters.values(), &free) {
            let x = near.settled(&weighted, &free);
            parameters.values_mut().copy_from_slice(&x);
        }
        let mut report = solve(&weighted, &parameters, &point.mask, &options())?;
        let x = report.parameters.values();
        let linear = rows.linearize(x);
        let white = &weights.whitening.white;
        let (white_residuals, white_jacobian) = linear.whitened(&free, |a| white.apply(a));
        let mut jacobian = white_jacobian.clone();
        weights.whitening.finish(jacobian.as_mut());
        if report.termination == Termination::Stalled && is_near(&report.residuals, &jacobian) {
            report.termination = Termination::Cost;
        }
        let broken = self.broken();
        Ok(JointFit {
            models: [
                self.request.accelerometer.clone(),
                self.request.gyroscope.clone(),
            ],
            parameters: report.parameters.clone(),
            shared: rows.layout.shared(),
            first_rows: [rows.first_rate_row(), rows.first_turn_row()],
            rest_of_row: rows.rest_of_row(),
            residuals: report.residuals.clone(),
            jacobian,
            white_residuals,
            white_jacobian,
            accused: weights
                .accused
                .iter()
                .map(|s| self.in_words(s))
                .chain(broken)
                .collect(),
            own_force_bias: self.start.own_force_bias,
            force_unit: self.start.force_unit,
            rate_unit: self.start.rate_unit,
            gravity: self.request.gravity,
            chords_before: rows.chords(self.first_values(&rows).values()),
            chords: rows.chords(x),
            moduli: rows.moduli(x),
            data: self.data.clone(),
            charts: self.charts.to_vec(),
            disturbance_columns: columns.clone(),
            whitening: weights.whitening,
            components: weights.components,
            levels: weights.levels,
            free,
            report,
        })
    }

    /// The touches that broke rests: nothing of them is in the means, and the turn carries on.
    fn broken(&self) -> impl Iterator<Item = Accused> + '_ {
        self.data
            .broken
            .iter()
            .map(|&(recording, interval, span)| Accused {
                kind: Disturbance::DisturbedInterval,
                recording,
                interval,
                span,
                detail:
                    "it broke a rest: what remains of it beyond the touch counts as part of a turn"
                        .into(),
            })
    }

    fn in_words(&self, suspect: &Suspect) -> Accused {
        let (recording, interval, span) = match suspect.kind {
            Disturbance::BadTurn => {
                let turn = &self.data.turns[suspect.place];
                (turn.recording, turn.turn, turn.span)
            }
            Disturbance::MountSlip => {
                let rest = &self.data.rests[suspect.place];
                (rest.recording, rest.interval, rest.span)
            }
            Disturbance::DisturbedInterval => {
                let chunk = &self.data.chunks[suspect.place];
                let rest = &self.data.rests[chunk.rest];
                let span = chunk.accelerometer.map_or(rest.span, |m| m.span);
                (rest.recording, rest.interval, span)
            }
        };
        Accused {
            kind: suspect.kind,
            recording,
            interval,
            span,
            detail: suspect.detail.clone(),
        }
    }
}

fn set(parameters: &mut Parameters, values: &[(String, f64)]) {
    for (name, value) in values {
        if let Some(place) = parameters.index(name) {
            parameters.values_mut()[place] = *value;
        }
    }
}

fn options() -> Options {
    Options {
        variant: Variant::GaussNewton,
        ..Options::default()
    }
}

/// Whether the minimum is nearer than a hundredth of the standard errors: of whitened residuals, what the
/// Jacobian's columns still explain is below that share of what chance makes of them (Bates & Watts 1981). A
/// combination that is hardly observable can keep rounding from letting the cost fall further.
fn is_near(residuals: &[f64], jacobian: &Mat<f64>) -> bool {
    let basis = orthonormal(jacobian);
    let r = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
    (basis.transpose() * r).squared_norm_l2() < NEAR.powi(2) * basis.ncols() as f64
}
