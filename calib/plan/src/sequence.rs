//! In which order placements come, and by which way from one to the next.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::session::{
    Chain, Information, Link, Noise, Place, Timing, covariance, place, reading_errors,
};
use crate::turn::{Turn, ways};

/// Sequences looked at, each an information matrix of both sensors.
const BUDGET: usize = 9000;
/// Random orders to begin with.
const STARTS: usize = 6;

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

/// The best order and ways of `ups`, from `start` where the device lies already, beside what is known: the product of
/// the errors of corrected readings of both sensors is the least.
///
/// Local search from random orders with a fixed number of trials: reversals, swaps and other ways. The same call gives
/// the same sequence.
pub fn sequence(
    ups: &[Vector3<f64>],
    start: Option<&Vector3<f64>>,
    known: &Information,
    noise: &Noise,
    timing: &Timing,
) -> Sequence {
    let mut all: Vec<Vector3<f64>> = start.into_iter().copied().collect();
    all.extend_from_slice(ups);
    let fixed = usize::from(start.is_some());
    let table = Table::new(&all, noise, timing);
    let search = Search {
        table: &table,
        known,
        noise,
        first_known: fixed == 1,
    };
    let mut random = ChaCha8Rng::seed_from_u64(all.len() as u64);
    let mut best: Option<(f64, Path)> = None;
    for _ in 0..STARTS {
        let mut order: Vec<usize> = (0..all.len()).collect();
        for k in (fixed + 1..order.len()).rev() {
            order.swap(k, random.random_range(fixed..=k));
        }
        let found = search.improve(order, fixed, &mut random);
        if best.as_ref().is_none_or(|(value, _)| found.0 < *value) {
            best = Some(found);
        }
    }
    let path = best.map_or_else(Path::default, |(_, path)| path);
    Sequence {
        information: search.information(&path),
        turns: path
            .pairs()
            .map(|(from, to, way)| table.turns[from][to][way].clone())
            .collect(),
        order: path.order[fixed.min(path.order.len())..]
            .iter()
            .map(|k| k - fixed)
            .collect(),
    }
}

/// All turns between all placements.
struct Table {
    links: Vec<Vec<Vec<Link>>>,
    turns: Vec<Vec<Vec<Turn>>>,
    first: Vec<Place>,
    later: Vec<Place>,
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
            turns,
        }
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
}

impl Search<'_> {
    fn information(&self, path: &Path) -> Information {
        let mut chain = Chain::new(self.known, self.noise);
        let Some(&first) = path.order.first() else {
            return *self.known;
        };
        let place = if self.first_known {
            &self.table.later[first]
        } else {
            &self.table.first[first]
        };
        chain.begin(place);
        for (from, to, way) in path.pairs() {
            let ways = &self.table.links[from][to];
            chain.turn_to(&ways[way.min(ways.len() - 1)], &self.table.later[to]);
        }
        chain.close()
    }

    /// `ln` of the product of the errors; where parameters are open, far above, less with more information.
    fn value(&self, path: &Path) -> f64 {
        let information = self.information(path);
        let ridge = Information::identity();
        match covariance(&information) {
            Some(c) => {
                let [force, rate] = reading_errors(&c, self.noise.gravity);
                (force * rate).ln()
            }
            None => covariance(&(information + ridge)).map_or(f64::INFINITY, |c| {
                let [force, rate] = reading_errors(&c, self.noise.gravity);
                100.0 + (force * rate).ln()
            }),
        }
    }

    fn improve(&self, order: Vec<usize>, fixed: usize, random: &mut ChaCha8Rng) -> (f64, Path) {
        let links = order.len().saturating_sub(1);
        let mut path = Path {
            order,
            ways: vec![0; links],
        };
        let mut value = self.value(&path);
        if path.order.len() < 2 {
            return (value, path);
        }
        let movable = path.order.len() - fixed;
        for _ in 0..BUDGET / STARTS {
            let mut trial = path.clone();
            let kind = if movable < 2 {
                0
            } else {
                random.random_range(0..4)
            };
            if kind < 2 {
                let k = random.random_range(0..links);
                let count = self.table.turns[trial.order[k]][trial.order[k + 1]].len();
                trial.ways[k] = random.random_range(0..count);
            } else {
                let i = random.random_range(fixed..trial.order.len());
                let j = random.random_range(fixed..trial.order.len());
                let (i, j) = (i.min(j), i.max(j));
                if kind == 2 {
                    trial.order.swap(i, j);
                } else {
                    trial.order[i..=j].reverse();
                }
            }
            for (k, pair) in trial.order.windows(2).enumerate() {
                let count = self.table.turns[pair[0]][pair[1]].len();
                trial.ways[k] = trial.ways[k].min(count - 1);
            }
            let found = self.value(&trial);
            if found < value {
                (path, value) = (trial, found);
            }
        }
        (value, path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::edges;
    use crate::session::{predict, session_information};

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
