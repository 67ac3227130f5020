//! Turns that miss by so much that they hide each other and everything else.

use estimate::methods::joint::{Column, OUTLYING_TURN, Suspect};
use nalgebra::{DMatrix, DVector};
use recording::averages::median;

use super::few_turns::KNOCKED;
use super::named_claim::NamedClaim;
use crate::family::{Claim, Hypothesis};
use crate::state::State;

findings::tuning! {
    /// A turn is taken out at once where its `χ²` of two degrees is beyond this, and beyond as many times the usual one.
    GROSS: f64 = 50.0;

    /// At most this share of the turns.
    SHARE: f64 = 0.2;
}

/// The median of `χ²` of two degrees.
const MEDIAN: f64 = 1.386;

/// The turns that are off by far more than all others, under white noise alone.
///
/// Noise of the biases that is estimated with such turns among the data explains them, and each hides the other: so they
/// come before it. The worst is taken out first; at the end each has to be as far off with all others out.
pub(super) fn outlying_turns(state: &State) -> Vec<NamedClaim> {
    let suspects: Vec<&Suspect> = state
        .suspects
        .iter()
        .filter(|s| s.fault == &OUTLYING_TURN)
        .collect();
    let turns = Turns::of(state, &suspects);
    let most = (SHARE.get() * suspects.len() as f64) as usize;
    let mut out: Vec<usize> = Vec::new();
    while out.len() < most {
        let Some((worst, _)) = turns.worst(&out) else {
            break;
        };
        out.push(worst);
    }
    let beside = |k: usize| {
        out.iter()
            .copied()
            .filter(|o| *o != k)
            .collect::<Vec<usize>>()
    };
    out.iter()
        .copied()
        .filter(|&k| turns.is_gross(k, &beside(k)))
        .map(|k| NamedClaim {
            claim: Claim::Disturbed(suspects[k].fault),
            hypothesis: Hypothesis {
                shape: None,
                place: Some(suspects[k].place),
                columns: 0..0,
            },
            evidence: 0.0,
        })
        .collect()
}

/// Prediction errors of turns from all rows but those taken out: `P = N Nᵀ` and `y = P r` of their rows.
struct Turns {
    precision: DMatrix<f64>,
    y: DVector<f64>,
    count: usize,
    /// The least `χ²` of a gross one.
    gross: f64,
}

impl Turns {
    fn of(state: &State, suspects: &[&Suspect]) -> Self {
        let all: Vec<&Column> = suspects.iter().flat_map(|s| &s.columns).collect();
        let bare = state.projected.white();
        let own = state.projected.by_recording(&state.sparse(&all));
        let (precision, y) = bare.by_recording(own).normal(0..all.len(), &bare.z);
        Self {
            precision,
            y,
            count: suspects.len(),
            gross: if state.fit.data.misses_something_between_samples() {
                KNOCKED.get() * GROSS.get()
            } else {
                GROSS.get()
            },
        }
    }

    /// `χ²` of every turn, those in `out` taken out; nothing of these.
    fn statistics(&self, out: &[usize]) -> Vec<Option<f64>> {
        let rows: Vec<usize> = out.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
        let part = |a: &[usize], b: &[usize]| {
            DMatrix::from_fn(a.len(), b.len(), |i, k| self.precision[(a[i], b[k])])
        };
        let inverse = part(&rows, &rows).try_inverse();
        let known = DVector::from_fn(rows.len(), |i, _| self.y[rows[i]]);
        let of = |k: usize| {
            if out.contains(&k) {
                return None;
            }
            let own = [2 * k, 2 * k + 1];
            let (mut p, mut y) = (part(&own, &own), DVector::from_fn(2, |i, _| self.y[own[i]]));
            if !rows.is_empty() {
                let across = part(&own, &rows) * inverse.as_ref()?;
                p -= &across * part(&rows, &own);
                y -= &across * &known;
            }
            Some(y.dot(&(p.try_inverse()? * &y)))
        };
        (0..self.count).map(of).collect()
    }

    fn limit(&self, statistics: &[Option<f64>]) -> f64 {
        let usual = median(statistics.iter().flatten().copied()).unwrap_or(0.0);
        self.gross * (usual / MEDIAN).max(1.0)
    }

    fn worst(&self, out: &[usize]) -> Option<(usize, f64)> {
        let all = self.statistics(out);
        let limit = self.limit(&all);
        let places = all.iter().enumerate().filter_map(|(k, s)| Some((k, (*s)?)));
        let worst = places.max_by(|a, b| a.1.total_cmp(&b.1));
        worst.filter(|(_, s)| *s > limit)
    }

    fn is_gross(&self, k: usize, others: &[usize]) -> bool {
        let all = self.statistics(others);
        all[k].is_some_and(|s| s > self.limit(&all))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten turns of precision one that share a parameter, so that one that is off moves all.
    fn turns(y: &[f64]) -> Turns {
        let n = y.len();
        let shared = DMatrix::from_element(n, n, 1.0 / n as f64);
        let precision = DMatrix::identity(n, n) - shared;
        Turns {
            y: &precision * DVector::from_column_slice(y),
            precision,
            count: n / 2,
            gross: GROSS.get(),
        }
    }

    #[test]
    fn two_neighbours_that_are_off_do_not_hide_each_other_nor_flag_a_third() {
        let mut y = vec![0.5; 20];
        (y[6], y[8]) = (300.0, 200.0);
        let turns = turns(&y);
        let first = turns.worst(&[]).unwrap().0;
        let second = turns.worst(&[first]).unwrap().0;
        assert_eq!([first, second], [3, 4]);
        assert!(turns.worst(&[first, second]).is_none());
        assert!(turns.is_gross(3, &[4]) && turns.is_gross(4, &[3]));
    }
}
