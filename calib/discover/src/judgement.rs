//! Names, and what they leave, judged again once all is known.

use recording::Error;

use super::fault::mixed::{explain_disturbed, leave_out_mixed, take_back};
use super::flicker::names_and_rest;
use super::propose::{Proposed, instead_of_names};
use super::remainder::unexplained::{Unexplained, rest_of};
use super::remainder::withdrawn::{
    weigh_beside_shape, without_doubtful_steps, without_steps_of, without_undetermined,
    without_weak,
};
use super::request::{Request, Session};
use super::search::Search;
use super::state::State;

/// Result of a search after its remainder has been judged.
pub struct Judged {
    /// The names.
    pub search: Search,
    /// Disagreement that remains beside the names.
    pub rest: Option<Unexplained>,
    /// The formula that explains the whole in their place.
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

/// Looks for names, and takes those back that do not stand beside all that was found; a formula may take their place where
/// `may_replace` says so of it.
///
/// # Errors
/// As the joint fit.
pub fn judged(
    session: &mut Session<'_>,
    request: &Request,
    base: State,
    may_replace: impl Fn(&Session<'_>, &State) -> bool,
) -> Result<Judged, Error> {
    let alpha = request.alpha_of_rest();
    let found = names_and_rest(session, request, base)?;
    let (mut search, mut rest) = (found.search, found.rest);
    let instead = instead_of_names(session, request, &search, found.of_base);
    let instead = instead.filter(|(formula, _)| may_replace(session, &formula.state));
    let instead = instead.map(|(formula, mut whole)| {
        whole.instead_of = search.withdraw_all();
        rest = Some(whole);
        formula
    });
    if leave_out_mixed(session, &mut search)? {
        rest = rest_of(&search.last, alpha);
    }
    if rest.is_some() && without_weak(session, &mut search, request)? {
        rest = rest_of(&search.last, alpha);
    }
    if without_doubtful_steps(session, &mut search)? {
        rest = rest_of(&search.last, alpha);
    }
    if let Some((sensor, _)) = rest.as_ref().and_then(|found| found.wandering)
        && without_steps_of(session, &mut search, sensor)?
    {
        rest = rest_of(&search.last, alpha);
    }
    let mut fewer = search.clone();
    if without_undetermined(session, &mut fewer)? {
        let left = rest_of(&fewer.last, alpha);
        // What nothing would explain without it is not by chance.
        if rest.is_some() || left.is_none() {
            (search, rest) = (fewer, left);
        }
    }
    if take_back(session, &mut search)? {
        rest = rest_of(&search.last, alpha);
    }
    explain_disturbed(session, &mut search)?;
    if let Some(found) = rest.as_mut() {
        weigh_beside_shape(session, request, &mut search, found)?;
    }
    Ok(Judged {
        search,
        rest,
        instead,
    })
}
