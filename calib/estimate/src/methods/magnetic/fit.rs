//! The fit: start, unevenness, disturbed placements, result.

use findings::{Finding, Kind};
use recording::Error;
use sensor::{Model, Sensor};

use super::disturbed::most_disturbed;
use super::fitted::MagneticFit;
use super::placement::{HeadingChange, Placement};
use super::problem::Problem;
use super::result::Judged;
use super::start::{Start, linear_start};
use super::unevenness::unevenness;

findings::tuning! {
    /// Fewer static intervals say too little: thirteen unknowns, a heading each, and something spare.
    LEAST_PLACEMENTS: usize = 6;

    /// At most one placement in so many is left out as disturbed.
    DISTURBED_SHARE: usize = 5;
}

/// Request for a fit of a magnetometer.
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
    /// Number of parts; each has its own bias.
    pub parts: usize,
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

/// Fits a magnetometer.
///
/// # Errors
/// [`Error::NotEnough`] where the attitudes do not determine the parameters, [`Error::NotConverged`].
pub fn fit_magnetometer(mut request: MagneticRequest<'_>) -> Result<MagneticFit, Error> {
    let most = request.placements.len() / DISTURBED_SHARE.get();
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

/// The smallest `χ²` of all placements where the field differs by `uneven` from place to place: one minimum, where a fit takes twenty to
/// find the unevenness. It compares divisions of a recording of equally many parts.
///
/// # Errors
/// As [`fit_magnetometer`].
pub fn chi2_at(request: &MagneticRequest<'_>, uneven: f64) -> Result<f64, Error> {
    let start = start_of(request)?;
    let minimum = problem_of(request, &start).minimum(&start, uneven, None)?;
    Ok(2.0 * minimum.report.cost)
}

/// The fit to the placements as they are marked, where the field differs by `uneven` from place to place.
///
/// # Errors
/// As [`fit_magnetometer`].
pub fn fit_at(request: &MagneticRequest<'_>, uneven: f64) -> Result<MagneticFit, Error> {
    let start = start_of(request)?;
    let problem = problem_of(request, &start);
    let minimum = problem.minimum(&start, uneven, None)?;
    Judged::new(&problem, &start, uneven, &minimum)?.written()
}

fn start_of(request: &MagneticRequest<'_>) -> Result<Start, Error> {
    let (placements, changes) = (&request.placements, &request.changes);
    linear_start(placements, changes, request.recordings, request.strength)
}

fn problem_of<'a>(request: &'a MagneticRequest<'_>, start: &Start) -> Problem<'a> {
    Problem {
        model: request.model,
        placements: &request.placements,
        changes: &request.changes,
        recordings: request.recordings,
        parts: request.parts,
        errors: request.errors,
        strength: start.strength,
        strength_given: request.strength.is_some(),
        walk: request.walk,
    }
}

/// The fit to all placements, and the one that is disturbed most, if one is.
fn fit_all(request: &MagneticRequest<'_>) -> Result<(MagneticFit, Option<(usize, f64)>), Error> {
    let used = request.placements.iter().filter(|p| p.is_used).count();
    if used < LEAST_PLACEMENTS.get() {
        return Err(Error::not_enough(
            Finding::of(Kind::ATTITUDES_TOO_FEW)
                .of_sensor(Sensor::Magnetometer)
                .count("count", used)
                .count("least", LEAST_PLACEMENTS.get()),
        ));
    }
    let start = start_of(request)?;
    let problem = problem_of(request, &start);
    let (uneven, minimum) = unevenness(&problem, &start)?;
    let minimum = problem.polished(&start, uneven, minimum);
    let judged = Judged::new(&problem, &start, uneven, &minimum)?;
    let worst = most_disturbed(&problem, &minimum, judged.left());
    Ok((judged.written()?, worst))
}
