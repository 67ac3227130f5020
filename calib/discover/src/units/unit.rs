//! One unit among several: its session, what it says alone, and its model.

use ::findings::{Finding, Front, Kind};
use estimate::calibrate::is_determined;
use estimate::calibration::{Calibration, EffectParameter};
use estimate::methods::joint::BiasNoise;
use recording::{Error, Recording};
use sensor::EffectRef;

use super::findings::UnitAlone;
use crate::calibrated::calibration;
use crate::discovery::discover_in;
use crate::findings::Findings;
use crate::findings::named::parameters_of;
use crate::gap::sequence::{Misfit, Sequence};
use crate::request::{Request, Session};
use crate::state::{Extension, State};

/// A unit with its model.
#[derive(Clone, Debug)]
pub(super) struct Unit<'a> {
    pub name: String,
    session: Session<'a>,
    alone: UnitAlone,
    pub state: State,
    /// Ratio of this unit's unexplained misfit to its noise, at least 1: likelihood ratios are too large by its square.
    pub excess: f64,
}

impl<'a> Unit<'a> {
    /// Its base models with the faults of its own recording.
    ///
    /// # Errors
    /// As [`discover`](crate::discover).
    pub fn new(recording: &'a [&'a Recording; 1], request: &Request) -> Result<Self, Error> {
        let mut session = Session::new(recording, request)?;
        let [recording] = recording;
        let discovery = discover_in(&mut session)?;
        let faults = Extension {
            disturbed: discovery.search.last.extension.disturbed.clone(),
            ..Extension::default()
        };
        let state = State::fit(&session, faults)?;
        let findings = &discovery.findings;
        Ok(Self {
            name: recording.name.clone(),
            alone: alone(recording, findings),
            excess: findings
                .unexplained
                .as_ref()
                .map_or(1.0, |rest| rest.size.max(1.0)),
            session,
            state,
        })
    }

    /// Returns true if its evidence counts for the type.
    pub fn is_counted(&self) -> bool {
        self.alone.left_out.is_none()
    }

    /// Returns the findings about this unit by itself.
    pub fn alone(&self) -> UnitAlone {
        self.alone.clone()
    }

    /// Takes an effect into the model; whether the recording determines it.
    ///
    /// # Errors
    /// That it was cancelled.
    pub fn take_in(
        &mut self,
        effect: EffectRef,
        shape: Option<(usize, f64)>,
        catalogue: &[EffectRef],
    ) -> Result<bool, Error> {
        let mut extension = self.state.extension.clone();
        extension.hold(effect, shape, catalogue);
        let state = match State::fit(&self.session, extension) {
            Ok(state) => state,
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            // A claim that the data do not hold together with is none.
            Err(_) => return Ok(false),
        };
        let is_determined = is_determined(&state.fit);
        if is_determined {
            self.state = state;
        }
        Ok(is_determined)
    }

    /// The unit without an effect in its model.
    ///
    /// # Errors
    /// As the joint fit.
    pub fn without(&self, effect: &EffectRef) -> Result<Self, Error> {
        let mut unit = self.clone();
        if self.state.has(effect.name()) {
            let mut extension = self.state.extension.clone();
            extension.remove(effect.name());
            unit.state = State::fit(&self.session, extension)?;
        }
        Ok(unit)
    }

    /// The parameters of an effect of its model.
    ///
    /// # Errors
    /// A calibration that the recording does not determine.
    pub fn parameters(&self, effect: &EffectRef) -> Result<Vec<EffectParameter>, Error> {
        let calibration = calibration(&self.session, &self.state)?;
        Ok(parameters_of(effect.name(), &calibration))
    }

    /// Computes the misfit of each channel.
    pub fn misfits(&self, noise: BiasNoise) -> [Misfit; 3] {
        Sequence::of(&self.state, noise).misfits(&self.state)
    }
}

fn alone(recording: &Recording, findings: &Findings) -> UnitAlone {
    let mut integrity: Vec<String> = findings
        .integrity
        .iter()
        .map(|i| i.name.to_string())
        .collect();
    integrity.sort();
    integrity.dedup();
    UnitAlone {
        recording: recording.name.clone(),
        verdict: findings.verdict,
        effects: findings.effects.iter().map(|e| e.name.clone()).collect(),
        integrity,
        faults: findings.integrity.clone(),
        unexplained: findings.unexplained.as_ref().map(|u| u.shape()),
        left_out: left_out(findings),
        warnings: findings.calibration.warnings.texts(Front::CommandLine),
        failed_gates: findings.calibration.failed_gates.texts(Front::CommandLine),
    }
}

/// Why what a unit shows says nothing of its type: a wrong axis, unit or latitude does to the readings what an error of the
/// sensor may do.
fn left_out(findings: &Findings) -> Option<String> {
    let Calibration {
        failed_gates,
        warnings,
        ..
    } = &findings.calibration;
    let is_of_the_place = |found: &&Finding| found.kind == Kind::LATITUDE_DOUBTFUL;
    let first = failed_gates
        .first()
        .or_else(|| warnings.iter().find(is_of_the_place));
    first.map(|found| found.text(Front::CommandLine))
}
