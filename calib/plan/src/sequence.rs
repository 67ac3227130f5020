//! In which order placements come, and by which way from one to the next.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::accelerometer::{ForceMatrix, ForceRow, force_covariance, force_row};
use crate::direction::{edges, faces};
use crate::requirement::REQUIREMENT;
use crate::session::{
    Chain, Information, Link, Noise, Place, Timing, place, reading_errors, variances,
};
use crate::turn::{Turn, Way, ways};

/// Sequences looked at, each an information matrix of both sensors: of placements that are given, and of ones to choose.
const BUDGET: [usize; 2] = [9000, 90_000];

findings::tuning! {
    /// Random orders to begin with.
    STARTS: usize = 5;
    /// A sequence that is worse by about this share is taken at first, to come out of a hollow.
    WARMTH: f64 = 0.03;
    /// Share of the steps after which none that is worse is taken.
    WARM: f64 = 0.85;
    /// Weight of the imbalance between the errors of both sensors.
    BALANCE: f64 = 0.5;
    /// The errors of both sensors are in balance where that of the gyroscope is so much of what a quarter turn misses, as in the
    /// sessions that are best by their product without regard to the hand.
    IN_BALANCE: f64 = 0.49;
    /// The cost of a session whose norms of gravity alone do not tell the accelerometer's parameters, in `ln` of the errors.
    NOT_BY_NORMS: f64 = 1.0;
    /// Directions closer than this are one.
    SAME: f64 = 1e-6;
}

/// Placements in order with the turns between them.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// The places of the placements in the list they were given in.
    pub order: Vec<usize>,
    /// From each to the next; with a start the first leads from it.
    pub turns: Vec<Turn>,
    /// All information, that known before included.
    pub information: Information,
}

/// The best order and ways of `ups`, from `start` where the device lies already, beside what is known: the faces first, and
/// the product of the errors of corrected readings of both sensors the least for what a hand has to do.
///
/// Simulated annealing from random orders with a fixed number of trials: reversals, swaps and other ways. The same call
/// gives the same sequence.
pub fn sequence(
    ups: &[Vector3<f64>],
    start: Option<&Vector3<f64>>,
    known: &Information,
    noise: &Noise,
    timing: &Timing,
) -> Sequence {
    let mut all: Vec<Vector3<f64>> = start.into_iter().copied().collect();
    all.extend_from_slice(ups);
    let begin = usize::from(start.is_some());
    let mut first = in_order_of_faces(ups);
    first.iter_mut().for_each(|k| *k += begin);
    let fixed: Vec<usize> = (0..begin).chain(first).collect();
    let others = (0..all.len()).filter(|k| !fixed.contains(k)).collect();
    let search = Search {
        table: &Table::new(&all, noise, timing),
        known,
        noise,
        first_known: begin == 1,
        others: Vec::new(),
        told_by_norms: false,
        balance: balance(noise, timing),
    };
    let mut found = search.best(&fixed, others);
    found.order = found.order.split_off(begin.min(found.order.len()));
    found.order.iter_mut().for_each(|k| *k -= begin);
    found
}

/// The best session of `count` placements from nothing that a hand can follow: the faces first, then edges (and faces again)
/// that lower the errors of both sensors most, as [`sequence`]; the placements in order beside it. From as many placements on as
/// [`REQUIREMENT`] asks for, the norms of gravity alone tell the accelerometer's parameters as well as it asks.
pub fn session_of(count: usize, noise: &Noise, timing: &Timing) -> (Vec<Vector3<f64>>, Sequence) {
    // A corner is hard to hold, and turns between corners hard to say.
    let all = [faces().to_vec(), edges()].concat();
    let first: Vec<usize> = in_order_of_faces(&all).into_iter().take(count).collect();
    let mut search = Search {
        table: &Table::new(&all, noise, timing),
        known: &Information::zeros(),
        noise,
        first_known: false,
        others: (0..all.len()).collect(),
        told_by_norms: false,
        balance: balance(noise, timing),
    };
    let edge = faces().len();
    let begin: Vec<usize> = (first.len()..count)
        .map(|k| edge + k % edges().len())
        .collect();
    let mut found = search.best(&first, begin.clone());
    if count >= REQUIREMENT.placements && !search.table.tells_by_norms(&found.order) {
        search.told_by_norms = true;
        found = search.best(&first, begin);
    }
    let ups = found.order.iter().map(|k| all[*k]).collect();
    found.order = (0..found.order.len()).collect();
    (ups, found)
}

/// The places of the faces among `ups` in the order they are asked for: z up, z down, x up, x down, y up, y down.
fn in_order_of_faces(ups: &[Vector3<f64>]) -> Vec<usize> {
    let faces = faces();
    let wanted = [4, 5, 0, 1, 2, 3].map(|k| faces[k]);
    let place = |face: Vector3<f64>| ups.iter().position(|up| (up - face).norm() < SAME.get());
    wanted.into_iter().filter_map(place).collect()
}

/// See [`IN_BALANCE`].
fn balance(noise: &Noise, timing: &Timing) -> f64 {
    let force = (noise.force.powi(2) / timing.used(1) + noise.placement.powi(2)).sqrt();
    let quarter = (FRAC_PI_2 / timing.pace.rate).max(timing.pace.shortest) + 2.0 * timing.cut;
    let directions = 2.0 * (force / noise.gravity).powi(2);
    let turn = (directions + noise.rate.powi(2) * quarter + noise.turn.powi(2)).sqrt();
    IN_BALANCE.get() * turn / force
}

/// Returns the effort of a turn for a hand, as the relative reduction of the product of both sensors' errors that
/// justifies it.
fn effort(turn: &Turn) -> f64 {
    match turn.way {
        Way::Short => 0.0,
        Way::Via | Way::Long => 0.002,
        Way::SpinLeft | Way::SpinRight => 0.004,
        Way::Round => 0.012,
    }
}

/// The same of a placement: corners are hard to hold.
fn hold(up: &Vector3<f64>) -> f64 {
    let parts = up.iter().filter(|c| c.abs() > SAME.get()).count();
    [0.0, 0.0, 0.002, 0.008][parts]
}

/// All turns between all placements.
struct Table {
    links: Vec<Vec<Vec<Link>>>,
    turns: Vec<Vec<Vec<Turn>>>,
    first: Vec<Place>,
    later: Vec<Place>,
    hold: Vec<f64>,
    /// Information of each on the accelerometer by its norm alone.
    norm: Vec<ForceRow>,
}

impl Table {
    fn new(all: &[Vector3<f64>], noise: &Noise, timing: &Timing) -> Self {
        let turns: Vec<Vec<Vec<Turn>>> = all
            .iter()
            .map(|from| all.iter().map(|to| ways(from, to)).collect())
            .collect();
        let link = |i: usize, j: usize| {
            let carry = |turn: &Turn| {
                let carried = turn.carry(&timing.pace);
                Link::new(&all[i], &all[j], &carried, noise, timing.cut)
            };
            turns[i][j].iter().map(carry).collect()
        };
        let count = all.len();
        Self {
            links: (0..count)
                .map(|i| (0..count).map(|j| link(i, j)).collect())
                .collect(),
            first: all.iter().map(|up| place(up, 0, timing)).collect(),
            later: all.iter().map(|up| place(up, 1, timing)).collect(),
            hold: all.iter().map(hold).collect(),
            norm: all.iter().map(force_row).collect(),
            turns,
        }
    }

    /// Returns true if the norms of gravity in these placements tell every parameter of the accelerometer as [`REQUIREMENT`] asks.
    fn tells_by_norms(&self, order: &[usize]) -> bool {
        let rows = order.iter().map(|k| self.norm[*k]);
        let information: ForceMatrix = rows.map(|row| row * row.transpose()).sum();
        let covariance = force_covariance(&information);
        let largest = covariance.map(|c| c.diagonal().max().sqrt());
        largest.is_some_and(|error| error <= REQUIREMENT.largest_error)
    }
}

/// An order, and the way of each turn.
#[derive(Clone, Debug, Default)]
struct Path {
    order: Vec<usize>,
    ways: Vec<usize>,
}

impl Path {
    fn pairs(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        let pairs = self.order.windows(2).zip(&self.ways);
        pairs.map(|(pair, way)| (pair[0], pair[1], *way))
    }
}

struct Search<'a> {
    table: &'a Table,
    known: &'a Information,
    noise: &'a Noise,
    /// The first placement is in what is known already.
    first_known: bool,
    /// Candidates that may replace a placement.
    others: Vec<usize>,
    /// True if the norms of gravity have to tell the accelerometer's parameters without the turns.
    told_by_norms: bool,
    /// The gyroscope's error in rad/s for 1 m/s² of the accelerometer's where both are alike.
    balance: f64,
}

impl<'a> Search<'a> {
    /// The best of a few starts, `fixed` first.
    fn best(&self, fixed: &[usize], movable: Vec<usize>) -> Sequence {
        let mut random = ChaCha8Rng::seed_from_u64((fixed.len() + movable.len()) as u64);
        let mut best: Option<(f64, Path)> = None;
        for _ in 0..STARTS.get() {
            let mut order = [fixed, &movable].concat();
            for k in (fixed.len() + 1..order.len()).rev() {
                order.swap(k, random.random_range(fixed.len()..=k));
            }
            let found = self.improve(order, fixed.len(), &mut random);
            if best.as_ref().is_none_or(|(value, _)| found.0 < *value) {
                best = Some(found);
            }
        }
        let path = best.map_or_else(Path::default, |(_, path)| path);
        Sequence {
            information: self.information(&path),
            turns: path
                .pairs()
                .map(|(from, to, way)| self.table.turns[from][to][way].clone())
                .collect(),
            order: path.order,
        }
    }

    fn information(&self, path: &Path) -> Information {
        let chains = self.follow(path, 0, None);
        chains
            .last()
            .map_or(*self.known, |chain| chain.clone().close())
    }

    /// Returns the chains after each placement of `path` from place `begin` on; `before` is the chain before that
    /// place.
    fn follow(&self, path: &Path, begin: usize, before: Option<&Chain<'a>>) -> Vec<Chain<'a>> {
        let mut chains: Vec<Chain<'a>> = Vec::with_capacity(path.order.len() - begin);
        for (k, to) in path.order.iter().enumerate().skip(begin) {
            let next = match chains.last().or(before).filter(|_| k > 0) {
                Some(chain) => {
                    let ways = &self.table.links[path.order[k - 1]][*to];
                    let mut chain = chain.clone();
                    chain.turn_to(&ways[path.ways[k - 1]], &self.table.later[*to]);
                    chain
                }
                None => {
                    let first = if self.first_known {
                        &self.table.later
                    } else {
                        &self.table.first
                    };
                    let mut chain = Chain::new(self.known, self.noise);
                    chain.begin(&first[*to]);
                    chain
                }
            };
            chains.push(next);
        }
        chains
    }

    /// `ln` of the product of the errors and what a hand has to do; where parameters are open, far above, less with more
    /// information.
    fn value(&self, path: &Path, last: Option<&Chain<'a>>) -> f64 {
        let turns = path.pairs();
        let efforts = turns.map(|(from, to, way)| effort(&self.table.turns[from][to][way]));
        let holds = path.order.iter().map(|k| self.table.hold[*k]);
        let mut asked: f64 = efforts.chain(holds).sum();
        if self.told_by_norms && !self.table.tells_by_norms(&path.order) {
            asked += NOT_BY_NORMS.get();
        }
        let information = last.map_or(*self.known, |chain| chain.clone().close());
        let ridge = Information::identity();
        let value = match variances(&information) {
            Some(c) => {
                let [force, rate] = reading_errors(&c, self.noise.gravity);
                (force * rate).ln() + BALANCE.get() * (rate / force / self.balance).ln().abs()
            }
            None => variances(&(information + ridge)).map_or(f64::INFINITY, |c| {
                let [force, rate] = reading_errors(&c, self.noise.gravity);
                100.0 + (force * rate).ln()
            }),
        };
        asked + value
    }

    fn improve(&self, order: Vec<usize>, fixed: usize, random: &mut ChaCha8Rng) -> (f64, Path) {
        let links = order.len().saturating_sub(1);
        let mut path = Path {
            order,
            ways: vec![0; links],
        };
        let mut chains = self.follow(&path, 0, None);
        let mut value = self.value(&path, chains.last());
        if path.order.len() < 2 {
            return (value, path);
        }
        let movable = path.order.len() - fixed;
        let kinds = match movable {
            0 => 2,
            _ if self.others.is_empty() => 4,
            _ => 6,
        };
        let steps = BUDGET[usize::from(!self.others.is_empty())] / STARTS.get();
        let mut best = (value, path.clone());
        for step in 0..steps {
            let mut trial = path.clone();
            let changed = match random.random_range(0..kinds) {
                0 | 1 => {
                    let k = random.random_range(0..links);
                    let count = self.table.turns[trial.order[k]][trial.order[k + 1]].len();
                    trial.ways[k] = random.random_range(0..count);
                    k + 1
                }
                kind @ (2 | 3) => {
                    let i = random.random_range(fixed..trial.order.len());
                    let j = random.random_range(fixed..trial.order.len());
                    let (i, j) = (i.min(j), i.max(j));
                    if kind == 2 {
                        trial.order.swap(i, j);
                    } else {
                        trial.order[i..=j].reverse();
                    }
                    i
                }
                _ => {
                    let k = random.random_range(fixed..trial.order.len());
                    trial.order[k] = self.others[random.random_range(0..self.others.len())];
                    k
                }
            };
            for (k, pair) in trial.order.windows(2).enumerate() {
                let count = self.table.turns[pair[0]][pair[1]].len();
                trial.ways[k] = trial.ways[k].min(count - 1);
            }
            let before = changed.checked_sub(1).and_then(|k| chains.get(k));
            let told = self.follow(&trial, changed, before);
            let found = self.value(&trial, told.last());
            let cooled = step as f64 / (WARM.get() * steps as f64);
            let warmth = WARMTH.get() * (1.0 - cooled).max(0.0);
            let luck: f64 = random.random_range(f64::EPSILON..1.0);
            if found < value - warmth * luck.ln() {
                (path, value) = (trial, found);
                chains.truncate(changed);
                chains.extend(told);
                if value < best.0 {
                    best = (value, path.clone());
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::edges;
    use crate::session::{predict, session_information};

    #[test]
    fn the_norms_of_every_planned_session_tell_the_accelerometer() {
        for count in [10, 11, 12, 13, 14] {
            let (ups, _) = session_of(count, &Noise::default(), &Timing::default());
            let table = Table::new(&ups, &Noise::default(), &Timing::default());
            let order: Vec<usize> = (0..ups.len()).collect();
            assert!(table.tells_by_norms(&order), "{count}: {ups:?}");
        }
    }

    #[test]
    fn a_planned_order_beats_random_ones_by_a_fifth() {
        let ups = edges();
        let (noise, timing, known) = (Noise::default(), Timing::default(), Information::zeros());
        let start = std::time::Instant::now();
        let planned = sequence(&ups, None, &known, &noise, &timing);
        println!("{:?}", start.elapsed());
        let best = predict(&planned.information, &noise).rate_error;
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut others: Vec<f64> = (0..50)
            .map(|_| {
                let mut order = ups.clone();
                for k in (1..order.len()).rev() {
                    order.swap(k, random.random_range(0..=k));
                }
                let turns: Vec<Turn> = order
                    .windows(2)
                    .map(|w| ways(&w[0], &w[1]).remove(0))
                    .collect();
                let found = session_information(&order, &turns, &known, &noise, &timing);
                predict(&found, &noise).rate_error
            })
            .collect();
        others.sort_by(f64::total_cmp);
        println!("{best:e} {:e} {:e}", others[0], others[25]);
        assert!(best < 0.8 * others[25]);
        let order: Vec<Vector3<f64>> = planned.order.iter().map(|k| ups[*k]).collect();
        let again = session_information(&order, &planned.turns, &known, &noise, &timing);
        assert!((again - planned.information).amax() < 1e-9 * again.amax());
    }
}
