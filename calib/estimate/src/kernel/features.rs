//! Effects that are linear in their parameters and blind to the gyroscope's own signal: known numbers
//! times parameters, `e = F p`.

use nalgebra::Vector3;
use sensor::{EffectRef, Kinematics, Model};
use solver::scalar::{derivatives, variable};
use solver::{Jet, LANES, lit};

use crate::residuals::TurnData;
use crate::truth::unneeded;

/// One element of `F` that is not always zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    /// Axis of the error: the row of `F`.
    pub axis: usize,
    /// Parameter among those of the effects: the column of `F`.
    pub parameter: usize,
}

/// `F` at every sample of every turn, without the elements that are always zero.
#[derive(Clone, Debug, Default)]
pub(super) struct Features {
    entries: Vec<Entry>,
    /// Turn by turn, sample by sample, entry by entry.
    values: Vec<Vec<f64>>,
}

impl Features {
    /// Computes them for a model all of whose effects are linear; `None` where one is not.
    pub fn of(model: &Model, turns: &[TurnData]) -> Option<Self> {
        if !model.effects().iter().all(|effect| effect.is_linear()) {
            return None;
        }
        if model.effects().is_empty() {
            return Some(Self::default());
        }
        let dense: Vec<Vec<Vec<Vector3<f64>>>> =
            turns.iter().map(|turn| columns(model, turn)).collect();
        let parameters = dense.iter().flatten().map(Vec::len).max().unwrap_or(0);
        let all =
            (0..parameters).flat_map(|parameter| (0..3).map(move |axis| Entry { axis, parameter }));
        let entries: Vec<Entry> = all
            .filter(|entry| {
                let mut samples = dense.iter().flatten();
                samples.any(|sample| sample[entry.parameter][entry.axis] != 0.0)
            })
            .collect();
        let kept = |sample: &Vec<Vector3<f64>>| -> Vec<f64> {
            let value = |entry: &Entry| sample[entry.parameter][entry.axis];
            entries.iter().map(value).collect()
        };
        let values = dense
            .iter()
            .map(|turn| turn.iter().flat_map(kept).collect())
            .collect();
        Some(Self { entries, values })
    }

    /// The elements that are not always zero.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Samples of a turn that have features.
    pub fn samples(&self, turn: usize) -> usize {
        let values = self.values.get(turn).map_or(0, Vec::len);
        values / self.entries.len().max(1)
    }

    /// An element at a sample of a turn.
    pub fn value(&self, turn: usize, sample: usize, entry: usize) -> f64 {
        self.values[turn][sample * self.entries.len() + entry]
    }
}

/// The columns of `F` at each sample.
fn columns(model: &Model, turn: &TurnData) -> Vec<Vec<Vector3<f64>>> {
    let still = unneeded();
    (0..turn.t.len())
        .map(|k| {
            let known = turn.rest.get(k).unwrap_or(&still);
            let effects = model.effects().iter();
            effects
                .flat_map(|effect| of_effect(effect, known))
                .collect()
        })
        .collect()
}

/// `∂e/∂p` of one effect.
fn of_effect(effect: &EffectRef, known: &Kinematics<f64>) -> Vec<Vector3<f64>> {
    let count = effect.params().len();
    let mut columns = Vec::with_capacity(count);
    for from in (0..count).step_by(LANES) {
        let mut p: Vec<Jet> = vec![lit(0.0); count];
        let lanes = LANES.min(count - from);
        for lane in 0..lanes {
            p[from + lane] = variable(0.0, lane);
        }
        let slopes = effect.error_jet(&known.lift(), &p).map(|v| derivatives(&v));
        columns.extend((0..lanes).map(|lane| Vector3::from_fn(|i, _| slopes[i][lane])));
    }
    columns
}
