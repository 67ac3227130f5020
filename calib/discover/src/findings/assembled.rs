//! All that was found, as it is written to findings.json.

use ::findings::{Finding, Kind};
use estimate::calibrate::{untested_linearity, withdraw_explained};
use estimate::calibration::Calibration;
use estimate::methods::joint::SensorNoise;

use super::named::ranked_claim;
use super::typed::of_discovery;
use super::{EffectFinding, FINDINGS_SCHEMA, Findings, Verdict};
use crate::fault::integrity::Integrity;
use crate::gap::localise::disagreements;
use crate::propose::Proposal;
use crate::remainder::unexplained::Unexplained;
use crate::request::Session;
use crate::search::Search;
use crate::state::State;

/// The parts of findings.
pub struct Found {
    /// Effects with a name.
    pub effects: Vec<EffectFinding>,
    /// Faults of the recordings.
    pub faults: Vec<Integrity>,
    /// The residual that no name explains.
    pub rest: Option<Unexplained>,
    /// A formula for it.
    pub proposed: Option<Proposal>,
    /// The calibration of the final model.
    pub calibration: Calibration,
}

impl Found {
    /// The findings of a search.
    pub fn assembled(self, session: &Session<'_>, search: &Search) -> Findings {
        let Self {
            effects,
            faults,
            rest,
            proposed,
            mut calibration,
        } = self;
        let named = !effects.is_empty() || !faults.is_empty();
        let verdict = match (named, rest.is_some()) {
            (false, false) => Verdict::Nothing,
            (true, false) => Verdict::Named,
            (false, true) => Verdict::Unexplained,
            (true, true) => Verdict::NamedAndUnexplained,
        };
        let cut = session.recordings.iter();
        let cut = cut.map(|(_, choice)| Some(&choice.segmentation));
        let inputs = session.originals.iter().copied().zip(cut);
        calibration.state_inputs(inputs, None);
        let mut said = of_discovery(&effects, &faults, rest.as_ref());
        if calibration.warnings.has(Kind::RESTS_TURN) {
            // What remains is that motion, which is said first.
            let remains =
                |f: &&mut Finding| matches!(f.kind, Kind::MORE_SCATTER | Kind::DRIFT_AT_REST);
            let remainder = said.iter_mut().filter(remains);
            remainder.for_each(|found| found.consequence.clear());
        }
        calibration.warnings.extend(said);
        withdraw_explained(&mut calibration.warnings);
        let untested = untested_linearity(&calibration);
        calibration.warnings.extend(untested);
        let ranking = search.first_ranking.iter();
        Findings {
            schema: FINDINGS_SCHEMA,
            verdict,
            effects,
            integrity: faults,
            unexplained: rest,
            proposed,
            // What chance and a wandering bias explain is no disagreement.
            disagreement: match verdict {
                Verdict::Nothing => Vec::new(),
                _ => disagreements(&search.base, search.last.noise),
            },
            ranking: ranking.map(|(c, r)| ranked_claim(c, r)).collect(),
            not_observable: search.not_observable.clone(),
            never_visible: never_visible(),
            validation: Vec::new(),
            confirmations: Vec::new(),
            walks: search.last.noise.walk,
            bias_instability: search.last.noise.flicker,
            white: white(&search.last),
            calibration,
        }
    }
}

/// Kinds of errors that no hand-held recording shows: a free parameter takes each up.
fn never_visible() -> ::findings::Findings {
    let kinds = [
        Kind::GRAVITY_NEVER_SEEN,
        Kind::CLOCK_NEVER_SEEN,
        Kind::DISTANCE_NEVER_SEEN,
        Kind::DELAY_NEVER_SEEN,
        Kind::EARTH_NEVER_SEEN,
    ];
    kinds.map(Finding::of).to_vec().into()
}

/// White noise densities at low frequency of the first recording, the mean of the axes.
fn white(state: &State) -> [f64; 2] {
    let source = state.fit.data.sources.first();
    let density = |noise: Option<&SensorNoise>| {
        noise.map_or(0.0, |n| {
            n.white.component_mul(&n.long_run).mean() * n.interval.sqrt()
        })
    };
    [
        density(source.and_then(|s| s.accelerometer.as_ref())),
        density(source.and_then(|s| s.gyroscope.as_ref())),
    ]
}
