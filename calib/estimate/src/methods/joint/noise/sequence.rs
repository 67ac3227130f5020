//! Rows along one line of stations under noise that is passed on: factor, whitening and products in time proportional to
//! their number.

mod small;

use small::{
    MOST, Small, add, add_gram, add_scaled, backward, both_sides, cholesky, forward, product,
    small, transposed_product,
};

use super::chain::Chain;

/// Kinds of noise along one line of stations.
#[derive(Clone, Debug)]
pub struct Sequence {
    stops: Vec<Stop>,
    /// The component of every number of the state.
    of_slot: Vec<usize>,
    rows: usize,
}

/// One station.
#[derive(Clone, Debug)]
struct Stop {
    /// First row in the line, and number of rows `d`.
    first: usize,
    rows: usize,
    /// Covariances of its rows, by component.
    own: Vec<(usize, Small)>,
    /// `d × r` each, row by row.
    gives: Vec<f64>,
    takes: Vec<f64>,
    /// Share of the state that is kept on the way to this station (`r`); `None` where all of it is.
    keeps: Option<Vec<f64>>,
}

/// The Cholesky factor of `I + Σ θ_c C_c`.
#[derive(Clone, Debug)]
pub struct Factor {
    /// `ln |V|`.
    pub log_determinant: f64,
    /// Diagonal blocks.
    lower: Vec<Small>,
    /// Contributions of the whitened rows to the state (`d × r` for each station).
    told: Vec<f64>,
    /// First index of each station's part of them.
    begins: Vec<usize>,
}

impl Sequence {
    /// The stations `line` of these chains, in the order of the components; `None` for a component that is no chain.
    pub fn new(chains: &[Option<&Chain>], line: std::ops::Range<usize>) -> Self {
        let here = |chain: &&Chain| chain.links()[line.clone()].iter().any(Option::is_some);
        let mut of_slot = Vec::new();
        let mut first_slot = vec![0; chains.len()];
        for (c, chain) in chains.iter().enumerate() {
            first_slot[c] = of_slot.len();
            if let Some(chain) = chain.filter(here) {
                of_slot.extend(std::iter::repeat_n(c, chain.width()));
            }
        }
        let width = of_slot.len();
        let mut rows = 0;
        let mut stops = Vec::new();
        let stations = chains.iter().flatten().next().map(|chain| chain.stations());
        for k in stations.map_or(0..0, |_| line.clone()) {
            let d = stations.map_or(0, |stations| stations.all()[k].rows.len());
            let mut stop = Stop {
                first: rows,
                rows: d,
                own: Vec::new(),
                gives: vec![0.0; d * width],
                takes: vec![0.0; d * width],
                keeps: None,
            };
            for (c, chain) in chains.iter().enumerate() {
                let Some(link) = chain.and_then(|chain| chain.links()[k].as_ref()) else {
                    continue;
                };
                stop.own.push((c, small(&link.own)));
                for slot in 0..link.keeps.len() {
                    let to = first_slot[c] + slot;
                    for i in 0..d {
                        stop.gives[i * width + to] = link.gives[(i, slot)];
                        stop.takes[i * width + to] = link.takes[(i, slot)];
                    }
                    if link.keeps[slot] != 1.0 {
                        stop.keeps.get_or_insert_with(|| vec![1.0; width])[to] = link.keeps[slot];
                    }
                }
            }
            rows += d;
            stops.push(stop);
        }
        Self {
            stops,
            of_slot,
            rows,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns true if the rows have noise of a component.
    pub fn feels(&self, component: usize) -> bool {
        let mut own = self.stops.iter().flat_map(|stop| &stop.own);
        own.any(|(c, block)| *c == component && block.iter().any(|v| *v != 0.0))
    }

    /// The factor at these variances; `None` where the covariance is not positive.
    pub fn factor(&self, theta: &[f64]) -> Option<Factor> {
        let r = self.of_slot.len();
        let mut factor = Factor {
            log_determinant: 0.0,
            lower: Vec::with_capacity(self.stops.len()),
            told: vec![0.0; self.rows * r],
            begins: Vec::with_capacity(self.stops.len()),
        };
        let mut state = vec![0.0; r * r];
        let mut seen = vec![0.0; MOST * r];
        for stop in &self.stops {
            let d = stop.rows;
            keep_square(stop, r, &mut state);
            times_state(stop, r, &state, &mut seen);
            let mut block = [0.0; MOST * MOST];
            for i in 0..d {
                block[i * MOST + i] = 1.0;
            }
            for (c, own) in stop.own.iter().filter(|(c, _)| theta[*c] > 0.0) {
                add(&mut block, theta[*c], own);
            }
            less_outer(stop, r, &seen, &mut block);
            let lower = cholesky(&block, d)?;
            for i in 0..d {
                factor.log_determinant += 2.0 * lower[i * MOST + i].ln();
            }
            let begin = stop.first * r;
            let told = &mut factor.told[begin..begin + d * r];
            for i in 0..d {
                for (s, c) in self.of_slot.iter().enumerate() {
                    let at = i * r + s;
                    told[at] = theta[*c].max(0.0) * stop.takes[at] - seen[at];
                }
            }
            forward(&lower, d, told, r);
            add_gram(&mut state, told, told, (d, r), 1.0);
            factor.lower.push(lower);
            factor.begins.push(begin);
        }
        Some(factor)
    }

    /// `tr(V⁻¹ C_c)`: the derivative of `ln |V|` by the variance of a component.
    pub fn trace(&self, factor: &Factor, component: usize) -> f64 {
        let r = self.of_slot.len();
        let mut trace = 0.0;
        let mut state = vec![0.0; r * r];
        let mut seen = vec![0.0; MOST * r];
        let mut moved = vec![0.0; MOST * r];
        for (k, stop) in self.stops.iter().enumerate() {
            let d = stop.rows;
            keep_square(stop, r, &mut state);
            times_state(stop, r, &state, &mut seen);
            let mut block = [0.0; MOST * MOST];
            for (_, own) in stop.own.iter().filter(|(c, _)| *c == component) {
                add(&mut block, 1.0, own);
            }
            less_outer(stop, r, &seen, &mut block);
            let lower = &factor.lower[k];
            let relative = both_sides(lower, &block, d);
            let told = &factor.told[factor.begins[k]..factor.begins[k] + d * r];
            for i in 0..d {
                trace += relative[i * MOST + i];
                for (s, c) in self.of_slot.iter().enumerate() {
                    let at = i * r + s;
                    let takes = if *c == component { stop.takes[at] } else { 0.0 };
                    moved[at] = takes - seen[at];
                }
            }
            forward(lower, d, &mut moved, r);
            for i in 0..d {
                for j in 0..=i {
                    let share = if i == j { 0.5 } else { 1.0 };
                    let factor = share * relative[i * MOST + j];
                    for s in 0..r {
                        moved[i * r + s] -= factor * told[j * r + s];
                    }
                }
            }
            add_gram(&mut state, &moved, told, (d, r), 1.0);
            add_gram(&mut state, told, &moved, (d, r), 1.0);
        }
        trace
    }

    /// `L⁻¹ A` in place, `A` (`rows × columns`) row by row.
    pub fn whiten(&self, factor: &Factor, a: &mut [f64], columns: usize) {
        let r = self.of_slot.len();
        let mut state = vec![0.0; r * columns];
        for (k, stop) in self.stops.iter().enumerate() {
            let d = stop.rows;
            keep_rows(stop, &mut state, columns);
            let own = &mut a[stop.first * columns..(stop.first + d) * columns];
            product(own, &stop.gives, &state, (d, r, columns), -1.0);
            forward(&factor.lower[k], d, own, columns);
            let told = &factor.told[factor.begins[k]..factor.begins[k] + d * r];
            transposed_product(&mut state, told, own, (d, r, columns));
        }
    }

    /// `L⁻ᵀ A` in place.
    pub fn unwhiten(&self, factor: &Factor, a: &mut [f64], columns: usize) {
        let r = self.of_slot.len();
        let mut state = vec![0.0; r * columns];
        for (k, stop) in self.stops.iter().enumerate().rev() {
            let d = stop.rows;
            let own = &mut a[stop.first * columns..(stop.first + d) * columns];
            let told = &factor.told[factor.begins[k]..factor.begins[k] + d * r];
            product(own, told, &state, (d, r, columns), -1.0);
            backward(&factor.lower[k], d, own, columns);
            transposed_product(&mut state, &stop.gives, own, (d, r, columns));
            keep_rows(stop, &mut state, columns);
        }
    }

    /// `C_c A` (`rows × columns`).
    pub fn times(&self, component: usize, a: &[f64], columns: usize) -> Vec<f64> {
        if columns == 0 {
            return Vec::new();
        }
        let slots: Vec<usize> = (0..self.of_slot.len())
            .filter(|&s| self.of_slot[s] == component)
            .collect();
        let r = self.of_slot.len();
        let mut out = vec![0.0; a.len()];
        let mut state = vec![0.0; slots.len() * columns];
        let keep = |stop: &Stop, state: &mut [f64]| {
            let Some(keeps) = &stop.keeps else { return };
            for (row, &slot) in state.chunks_exact_mut(columns).zip(&slots) {
                if keeps[slot] != 1.0 {
                    row.iter_mut().for_each(|v| *v *= keeps[slot]);
                }
            }
        };
        for stop in &self.stops {
            keep(stop, &mut state);
            for i in 0..stop.rows {
                let at = (stop.first + i) * columns;
                let to = &mut out[at..at + columns];
                for (row, &slot) in state.chunks_exact(columns).zip(&slots) {
                    add_scaled(to, stop.gives[i * r + slot], row);
                }
                for (_, own) in stop.own.iter().filter(|(c, _)| *c == component) {
                    for j in 0..stop.rows {
                        let from = (stop.first + j) * columns;
                        add_scaled(to, own[i * MOST + j], &a[from..from + columns]);
                    }
                }
            }
            for i in 0..stop.rows {
                let from = &a[(stop.first + i) * columns..][..columns];
                for (row, &slot) in state.chunks_exact_mut(columns).zip(&slots) {
                    add_scaled(row, stop.takes[i * r + slot], from);
                }
            }
        }
        state.fill(0.0);
        for stop in self.stops.iter().rev() {
            for i in 0..stop.rows {
                let to = &mut out[(stop.first + i) * columns..][..columns];
                for (row, &slot) in state.chunks_exact(columns).zip(&slots) {
                    add_scaled(to, stop.takes[i * r + slot], row);
                }
            }
            for i in 0..stop.rows {
                let from = &a[(stop.first + i) * columns..][..columns];
                for (row, &slot) in state.chunks_exact_mut(columns).zip(&slots) {
                    add_scaled(row, stop.gives[i * r + slot], from);
                }
            }
            keep(stop, &mut state);
        }
        out
    }
}

/// `K S K`.
fn keep_square(stop: &Stop, r: usize, state: &mut [f64]) {
    let Some(keeps) = &stop.keeps else { return };
    for (a, row) in keeps.iter().zip(state.chunks_exact_mut(r.max(1))) {
        row.iter_mut().zip(keeps).for_each(|(v, b)| *v *= a * b);
    }
}

/// `K S`.
fn keep_rows(stop: &Stop, state: &mut [f64], columns: usize) {
    let Some(keeps) = &stop.keeps else { return };
    for (kept, row) in keeps.iter().zip(state.chunks_exact_mut(columns.max(1))) {
        if *kept != 1.0 {
            row.iter_mut().for_each(|v| *v *= kept);
        }
    }
}

/// `G S` (`d × r`).
fn times_state(stop: &Stop, r: usize, state: &[f64], out: &mut [f64]) {
    out[..stop.rows * r].fill(0.0);
    let d = (stop.rows, r, r);
    product(&mut out[..stop.rows * r], &stop.gives, state, d, 1.0);
}

/// `B −= (G S) Gᵀ`.
fn less_outer(stop: &Stop, r: usize, seen: &[f64], block: &mut Small) {
    for i in 0..stop.rows {
        for k in 0..stop.rows {
            let rows = seen[i * r..(i + 1) * r]
                .iter()
                .zip(&stop.gives[k * r..(k + 1) * r]);
            block[i * MOST + k] -= rows.map(|(a, b)| a * b).sum::<f64>();
        }
    }
}
