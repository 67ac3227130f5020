//! Stability selection: frequency with which a group, or one much like it, is selected from half of the intervals.

use std::ops::Range;

use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, Par, Side};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::dictionary::Product;
use super::group_lasso::GroupLasso;
use super::screen::Screened;
use crate::noise::projected::Whitened;
use crate::state::State;

findings::tuning! {
    /// Pairs of halves.
    PAIRS: u64 = 25;

    /// Groups that a half may select: few, so that chance seldom selects the same again.
    MOST: usize = 3;

    /// Share of the halves that must select anything at all.
    SPEAK: f64 = 0.5;

    /// `λ` from one step of the path to the next.
    STEP: f64 = 0.8;

    /// Added to precisions, which are at most 1: rows of a half may depend on each other.
    RIDGE: f64 = 1e-9;
}

/// For every group the share of the halves that select it or one like it, of those that select any: a half in which nothing
/// rises above the noise says nothing for or against. 0 where fewer than [`SPEAK`] select any.
///
/// The bases (`q × p_g`) are orthonormal, whitened. A half of the rests speaks through its rows, given all others:
/// with `B = N L⁻ᵀ` (`m × q`) and its rows `B_I`, through `B_I z ~ N(B_I W β, B_I B_Iᵀ)`. A group is selected where it is
/// among the first [`MOST`] on the path of falling `λ`, no lower than `floor`.
///
/// Source: Meinshausen and Bühlmann, Stability selection, 2010; halves in complementary pairs as of Shah and
/// Samworth, Variable selection with error control, 2013; votes by clusters as of Faletto and Bien, Cluster stability
/// selection, 2022.
pub fn stability(state: &State, products: &[Product], screened: &Screened) -> Vec<f64> {
    let (whitened, bases, floor) = (&screened.whitened, &screened.bases, screened.floor);
    let halves = Halves::new(state, whitened, bases);
    let rests = state.fit.data.rests.len();
    let selected: Vec<Vec<usize>> = (0..PAIRS.get())
        .into_par_iter()
        .flat_map_iter(|seed| {
            let mut order: Vec<usize> = (0..rests).collect();
            order.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
            let (one, other) = order.split_at(rests / 2);
            [halves.selected(one, floor), halves.selected(other, floor)]
        })
        .collect();
    let speak = selected.iter().filter(|own| !own.is_empty()).count();
    if (speak as f64) < SPEAK.get() * selected.len() as f64 {
        return vec![0.0; bases.len()];
    }
    let votes = |g: usize| {
        let for_it = |own: &&Vec<usize>| {
            own.iter()
                .any(|&s| s == g || screened.are_alike(products, s, g))
        };
        selected.iter().filter(for_it).count()
    };
    (0..bases.len())
        .map(|g| votes(g) as f64 / speak.max(1) as f64)
        .collect()
}

struct Halves<'a> {
    rest_of_row: &'a [usize],
    groups: Vec<Range<usize>>,
    /// `B Bᵀ` (`m × m`).
    precision: Mat<f64>,
    /// `B [W z]` (`m × p + 1`).
    seen: Mat<f64>,
}

impl<'a> Halves<'a> {
    fn new(state: &'a State, whitened: &Whitened, bases: &[Mat<f64>]) -> Self {
        let all: Vec<usize> = (0..state.rows()).collect();
        let b = whitened.columns(&state.projected.units(&all).to_dense());
        let mut parts = bases.to_vec();
        parts.push(whitened.z.clone());
        let whole = crate::family::beside(&parts, whitened.z.nrows());
        let mut first = 0;
        let groups = bases.iter().map(|basis| {
            let range = first..first + basis.ncols();
            first = range.end;
            range
        });
        Self {
            rest_of_row: &state.fit.rest_of_row,
            groups: groups.collect(),
            precision: b.transpose() * &b,
            seen: b.transpose() * whole,
        }
    }

    /// The groups that these rests select.
    fn selected(&self, rests: &[usize], floor: f64) -> Vec<usize> {
        let mut path = Vec::new();
        let Some(problem) = self.problem(rests) else {
            return path;
        };
        let mut beta = vec![0.0; self.seen.ncols() - 1];
        let mut lambda = STEP.get() * problem.largest();
        while lambda > floor {
            let active = problem.solve(lambda, &mut beta);
            if active.len() > MOST.get() {
                break;
            }
            let new = active.into_iter().filter(|g| !path.contains(g));
            let new: Vec<usize> = new.collect();
            path.extend(new);
            lambda *= STEP.get();
        }
        path
    }

    fn problem(&self, rests: &[usize]) -> Option<GroupLasso> {
        let rows: Vec<usize> = (0..self.rest_of_row.len())
            .filter(|i| rests.contains(&self.rest_of_row[*i]))
            .collect();
        let covariance = Mat::from_fn(rows.len(), rows.len(), |i, k| {
            self.precision[(rows[i], rows[k])] + if i == k { RIDGE.get() } else { 0.0 }
        });
        let factor = covariance.llt(Side::Lower).ok()?;
        let mut own = Mat::from_fn(rows.len(), self.seen.ncols(), |i, k| {
            self.seen[(rows[i], k)]
        });
        solve_lower_triangular_in_place(factor.L(), own.as_mut(), Par::Seq);
        let p = own.ncols() - 1;
        let x = own.subcols(0, p);
        let moved = x.transpose() * own.subcols(p, 1);
        let moved = moved.col(0).iter().copied().collect();
        GroupLasso::new(x.transpose() * x, moved, &self.groups)
    }
}
