//! The fit: start, unevenness, disturbed placements, covariance.

use nalgebra::DMatrix;
use sensor::Model;
use solver::{Block, Products};

use super::disturbed::{most_disturbed, readings_left};
use super::placement::{HeadingChange, Placement};
use super::problem::{Minimum, Problem};
use super::start::linear_start;
use super::unevenness::unevenness;
use crate::error::Error;
use crate::methods::small_sample::{by_chance, widening};

/// Fewer static intervals say too little: thirteen unknowns, a heading each, and something spare.
const LEAST_PLACEMENTS: usize = 6;

/// At most one placement in so many is left out as disturbed.
const DISTURBED_SHARE: usize = 5;

/// What to fit.
#[derive(Debug)]
pub struct MagneticRequest<'a> {
    /// Base model and effects.
    pub model: &'a Model,
    /// Static intervals, recording after recording.
    pub placements: Vec<Placement>,
    /// Turns between neighbours of them.
    pub changes: Vec<HeadingChange>,
    /// Number of recordings; each has its own field.
    pub recordings: usize,
    /// Number of errors of the other sensors, each of variance 1.
    pub errors: usize,
    /// Strength of the field, in the unit of the readings, if it is known.
    pub strength: Option<f64>,
    /// Density of the walk of the gyroscope's bias, rad/s/√s.
    pub walk: f64,
}

/// The field of one recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Its strength.
    pub strength: f64,
    /// Standard error; `None` where it was given.
    pub strength_std: Option<f64>,
    /// Angle below the horizontal, rad.
    pub inclination: f64,
    /// Standard error.
    pub inclination_std: f64,
}

/// Values and their covariance.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Values.
    pub values: Vec<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
}

/// The result.
#[derive(Clone, Debug)]
pub struct MagneticFit {
    /// Parameters of the model.
    pub model: Fitted,
    /// Errors of the other sensors as the magnetometer sees them.
    pub errors: Fitted,
    /// Covariance of `model` (rows) with `errors` (columns).
    pub between: DMatrix<f64>,
    /// The field of each recording.
    pub fields: Vec<Field>,
    /// How much the field differs from place to place, standard deviation per axis, in the unit of the readings.
    pub unevenness: f64,
    /// Reading less model, root mean square of an axis.
    pub residual_rms: f64,
    /// The same squared over the noise within the intervals, per degree of freedom.
    pub reduced_chi2: f64,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// What was fitted to.
    pub placements: Vec<Placement>,
    /// Places of those whose reading is left out because the field was another there, with its difference (norm).
    pub disturbed: Vec<(usize, f64)>,
    /// Probability that noise makes the turns about the vertical disagree so much with the headings; 1 without turns.
    pub turns_p_value: f64,
    /// Free parameters.
    pub rank: usize,
    /// Turns used.
    pub turns: usize,
}

/// Fits a magnetometer.
///
/// # Errors
/// [`Error::NotEnough`] where the attitudes do not determine the parameters, [`Error::NotConverged`].
pub fn fit_magnetometer(mut request: MagneticRequest<'_>) -> Result<MagneticFit, Error> {
    let most = request.placements.len() / DISTURBED_SHARE;
    let mut disturbed = Vec::new();
    loop {
        let (fit, worst) = fit_all(&request)?;
        match worst.filter(|_| disturbed.len() < most) {
            Some((place, size)) => {
                request.placements[place].is_used = false;
                disturbed.push((place, size));
            }
            None => return Ok(MagneticFit { disturbed, ..fit }),
        }
    }
}

/// The fit to all placements, and the one that is disturbed most, if one is.
fn fit_all(request: &MagneticRequest<'_>) -> Result<(MagneticFit, Option<(usize, f64)>), Error> {
    let used = request.placements.iter().filter(|p| p.is_used).count();
    if used < LEAST_PLACEMENTS {
        return Err(Error::NotEnough(format!(
            "{used} static intervals have readings of the magnetometer, {LEAST_PLACEMENTS} at least are needed"
        )));
    }
    let (placements, changes) = (&request.placements, &request.changes);
    let start = linear_start(placements, changes, request.recordings, request.strength)?;
    let problem = Problem {
        model: request.model,
        placements,
        changes,
        recordings: request.recordings,
        errors: request.errors,
        strength: start.strength,
        strength_given: request.strength.is_some(),
        walk: request.walk,
    };
    let (uneven, minimum) = unevenness(&problem, &start)?;
    let fit = written(&problem, request, &start, uneven, &minimum)?;
    Ok((fit, most_disturbed(&problem, &minimum)))
}

fn written(
    problem: &Problem<'_>,
    request: &MagneticRequest<'_>,
    start: &super::start::Start,
    uneven: f64,
    minimum: &Minimum,
) -> Result<MagneticFit, Error> {
    let (report, blocks) = (&minimum.report, &minimum.blocks);
    let made = problem.graph(start, uneven)?;
    let failed = |e: solver::Error| Error::NotConverged(e.to_string());
    let products = Products::new(&made.graph, &report.values).map_err(failed)?;
    if let Some(open) = products.null_space().first() {
        return Err(Error::NotEnough(format!(
            "the attitudes do not determine the magnetometer ({}): hold every face up and turn the device to \
             other headings in between",
            open.words
        )));
    }
    let all_left = readings_left(problem, minimum);
    let used = || {
        problem
            .placements
            .iter()
            .zip(&all_left)
            .filter(|(p, _)| p.is_used)
    };
    let squares = |each: &[f64; 3]| each.iter().map(|r| r * r).sum::<f64>();
    let rows = 3 * used().count();
    let over_noise: f64 = used()
        .map(|(placement, left)| squares(left) / (placement.noise * placement.noise))
        .sum();
    let parameters = report.value(blocks.model).len();
    let fields = if problem.strength_given { 1 } else { 2 } * problem.recordings;
    let gauge = usize::from(!problem.strength_given);
    let known = rows + problem.changes.len() + gauge;
    let dof = known.saturating_sub(parameters + fields + problem.placements.len());
    if dof == 0 {
        return Err(Error::NotEnough(format!(
            "{} static intervals leave nothing to judge the magnetometer by",
            rows / 3
        )));
    }
    let widened = if uneven > 0.0 {
        widening(dof).powi(2)
    } else {
        1.0
    };
    let all: Vec<Block> = [blocks.model, blocks.errors]
        .into_iter()
        .chain(blocks.fields.iter().copied())
        .collect();
    let covariance = products.covariance(&all);
    let at =
        |i: usize, j: usize| covariance[i][j] * if i.max(j) < parameters { widened } else { 1.0 };
    let block = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
            at(rows.start + i, columns.start + j)
        })
    };
    let (model, errors) = (0..parameters, parameters..parameters + problem.errors);
    let mut next = errors.end;
    let mut fields = Vec::new();
    for &field in &blocks.fields {
        let value = report.value(field);
        let strength = start.strength * value[1].exp();
        let std = |k: usize| (covariance[k][k] * widened).max(0.0).sqrt();
        fields.push(Field {
            strength,
            strength_std: (!problem.strength_given).then(|| strength * std(next + 1)),
            inclination: value[0],
            inclination_std: std(next),
        });
        next += if problem.strength_given { 1 } else { 2 };
    }
    let turns = problem.changes.len();
    let turned = problem.turns_left(minimum);
    Ok(MagneticFit {
        model: Fitted {
            values: report.value(blocks.model).to_vec(),
            covariance: block(model.clone(), model.clone()),
        },
        errors: Fitted {
            values: report.value(blocks.errors).to_vec(),
            covariance: block(errors.clone(), errors.clone()),
        },
        between: block(model, errors),
        fields,
        unevenness: uneven,
        residual_rms: (used().map(|(_, left)| squares(left)).sum::<f64>() / rows as f64).sqrt(),
        reduced_chi2: over_noise / dof as f64,
        degrees_of_freedom: dof,
        placements: request.placements.clone(),
        disturbed: Vec::new(),
        turns_p_value: if turns == 0 {
            1.0
        } else {
            by_chance(turned, turns as f64)
        },
        rank: parameters - gauge,
        turns,
    })
}
