//! A formula as it is written down.

use recording::Error;

use super::named::parameters_of;
use crate::calibrated::calibration;
use crate::family::effect_family;
use crate::propose::{Proposal, Proposed, propose};
use crate::remainder::unexplained::Unexplained;
use crate::remainder::weighed_again::weighed_again;
use crate::request::Session;
use crate::search::Search;
use crate::state::State;

/// A formula for what remains, or that is `known` to explain it, with its coefficients; names that it explains are
/// withdrawn, and the formula is then looked for without them.
pub fn proposed(
    session: &Session<'_>,
    search: &mut Search,
    rest: &Unexplained,
    known: Option<Proposed>,
) -> Result<Option<(Proposal, State)>, Error> {
    let found = known.or_else(|| propose(session, &search.last, rest));
    let Some(mut proposed) = found else {
        return Ok(None);
    };
    let family = effect_family(&search.base, &proposed.effect, &[]);
    let noise = proposed.state.noise;
    if let Some(less) = weighed_again(search, &session.request, &family.columns.to_dense(), noise) {
        search.withdraw_to(session, less)?;
        let Some(again) = propose(session, &search.last, rest) else {
            return Ok(None);
        };
        proposed = again;
    }
    // A formula whose parameters these recordings do not determine is none.
    let Ok(calibration) = calibration(session, &proposed.state) else {
        return Ok(None);
    };
    let parameters = parameters_of(proposed.effect.name(), &calibration);
    let state = proposed.state.clone();
    Ok(Some((proposed.written(rest.channel, parameters), state)))
}
