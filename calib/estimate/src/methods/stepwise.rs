//! The stepwise accelerometer calibration, as published (Liu et al. 2021, section 4.1).

use findings::{Finding, Kind};
use recording::Error;
use sensor::{Base, Model, is_bias};
use solver::{Options, Report, Variant, solve};

use super::first_guess::accelerometer_unit;
use super::fitted::Fitted;
use super::outliers::{Outlier, outliers};
use super::small_sample::residual_std;
use crate::methods::chance;
use crate::residuals::{GravityNorm, OwnBias, StaticMean};
use crate::truth::RawUnit;

findings::tuning! {
    /// Recordings get biases of their own where a common one is refuted at this level.
    OWN_BIAS_LEVEL: f64 = 0.01;

    /// Biases of their own are cheap where no standard error of a scale factor or misalignment becomes larger by more than this.
    CHEAP: f64 = 1.5;

    /// Steps that a fit may take: placements that determine the parameters need ten.
    MOST_STEPS: usize = 200;

    /// A rest is called an outlier where chance makes one in so many sessions.
    OUTLIER_LEVEL: f64 = 1e-4;
}

/// Request for a fit of an accelerometer.
#[derive(Clone, Debug)]
pub struct AccelerometerRequest {
    /// Static means of each recording, raw unit.
    pub recordings: Vec<Vec<StaticMean>>,
    /// Names of the recordings.
    pub names: Vec<String>,
    /// Base model and effects.
    pub model: Model,
    /// Local gravity, m/s².
    pub gravity: f64,
}

/// The fit of an accelerometer.
#[derive(Clone, Debug)]
pub struct AccelerometerFit {
    /// Base model and effects.
    pub model: Model,
    /// Step 1 in raw units: the nine parameters of the triangular frame.
    pub fitted: Fitted,
    /// Step 1, on readings near SI units.
    pub first: Report,
    /// The unit of the readings.
    pub unit: RawUnit,
    /// True if each recording has a bias of its own.
    pub own_bias: bool,
    /// True if the recordings determine biases of their own with little loss in the other standard errors.
    pub own_bias_is_cheap: bool,
    /// Rests that disagree with all the others.
    pub outliers: Vec<Outlier>,
    /// The probability of so much difference between the recordings under one common bias.
    pub common_bias_p: Option<f64>,
}

/// Frees the nine parameters that gravity's norm knows, from a perfect sensor: step 1 of the published method.
///
/// # Errors
/// Means that lie on no sphere, and what the solver refuses.
pub fn fit_accelerometer(request: &AccelerometerRequest) -> Result<AccelerometerFit, Error> {
    let all: Vec<_> = request.recordings.iter().flatten().map(|m| m.raw).collect();
    let unit = accelerometer_unit(&all, request.gravity).ok_or_else(|| {
        Error::not_enough(
            Finding::of(Kind::NO_SPHERE)
                .count("count", all.len())
                .because(plan::REQUIREMENT.finding()),
        )
    })?;
    let near_si: Vec<Vec<StaticMean>> = request
        .recordings
        .iter()
        .map(|means| unit.means_to_si(means))
        .collect();
    let common = step_one(request, &near_si, false)?;
    let (first, common_bias_p, own_bias_is_cheap) = match request.recordings.len() {
        0 | 1 => (common, None, false),
        _ => {
            let own = step_one(request, &near_si, true)?;
            let is_cheap = is_cheap(&common, &own);
            let (first, p) = choose_bias(common, own);
            (first, p, is_cheap)
        }
    };
    let shared = request.model.parameter_count();
    let own_bias = first.parameters.len() > shared;
    Ok(AccelerometerFit {
        model: request.model.clone(),
        fitted: Fitted::in_raw_units(&first, &unit, shared, scatter(&first, &near_si)),
        outliers: outliers(
            &problem(request, &near_si, own_bias),
            &first,
            OUTLIER_LEVEL.get(),
        ),
        first,
        unit,
        own_bias,
        own_bias_is_cheap,
        common_bias_p,
    })
}

fn problem<'a>(
    request: &'a AccelerometerRequest,
    near_si: &'a [Vec<StaticMean>],
    own_bias: bool,
) -> OwnBias<GravityNorm<'a>> {
    let parts = near_si
        .iter()
        .map(|means| GravityNorm {
            model: &request.model,
            means,
            gravity: request.gravity,
        })
        .collect();
    OwnBias {
        parts,
        shared: request.model.parameter_count(),
        own_bias,
    }
}

fn step_one(
    request: &AccelerometerRequest,
    near_si: &[Vec<StaticMean>],
    own_bias: bool,
) -> Result<Report, Error> {
    let problem = problem(request, near_si, own_bias);
    let start = problem.parameters(&request.model.parameters(), &request.names);
    let mask = start.free_where(accelerometer::is_free_in_triangular_frame);
    let options = Options {
        max_iterations: MOST_STEPS.get(),
        ..Options::default()
    };
    Ok(solve(&problem, &start, &mask, &options)?)
}

/// Step 2 of the published method, on readings near SI units: holds the biases of step 1 and frees all of `T`, again from a perfect sensor.
/// The Jacobian has rank 6, so the steps are of minimum norm, and lead to the symmetric factor of step 1's `T`. No calibration needs it.
///
/// # Errors
/// What the solver refuses.
pub fn step_two(request: &AccelerometerRequest, fit: &AccelerometerFit) -> Result<Report, Error> {
    let means = request.recordings.iter();
    let near_si: Vec<_> = means.map(|means| fit.unit.means_to_si(means)).collect();
    let problem = problem(request, &near_si, fit.own_bias);
    let mut start = fit.first.parameters.clone();
    let perfect = Base::identity().parameters();
    start.values_mut()[..9].copy_from_slice(&perfect[..9]);
    let base: Vec<String> = start.names()[..9].to_vec();
    let mask = start.free_where(|name| base.iter().any(|free| free == name));
    let options = Options {
        variant: Variant::GaussNewtonMinimumNorm,
        max_iterations: MOST_STEPS.get(),
        ..Options::default()
    };
    Ok(solve(&problem, &start, &mask, &options)?)
}

/// Returns true if biases of their own are determined and leave the standard errors of scale factors and misalignments
/// nearly as they are.
fn is_cheap(common: &Report, own: &Report) -> bool {
    let (one, each) = (&common.uncertainty, &own.uncertainty);
    let growth = one.names.iter().enumerate().filter_map(|(k, name)| {
        let own = each.names.iter().position(|other| other == name)?;
        (!is_bias(name)).then(|| each.standard_error(own, 1.0) / one.standard_error(k, 1.0))
    });
    each.rank == each.names.len() && growth.fold(0.0, f64::max) < CHEAP.get()
}

/// The fit with own biases where the F test refutes a common one, and that test's p-value.
fn choose_bias(common: Report, own: Report) -> (Report, Option<f64>) {
    let extra = (own.uncertainty.rank as f64) - (common.uncertainty.rank as f64);
    let dof = own.residuals.len() as f64 - own.uncertainty.rank as f64;
    if extra < 1.0 || dof < 1.0 || own.cost <= 0.0 {
        return (common, None);
    }
    let f = ((common.cost - own.cost).max(0.0) / extra) / (own.cost / dof);
    if !f.is_finite() {
        return (common, None);
    }
    let p = chance::of_f(f, [extra, dof]);
    match p < OWN_BIAS_LEVEL.get() {
        true => (own, Some(p)),
        false => (common, Some(p)),
    }
}

/// Standard deviation of a residual: the white noise within the rests, or the scatter around the fit where that says
/// otherwise.
fn scatter(report: &Report, means: &[Vec<StaticMean>]) -> f64 {
    let all: Vec<f64> = means.iter().flatten().map(|m| m.white * m.white).collect();
    let white = (all.iter().sum::<f64>() / all.len().max(1) as f64).sqrt();
    let spare = report.residuals.len().checked_sub(report.uncertainty.rank);
    spare.filter(|spare| *spare > 0).map_or(f64::NAN, |spare| {
        residual_std(2.0 * report.cost, spare, white)
    })
}
