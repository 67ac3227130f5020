//! The final model of a session, step by step: names, what remains beside them, a formula.

use estimate::calibrate::{LatitudeDoubt, is_determined};
use recording::Error;

use super::calibrated::calibration;
use super::family::effect_family;
use super::fault::mixed::{explain_disturbed, leave_out_mixed, take_back};
use super::findings::late::LateStamps;
use super::findings::latitude::instead_of_a_name;
use super::findings::named::parameters_of;
use super::flicker::{flickers, without_flickering};
use super::propose::{Proposal, Proposed, hidden_formula, instead_of_names, propose};
use super::rank::APART;
use super::remainder::described::Described;
use super::remainder::unexplained::{Unexplained, rest_beside, rest_of};
use super::remainder::withdrawn::{
    withdrawn_beside, without_doubtful_steps, without_undetermined, without_weak,
};
use super::request::Session;
use super::search::{Search, search};
use super::state::{Extension, State};
use super::time_constants::{HeldShape, settle};

/// Recordings with what explains them.
pub struct Explained {
    /// The models, with the names.
    pub search: Search,
    /// Disagreement that remains beside the names.
    pub rest: Option<Unexplained>,
    /// A formula for what remains, with the model that has it.
    pub proposed: Option<(Proposal, State)>,
    /// Stamps that are late.
    pub late: LateStamps,
    /// Time constants that these recordings do not show.
    pub held: Vec<HeldShape>,
    /// The doubt about the latitude that explains one of the names as well, and that name: nothing was looked for after it.
    pub latitude: Option<(LatitudeDoubt, String)>,
    /// A formula for the whole in place of names, or for what the noise of the biases hid.
    formula: Option<Proposed>,
    /// Tests for shapes in the residuals of the base models, where they were run.
    of_base: Option<Described>,
}

/// A step towards the final model: true where it took names back, and the rest is another.
type Step = fn(&mut Session<'_>, &mut Explained) -> Result<bool, Error>;

/// The steps after the search, each with what those before it have left.
///
/// First what may stand in the place of all names: a shape, noise that flickers, a formula. Then the names that do not stand beside each other
/// and beside what is left, the weakest evidence first. Then what the recordings say of the named: a latitude, late stamps, time constants. Last a
/// formula for what nothing explains.
const STEPS: [Step; 17] = [
    shape_for_the_whole,
    again_where_biases_flicker,
    formula_for_the_whole,
    |session, found| without_flickering(session, &mut found.search),
    // An interval that is off beside a step is none of the step's.
    |session, found| leave_out_mixed(session, &mut found.search),
    // Beside a rest of several times the noise every likelihood ratio is too large.
    |session, found| Ok(found.rest.is_some() && without_weak(session, &mut found.search)?),
    // A step that a wandering explains as well.
    |session, found| without_doubtful_steps(session, &mut found.search),
    without_steps_of_what_wanders,
    without_undetermined_effects,
    // Rows that were left out for a step that has gone.
    |session, found| take_back(session, &mut found.search),
    formula_that_noise_hides,
    |session, found| explain_disturbed(session, &mut found.search).map(|()| false),
    without_what_the_shape_explains,
    |session, found| {
        let names = &found.search.names;
        let given = session.request.latitude;
        found.latitude = given.and_then(|given| instead_of_a_name(names, given));
        Ok(false)
    },
    |session, found| {
        found.late = LateStamps::of(session, &mut found.search)?;
        Ok(false)
    },
    |session, found| {
        found.held = settle(session, &mut found.search.last);
        Ok(false)
    },
    formula_for_the_rest,
];

/// Looks for names, and takes those back that do not stand beside all that was found; a formula may take their place.
///
/// # Errors
/// As the joint fit.
pub fn explained(session: &mut Session<'_>, base: State) -> Result<Explained, Error> {
    let mut found = Explained::of(search(session, base)?);
    for step in STEPS {
        if step(session, &mut found)? {
            found.rest = rest_of(&found.search.last, session.request.alpha_of_rest());
        }
        if found.latitude.is_some() {
            break;
        }
    }
    Ok(found)
}

/// Puts one shape in the place of all names where it explains the whole better.
fn shape_for_the_whole(session: &mut Session<'_>, found: &mut Explained) -> Result<bool, Error> {
    let Search {
        base, last, names, ..
    } = &found.search;
    let names_effect = names.iter().any(|name| name.claim.effect().is_some());
    // A bias that goes by something else is far off in some rests.
    let mut in_rests = last.extension.disturbed.iter().peekable();
    let of_rests =
        in_rests.peek().is_some() && in_rests.all(|known| known.fault.is_over_with_interval);
    if !names_effect && !of_rests {
        return Ok(true);
    }
    let alpha = session.request.alpha_of_rest();
    let needed = found.search.evidence + APART.get();
    let described = Described::of(base, needed.min(-alpha.ln()));
    let is_better = described.has_better(needed, names);
    if is_better {
        found.rest = rest_beside(base, &described, alpha);
        if let Some(whole) = &mut found.rest {
            whole.instead_of = found.search.withdraw_all();
        }
    }
    found.of_base = Some(described);
    Ok(!is_better)
}

/// Searches again under noise that flickers, where the biases do.
///
/// A search takes the noise of the biases for walks: flicker beside them would take some of what depends on the
/// placement. Of biases that flicker a walk leaves what looks like a wandering, a fine pattern or a small effect. Sensors do
/// that, and nothing is missing: what was found is then looked for again.
fn again_where_biases_flicker(
    session: &mut Session<'_>,
    found: &mut Explained,
) -> Result<bool, Error> {
    let by_shape = found.gained_by_shape();
    if found.lacks_nothing() || !flickers(session, &found.search.last, by_shape) {
        return Ok(false);
    }
    session.request.flicker = true;
    let base = State::fit(session, Extension::default())?;
    *found = Explained::of(search(session, base)?);
    shape_for_the_whole(session, found)
}

/// Puts a formula in the place of all names where it explains the whole better. One whose parameters these recordings do not determine
/// takes no name's place.
fn formula_for_the_whole(session: &mut Session<'_>, found: &mut Explained) -> Result<bool, Error> {
    let instead = instead_of_names(session, &found.search, found.of_base.take());
    if let Some((formula, mut whole)) = instead.filter(|own| is_determined(&own.0.state.fit)) {
        whole.instead_of = found.search.withdraw_all();
        found.rest = Some(whole);
        found.formula = Some(formula);
    }
    Ok(false)
}

/// Withdraws the steps of a sensor whose bias wanders beside them.
fn without_steps_of_what_wanders(
    session: &mut Session<'_>,
    found: &mut Explained,
) -> Result<bool, Error> {
    let wandering = found.rest.as_ref().and_then(|rest| rest.wandering);
    let Some((sensor, _)) = wandering else {
        return Ok(false);
    };
    let search = &mut found.search;
    search.withdraw_where(session, |name| name.stepping() == Some(sensor))
}

/// Withdraws effects whose coefficients are zero within their errors, unless nothing else explains what they do.
fn without_undetermined_effects(
    session: &mut Session<'_>,
    found: &mut Explained,
) -> Result<bool, Error> {
    let mut fewer = found.search.clone();
    let alpha = session.request.alpha_of_rest();
    let goes = without_undetermined(session, &mut fewer)?
        && (found.rest.is_some() || rest_of(&fewer.last, alpha).is_none());
    if goes {
        found.search = fewer;
    }
    Ok(goes)
}

/// Takes a formula for what remains whose effect the noise of the biases was taken for, where nothing else remains.
fn formula_that_noise_hides(
    session: &mut Session<'_>,
    found: &mut Explained,
) -> Result<bool, Error> {
    if found.rest.is_none()
        && let Some(own) = hidden_formula(session, &found.search.last)
        && is_determined(&own.0.state.fit)
    {
        let (formula, hidden) = own;
        found.rest = Some(hidden);
        found.formula = Some(formula);
    }
    Ok(false)
}

/// Withdraws what is no longer evident beside the shape of what remains.
fn without_what_the_shape_explains(
    session: &mut Session<'_>,
    found: &mut Explained,
) -> Result<bool, Error> {
    if let Some(rest) = &mut found.rest
        && let Some(shape) = &rest.columns
    {
        let gone = withdrawn_beside(session, &mut found.search, &shape.columns, shape.noise)?;
        rest.instead_of.extend(gone.into_iter().flatten());
    }
    Ok(false)
}

/// Looks for a formula for what remains, unless one is known; names that it explains are withdrawn, and the formula is then looked for without
/// them.
fn formula_for_the_rest(session: &mut Session<'_>, found: &mut Explained) -> Result<bool, Error> {
    let (known, Some(rest)) = (found.formula.take(), &found.rest) else {
        return Ok(false);
    };
    let search = &mut found.search;
    let Some(formula) = known.or_else(|| propose(session, &search.last, rest)) else {
        return Ok(false);
    };
    let family = effect_family(&search.base, &formula.effect, &[]);
    let columns = family.columns.to_dense();
    let gone = withdrawn_beside(session, search, &columns, formula.state.noise)?;
    let formula = match gone {
        Some(_) => propose(session, &search.last, rest),
        None => Some(formula),
    };
    // A formula whose parameters these recordings do not determine is none.
    found.proposed = formula.and_then(|formula| {
        let calibration = calibration(session, &formula.state).ok()?;
        let parameters = parameters_of(formula.effect.name(), &calibration);
        let state = formula.state.clone();
        Some((formula.written(rest.channel, parameters), state))
    });
    Ok(false)
}

impl Explained {
    /// The names of a search alone.
    pub fn of(search: Search) -> Self {
        Self {
            search,
            rest: None,
            proposed: None,
            formula: None,
            late: LateStamps::default(),
            held: Vec::new(),
            latitude: None,
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
            let mut found = Explained::of(search(&session, base).unwrap());
            let mut step = |step: Step| {
                if step(&mut session, &mut found).unwrap() {
                    found.rest = rest_of(&found.search.last, request.alpha_of_rest());
                }
                found.lacks_nothing()
            };
            let lacks = !step(shape_for_the_whole);
            assert!(lacks || seed == 54, "{seed}");
            assert!(step(again_where_biases_flicker), "{seed}");
            let flicker = found.search.last.noise.flicker[0];
            assert!(!lacks || flicker.iter().all(|b| *b > 1e-4), "{seed}");
        }
    }
}
