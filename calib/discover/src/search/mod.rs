//! Naming what is missing, one thing after the other, until the rest is noise.

mod all_together;
pub mod few_turns;
mod named_claim;
mod names;
mod outlying_turns;
mod pairs;
mod ranking;
mod review;
pub(super) mod samples;
mod two_together;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use estimate::methods::joint::Data;
use findings::{Finding, Kind};
pub use names::{Either, Name, Search, Tie};
use outlying_turns::outlying_turns;
pub(crate) use ranking::{Ranking, VERTICAL};
use recording::Error;
use sensor::EffectRef;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use self::named_claim::NamedClaim;
use crate::family::{Claim, Family};
use crate::rank::Ranked;
use crate::request::Session;
use crate::state::{Extension, State, with_companions};

findings::tuning! {
    /// Names at most; a device that seems to lack more is not understood.
    MOST_NAMES: usize = 6;

    /// A temperature effect of second order must gain this over that of first order, in `χ²₃`.
    HIGHER_ORDER: f64 = 0.99;

    /// Work that the joint fits of a search may take, in [`cost_of_fit`]: twenty fits of forty static intervals.
    MOST_WORK: f64 = 2e5;

    /// And what they may take together in linearisations times samples of turns: forty fits of forty turns of 3 s at 200 Hz.
    MOST_LINEARISED: usize = 30_000_000;

    /// Fewest fits of a search, however long one takes.
    FEWEST_FITS: usize = 6;
}

/// Returns the cost of a joint fit, in units of one with a single static interval. Recordings share few parameters and no
/// noise.
fn cost_of_fit(data: &Data) -> f64 {
    let of = |recording: usize| {
        let own = data.rests.iter().filter(|r| r.recording == recording);
        (own.count() as f64).powf(2.5)
    };
    (0..data.sources.len()).map(of).sum()
}

/// Names what is missing.
///
/// # Errors
/// As the joint fit.
pub fn search(session: &Session<'_>, base: State) -> Result<Search, Error> {
    let most = MOST_WORK.get() / cost_of_fit(&base.fit.data).max(1.0);
    let finder = Finder {
        session,
        catalogue: &session.candidates,
        threshold: session.request.threshold(),
        most_fits: (most as usize).max(FEWEST_FITS.get()),
        fits: Cell::new(0),
        linearised: Cell::new(0),
        fitted: RefCell::new(vec![base.clone()]),
        rankings: RefCell::new(Vec::new()),
        base: base.clone(),
    };
    let mut held = outlying_turns(&base);
    let gross = held.len();
    let mut last = finder.state(&held)?;
    let (mut first_ranking, mut not_observable) = (Vec::new(), Vec::new());
    let (mut spent, mut unfit) = (false, Vec::new());
    while held.len() < MOST_NAMES.get() + gross {
        let ranking = finder.ranked(&last);
        let (families, ranked) = (&ranking.families, &ranking.ranked);
        let next = finder.next(families, ranked, &unfit);
        if held.len() == gross {
            first_ranking = ranking.first();
            not_observable = ranking.not_observable();
        }
        let next = match next {
            Some(next) => vec![next],
            None => finder
                .two_together(&last, &ranking, &unfit)
                .map_or_else(Vec::new, |two| two.to_vec()),
        };
        if next.is_empty() {
            break;
        }
        // The next name, and the review of all.
        if finder.is_spent(held.len() + next.len() + 1) {
            spent = true;
            break;
        }
        let before = held.len();
        held.extend(next);
        match finder.state(&held) {
            Ok(state) => last = state,
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            // A claim that the data do not hold together with is none.
            Err(_) => unfit.extend(held.drain(before..).map(|h| h.claim)),
        }
    }
    let reviewed = finder.review(last, held)?;
    let spent = (spent || reviewed.is_spent).then(|| {
        Finding::of(Kind::SEARCH_CUT_SHORT)
            .count("fits", finder.fits.get())
            .count("count", base.fit.data.rests.len())
    });
    Ok(Search {
        spent,
        base,
        last: reviewed.last,
        names: reviewed.names,
        either: reviewed.either,
        evidence: reviewed.evidence,
        first_ranking,
        not_observable,
        fitted: finder.fitted.into_inner(),
    })
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
        self.fits.get() + more > self.most_fits || self.linearised.get() > MOST_LINEARISED.get()
    }

    /// The model with all that is held but one.
    fn without(&self, held: &[NamedClaim], k: usize) -> Result<State, Error> {
        let mut others = held.to_vec();
        others.remove(k);
        self.state(&others)
    }

    /// The model with all that is held, fitted unless it was before.
    fn state(&self, held: &[NamedClaim]) -> Result<State, Error> {
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

    fn extension(&self, held: &[NamedClaim]) -> Extension {
        let mut extension = Extension::default();
        for h in held {
            h.claim
                .put_in(&mut extension, &h.hypothesis, self.catalogue);
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
    fn next(&self, families: &[Family], ranked: &[Ranked], unfit: &[Claim]) -> Option<NamedClaim> {
        let may = |r: &&Ranked| {
            let own = &families[r.family].claim;
            !unfit.iter().any(|claim| claim.is_same(own))
        };
        let mut open = ranked.iter().filter(may);
        let top = open.find(|r| r.evidence > families[r.family].claim.needed(self.threshold))?;
        let chosen = self.simpler(families, ranked, top).unwrap_or(top);
        Some(NamedClaim::of(families, chosen))
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
        (lower.evidence > self.threshold && gain < law.inverse_cdf(HIGHER_ORDER.get()))
            .then_some(lower)
    }
}
