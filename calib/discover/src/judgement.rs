//! Names, and what they leave, judged again once all is known.

use recording::Error;

use super::fault::mixed::{explain_disturbed, leave_out_mixed, take_back};
use super::flicker::{names_and_rest, without_flickering};
use super::propose::{Proposed, hidden_formula, instead_of_names};
use super::remainder::unexplained::{Unexplained, rest_of};
use super::remainder::withdrawn::{
    weigh_beside_shape, without_doubtful_steps, without_steps_of, without_undetermined,
    without_weak,
};
use super::request::Session;
use super::search::Search;
use super::state::State;

/// Result of a search after its remainder has been judged.
pub struct Judged {
    /// The names.
    pub search: Search,
    /// Disagreement that remains beside the names.
    pub rest: Option<Unexplained>,
    /// The formula that explains the whole in their place, or what the noise of the biases hid.
    pub instead: Option<Proposed>,
}

impl Judged {
    /// The base models, with nothing looked for.
    pub fn nothing_looked_for(base: State) -> Self {
        Self {
            search: Search::without_names(base),
            rest: None,
            instead: None,
        }
    }
}

/// A look at the names beside what they leave: true where some were taken back, and the rest is another.
type Review = fn(&Session<'_>, &mut Search, Option<&Unexplained>) -> Result<bool, Error>;

/// The reviews, each of what those before it have left.
const REVIEWS: [Review; 7] = [
    |session, search, _| without_flickering(session, search),
    // An interval that is off beside a step is none of the step's.
    |session, search, _| leave_out_mixed(session, search),
    // Beside a rest of several times the noise every likelihood ratio is too large.
    |session, search, rest| Ok(rest.is_some() && without_weak(session, search)?),
    // A step that a wandering explains as well.
    |session, search, _| without_doubtful_steps(session, search),
    |session, search, rest| match rest.and_then(|found| found.wandering) {
        Some((sensor, _)) => without_steps_of(session, search, sensor),
        None => Ok(false),
    },
    // Coefficients that are zero within their errors, unless nothing else explains what they do.
    |session, search, rest| {
        let mut fewer = search.clone();
        let is_needed = |fewer: &Search| {
            rest.is_none() && rest_of(&fewer.last, session.request.alpha_of_rest()).is_some()
        };
        let goes = without_undetermined(session, &mut fewer)? && !is_needed(&fewer);
        if goes {
            *search = fewer;
        }
        Ok(goes)
    },
    // Rows that were left out for a step that has gone.
    |session, search, _| take_back(session, search),
];

/// Looks for names, and takes those back that do not stand beside all that was found; a formula may take their place where
/// `may_replace` says so of it.
///
/// # Errors
/// As the joint fit.
pub fn judged(
    session: &mut Session<'_>,
    base: State,
    may_replace: impl Fn(&Session<'_>, &State) -> bool,
) -> Result<Judged, Error> {
    let alpha = session.request.alpha_of_rest();
    let found = names_and_rest(session, base)?;
    let (mut search, mut rest) = (found.search, found.rest);
    let instead = instead_of_names(session, &search, found.of_base);
    let instead = instead.filter(|(formula, _)| may_replace(session, &formula.state));
    let mut instead = instead.map(|(formula, mut whole)| {
        whole.instead_of = search.withdraw_all();
        rest = Some(whole);
        formula
    });
    for review in REVIEWS {
        if review(session, &mut search, rest.as_ref())? {
            rest = rest_of(&search.last, alpha);
        }
    }
    if rest.is_none()
        && let Some((formula, hidden)) = hidden_formula(session, &search.last)
        && may_replace(session, &formula.state)
    {
        rest = Some(hidden);
        instead = Some(formula);
    }
    explain_disturbed(session, &mut search)?;
    if let Some(found) = rest.as_mut() {
        weigh_beside_shape(session, &mut search, found)?;
    }
    Ok(Judged {
        search,
        rest,
        instead,
    })
}
