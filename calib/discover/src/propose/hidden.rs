//! A formula whose effect the noise of the biases was taken for.

use super::instead::promising;
use super::{Proposed, propose_of};
use crate::remainder::unexplained::{Unexplained, rest_of};
use crate::request::Session;
use crate::state::State;

/// Looks for a formula where `last` leaves nothing that is more than its noise, with what is left where the biases have the noise
/// that suits the formula. Its evidence is that over all that the noise may be, as that of an effect.
pub fn hidden_formula(session: &Session<'_>, last: &State) -> Option<(Proposed, Unexplained)> {
    if last.noise_given {
        return None;
    }
    let (products, screened) = promising(session, last, session.request.threshold())?;
    let alpha = session.request.alpha_of_rest();
    let mut rest = rest_of(&last.at_noise(screened.noise), alpha)?;
    let found = propose_of(session, last, &rest, (&products, &screened))?;
    rest.p_value = found.p_value();
    Some((found, rest))
}
