//! The fit: start, unevenness, disturbed placements, result.

use nalgebra::DMatrix;
use recording::Error;
use sensor::Model;

use super::disturbed::most_disturbed;
use super::placement::{HeadingChange, Placement};
use super::problem::Problem;
use super::result::Judged;
use super::start::linear_start;
use super::unevenness::unevenness;

/// Fewer static intervals say too little: thirteen unknowns, a heading each, and something spare.
const LEAST_PLACEMENTS: usize = 6;

/// At most one placement in so many is left out as disturbed.
const DISTURBED_SHARE: usize = 5;

/// What to fit.
#[derive(Clone, Debug)]
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

impl MagneticRequest<'_> {
    /// The same for another model.
    pub fn with_model(self, model: &Model) -> MagneticRequest<'_> {
        MagneticRequest { model, ..self }
    }
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

/// The bias of one recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnBias {
    /// Its value.
    pub value: [f64; 3],
    /// Standard errors.
    pub std: [f64; 3],
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
    /// The bias of each recording: magnets that turn with the device may have moved in between. That of the last is the
    /// model's.
    pub biases: Vec<OwnBias>,
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
    let minimum = problem.polished(&start, uneven, minimum);
    let judged = Judged::new(&problem, &start, uneven, &minimum)?;
    let worst = most_disturbed(&problem, &minimum, judged.left());
    Ok((judged.written()?, worst))
}
