//! The pattern of the normal equations: which blocks meet, in which order they are eliminated.

use super::fill::{Filled, filled};
use super::order::fill_reducing;
use crate::error::Error;
use crate::graph::problem::Graph;

/// No position: a held block.
pub(crate) const NONE: u32 = u32::MAX;

/// Marks the first factor that adds to a slot: it writes what others add to.
pub(crate) const FIRST: u32 = 1 << 31;

/// Share of the unknowns from which blocks that do not meet are eliminated first.
const MANY: f64 = 0.6;

/// Widest block that is eliminated first.
const SMALL: usize = 24;

/// Unknowns up to which what is left is always dense.
const DENSE: usize = 160;

/// Share of the lower triangle from which what is left counts as dense.
const FULL: f64 = 0.3;

/// Most unknowns of a dense matrix; above, whatever its pattern, it is stored sparse.
const LARGEST: usize = 20_000;

/// Free blocks in the order of elimination, and the block pattern of the lower triangle of `H`.
///
/// | symbol | meaning |
/// |---|---|
/// | position | place of a free block in the order of elimination |
/// | slot | a block of `H` (later position × earlier position), stored column after column |
#[derive(Debug)]
pub(crate) struct Structure {
    /// Block of every position.
    pub order: Vec<u32>,
    /// Position of every block, [`NONE`] if held.
    pub position: Vec<u32>,
    /// First unknown of every position, and their number.
    pub first: Vec<usize>,
    /// Positions before this are eliminated one by one: no two of them meet.
    pub eliminated: usize,
    /// First slot of every position's column, and the number of slots.
    pub column: Vec<usize>,
    /// Position of the row of every slot, ascending within a column; the first is the diagonal.
    pub row: Vec<u32>,
    /// First entry of every slot, and the number of entries.
    pub entry: Vec<usize>,
    /// Slots of the pairs of every factor, see [`pair`]; marked where the factor is the [`FIRST`].
    pub pairs: Vec<u32>,
    /// Free blocks of every factor.
    pub free: Vec<u8>,
    /// Blocks left after the elimination.
    pub reduced: Pattern,
}

/// The pattern of what is left.
#[derive(Debug)]
pub(crate) enum Pattern {
    /// All of the lower triangle.
    Dense,
    /// Positions of rows, ascending, by position of the column (both less `eliminated`).
    Sparse(Vec<Vec<u32>>),
    /// The same with the fill of the factor, where that is little.
    Filled(Filled),
}

impl Pattern {
    /// Positions of rows, by position of the column; of a dense matrix none.
    pub fn rows(&self) -> Option<&[Vec<u32>]> {
        match self {
            Self::Dense => None,
            Self::Sparse(rows) => Some(rows),
            Self::Filled(filled) => Some(&filled.rows),
        }
    }
}

/// Place of the pair `(i, k)`, `i ≤ k`, among the pairs of `n`.
pub(crate) fn pair(i: usize, k: usize, n: usize) -> usize {
    i * n - i * (i + 1) / 2 + k
}

/// Factors that read every block, one list after the other.
struct Readers {
    first: Vec<u32>,
    factor: Vec<u32>,
}

impl Readers {
    fn of(&self, block: usize) -> &[u32] {
        &self.factor[self.first[block] as usize..self.first[block + 1] as usize]
    }
}

impl Structure {
    /// Works out the order and the pattern for the free blocks of a graph.
    pub fn new(graph: &Graph<'_>) -> Result<Self, Error> {
        let width: Vec<usize> = graph.variables.iter().map(|v| v.width()).collect();
        let readers = readers(graph);
        let chosen = independent(graph, &width, &readers);
        let (left, pattern) = left_over(graph, &width, &readers, &chosen)?;
        let mut order: Vec<u32> = (0..width.len() as u32)
            .filter(|&b| chosen[b as usize])
            .collect();
        // Those of the same width in a row: their products are added together.
        order.sort_by_key(|&b| width[b as usize]);
        let eliminated = order.len();
        order.extend(left);
        let mut position = vec![NONE; width.len()];
        let mut first = Vec::with_capacity(order.len() + 1);
        let mut unknowns = 0;
        for (place, &block) in order.iter().enumerate() {
            position[block as usize] = place as u32;
            first.push(unknowns);
            unknowns += width[block as usize];
        }
        first.push(unknowns);
        let mut structure = Self {
            order,
            position,
            first,
            eliminated,
            column: Vec::new(),
            row: Vec::new(),
            entry: Vec::new(),
            pairs: Vec::new(),
            free: Vec::new(),
            reduced: pattern,
        };
        structure.lay_out(graph, &readers);
        Ok(structure)
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.first.last().copied().unwrap_or(0)
    }

    /// Width of a position.
    pub fn width(&self, position: usize) -> usize {
        self.first[position + 1] - self.first[position]
    }

    /// First unknown that is not eliminated.
    pub fn split(&self) -> usize {
        self.first[self.eliminated]
    }

    /// Slots and the pairs of factors that they collect.
    fn lay_out(&mut self, graph: &Graph<'_>, readers: &Readers) {
        let mut pair_first = Vec::with_capacity(graph.factors.len());
        let mut pairs = 0;
        for factor in 0..graph.factors.len() {
            let free = graph.blocks_of(factor).iter();
            let free = free.filter(|&&b| self.position[b as usize] != NONE).count();
            self.free.push(free as u8);
            pair_first.push(pairs);
            pairs += free * (free + 1) / 2;
        }
        self.pairs = vec![0; pairs];
        let mut slot_of = vec![NONE; self.order.len()];
        let mut rows: Vec<u32> = Vec::new();
        let mut entries = 0;
        for place in 0..self.order.len() {
            self.column.push(self.row.len());
            rows.clear();
            rows.push(place as u32);
            slot_of[place] = 0;
            let block = self.order[place];
            for &factor in readers.of(block as usize) {
                for &other in graph.blocks_of(factor as usize) {
                    let at = self.position[other as usize];
                    if at != NONE && at as usize > place && slot_of[at as usize] == NONE {
                        slot_of[at as usize] = 0;
                        rows.push(at);
                    }
                }
            }
            rows[1..].sort_unstable();
            for &row in &rows {
                slot_of[row as usize] = self.row.len() as u32;
                self.row.push(row);
                self.entry.push(entries);
                entries += self.width(place) * self.width(row as usize);
            }
            for &factor in readers.of(block as usize) {
                self.place_pairs(graph, factor as usize, place, &pair_first, &slot_of);
            }
            for &row in &rows {
                slot_of[row as usize] = NONE;
            }
        }
        self.column.push(self.row.len());
        self.entry.push(entries);
        self.mark_first();
    }

    /// Marks the first pair of every slot, in the order of the factors.
    fn mark_first(&mut self) {
        let mut seen = vec![false; self.row.len()];
        for mark in &mut self.pairs {
            let seen = &mut seen[*mark as usize];
            *mark |= if *seen { 0 } else { FIRST };
            *seen = true;
        }
    }

    /// Writes the slots of a factor's pairs whose column is `place`.
    fn place_pairs(
        &mut self,
        graph: &Graph<'_>,
        factor: usize,
        place: usize,
        pair_first: &[usize],
        slot_of: &[u32],
    ) {
        let n = self.free[factor] as usize;
        let all = graph.blocks_of(factor).iter();
        let mut free = all
            .map(|&b| self.position[b as usize])
            .filter(|&p| p != NONE);
        let own = free.clone().position(|p| p as usize == place).unwrap_or(0);
        for k in 0..n {
            let Some(other) = free.next() else { return };
            if other as usize >= place {
                let (i, j) = (own.min(k), own.max(k));
                self.pairs[pair_first[factor] + pair(i, j, n)] = slot_of[other as usize];
            }
        }
    }
}

fn readers(graph: &Graph<'_>) -> Readers {
    let blocks = graph.variables.len();
    let mut first = vec![0u32; blocks + 1];
    for &block in &graph.touched {
        first[block as usize + 1] += 1;
    }
    for b in 0..blocks {
        first[b + 1] += first[b];
    }
    let mut next = first.clone();
    let mut factor = vec![0; graph.touched.len()];
    for f in 0..graph.factors.len() {
        for &block in graph.blocks_of(f) {
            factor[next[block as usize] as usize] = f as u32;
            next[block as usize] += 1;
        }
    }
    Readers { first, factor }
}

/// Blocks of which no two share a factor, the least read first; none unless they are most of all.
fn independent(graph: &Graph<'_>, width: &[usize], readers: &Readers) -> Vec<bool> {
    let mut candidates: Vec<u32> = (0..width.len() as u32)
        .filter(|&b| (1..=SMALL).contains(&width[b as usize]))
        .collect();
    candidates.sort_by_key(|&b| (readers.of(b as usize).len(), b));
    let mut taken = vec![false; graph.factors.len()];
    let mut chosen = vec![false; width.len()];
    let mut unknowns = 0;
    for block in candidates {
        let own = readers.of(block as usize);
        if own.iter().any(|&f| taken[f as usize]) {
            continue;
        }
        own.iter().for_each(|&f| taken[f as usize] = true);
        chosen[block as usize] = true;
        unknowns += width[block as usize];
    }
    let all: usize = width.iter().sum();
    if all <= DENSE || (unknowns as f64) < MANY * all as f64 {
        chosen.fill(false);
    }
    chosen
}

/// The blocks that are left, in the order in which to factor them, and their pattern.
fn left_over(
    graph: &Graph<'_>,
    width: &[usize],
    readers: &Readers,
    chosen: &[bool],
) -> Result<(Vec<u32>, Pattern), Error> {
    let left: Vec<u32> = (0..width.len() as u32)
        .filter(|&b| width[b as usize] > 0 && !chosen[b as usize])
        .collect();
    let unknowns: usize = left.iter().map(|&b| width[b as usize]).sum();
    if unknowns <= DENSE {
        return Ok((left, Pattern::Dense));
    }
    let mut place = vec![NONE; width.len()];
    for (k, &b) in left.iter().enumerate() {
        place[b as usize] = k as u32;
    }
    let meets = neighbours(graph, readers, chosen, &left, &place);
    let size = |k: usize| width[left[k] as usize];
    let entries: usize = (0..left.len())
        .map(|k| size(k) * meets[k].iter().map(|&o| size(o as usize)).sum::<usize>())
        .sum();
    let all = (unknowns * unknowns) as f64;
    if unknowns <= LARGEST && entries as f64 >= FULL * all {
        return Ok((left, Pattern::Dense));
    }
    let new_place = fill_reducing(&meets).ok_or(Error::TooLarge { unknowns })?;
    let mut ordered = vec![0; left.len()];
    let mut rows = vec![Vec::new(); left.len()];
    for (k, &block) in left.iter().enumerate() {
        let column = new_place[k];
        ordered[column as usize] = block;
        let mut below: Vec<u32> = meets[k].iter().map(|&o| new_place[o as usize]).collect();
        below.retain(|&row| row >= column);
        below.sort_unstable();
        rows[column as usize] = below;
    }
    let width_of = |place: usize| width[ordered[place] as usize];
    let pattern = match filled(&rows, width_of) {
        Some(filled) => Pattern::Filled(filled),
        None => Pattern::Sparse(rows),
    };
    Ok((ordered, pattern))
}

/// For each block that is left those that it meets, itself included, directly or over a block that
/// is eliminated.
fn neighbours(
    graph: &Graph<'_>,
    readers: &Readers,
    chosen: &[bool],
    left: &[u32],
    place: &[u32],
) -> Vec<Vec<u32>> {
    let mut seen = vec![NONE; left.len()];
    let mut meets = Vec::with_capacity(left.len());
    for (k, &block) in left.iter().enumerate() {
        let mut own = vec![k as u32];
        seen[k] = k as u32;
        let mut note = |factor: u32, own: &mut Vec<u32>| {
            for &other in graph.blocks_of(factor as usize) {
                let at = place[other as usize];
                if at != NONE && seen[at as usize] != k as u32 {
                    seen[at as usize] = k as u32;
                    own.push(at);
                }
            }
        };
        for &factor in readers.of(block as usize) {
            if own.len() == left.len() {
                break;
            }
            note(factor, &mut own);
            for &other in graph.blocks_of(factor as usize) {
                if chosen[other as usize] {
                    readers
                        .of(other as usize)
                        .iter()
                        .for_each(|&f| note(f, &mut own));
                }
            }
        }
        meets.push(own);
    }
    meets
}
