//! Samples at instants or means over windows, decided again beside the names.

use estimate::methods::joint::{JointRequest, SourceClock, fit_joint};
use recording::Error;

use crate::request::Session;
use crate::state::{State, joint_request};

/// The clocks of a session with what the samples are beside all that is named; `None` where that is as it was decided beside the base
/// models. A name that is missing makes the turns miss by more than the samples do.
///
/// # Errors
/// As [`fit_joint`].
pub(crate) fn other_samples(
    session: &Session<'_>,
    last: &State,
) -> Result<Option<Vec<SourceClock>>, Error> {
    let Some(decided) = &session.clocks else {
        return Ok(None);
    };
    if last.extension.effects.is_empty() {
        return Ok(None);
    }
    let beside_names = fit_joint(&JointRequest {
        clocks: None,
        compared: false,
        before: Some(&*last.fit),
        from_its_minimum: true,
        ..joint_request(session, &last.extension)
    })?;
    let anew = beside_names.data.decided_clocks();
    let pairs = || decided.iter().zip(&anew);
    if pairs().all(|(clock, anew)| clock.instants == anew.instants) {
        return Ok(None);
    }
    let merged = pairs().map(|(clock, anew)| SourceClock {
        instants: anew.instants,
        ..*clock
    });
    Ok(Some(merged.collect()))
}

#[cfg(test)]
mod tests {
    use simulate::{Grade, Motion, Sampling, Spec};

    use super::*;
    use crate::request::Request;
    use crate::state::Extension;

    /// Instants of quick turns, with a gyroscope that is far from linear.
    fn cubic_at_instants() -> Spec {
        let mut spec = Spec {
            grade: Grade::Tactical,
            sampling: Sampling::Point,
            ..Spec::hand_held(2)
        };
        if let Motion::HandHeld(motion) = &mut spec.motion {
            (motion.turn, motion.tremor) = ([0.6, 1.0], 0.0);
        }
        spec.with_effect("gyro_cubic", 3.0)
    }

    #[test]
    fn what_the_samples_are_is_seen_beside_the_name_that_was_missing() {
        let spec = cubic_at_instants();
        let recording = spec.run().unwrap().recording;
        let recordings = [recording];
        let mut session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        let base = State::fit(&session, Extension::default()).unwrap();
        session.clocks = Some(base.fit.data.decided_clocks());
        assert!(other_samples(&session, &base).unwrap().is_none());
        let mut named = Extension::default();
        let cubic = session.candidates.iter().find(|e| e.name() == "gyro_cubic");
        named.effects.push((cubic.unwrap().clone(), None));
        let named = State::fit(&session, named).unwrap();
        let clocks = other_samples(&session, &named).unwrap();
        let instants = clocks.or(session.clocks).unwrap()[0].instants;
        assert!(instants);
    }
}
