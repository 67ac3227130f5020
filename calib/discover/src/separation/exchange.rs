//! The search for the recording that tells tied effects apart.

use std::collections::BTreeSet;

use findings::{Finding, Kind};
use nalgebra::Vector3;
use plan::{ForceMatrix, Noise, Speed, Timing, best, sequence, tilts, ways};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use recording::Error;
use recording::watch::Stage;

use super::aim::{Aim, SETTLED, Separated};
use super::design::{Conditions, Design};
use super::rivalry::Rivalry;

/// More than this is not aimed at: the sizes of the effects are estimates.
const ENOUGH: f64 = 3.0 * SETTLED;

/// Placements that are tried where their number is not given.
const COUNTS: [usize; 3] = [12, 24, 36];

findings::tuning! {
    /// More placements have to gain this share of what fewer came to.
    WORTH_MORE: f64 = 1.1;

    /// Exchange is worth its time from this share of what settles on.
    NEARLY: f64 = 0.5;

    /// Rounds of exchange.
    ROUNDS: usize = 10;
    /// Designs beside the best that each round looks at.
    TRIALS: usize = 8;

    /// Changes of one trial.
    CHANGES: usize = 3;

    /// Cost of a minute, in units of `ln(1 + separation)`.
    MINUTE: f64 = 0.02;

    /// The longer kind of a static interval, s.
    LONG_REST: f64 = 20.0;
    /// The longer kind of the first one, s.
    LONG_FIRST: f64 = 300.0;

    /// The first rest of one who leaves the device alone for a while, s.
    PATIENT_FIRST: f64 = 900.0;
}

/// A design with what it separates and how good that is.
#[derive(Clone, Debug)]
struct Judged {
    design: Design,
    separations: Vec<f64>,
    value: f64,
}

impl Judged {
    fn of(design: Design, rivalries: &[Rivalry], conditions: &Conditions) -> Self {
        let separations = design.separations(rivalries, conditions);
        let gained: f64 = separations.iter().map(|s| s.min(ENOUGH).ln_1p()).sum();
        Self {
            value: gained - MINUTE.get() * design.duration() / 60.0,
            separations,
            design,
        }
    }

    /// Returns the least separation, at most [`SETTLED`].
    fn reached(&self) -> f64 {
        self.separations
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min)
            .min(SETTLED)
    }

    fn is_enough(&self) -> bool {
        self.separations.iter().all(|s| *s >= ENOUGH)
    }
}

/// The recording of `count` placements that tells the rivals apart best beside what was recorded; of as few as settle it where
/// no number is given.
///
/// Exchange of placements, ways and speeds from several starts with a fixed number of trials, each simulated, fitted and asked
/// what the effects would do there. The same call gives the same design.
///
/// # Errors
/// Nothing to separate; cancelled.
pub fn separate(
    rivalries: &[Rivalry],
    count: Option<usize>,
    conditions: &Conditions,
) -> Result<Aim, Error> {
    if rivalries.is_empty() {
        return Err(Error::not_enough(Finding::of(Kind::NOTHING_TIED)));
    }
    let counts = count.map_or(COUNTS.to_vec(), |count| vec![count]);
    let mut best: Option<Judged> = None;
    for (k, count) in counts.iter().enumerate() {
        let start = judge(starts(*count, conditions), rivalries, conditions)
            .ok_or_else(|| Error::not_enough(Finding::of(Kind::NO_PLACEMENTS)))?;
        // What is far from settled by any start wants more placements, not better ones.
        let found = if start.reached() >= NEARLY.get() * SETTLED || k + 1 == counts.len() {
            exchanged(start, *count, rivalries, conditions)?
        } else {
            start
        };
        if best
            .as_ref()
            .is_none_or(|b| found.reached() > WORTH_MORE.get() * b.reached())
        {
            best = Some(found);
        }
        if best.as_ref().is_some_and(|b| b.reached() >= SETTLED) {
            break;
        }
    }
    let Some(Judged {
        design,
        separations,
        ..
    }) = best
    else {
        return Err(Error::not_enough(Finding::of(Kind::NO_PLACEMENTS)));
    };
    let warmed = Design {
        warmed: true,
        ..design.clone()
    };
    let mut longer = design.clone();
    (longer.timing.rest, longer.timing.first_rest) = (LONG_REST.get(), LONG_FIRST.get());
    let others = [warmed, longer];
    let others: Vec<Vec<f64>> = others
        .par_iter()
        .map(|design| design.separations(rivalries, conditions))
        .collect();
    let ties = rivalries.iter().enumerate().map(|(k, rivalry)| Separated {
        named: rivalry.named.name.clone(),
        other: rivalry.other.name.clone(),
        before: rivalry.separation,
        after: separations[k],
        if_warmed: others[0][k],
        if_longer: others[1][k],
        settles: rivalry.named.settles() || rivalry.other.settles(),
        of_an_instant: rivalry.named.is_of_an_instant() || rivalry.other.is_of_an_instant(),
    });
    Ok(Aim {
        ties: ties.collect(),
        design,
    })
}

/// The best of some designs.
fn judge(designs: Vec<Design>, rivalries: &[Rivalry], conditions: &Conditions) -> Option<Judged> {
    let all: Vec<Judged> = designs
        .into_par_iter()
        .map(|design| Judged::of(design, rivalries, conditions))
        .collect();
    let better = |a: &Judged, b: &Judged| a.value.total_cmp(&b.value);
    all.into_iter().rev().max_by(better)
}

/// Exchanges placements, ways and speeds of a design, as long as that is not enough.
fn exchanged(
    mut best: Judged,
    seed: usize,
    rivalries: &[Rivalry],
    conditions: &Conditions,
) -> Result<Judged, Error> {
    let candidates = tilts();
    let mut random = ChaCha8Rng::seed_from_u64(seed as u64);
    for _ in 0..ROUNDS.get() {
        conditions.watch.step(Stage::Searching)?;
        if best.is_enough() {
            break;
        }
        let trials = (0..TRIALS.get()).map(|_| changed(&best.design, &candidates, &mut random));
        match judge(trials.collect(), rivalries, conditions) {
            Some(found) if found.value > best.value => best = found,
            _ => {}
        }
    }
    Ok(best)
}

/// The placements that a corrected reading wants, and some in all directions, with turns of one speed and of all, with short
/// and with long rests.
fn starts(count: usize, conditions: &Conditions) -> Vec<Design> {
    let usual = conditions.timing;
    let long = Timing {
        rest: usual.rest.max(LONG_REST.get()),
        ..usual
    };
    let wait = Timing {
        first_rest: usual.first_rest.max(LONG_FIRST.get()),
        ..usual
    };
    let patient = Timing {
        first_rest: usual.first_rest.max(PATIENT_FIRST.get()),
        ..long
    };
    let best = best(count, &ForceMatrix::zeros());
    let candidates = tilts();
    let mut random = ChaCha8Rng::seed_from_u64(count as u64);
    let spread = (0..count).map(|_| candidates[random.random_range(0..candidates.len())]);
    let spread: Vec<Vector3<f64>> = spread.collect();
    let noise = Noise {
        force: conditions.white[0],
        rate: conditions.white[1],
        gravity: conditions.gravity,
        ..Noise::default()
    };
    let mut all = Vec::new();
    for ups in [best, spread] {
        let none = plan::Information::zeros();
        let found = sequence(&ups, None, &none, &noise, &usual);
        let ordered: Vec<Vector3<f64>> = found.order.iter().map(|k| ups[*k]).collect();
        for timing in [usual, long, wait, patient] {
            for mixed in [false, true] {
                let mut turns = found.turns.clone();
                for (k, turn) in turns.iter_mut().enumerate().filter(|_| mixed) {
                    turn.speed = Speed::ALL[k % Speed::ALL.len()];
                }
                all.push(Design {
                    ups: ordered.clone(),
                    turns,
                    timing,
                    warmed: conditions.warmed,
                });
            }
        }
    }
    all
}

/// A few placements, ways or speeds are others.
fn changed(design: &Design, candidates: &[Vector3<f64>], random: &mut ChaCha8Rng) -> Design {
    let mut design = design.clone();
    let mut moved = BTreeSet::new();
    for _ in 0..CHANGES.get() {
        let turns = design.turns.len().max(1);
        match random.random_range(0..3) {
            0 => {
                let k = random.random_range(0..design.ups.len());
                design.ups[k] = candidates[random.random_range(0..candidates.len())];
                moved.extend([k.saturating_sub(1), k.min(turns - 1)]);
            }
            1 => {
                moved.insert(random.random_range(0..turns));
            }
            _ => {
                let k = random.random_range(0..turns);
                if let Some(turn) = design.turns.get_mut(k) {
                    turn.speed = Speed::ALL[random.random_range(0..Speed::ALL.len())];
                }
            }
        }
    }
    for k in moved {
        let (Some(turn), [from, to]) = (design.turns.get_mut(k), &design.ups[k..k + 2]) else {
            continue;
        };
        let all = ways(from, to);
        let way = random.random_range(0..all.len());
        turn.way = all[way].way;
        turn.legs.clone_from(&all[way].legs);
    }
    design
}
