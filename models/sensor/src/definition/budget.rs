//! Computing budget of an effect that a user wrote in one run, and its first fault.

use std::mem::size_of;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use solver::Scalar;

use crate::kinematics::Kinematics;

/// Steps per reading in all fits of a run together: ten times what a fit of an effect as costly as any takes.
const STEPS_PER_READING: u64 = 60_000;

/// Fault of an effect that a user wrote.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EffectFault {
    /// Its steps are spent.
    StepsSpent,
    /// It was no number.
    NoNumber {
        /// Specific force there, m/s².
        force: [f64; 3],
        /// Angular rate there, rad/s.
        rate: [f64; 3],
        /// Its parameters.
        parameters: Vec<f64>,
    },
}

/// Steps left, and the first place where there was no number.
#[derive(Debug)]
pub(crate) struct Budget {
    /// Steps of an evaluation.
    cost: u64,
    /// Steps so far.
    spent: AtomicU64,
    /// Steps granted.
    granted: u64,
    no_number: OnceLock<EffectFault>,
}

impl Budget {
    /// Without end.
    pub fn endless(cost: u64) -> Self {
        Self {
            cost: cost.max(1),
            spent: AtomicU64::new(0),
            granted: u64::MAX,
            no_number: OnceLock::new(),
        }
    }

    /// Enough for `samples` readings.
    pub fn of(&self, samples: usize) -> Self {
        Self {
            granted: STEPS_PER_READING.saturating_mul(samples.max(1) as u64),
            ..Self::endless(self.cost)
        }
    }

    /// Takes the steps of one evaluation; false where they are spent. An evaluation with derivatives takes as many
    /// times more as it has numbers.
    pub fn spend<D: Scalar>(&self) -> bool {
        let numbers = (size_of::<D>() / size_of::<f64>()) as u64;
        let steps = self.cost * numbers;
        self.spent.fetch_add(steps, Ordering::Relaxed) < self.granted
    }

    /// Remembers the first instant at which the effect is no number.
    pub fn note_no_number<D: Scalar>(&self, truth: &Kinematics<D>, parameters: &[f64]) {
        self.no_number.get_or_init(|| EffectFault::NoNumber {
            force: truth.specific_force.map(|v| v.re()).into(),
            rate: truth.angular_rate.map(|v| v.re()).into(),
            parameters: parameters.to_vec(),
        });
    }

    /// Returns the fault, if there is one.
    pub fn fault(&self) -> Option<EffectFault> {
        if self.spent.load(Ordering::Relaxed) > self.granted {
            return Some(EffectFault::StepsSpent);
        }
        self.no_number.get().cloned()
    }
}
