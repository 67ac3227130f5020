//! The names of what is missing and what remains beside them, each looked at again once all is known.

use recording::Error;

use super::calibrated::calibration;
use super::fault::mixed::{explain_disturbed, leave_out_mixed, take_back};
use super::flicker::{flickers, without_flickering};
use super::propose::{Proposed, hidden_formula, instead_of_names};
use super::remainder::described::Described;
use super::remainder::unexplained::{Unexplained, rest_of, unexplained};
use super::remainder::withdrawn::{
    weigh_beside_shape, without_doubtful_steps, without_undetermined, without_weak,
};
use super::request::Session;
use super::search::{Search, search};
use super::state::{Extension, State};

/// Result of a search, with what remains beside its names.
pub struct Judged {
    /// The names.
    pub search: Search,
    /// Disagreement that remains beside the names.
    pub rest: Option<Unexplained>,
    /// The formula that explains the whole in their place, or what the noise of the biases hid.
    pub instead: Option<Proposed>,
    /// Tests for shapes in the residuals of the base models, where they were run.
    of_base: Option<Described>,
}

/// A look at the names beside what they leave: true where some were taken back, and the rest is another.
type Review = fn(&mut Session<'_>, &mut Judged) -> Result<bool, Error>;

/// The reviews, each of what those before it have left.
const REVIEWS: [Review; 12] = [
    again_where_biases_flicker,
    formula_for_the_whole,
    |session, judged| without_flickering(session, &mut judged.search),
    // An interval that is off beside a step is none of the step's.
    |session, judged| leave_out_mixed(session, &mut judged.search),
    // Beside a rest of several times the noise every likelihood ratio is too large.
    |session, judged| Ok(judged.rest.is_some() && without_weak(session, &mut judged.search)?),
    // A step that a wandering explains as well.
    |session, judged| without_doubtful_steps(session, &mut judged.search),
    |session, judged| match judged.rest.as_ref().and_then(|rest| rest.wandering) {
        Some((sensor, _)) => {
            let search = &mut judged.search;
            search.withdraw_where(session, |name| name.stepping() == Some(sensor))
        }
        None => Ok(false),
    },
    // Coefficients that are zero within their errors, unless nothing else explains what they do.
    |session, judged| {
        let mut fewer = judged.search.clone();
        let is_needed = |fewer: &Search| {
            judged.rest.is_none() && rest_of(&fewer.last, session.request.alpha_of_rest()).is_some()
        };
        let goes = without_undetermined(session, &mut fewer)? && !is_needed(&fewer);
        if goes {
            judged.search = fewer;
        }
        Ok(goes)
    },
    // Rows that were left out for a step that has gone.
    |session, judged| take_back(session, &mut judged.search),
    formula_that_noise_hides,
    |session, judged| explain_disturbed(session, &mut judged.search).map(|()| false),
    |session, judged| match judged.rest.as_mut() {
        Some(rest) => weigh_beside_shape(session, &mut judged.search, rest).map(|()| false),
        None => Ok(false),
    },
];

/// Looks for names, and takes those back that do not stand beside all that was found; a formula may take their place.
///
/// # Errors
/// As the joint fit.
pub fn judged(session: &mut Session<'_>, base: State) -> Result<Judged, Error> {
    let mut judged = look(session, base)?;
    for review in REVIEWS {
        if review(session, &mut judged)? {
            judged.rest = rest_of(&judged.search.last, session.request.alpha_of_rest());
        }
    }
    Ok(judged)
}

/// The names and what they leave, before any review.
fn look(session: &Session<'_>, base: State) -> Result<Judged, Error> {
    let mut search = search(session, base)?;
    let (rest, of_base) = unexplained(&mut search, session.request.alpha_of_rest());
    Ok(Judged {
        search,
        rest,
        instead: None,
        of_base,
    })
}

/// Looks again under noise that flickers, where the biases do.
///
/// A search takes the noise of the biases for walks: flicker beside them would take some of what depends on the
/// placement. Of biases that flicker a walk leaves what looks like a wandering, a fine pattern or a small effect. Sensors do
/// that, and nothing is missing: what was found is then looked for again.
fn again_where_biases_flicker(
    session: &mut Session<'_>,
    judged: &mut Judged,
) -> Result<bool, Error> {
    let by_shape = judged.gained_by_shape();
    if !judged.lacks_nothing() && flickers(session, &judged.search.last, by_shape) {
        session.request.flicker = true;
        let base = State::fit(session, Extension::default())?;
        *judged = look(session, base)?;
    }
    Ok(false)
}

/// Puts a formula in the place of all names where it explains the whole better. One whose parameters these recordings do not determine
/// takes no name's place.
fn formula_for_the_whole(session: &mut Session<'_>, judged: &mut Judged) -> Result<bool, Error> {
    let found = instead_of_names(session, &judged.search, judged.of_base.take());
    if let Some((formula, mut whole)) = found
        && calibration(session, &formula.state).is_ok()
    {
        whole.instead_of = judged.search.withdraw_all();
        judged.rest = Some(whole);
        judged.instead = Some(formula);
    }
    Ok(false)
}

/// Takes a formula for what remains whose effect the noise of the biases was taken for, where nothing else remains.
fn formula_that_noise_hides(session: &mut Session<'_>, judged: &mut Judged) -> Result<bool, Error> {
    if judged.rest.is_none()
        && let Some((formula, hidden)) = hidden_formula(session, &judged.search.last)
        && calibration(session, &formula.state).is_ok()
    {
        judged.rest = Some(hidden);
        judged.instead = Some(formula);
    }
    Ok(false)
}

impl Judged {
    /// The base models, with nothing looked for.
    pub fn nothing_looked_for(base: State) -> Self {
        Self {
            search: Search::without_names(base),
            rest: None,
            instead: None,
            of_base: None,
        }
    }

    fn lacks_nothing(&self) -> bool {
        self.rest.is_none() && self.search.names.is_empty()
    }

    /// By how much the data are likelier (log) with the shape of what remains, less one for each degree of freedom (Akaike 1974);
    /// `None` beside names or where it has no shape.
    fn gained_by_shape(&self) -> Option<f64> {
        let rest = self.rest.as_ref();
        let rest = rest.filter(|_| self.search.names.is_empty())?;
        // A bias that wanders on one axis is what flicker makes of it.
        let has_shape = rest.columns.is_some() && rest.wandering.is_none();
        has_shape.then_some(0.5 * rest.statistic - rest.dof)
    }
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::request::Request;

    #[test]
    fn biases_that_flicker_on_all_axes_lack_nothing() {
        // To a walk the first two leave a remainder.
        for seed in [41, 47, 54] {
            let mut spec = Spec::hand_held(seed);
            spec.accelerometer.instability = 1e-3;
            spec.gyroscope.instability = 7.3e-5;
            let recordings = [spec.run().unwrap().recording];
            let request = Request::new(spec.gravity);
            let mut session = Session::new(&recordings, &request).unwrap();
            let base = State::fit(&session, Extension::default()).unwrap();
            let walking = look(&session, base.clone()).unwrap();
            let lacks = !walking.lacks_nothing();
            assert!(lacks || seed == 54, "{seed}");
            let mut found = look(&session, base).unwrap();
            again_where_biases_flicker(&mut session, &mut found).unwrap();
            assert!(found.lacks_nothing(), "{seed}");
            let flicker = found.search.last.noise.flicker[0];
            assert!(!lacks || flicker.iter().all(|b| *b > 1e-4), "{seed}");
        }
    }
}
