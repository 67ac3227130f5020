//! Directions that no factor sees, found without a dense matrix.

use faer::Mat;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::graph::bounds::Held;
use crate::graph::elimination::Factored;
use crate::graph::elimination::equations::Equations;
use crate::graph::elimination::structure::{NONE, Structure};
use crate::graph::problem::{Block, Graph};
use crate::linear::vector::{add_to, dot, norm};
use crate::rules::RANK_TOLERANCE;
use crate::uncertainty::observability::{in_words, separate};

/// Damping of the factorisation by which directions are found, relative to columns of unit length.
const DAMPING: f64 = 1e-13;

/// Directions looked for at first.
const FIRST: usize = 8;

/// Rounds of inverse iteration.
const ROUNDS: usize = 4;

/// Components smaller than this, relative to the largest, are not named.
const NAMED: f64 = 0.05;

/// Most components in words.
const WORDS: usize = 12;

/// An orthonormal basis of the null space of `J D⁻¹`.
#[derive(Clone, Debug, Default)]
pub(crate) struct NullSpace {
    /// The vectors, each of all unknowns.
    pub basis: Vec<Vec<f64>>,
    /// An unknown for each of them by which together they can be told apart.
    pub pivots: Vec<usize>,
}

/// A direction that no factor sees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NullVector {
    /// The direction by name, as `a + 0.5 b`; of many coordinates the first few.
    pub words: String,
    /// Blocks and coordinates of the components that are not small, with the components.
    pub components: Vec<(Block, usize, f64)>,
}

/// A graph linearised: what its null space follows from.
pub(crate) struct Local<'a> {
    pub equations: &'a Equations<'a>,
    pub values: &'a [f64],
    /// `H`, without what bounds hold.
    pub h: &'a [f64],
    /// `‖J_k‖`, the diagonal of `D`.
    pub units: &'a [f64],
    /// Unknowns that bounds hold.
    pub held: Option<&'a Held>,
}

impl Local<'_> {
    /// Number of unknowns that no bound holds.
    pub fn free(&self) -> usize {
        self.units.len() - self.held.map_or(0, |held| held.count)
    }

    /// Numbers between −1 and 1 that repeat, 0 for what is held.
    fn random(&self, seed: u64) -> Vec<f64> {
        let mut x = random(self.units.len(), seed);
        if let Some(held) = self.held {
            held.clear(&mut x);
        }
        x
    }
}

/// Finds the null space of `J D⁻¹` and leaves `H + E D² Eᵀ` factored, `E` its pivots.
pub(crate) fn find(local: &Local<'_>, factored: &mut Factored) -> Result<NullSpace, Error> {
    let Local { h, units, .. } = *local;
    let n = units.len();
    let Some(null) = seek(local, factored, local.free())? else {
        return Ok(NullSpace::default());
    };
    let mut spare = vec![0.0; n];
    let mut more = vec![0.0; n];
    for &p in &null.pivots {
        more[p] = units[p] * units[p];
    }
    if factored.factor_and_solve(h, &more, &mut spare) {
        return Ok(null);
    }
    // Singular values between rounding of H and the tolerance: counted, hardly resolved.
    for (more, d) in more.iter_mut().zip(units) {
        *more += DAMPING * d * d;
    }
    spare.fill(0.0);
    if factored.factor_and_solve(h, &more, &mut spare) {
        Ok(null)
    } else {
        Err(Error::TooLarge { unknowns: n })
    }
}

/// Finds up to `most` directions of the null space of `J D⁻¹`; `None`, and `H` factored, where `H` is far
/// from singular.
///
/// Directions of small singular values are found by inverse iteration on the normal equations, which
/// resolve them to 1e-8; within their span the Jacobian itself tells them apart to 1e-15.
pub(crate) fn seek(
    local: &Local<'_>,
    factored: &mut Factored,
    most: usize,
) -> Result<Option<NullSpace>, Error> {
    let Local { h, units, .. } = *local;
    let n = units.len();
    let most = most.min(local.free());
    let mut spare = vec![0.0; n];
    if safely(local, factored) {
        return Ok(None);
    }
    let mut damping = DAMPING;
    loop {
        let more: Vec<f64> = units.iter().map(|d| damping * d * d).collect();
        spare.fill(0.0);
        if factored.factor_and_solve(h, &more, &mut spare) {
            break;
        }
        damping *= 100.0;
        if damping > 1.0 {
            return Err(Error::TooLarge { unknowns: n });
        }
    }
    let largest = largest_singular(local);
    let mut count = FIRST.min(most);
    let null = loop {
        let basis = inverse_iteration(local, factored, count);
        let (singular, rotated) = ritz(local, &basis);
        let zero = |s: &&f64| **s <= RANK_TOLERANCE * largest;
        let null = singular.iter().filter(zero).count();
        if null < count || count == most {
            break rotated
                .into_iter()
                .zip(&singular)
                .filter(|(_, s)| zero(s))
                .map(|(v, _)| v)
                .collect::<Vec<_>>();
        }
        count = (4 * count).min(most);
    };
    Ok(Some(NullSpace {
        pivots: pivots(&null),
        basis: null,
    }))
}

/// True where the undamped equations are so far from singular that no singular value can be small:
/// the inverse grows a random vector by the largest of `1 / s²`.
fn safely(local: &Local<'_>, factored: &mut Factored) -> bool {
    let Local { h, units, .. } = *local;
    let n = units.len();
    let mut vector = vec![0.0; n];
    if !factored.factor_and_solve(h, &vec![0.0; n], &mut vector) {
        return false;
    }
    if local.free() == 0 {
        return true;
    }
    let mut x = local.random(1);
    let mut growth = 0.0f64;
    for _ in 0..3 {
        let length = norm(&x);
        x.iter_mut().zip(units).for_each(|(x, d)| *x *= d / length);
        factored.solve(h, &mut x);
        x.iter_mut().zip(units).for_each(|(x, d)| *x *= d);
        growth = growth.max(norm(&x));
    }
    growth < 1e10
}

/// Numbers between −1 and 1 that repeat.
fn random(n: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    (0..n)
        .map(|_| {
            // Marsaglia, "Xorshift RNGs", 2003.
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
        .collect()
}

/// Orthonormal vectors in the span of the smallest singular directions.
fn inverse_iteration(local: &Local<'_>, factored: &mut Factored, count: usize) -> Vec<Vec<f64>> {
    let Local { h, units, .. } = *local;
    let n = units.len();
    let mut basis: Vec<Vec<f64>> = (0..count).map(|k| local.random(k as u64 + 1)).collect();
    orthonormalise(&mut basis);
    for _ in 0..ROUNDS {
        let mut all: Vec<f64> = Vec::with_capacity(n * count);
        for vector in &basis {
            all.extend(vector.iter().zip(units).map(|(v, d)| v * d));
        }
        factored.solve(h, &mut all);
        for (vector, solved) in basis.iter_mut().zip(all.chunks_exact(n)) {
            for ((v, s), d) in vector.iter_mut().zip(solved).zip(units) {
                *v = s * d;
            }
        }
        orthonormalise(&mut basis);
    }
    basis
}

/// Gram and Schmidt, twice.
fn orthonormalise(basis: &mut [Vec<f64>]) {
    for k in 0..basis.len() {
        let (before, rest) = basis.split_at_mut(k);
        let own = &mut rest[0];
        for _ in 0..2 {
            let length = norm(own);
            if length > 0.0 {
                own.iter_mut().for_each(|v| *v /= length);
            }
            for other in &*before {
                let along = dot(own, other);
                add_to(own, -along, other);
            }
        }
        let length = norm(own);
        if length > 0.0 {
            own.iter_mut().for_each(|v| *v /= length);
        }
    }
}

/// Singular values of `J D⁻¹ X`, descending, and `X` turned to their directions.
fn ritz(local: &Local<'_>, basis: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let Local {
        equations,
        values,
        units,
        ..
    } = *local;
    let structure = equations.structure;
    let mut product = Mat::zeros(equations.rows(), basis.len());
    let mut row = 0;
    // What is finite was found to be so before.
    let _ = equations.visit(values, &mut |factor, r, jacobian| {
        let width = jacobian.len() / r.len().max(1);
        if let Some(loss) = equations.loss_of(factor) {
            crate::graph::reweight::rewrite(&loss, r, jacobian, width);
        }
        let places: Vec<usize> = equations
            .graph
            .blocks_of(factor)
            .iter()
            .map(|&b| structure.position[b as usize])
            .filter(|&p| p != NONE)
            .flat_map(|p| structure.first[p as usize]..structure.first[p as usize + 1])
            .collect();
        for k in 0..r.len() {
            let line = &jacobian[k * width..(k + 1) * width];
            for (c, vector) in basis.iter().enumerate() {
                let sum: f64 = line
                    .iter()
                    .zip(&places)
                    .map(|(j, &p)| j * vector[p] / units[p])
                    .sum();
                product[(row, c)] = sum;
            }
            row += 1;
        }
    });
    let triangle = crate::uncertainty::covariance::triangle(product.as_ref());
    let Some((mut singular, v)) = crate::uncertainty::covariance::right_vectors(triangle.as_ref())
    else {
        return (vec![f64::INFINITY; basis.len()], basis.to_vec());
    };
    singular.resize(basis.len(), 0.0);
    let turned = (0..basis.len())
        .map(|k| {
            let mut out = vec![0.0; units.len()];
            for (c, vector) in basis.iter().enumerate() {
                add_to(&mut out, v[(c, k)], vector);
            }
            out
        })
        .collect();
    (singular, turned)
}

/// `‖J D⁻¹‖`, by power iteration, to a tenth or so.
fn largest_singular(local: &Local<'_>) -> f64 {
    let Local { h, units, .. } = *local;
    let structure = local.equations.structure;
    let mut x = local.random(7);
    let mut largest = 0.0;
    for _ in 0..20 {
        let length = norm(&x);
        x.iter_mut().zip(units).for_each(|(x, d)| *x /= length * d);
        let mut product = structure.multiply(h, &x);
        product.iter_mut().zip(units).for_each(|(p, d)| *p /= d);
        largest = norm(&product);
        x = product;
    }
    largest.sqrt()
}

/// Unknowns in which the vectors are told apart, by elimination with the largest pivots.
fn pivots(basis: &[Vec<f64>]) -> Vec<usize> {
    let mut left = basis.to_vec();
    let mut pivots = Vec::with_capacity(left.len());
    for k in 0..left.len() {
        let n = left[k].len();
        let size = |i: usize| left[k..].iter().map(|v| v[i] * v[i]).sum::<f64>();
        let Some(best) = (0..n).max_by(|&a, &b| size(a).total_cmp(&size(b))) else {
            break;
        };
        let row = (k..left.len())
            .max_by(|&a, &b| left[a][best].abs().total_cmp(&left[b][best].abs()))
            .unwrap_or(k);
        left.swap(k, row);
        let (head, tail) = left.split_at_mut(k + 1);
        let pivot = &head[k];
        for other in tail {
            let factor = -other[best] / pivot[best];
            add_to(other, factor, pivot);
        }
        pivots.push(best);
    }
    pivots
}

impl NullSpace {
    /// Takes the null space out of a vector in scaled coordinates.
    pub fn project(&self, x: &mut [f64]) {
        for vector in &self.basis {
            let along = dot(vector, x);
            add_to(x, -along, vector);
        }
    }

    /// Contribution of the pivots to `ln det`: `Σ ln d_p² + 2 ln |det Eᵀ N|`, `N` orthonormal in the
    /// coordinates' own units.
    pub fn log_share(&self, units: &[f64]) -> f64 {
        let mut own: Vec<Vec<f64>> = self
            .basis
            .iter()
            .map(|v| v.iter().zip(units).map(|(v, d)| v / d).collect())
            .collect();
        orthonormalise(&mut own);
        let mut share: f64 = self.pivots.iter().map(|&p| 2.0 * units[p].ln()).sum();
        let k = own.len();
        let mut a: Vec<Vec<f64>> = own
            .iter()
            .map(|v| self.pivots.iter().map(|&p| v[p]).collect())
            .collect();
        for c in 0..k {
            let row = (c..k)
                .max_by(|&i, &j| a[i][c].abs().total_cmp(&a[j][c].abs()))
                .unwrap_or(c);
            a.swap(c, row);
            share += 2.0 * a[c][c].abs().ln();
            let (head, tail) = a.split_at_mut(c + 1);
            for other in tail {
                let factor = -other[c] / head[c][c];
                add_to(other, factor, &head[c]);
            }
        }
        share
    }
}

/// The null space by names.
pub(crate) fn in_names(
    null: &NullSpace,
    graph: &Graph<'_>,
    structure: &Structure,
    units: &[f64],
) -> Vec<NullVector> {
    let unscaled = null
        .basis
        .iter()
        .map(|v| v.iter().zip(units).map(|(v, d)| v / d).collect())
        .collect();
    let places: Vec<(Block, usize)> = structure
        .order
        .iter()
        .flat_map(|&b| {
            let variable = &graph.variables[b as usize];
            variable.free_coordinates().map(move |k| (Block(b), k))
        })
        .collect();
    let named = |direction: Vec<f64>| {
        let visible = |k: usize| (direction[k] * units[k]).abs();
        let most = (0..direction.len()).map(visible).fold(0.0, f64::max);
        let mut chosen: Vec<usize> = (0..direction.len())
            .filter(|&k| visible(k) >= NAMED * most)
            .collect();
        chosen.sort_by_key(|&k| places[k]);
        let first: Vec<usize> = chosen.iter().copied().take(WORDS).collect();
        let name = |&k: &usize| {
            let (block, coordinate) = places[k];
            graph.variables[block.number()].coordinate(coordinate)
        };
        let mut words = in_words(
            &first.iter().map(|&k| direction[k]).collect::<Vec<_>>(),
            &first.iter().map(|&k| units[k]).collect::<Vec<_>>(),
            &first.iter().map(name).collect::<Vec<_>>(),
        );
        if chosen.len() > first.len() {
            words += &format!(" and {} more", chosen.len() - first.len());
        }
        NullVector {
            words,
            components: chosen
                .iter()
                .map(|&k| (places[k].0, places[k].1, direction[k]))
                .collect(),
        }
    };
    separate(unscaled, units).into_iter().map(named).collect()
}
