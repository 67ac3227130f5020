//! The gyroscope by propagated gravity (Liu et al. 2021, section 2.2).

use faer::Mat;
use findings::{Finding, Kind};
use nalgebra::Vector3;
use recording::Error;
use recording::averages::root_mean_square;
use sensor::{Base, Model, is_bias};
use solver::{Mask, Options, Parameters, Problem, Report, solve};

use super::fitted::Fitted;
use super::gyro_guess::{GyroGuess, gyroscope_guess, perfect_chords};
use super::small_sample::widening;
use crate::kernel::TurnProblem;
use crate::residuals::{
    Integrator, OwnBias, PropagatedGravity, Stacked, StaticMean, StaticRate, TurnData,
};
use crate::truth::RawUnit;

findings::tuning! {
    /// Rounds in which the two kinds of rows are weighted by what the fit before left of them.
    WEIGHT_ROUNDS: usize = 6;

    /// At least this share of the sum of squares counts as the turns' own, however much the accelerometer's errors explain.
    LEAST_OWN_SHARE: f64 = 0.25;
}

/// Independent numbers in the three rows of a turn: a direction has two.
const NUMBERS_PER_TURN: usize = 2;

/// One recording's share of a gyroscope fit, raw units.
#[derive(Clone, Debug, Default)]
pub struct GyroscopeData {
    /// Name of the recording.
    pub name: String,
    /// Its sound turns.
    pub turns: Vec<TurnData>,
    /// The bias in each turn as the rests beside it show it.
    pub turn_bias: Vec<Vector3<f64>>,
    /// Changes of the directions before and after every turn by the errors of the accelerometer, one entry per
    /// independent combination of errors of unit variance; empty where the directions are taken as exact.
    pub moved: Vec<Vec<[Vector3<f64>; 2]>>,
    /// Static means of the gyroscope with the corrected specific force.
    pub statics: Vec<StaticMean>,
}

/// Request for a fit of the gyroscope.
#[derive(Clone, Debug)]
pub struct GyroscopeRequest {
    /// The recordings.
    pub recordings: Vec<GyroscopeData>,
    /// Base model and effects.
    pub model: Model,
    /// Method that integrates the rate.
    pub integrator: Integrator,
}

/// The fit of a gyroscope.
#[derive(Clone, Debug)]
pub struct GyroscopeFit {
    /// Base model and effects.
    pub model: Model,
    /// The parameters in raw units. Without effects the bias is not among the free ones and stands
    /// at zero: it was taken off turn by turn.
    pub fitted: Fitted,
    /// The fit on readings near SI units.
    pub report: Report,
    /// The unit of the readings.
    pub unit: RawUnit,
    /// Misfit of each turn: length of the chord between the two directions, rad.
    pub chords: Vec<f64>,
    /// The same before the fit: unit scales, no misalignment.
    pub chords_before: Vec<f64>,
    /// Contribution of the accelerometer's errors to the sum of squares of the chords, rad², one entry per independent
    /// combination of errors; empty where these are taken as exact or the model has effects.
    pub carried: Vec<f64>,
}

impl GyroscopeFit {
    /// Root mean square of the chords, rad.
    pub fn rms(&self) -> f64 {
        root_mean_square(&self.chords)
    }

    /// Root mean square of the chords before the fit, rad.
    pub fn rms_before(&self) -> f64 {
        root_mean_square(&self.chords_before)
    }
}

/// Fits the nine elements of `T` to the turns, the bias taken from the rests; with effects in the
/// model their parameters and the biases too, to the turns and to the static rates.
///
/// # Errors
/// No sound turn, and what the solver refuses.
pub fn fit_gyroscope(request: &GyroscopeRequest) -> Result<GyroscopeFit, Error> {
    // One copy of all readings, changed in place: a long recording has no room for more.
    let mut turns: Vec<TurnData> = request.recordings.iter().flat_map(without_bias).collect();
    if turns.is_empty() {
        return Err(Error::not_enough(Finding::of(Kind::TURNS_MISSING)));
    }
    let guess = gyroscope_guess(&turns);
    let before = perfect_chords(&turns, guess.unit.scale);
    if request.model.effects().is_empty() {
        for turn in &mut turns {
            let readings = turn.readings.iter_mut();
            readings.for_each(|w| *w = guess.unit.to_si(w));
        }
        published(request, &turns, &guess, before)
    } else {
        drop(turns);
        with_effects(request, &guess, before)
    }
}

/// The parameters with the sensor's axes where the guess has them.
fn mounted(mut parameters: Parameters, guess: &GyroGuess) -> Parameters {
    let base = Base {
        t: guess.axes,
        bias: Vector3::zeros(),
    };
    parameters.values_mut()[..9].copy_from_slice(&base.parameters()[..9]);
    parameters
}

/// The nine elements of `T` alone.
fn published(
    request: &GyroscopeRequest,
    turns: &[TurnData],
    guess: &GyroGuess,
    chords_before: Vec<f64>,
) -> Result<GyroscopeFit, Error> {
    let problem = TurnProblem::new(PropagatedGravity {
        model: &request.model,
        turns,
        integrator: request.integrator,
        sigma: 1.0,
    });
    let unit = guess.unit;
    let start = mounted(request.model.parameters(), guess);
    let mask = start.free_where(|name| !is_bias(name));
    let mut report = solve(&problem, &start, &mask, &Options::default())?;
    let spare = NUMBERS_PER_TURN * turns.len();
    let spare = spare.saturating_sub(report.uncertainty.rank);
    let carried = carried(request, &problem, turns, &report, &mask);
    let own = (2.0 * report.cost - carried.left.iter().sum::<f64>()).max(0.0);
    // A residual that the accelerometer's errors explain still says little of the noise.
    let least = 2.0 * report.cost * LEAST_OWN_SHARE.get();
    let variance = own.max(least) / spare as f64 * widening(spare).powi(2);
    for (row, carried) in report
        .uncertainty
        .covariance
        .iter_mut()
        .zip(&carried.covariance)
    {
        for (v, c) in row.iter_mut().zip(carried) {
            *v = *v * variance + c;
        }
    }
    Ok(GyroscopeFit {
        model: request.model.clone(),
        fitted: Fitted::in_raw_units(&report, &unit, start.len(), 1.0),
        chords: chords(&report.residuals),
        carried: carried.left,
        chords_before,
        report,
        unit,
    })
}

/// Everything free, turns and rests weighted by their own scatter.
fn with_effects(
    request: &GyroscopeRequest,
    guess: &GyroGuess,
    chords_before: Vec<f64>,
) -> Result<GyroscopeFit, Error> {
    let zero = request
        .recordings
        .last()
        .map_or_else(Vector3::zeros, |r| mean_rate(&r.statics));
    let unit = RawUnit { zero, ..guess.unit };
    let near_si: Vec<(Vec<TurnData>, Vec<StaticMean>)> = request
        .recordings
        .iter()
        .map(|r| {
            let turns = r
                .turns
                .iter()
                .map(|turn| map_readings(turn, |w| unit.to_si(w)))
                .collect();
            let statics = unit.means_to_si(&r.statics);
            (turns, statics)
        })
        .collect();
    let shared = request.model.parameter_count();
    let names: Vec<String> = request.recordings.iter().map(|r| r.name.clone()).collect();
    let (mut sigma_turn, mut sigma_rest) = (5e-3, 1e-4);
    let mut problem = turns_and_rests(request, &near_si);
    let mut result = None;
    for _ in 0..WEIGHT_ROUNDS.get() {
        for part in &mut problem.parts {
            part.first.weigh(sigma_turn);
            part.second.sigma = sigma_rest;
        }
        let model = mounted(request.model.parameters(), guess);
        let start = problem.parameters(&model, &names);
        let mask = start.free_where(|_| true);
        let report = solve(&problem, &start, &mask, &Options::default())?;
        let (turns, rests) = split_rows(&near_si, &report.residuals);
        let numbers = turns.len() * NUMBERS_PER_TURN / 3 + rests.len();
        let spare = (numbers as f64 - report.uncertainty.rank as f64).max(1.0) / numbers as f64;
        let scatter = |rows: &[f64], independent: f64| {
            let sum: f64 = rows.iter().map(|r| r * r).sum();
            (sum / (rows.len() as f64 * independent * spare).max(1.0))
                .sqrt()
                .max(1e-9)
        };
        let turn_factor = scatter(&turns, NUMBERS_PER_TURN as f64 / 3.0);
        let rest_factor = scatter(&rests, 1.0);
        let chords = chords(&turns).into_iter().map(|c| c * sigma_turn).collect();
        sigma_turn *= turn_factor;
        sigma_rest *= rest_factor;
        result = Some((report, chords));
    }
    let (report, chords) =
        result.ok_or_else(|| Error::not_converged(Finding::of(Kind::SOLVER_REFUSED)))?;
    Ok(GyroscopeFit {
        model: request.model.clone(),
        fitted: Fitted::in_raw_units(&report, &unit, shared, 1.0),
        report,
        unit,
        chords,
        chords_before,
        carried: Vec::new(),
    })
}

/// Effect of the accelerometer's errors on the gyroscope's fit.
#[derive(Default)]
struct CarriedOver {
    /// Covariance of the free parameters.
    covariance: Vec<Vec<f64>>,
    /// Sum of squares that each combination of errors leaves in the chords after the fit, rad².
    left: Vec<f64>,
}

/// `∂p = −(JᵀJ)⁻¹ Jᵀ ∂r` with `∂r = R ∂u_before − ∂u_after` of every turn: a direction that the accelerometer has wrong
/// is wrong in both turns beside it.
fn carried(
    request: &GyroscopeRequest,
    problem: &TurnProblem<'_>,
    turns: &[TurnData],
    report: &Report,
    mask: &Mask,
) -> CarriedOver {
    let x = report.parameters.values();
    let free = mask.free_indices();
    let moved: Vec<&Vec<[Vector3<f64>; 2]>> =
        request.recordings.iter().flat_map(|r| &r.moved).collect();
    let modes = moved.first().map_or(0, |m| m.len());
    let n = free.len();
    let mut out = CarriedOver {
        covariance: vec![vec![0.0; n]; n],
        left: Vec::new(),
    };
    if moved.len() != turns.len() || modes == 0 {
        return out;
    }
    let mut residuals = Vec::new();
    let jacobian = problem.linearize(x, &free, &mut residuals);
    let mut change = Mat::<f64>::zeros(3 * turns.len(), modes);
    for (k, (turn, moved)) in turns.iter().zip(moved).enumerate() {
        let attitude = turn.attitude(&request.model, request.integrator, x);
        for (mode, [before, after]) in moved.iter().enumerate() {
            let by = attitude.into_body(before) - after;
            for i in 0..3 {
                change[(3 * k + i, mode)] = by[i];
            }
        }
    }
    let right = jacobian.transpose() * &change;
    let inverse = &report.uncertainty.covariance;
    for mode in 0..modes {
        let step: Vec<f64> = inverse
            .iter()
            .map(|row| {
                row.iter()
                    .enumerate()
                    .map(|(k, v)| v * right[(k, mode)])
                    .sum()
            })
            .collect();
        for (row, a) in out.covariance.iter_mut().zip(&step) {
            for (v, b) in row.iter_mut().zip(&step) {
                *v += a * b;
            }
        }
        let taken: f64 = step
            .iter()
            .enumerate()
            .map(|(k, s)| s * right[(k, mode)])
            .sum();
        out.left
            .push((change.col(mode).squared_norm_l2() - taken).max(0.0));
    }
    out
}

/// Turns and rests of all recordings, each with a bias of its own.
fn turns_and_rests<'a>(
    request: &'a GyroscopeRequest,
    near_si: &'a [(Vec<TurnData>, Vec<StaticMean>)],
) -> OwnBias<Stacked<TurnProblem<'a>, StaticRate<'a>>> {
    let part = |(turns, means): &'a (Vec<TurnData>, Vec<StaticMean>)| Stacked {
        first: TurnProblem::new(PropagatedGravity {
            model: &request.model,
            turns,
            integrator: request.integrator,
            sigma: 1.0,
        }),
        second: StaticRate {
            model: &request.model,
            means,
            sigma: 1.0,
        },
    };
    OwnBias {
        parts: near_si.iter().map(part).collect(),
        shared: request.model.parameter_count(),
        own_bias: true,
    }
}

/// The rows of the turns and those of the rests, of all recordings.
fn split_rows(data: &[(Vec<TurnData>, Vec<StaticMean>)], rows: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut turns, mut rests) = (Vec::new(), Vec::new());
    let mut rest = rows;
    for (t, s) in data {
        let (of_turns, after) = rest.split_at(3 * t.len());
        let (of_rests, after) = after.split_at(3 * s.len());
        turns.extend_from_slice(of_turns);
        rests.extend_from_slice(of_rests);
        rest = after;
    }
    (turns, rests)
}

/// The length of each turn's three rows.
fn chords(rows: &[f64]) -> Vec<f64> {
    rows.chunks_exact(3)
        .map(|r| (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt())
        .collect()
}

fn without_bias(data: &GyroscopeData) -> impl Iterator<Item = TurnData> {
    let turns = data.turns.iter().zip(&data.turn_bias);
    turns.map(|(turn, b)| map_readings(turn, |w| w - b))
}

fn map_readings(turn: &TurnData, map: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> TurnData {
    TurnData {
        t: turn.t.clone(),
        readings: turn.readings.iter().map(map).collect(),
        rest: turn.rest.clone(),
        ..*turn
    }
}

fn mean_rate(statics: &[StaticMean]) -> Vector3<f64> {
    statics.iter().map(|m| m.raw).sum::<Vector3<f64>>() / statics.len().max(1) as f64
}
