//! The fit: solve, measure the noise, look for disturbances, solve again.

use faer::Mat;
use nalgebra::Vector3;
use sensor::{Model, Sensor};
use solver::{Mask, Options, Parameters, Problem, Report, Variant, solve};

use super::analysis::Analysis;
use super::chart::Chart;
use super::data::{Cut, Data};
use super::disturbance::{Disturbance, Suspect, pushed_chunk, suspects};
use super::problem::Rows;
use super::start::{Start, charts, start};
use super::weights::{Component, ComponentKind, NoiseLevel, Whitening};
use crate::error::Error;
use crate::intervals::{Segmentation, Span};
use crate::methods::RawUnit;
use crate::recording::Recording;

/// Rounds of weighting at most; two suffice where nothing was disturbed.
const ROUNDS: usize = 6;

/// Levels of noise that change by less than this share are settled.
const SETTLED: f64 = 0.02;

/// More disturbances than this share of the rests, and the noise is at fault, not the rests.
const MOST_DISTURBED: f64 = 0.2;

/// What to fit.
#[derive(Clone, Debug)]
pub struct JointRequest<'a> {
    /// The recordings with their rests and turns.
    pub recordings: Vec<(&'a Recording, &'a Segmentation)>,
    /// The accelerometer: base model and effects.
    pub accelerometer: Model,
    /// The gyroscope: base model and effects.
    pub gyroscope: Model,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// Random walk densities of the biases of accelerometer (m/s²/√s) and gyroscope (rad/s/√s), where
    /// they are known; estimated where not.
    pub walk: Option<[f64; 2]>,
    /// Whether rests and turns that something disturbed are looked for and get parameters of their own, and
    /// whether rests and turns may scatter beyond all noise. Without, the noise is white noise and walks, and
    /// every row is believed.
    pub disturbances: bool,
    /// What is known to be disturbed, by its place in the data: parameters of their own whatever is looked for.
    pub known: Vec<Known>,
    /// Parameters held at a value, by name.
    pub held: Vec<(String, f64)>,
    /// Whether what effects ask for is worked out at the samples of turns even where no effect of the
    /// models asks for it: time, temperature, specific force, angular acceleration.
    pub covariates: bool,
}

impl<'a> JointRequest<'a> {
    /// Base models, walks estimated, disturbances looked for.
    pub fn new(recordings: Vec<(&'a Recording, &'a Segmentation)>, gravity: f64) -> Self {
        Self {
            recordings,
            accelerometer: accelerometer::model(),
            gyroscope: gyroscope::model(),
            gravity,
            walk: None,
            disturbances: true,
            known: Vec::new(),
            held: Vec::new(),
            covariates: false,
        }
    }
}

/// Something that is known to be disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Known {
    /// What happened.
    pub kind: Disturbance,
    /// The rest, the chunk or the turn, by its place in [`Data`].
    pub place: usize,
}

/// Something that was found disturbed and has parameters of its own since.
#[derive(Clone, Debug, PartialEq)]
pub struct Accused {
    /// What happened.
    pub kind: Disturbance,
    /// Place of the recording.
    pub recording: usize,
    /// Static interval (or the one before the turn), counted from 0.
    pub interval: usize,
    /// When.
    pub span: Span,
    /// In words.
    pub detail: String,
}

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
    /// How many parameters come before the directions.
    pub shared: usize,
    /// First row of the gyroscope's means, first row of the turns.
    pub first_rows: [usize; 2],
    /// Rest of each row (a turn's: the one before it).
    pub rest_of_row: Vec<usize>,
    /// Residuals at the minimum, whitened by everything (`m`).
    pub residuals: Vec<f64>,
    /// Jacobian there (`m × n`), whitened by everything.
    pub jacobian: Mat<f64>,
    /// Residuals whitened by white noise alone.
    pub white_residuals: Vec<f64>,
    /// Jacobian whitened by white noise alone.
    pub white_jacobian: Mat<f64>,
    /// The whitening: by white noise, then by everything else.
    pub whitening: Whitening,
    /// `∂r/∂d` of what was found disturbed, one column per parameter, not whitened (`m` each).
    pub disturbance_columns: Vec<Vec<f64>>,
    /// What the noise may have besides, whitened by white noise: `Ca`, `Cg` …
    pub components: Vec<Component>,
    /// How much of it there is.
    pub levels: Vec<NoiseLevel>,
    /// What was found disturbed.
    pub accused: Vec<Accused>,
    /// Whether the accelerometer has a bias of its own in every recording.
    pub own_force_bias: bool,
    /// Unit of the accelerometer.
    pub force_unit: RawUnit,
    /// Unit of the gyroscope.
    pub rate_unit: RawUnit,
    /// Local gravity, m/s².
    pub gravity: f64,
    /// The solver's last report.
    pub report: Report,
    /// Turns' misses before any fit (unit scales), rad.
    pub chords_before: Vec<f64>,
    /// Turns' misses, rad.
    pub chords: Vec<f64>,
    /// `|f| − g` of every rest, m/s².
    pub moduli: Vec<f64>,
}

/// Rows under a whitening, for the solver.
struct Weighted<'a> {
    rows: &'a Rows<'a>,
    whitening: &'a Whitening,
}

impl Problem for Weighted<'_> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        self.whitened(&self.rows.linearize(x).residuals, out);
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        let linear = self.rows.linearize(x);
        self.whitened(&linear.residuals, residuals);
        let mut jacobian = Mat::from_fn(residuals.len(), free.len(), |i, k| {
            linear.jacobian[(i, free[k])]
        });
        self.whitening.apply(jacobian.as_mut());
        jacobian
    }

    fn second_derivative(&self, _: &[f64], _: &[f64], _: &mut Vec<f64>) -> bool {
        false
    }
}

impl Weighted<'_> {
    fn whitened(&self, r: &[f64], out: &mut Vec<f64>) {
        let mut column = Mat::from_fn(r.len(), 1, |i, _| r[i]);
        self.whitening.apply(column.as_mut());
        out.clear();
        out.extend(column.col(0).iter());
    }
}

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
    if request.covariates || !request.gyroscope.effects().is_empty() {
        for (k, p) in start.accelerometer.iter().enumerate() {
            data.know_turns(k, &cuts[k], &request.accelerometer, p);
        }
    }
    let charts = charts(&data, &request.accelerometer, &start)?;
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

/// A solution under given weights and disturbances.
struct Solution {
    report: Report,
    free: Vec<usize>,
    analysis: Analysis,
    whitening: Whitening,
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

    fn run(&self) -> Result<JointFit, Error> {
        let mut solution = self.solve(&[], &[], None)?;
        let (mut levels, mut accused): (Vec<NoiseLevel>, Vec<Suspect>) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            let (new_levels, new_accused) = self.judge(&solution, &accused)?;
            let same = settled(&levels, &new_levels) && same_suspects(&accused, &new_accused);
            (levels, accused) = (new_levels, new_accused);
            if same {
                break;
            }
            solution = self.solve(&levels, &accused, Some(&solution))?;
        }
        Ok(self.finish(solution, levels, &accused))
    }

    /// One solve under these weights.
    fn solve(
        &self,
        levels: &[NoiseLevel],
        accused: &[Suspect],
        before: Option<&Solution>,
    ) -> Result<Solution, Error> {
        let columns: Vec<Vec<f64>> = accused.iter().flat_map(|s| s.columns.clone()).collect();
        let rows = self.rows(&columns);
        let mut parameters = self.first_values(&rows);
        if let Some(before) = before {
            let n = rows.layout.disturbance(0);
            parameters.values_mut()[..n].copy_from_slice(&before.report.parameters.values()[..n]);
        }
        for (name, value) in &self.request.held {
            if let Some(place) = parameters.index(name) {
                parameters.values_mut()[place] = *value;
            }
        }
        let mask = self.mask(&rows, &parameters);
        let free = mask.free_indices();
        let whitening = {
            let mut analysis = self.analysis(&rows, parameters.values(), &free);
            if !levels.is_empty() {
                analysis.allow_all_scatter(&rows);
            }
            analysis.whitening(levels)
        };
        let weighted = Weighted {
            rows: &rows,
            whitening: &whitening,
        };
        let options = Options {
            variant: Variant::GaussNewton,
            ..Options::default()
        };
        let report = solve(&weighted, &parameters, &mask, &options)?;
        let analysis = self.analysis(&rows, report.parameters.values(), &free);
        Ok(Solution {
            report,
            free,
            analysis,
            whitening,
        })
    }

    fn analysis(&self, rows: &Rows<'_>, x: &[f64], free: &[usize]) -> Analysis {
        Analysis::new(rows, &rows.linearize(x), &rows.noise(x), free)
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
    fn mask(&self, _: &Rows<'_>, parameters: &Parameters) -> Mask {
        let turns = !self.data.turns.is_empty();
        parameters.free_where(|name| {
            accelerometer::is_free_in_triangular_frame(name)
                && self.request.held.iter().all(|(held, _)| held != name)
                && (turns || !(name.starts_with("gyro.s_") || name.starts_with("gyro.beta_")))
        })
    }

    /// Levels of noise and disturbances at a solution.
    fn judge(
        &self,
        solution: &Solution,
        accused: &[Suspect],
    ) -> Result<(Vec<NoiseLevel>, Vec<Suspect>), Error> {
        let n = accused.iter().map(|s| s.columns.len()).sum::<usize>();
        let free = &solution.free[..solution.free.len() - n];
        let x = solution.report.parameters.values();
        let rows = self.rows(&[]);
        let mut analysis = self.analysis(&rows, &x[..x.len() - n], free);
        let measured = |analysis: &Analysis, known: &[&Suspect]| match self.request.walk {
            Some(walk) => given_levels(walk),
            None => analysis.levels(known),
        };
        if !self.request.disturbances {
            let known: Vec<Suspect> = suspects(&rows, &x[..x.len() - n])
                .into_iter()
                .filter(|s| {
                    let found = |k: &Known| k.kind == s.kind && k.place == s.place;
                    self.request.known.iter().any(found)
                })
                .collect();
            let levels = measured(&analysis, &known.iter().collect::<Vec<_>>());
            return Ok((levels, known));
        }
        let mut candidates = suspects(&rows, &x[..x.len() - n]);
        let touched = self.touched(&rows, &x[..x.len() - n]);
        let given: Vec<usize> = (candidates.len()..candidates.len() + touched.len()).collect();
        candidates.extend(touched);
        let most = given.len() + (MOST_DISTURBED * self.data.rests.len() as f64).ceil() as usize;
        let all = |places: &[usize]| places.iter().map(|&k| &candidates[k]).collect::<Vec<_>>();
        let known = all(&given);
        let misfit = analysis.allow_scatter_where_misfit(&rows, &known);
        let mut found = given.clone();
        if !misfit {
            found = analysis
                .accuse(&candidates, &given, &[], most)
                .unwrap_or(given.clone());
        }
        let mut levels = measured(&analysis, &all(&found));
        for _ in 0..3 {
            let doubtful: Vec<usize> = found
                .iter()
                .copied()
                .filter(|k| !given.contains(k))
                .collect();
            let confirmed = analysis.confirm(&candidates, &found, &doubtful, &levels);
            let mut kept = given.clone();
            kept.extend(confirmed);
            let next = analysis
                .accuse(&candidates, &kept, &levels, most)
                .unwrap_or(kept);
            if next == found {
                break;
            }
            found = next;
            levels = measured(&analysis, &all(&found));
        }
        found.sort_unstable();
        let found = found.iter().map(|&k| candidates[k].clone()).collect();
        Ok((levels, found))
    }

    /// The chunks that were seen to shake: their force may be off and the device may have moved.
    fn touched(&self, rows: &Rows<'_>, x: &[f64]) -> Vec<Suspect> {
        self.data
            .shaken
            .iter()
            .filter_map(|(chunk, shake)| pushed_chunk(rows, x, *chunk, shake))
            .collect()
    }

    fn finish(&self, solution: Solution, levels: Vec<NoiseLevel>, accused: &[Suspect]) -> JointFit {
        let columns: Vec<Vec<f64>> = accused.iter().flat_map(|s| s.columns.clone()).collect();
        let rows = self.rows(&columns);
        let x = solution.report.parameters.values();
        let mut jacobian = solution.analysis.jacobian.clone();
        solution.whitening.finish(jacobian.as_mut());
        let residuals = solution.report.residuals.clone();
        let (chords, moduli) = (rows.chords(x), rows.moduli(x));
        let chords_before = rows.chords(self.first_values(&rows).values());
        JointFit {
            models: [
                self.request.accelerometer.clone(),
                self.request.gyroscope.clone(),
            ],
            parameters: solution.report.parameters.clone(),
            shared: rows.layout.shared(),
            first_rows: [rows.first_rate_row(), rows.first_turn_row()],
            rest_of_row: rows.rest_of_row(),
            disturbance_columns: columns.clone(),
            residuals,
            jacobian,
            whitening: solution.whitening,
            white_residuals: solution.analysis.residuals,
            white_jacobian: solution.analysis.jacobian,
            components: solution.analysis.components,
            levels,
            accused: accused
                .iter()
                .map(|s| self.in_words(s))
                .chain(self.broken())
                .collect(),
            own_force_bias: self.start.own_force_bias,
            force_unit: self.start.force_unit,
            rate_unit: self.start.rate_unit,
            gravity: self.request.gravity,
            chords_before,
            chords,
            moduli,
            data: self.data.clone(),
            charts: self.charts.to_vec(),
            free: solution.free,
            report: solution.report,
        }
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

fn given_levels([force, rate]: [f64; 2]) -> Vec<NoiseLevel> {
    [
        (ComponentKind::AccelerometerWalk, force),
        (ComponentKind::GyroscopeWalk, rate),
    ]
    .map(|(kind, size)| NoiseLevel { kind, size })
    .to_vec()
}

impl JointFit {
    /// The rows that were fitted, to be evaluated anywhere.
    pub fn rows(&self) -> Rows<'_> {
        Rows::new(
            &self.data,
            (&self.models[0], &self.models[1]),
            self.gravity,
            &self.charts,
            (self.own_force_bias, &self.disturbance_columns),
        )
    }

    /// The same without the columns of what was disturbed.
    pub fn plain_rows(&self) -> Rows<'_> {
        Rows::new(
            &self.data,
            (&self.models[0], &self.models[1]),
            self.gravity,
            &self.charts,
            (self.own_force_bias, &[]),
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

fn settled(before: &[NoiseLevel], after: &[NoiseLevel]) -> bool {
    before.len() == after.len()
        && before.iter().zip(after).all(|(a, b)| {
            a.kind == b.kind && (a.size - b.size).abs() <= SETTLED * a.size.max(b.size)
        })
}

fn same_suspects(before: &[Suspect], after: &[Suspect]) -> bool {
    before.len() == after.len()
        && before
            .iter()
            .zip(after)
            .all(|(a, b)| a.kind == b.kind && a.place == b.place)
}
