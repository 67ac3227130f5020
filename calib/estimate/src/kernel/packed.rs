//! Turns laid side by side: what of them does not depend on the parameters, computed once.

use nalgebra::Vector3;

use super::features::Features;
use super::lanes::WIDTH;
use crate::residuals::TurnData;

/// Fields of a step before its features: the integral of the reading and the time step.
pub(super) const PLAIN_FIELDS: usize = 4;

/// Up to [`WIDTH`] turns of similar length.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// Indices of the turns among all.
    pub turns: Vec<usize>,
    /// Numbers per step and turn: [`PLAIN_FIELDS`] and one for each feature.
    pub fields: usize,
    /// Step by step, field by field, turn by turn: `ψ = ½Δt (xₖ + xₖ₊₁)` of the reading (3), `Δt`, then
    /// the same integral of every feature. A turn that is over goes on with zeros, which change
    /// nothing.
    pub steps: Vec<f64>,
    /// The gravity before each turn `u₀` (3), then `e₁` (3), `e₂` (3) that complete it to a
    /// right-handed frame, turn by turn.
    pub starts: Vec<f64>,
    /// The largest `|ψ|` and `Δt`, and the largest integral of each feature.
    pub bounds: Bounds,
}

/// The largest step of a group, from which that for any parameters follows.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounds {
    /// Largest `|ψ|`, raw unit × s.
    pub reading: f64,
    /// Largest time step, s.
    pub time: f64,
    /// Largest integral of each feature.
    pub features: Vec<f64>,
}

/// Lays out the turns, the longest first.
pub(super) fn pack(turns: &[TurnData], features: &Features) -> Vec<Group> {
    in_groups(turns, |members| {
        let mut group = Group::empty(turns, members, features.entries().len());
        for (lane, &k) in members.iter().enumerate() {
            group.fill(lane, &turns[k], &turns[k].readings);
            group.fill_features(lane, k, features);
        }
        group
    })
}

/// Lays out the turns with `signals` in the place of their readings.
pub(super) fn pack_signals(turns: &[TurnData], signals: &[Vec<Vector3<f64>>]) -> Vec<Group> {
    in_groups(turns, |members| {
        let mut group = Group::empty(turns, members, 0);
        for (lane, &k) in members.iter().enumerate() {
            group.fill(lane, &turns[k], &signals[k]);
        }
        group
    })
}

fn in_groups(turns: &[TurnData], group: impl Fn(&[usize]) -> Group) -> Vec<Group> {
    let mut order: Vec<usize> = (0..turns.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(turns[k].t.len()));
    order.chunks(WIDTH).map(group).collect()
}

/// The larger of the two; not a number where one of them is none.
fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

impl Group {
    /// Room for the turns `members` and `features` features; no rotation.
    fn empty(turns: &[TurnData], members: &[usize], features: usize) -> Self {
        let steps = |k: usize| turns[k].t.len().saturating_sub(1);
        let longest = members.iter().map(|&k| steps(k)).max().unwrap_or(0);
        let fields = PLAIN_FIELDS + features;
        Self {
            turns: members.to_vec(),
            fields,
            steps: vec![0.0; longest * fields * WIDTH],
            starts: vec![0.0; 9 * WIDTH],
            bounds: Bounds {
                features: vec![0.0; features],
                ..Bounds::default()
            },
        }
    }

    /// Steps of all turns, those that only fill up included.
    pub fn samples(&self) -> usize {
        self.steps.len() / self.fields
    }

    /// The start, the readings and the time steps of a turn.
    fn fill(&mut self, lane: usize, turn: &TurnData, readings: &[Vector3<f64>]) {
        self.start(lane, &turn.before);
        let records = self.steps.chunks_exact_mut(self.fields * WIDTH);
        let pairs = turn.t.windows(2).zip(readings.windows(2));
        for (record, (t, x)) in records.zip(pairs) {
            let dt = t[1] - t[0];
            let reading = (x[0] + x[1]) * (0.5 * dt);
            for i in 0..3 {
                record[i * WIDTH + lane] = reading[i];
            }
            record[3 * WIDTH + lane] = dt;
            self.bounds.reading = larger(self.bounds.reading, reading.norm());
            self.bounds.time = larger(self.bounds.time, dt.abs());
        }
    }

    /// The features of turn `turn`, after [`Self::fill`].
    fn fill_features(&mut self, lane: usize, turn: usize, features: &Features) {
        let records = self.steps.chunks_exact_mut(self.fields * WIDTH);
        let last = features.samples(turn).saturating_sub(1);
        for (step, record) in records.take(last).enumerate() {
            let half = 0.5 * record[3 * WIDTH + lane];
            for (entry, bound) in self.bounds.features.iter_mut().enumerate() {
                let sum = features.value(turn, step, entry) + features.value(turn, step + 1, entry);
                record[(PLAIN_FIELDS + entry) * WIDTH + lane] = half * sum;
                *bound = larger(*bound, (half * sum).abs());
            }
        }
    }

    /// Gravity before a turn, and the frame it completes.
    fn start(&mut self, lane: usize, before: &Vector3<f64>) {
        let mut axis = Vector3::zeros();
        axis[before.iamin()] = 1.0;
        let first = before.cross(&axis).normalize();
        let second = before.normalize().cross(&first);
        for (field, v) in [*before, first, second].iter().enumerate() {
            for i in 0..3 {
                self.starts[(3 * field + i) * WIDTH + lane] = v[i];
            }
        }
    }
}
