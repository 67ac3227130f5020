//! Names, what else they may be, and the models on the way to them.

use estimate::methods::joint::Known;
use faer::Mat;
use findings::Finding;
use recording::Error;
use sensor::Sensor;

use crate::family::{Claim, Family, Hypothesis};
use crate::rank::Ranked;
use crate::request::Session;
use crate::separation::Rivalry;
use crate::state::{Extension, State};

/// Something named.
#[derive(Clone, Debug)]
pub struct Name {
    /// The claim.
    pub claim: Claim,
    /// In which way.
    pub hypothesis: Hypothesis,
    /// The evidence for it, everything else that is named being in the model.
    pub ranked: Ranked,
    /// Other claims that these recordings cannot tell from it.
    pub ties: Vec<Tie>,
    /// The model with everything else that is named.
    pub without: State,
    /// Its columns (`m × k`), white-whitened.
    pub columns: Mat<f64>,
}

impl Name {
    /// The best of a family's hypotheses, beside the model `without` it.
    pub(crate) fn of(families: &[Family], ranked: &Ranked, without: State, ties: Vec<Tie>) -> Self {
        let family = &families[ranked.family];
        Self {
            claim: family.claim.clone(),
            hypothesis: family.hypotheses[ranked.hypothesis].clone(),
            columns: family.columns_of(ranked.hypothesis),
            ranked: ranked.clone(),
            ties,
            without,
        }
    }

    /// The sensor whose bias it says to step at an instant; `None` of anything else.
    pub(crate) fn stepping(&self) -> Option<Sensor> {
        let effect = self.claim.effect()?;
        effect.instant().map(|_| effect.sensor())
    }

    /// `E β`: the contribution of the estimate to the rows (`m × 1`), white-whitened.
    pub fn predicted(&self) -> Mat<f64> {
        let change = &self.ranked.score.change;
        &self.columns * Mat::from_fn(self.columns.ncols(), 1, |i, _| change[i])
    }
}

/// A claim that explains the data about as well as the named one.
#[derive(Clone, Debug)]
pub struct Tie {
    /// The claim.
    pub claim: Claim,
    /// The share of what the named one explains that it explains too, `ρ²`.
    pub shared: f64,
    /// Separation of the two, where both are effects.
    pub rivalry: Option<Rivalry>,
}

/// A disturbance with what else it may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Either {
    /// Disturbance in the model.
    pub known: Known,
    /// Names of what explains the data about as well.
    pub or: Vec<String>,
}

impl Either {
    /// `None` where nothing has another name.
    pub(super) fn of(known: Known, ties: impl Iterator<Item = String>) -> Option<Self> {
        let own = Claim::Disturbed(known.fault);
        let mut or: Vec<String> = Vec::new();
        for name in ties {
            if name != own.name() && !or.contains(&name) {
                or.push(name);
            }
        }
        (!or.is_empty()).then_some(Self { known, or })
    }
}

/// All names and the models on the way.
#[derive(Clone, Debug)]
pub struct Search {
    /// The base models.
    pub base: State,
    /// The model with everything named.
    pub last: State,
    /// Claims that were named, most evident first, without the disturbances that are significant by their own parameters.
    pub names: Vec<Name>,
    /// Disturbances that these recordings cannot tell from something else.
    pub either: Vec<Either>,
    /// The evidence for all that was named, by likelihood ratios: together, as one was found after the other, or each beside the
    /// others, whichever says more.
    pub evidence: f64,
    /// The ranking against the base models, best first.
    pub first_ranking: Vec<(Claim, Ranked)>,
    /// Effects that the recordings would not show, had the device them.
    pub not_observable: Vec<String>,
    /// Finding that the search stopped early, as it would have taken too long.
    pub spent: Option<Finding>,
    /// Models that were fitted on the way.
    pub(super) fitted: Vec<State>,
}

impl Search {
    /// The base models, with nothing looked for.
    pub fn of(base: State) -> Self {
        Self {
            last: base.clone(),
            fitted: vec![base.clone()],
            base,
            names: Vec::new(),
            either: Vec::new(),
            evidence: 0.0,
            first_ranking: Vec::new(),
            not_observable: Vec::new(),
            spent: None,
        }
    }

    /// The base models, without any name: the names that go.
    pub fn withdraw_all(&mut self) -> Vec<String> {
        self.last = self.base.clone();
        self.evidence = 0.0;
        let names = std::mem::take(&mut self.names).into_iter();
        names.map(|name| name.claim.name().into()).collect()
    }

    /// Withdraws the names that go, with what they brought into the model: whether there are any.
    ///
    /// # Errors
    /// As the joint fit.
    pub fn withdraw_where(
        &mut self,
        session: &Session<'_>,
        goes: impl Fn(&Name) -> bool,
    ) -> Result<bool, Error> {
        let mut less = self.last.extension.clone();
        for name in self.names.iter().filter(|name| goes(name)) {
            name.claim.take_out_of(&mut less, &name.hypothesis);
        }
        let has_fewer = !less.is_same(&self.last.extension);
        if has_fewer {
            self.withdraw_to(session, less)?;
        }
        Ok(has_fewer)
    }

    /// The model with less in it: the names that go.
    ///
    /// # Errors
    /// As the joint fit.
    pub fn withdraw_to(
        &mut self,
        session: &Session<'_>,
        less: Extension,
    ) -> Result<Vec<String>, Error> {
        let stays = |name: &Name| {
            let is_shape = matches!(name.claim, Claim::Shape(..));
            is_shape || name.claim.is_in(&less, &name.hypothesis)
        };
        let gone = self.names.iter().filter(|name| !stays(name));
        let gone = gone.map(|name| name.claim.name().into()).collect();
        self.names.retain(stays);
        self.last = self.fit(session, less)?;
        Ok(gone)
    }

    /// The model with an extension, fitted unless it was before.
    ///
    /// # Errors
    /// As the joint fit.
    pub fn fit(&mut self, session: &Session<'_>, extension: Extension) -> Result<State, Error> {
        let all = self.fitted.iter().chain([&self.last]);
        if let Some(known) = all.into_iter().find(|s| s.extension.is_same(&extension)) {
            return Ok(known.clone());
        }
        let state = State::fit(session, extension)?;
        self.fitted.push(state.clone());
        Ok(state)
    }
}
