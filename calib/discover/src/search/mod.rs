//! Naming what is missing, one thing after the other, until the rest is noise.

pub mod few_turns;
mod held;
mod outlying_turns;
mod pairs;
mod ranking;
mod review;
mod together;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use estimate::methods::joint::{Data, Known};
use faer::Mat;
use findings::{Finding, Kind};
use outlying_turns::outlying_turns;
pub(crate) use ranking::{Ranking, VERTICAL};
use recording::Error;
pub use review::Either;
use sensor::{EffectRef, Sensor};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use self::held::Held;
use crate::family::{Claim, Family, Hypothesis};
use crate::rank::Ranked;
use crate::request::Session;
use crate::separation::Rivalry;
use crate::state::{Extension, State, with_companions};

/// Names at most; a device that seems to lack more is not understood.
const MOST_NAMES: usize = 6;

/// A temperature effect of second order must gain this over that of first order, in `χ²₃`.
const HIGHER_ORDER: f64 = 0.99;

/// Work that the joint fits of a search may take, in [`cost_of_fit`]: twenty fits of forty static intervals.
const MOST_WORK: f64 = 2e5;

/// And what they may take together in linearisations times samples of turns: forty fits of forty turns of 3 s at 200 Hz.
const MOST_LINEARISED: usize = 30_000_000;

/// Fewest fits of a search, however long one takes.
const FEWEST_FITS: usize = 6;

/// Returns the cost of a joint fit, in units of one with a single static interval. Recordings share few parameters and no
/// noise.
fn cost_of_fit(data: &Data) -> f64 {
    let of = |recording: usize| {
        let own = data.rests.iter().filter(|r| r.recording == recording);
        (own.count() as f64).powf(2.5)
    };
    (0..data.sources.len()).map(of).sum()
}

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
    fitted: Vec<State>,
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
            match &name.claim {
                Claim::Effect(effect) => less.remove(effect.name()),
                Claim::Disturbed(fault) => less
                    .disturbed
                    .retain(|own| own.fault != *fault || Some(own.place) != name.hypothesis.place),
                Claim::Shape(..) => {}
            }
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
        let stays = |name: &Name| match &name.claim {
            Claim::Effect(effect) => less.has(effect.name()),
            Claim::Disturbed(fault) => less
                .disturbed
                .iter()
                .any(|known| known.fault == *fault && Some(known.place) == name.hypothesis.place),
            Claim::Shape(..) => true,
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

/// Names what is missing.
///
/// # Errors
/// As the joint fit.
pub fn search(session: &Session<'_>, base: State) -> Result<Search, Error> {
    let most = MOST_WORK / cost_of_fit(&base.fit.data).max(1.0);
    let finder = Finder {
        session,
        catalogue: &session.candidates,
        threshold: session.request.threshold(),
        most_fits: (most as usize).max(FEWEST_FITS),
        fits: Cell::new(0),
        linearised: Cell::new(0),
        fitted: RefCell::new(vec![base.clone()]),
        rankings: RefCell::new(Vec::new()),
        base,
    };
    finder.run()
}

struct Finder<'a> {
    session: &'a Session<'a>,
    base: State,
    catalogue: &'a [EffectRef],
    threshold: f64,
    most_fits: usize,
    /// Fits so far.
    fits: Cell<usize>,
    /// Work of these fits.
    linearised: Cell<usize>,
    /// Their models: a review comes back to some of them.
    fitted: RefCell<Vec<State>>,
    /// Rankings, each with the model that it was made beside.
    rankings: RefCell<Vec<(Extension, Rc<Ranking>)>>,
}

impl Finder<'_> {
    /// Returns true if this many `more` fits would exceed the budget.
    fn is_spent(&self, more: usize) -> bool {
        self.fits.get() + more > self.most_fits || self.linearised.get() > MOST_LINEARISED
    }

    fn run(self) -> Result<Search, Error> {
        let mut held = outlying_turns(&self.base);
        let gross = held.len();
        let mut last = self.state(&held)?;
        let (mut first_ranking, mut not_observable) = (Vec::new(), Vec::new());
        let (mut spent, mut unfit) = (false, Vec::new());
        while held.len() < MOST_NAMES + gross {
            let ranking = self.ranked(&last);
            let (families, ranked) = (&ranking.families, &ranking.ranked);
            let next = self.next(families, ranked, &unfit);
            if held.len() == gross {
                first_ranking = ranking.first();
                not_observable = ranking.not_observable();
            }
            let next = match next {
                Some(next) => vec![next],
                None => self
                    .two_together(&last, &ranking, &unfit)
                    .map_or_else(Vec::new, |two| two.to_vec()),
            };
            if next.is_empty() {
                break;
            }
            // The next name, and the review of all.
            if self.is_spent(held.len() + next.len() + 1) {
                spent = true;
                break;
            }
            let before = held.len();
            held.extend(next);
            match self.state(&held) {
                Ok(state) => last = state,
                Err(Error::Cancelled) => return Err(Error::Cancelled),
                // A claim that the data do not hold together with is none.
                Err(_) => unfit.extend(held.drain(before..).map(|h| h.claim)),
            }
        }
        let reviewed = self.review(last, held)?;
        let spent = (spent || reviewed.is_spent).then(|| {
            Finding::of(Kind::SearchCutShort)
                .count("fits", self.fits.get())
                .count("count", self.base.fit.data.rests.len())
        });
        Ok(Search {
            spent,
            base: self.base,
            last: reviewed.last,
            names: reviewed.names,
            either: reviewed.either,
            evidence: reviewed.evidence,
            first_ranking,
            not_observable,
            fitted: self.fitted.into_inner(),
        })
    }

    /// The model with all that is held but one.
    fn without(&self, held: &[Held], k: usize) -> Result<State, Error> {
        let mut others = held.to_vec();
        others.remove(k);
        self.state(&others)
    }

    /// The model with all that is held, fitted unless it was before.
    fn state(&self, held: &[Held]) -> Result<State, Error> {
        let extension = self.extension(held);
        let mut fitted = self.fitted.borrow_mut();
        if let Some(known) = fitted.iter().find(|s| s.extension.is_same(&extension)) {
            return Ok(known.clone());
        }
        self.fits.set(self.fits.get() + 1);
        let state = State::fit(self.session, extension)?;
        self.linearised.set(self.linearised.get() + state.fit.work);
        fitted.push(state.clone());
        Ok(state)
    }

    fn extension(&self, held: &[Held]) -> Extension {
        let mut extension = Extension::default();
        for h in held {
            match &h.claim {
                Claim::Effect(effect) => {
                    extension.hold(effect.clone(), h.hypothesis.shape, self.catalogue);
                }
                Claim::Disturbed(fault) => {
                    extension.disturbed.extend(
                        h.hypothesis
                            .place
                            .map(|place| Known::disturbed(fault, place)),
                    );
                }
                Claim::Shape(..) => {}
            }
        }
        extension
    }

    fn ranked(&self, state: &State) -> Rc<Ranking> {
        let mut rankings = self.rankings.borrow_mut();
        let is_of = |(of, _): &&(Extension, _)| of.is_same(&state.extension);
        if let Some((_, ranking)) = rankings.iter().find(is_of) {
            return Rc::clone(ranking);
        }
        let ranking = Rc::new(Ranking::of(state, self.catalogue, self.threshold));
        rankings.push((state.extension.clone(), Rc::clone(&ranking)));
        ranking
    }

    /// The claim with the most evidence, where that is enough.
    fn next(&self, families: &[Family], ranked: &[Ranked], unfit: &[Claim]) -> Option<Held> {
        let may = |r: &&Ranked| {
            let own = &families[r.family].claim;
            !unfit.iter().any(|claim| claim.is_same(own))
        };
        let mut open = ranked.iter().filter(may);
        let top = open.find(|r| r.evidence > families[r.family].claim.needed(self.threshold))?;
        let chosen = self.simpler(families, ranked, top).unwrap_or(top);
        Some(Held::of(families, chosen))
    }

    /// The first order of a temperature effect, where the second does not gain enough over it.
    fn simpler<'r>(
        &self,
        families: &[Family],
        ranked: &'r [Ranked],
        top: &Ranked,
    ) -> Option<&'r Ranked> {
        let Claim::Effect(effect) = &families[top.family].claim else {
            return None;
        };
        let companion = with_companions(effect, self.catalogue).nth(1)?;
        let lower = ranked
            .iter()
            .find(|r| families[r.family].claim.name() == companion.name())?;
        let law = ChiSquared::new((top.dof - lower.dof).max(1.0)).ok()?;
        let gain = top.statistic - lower.statistic;
        (lower.evidence > self.threshold && gain < law.inverse_cdf(HIGHER_ORDER)).then_some(lower)
    }
}
