//! Computing budget of an effect that a user wrote, and its first fault.

use std::mem::size_of;
use std::sync::OnceLock;
use std::sync::RwLock;
use std::sync::atomic::{AtomicU64, Ordering};

use solver::Scalar;

use crate::kinematics::Kinematics;

/// Steps per reading in all fits of a command together: ten times what a fit of an effect as costly as any takes.
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
    granted: AtomicU64,
    no_number: RwLock<OnceLock<EffectFault>>,
}

impl Budget {
    /// Without end, until [`Budget::grant`].
    pub fn new(cost: u64) -> Self {
        Self {
            cost: cost.max(1),
            spent: AtomicU64::new(0),
            granted: AtomicU64::new(u64::MAX),
            no_number: RwLock::default(),
        }
    }

    /// Enough for `samples` readings, counted from now on.
    pub fn grant(&self, samples: usize) {
        let granted = STEPS_PER_READING.saturating_mul(samples.max(1) as u64);
        self.granted.store(granted, Ordering::Relaxed);
        self.spent.store(0, Ordering::Relaxed);
        if let Ok(mut no_number) = self.no_number.write() {
            *no_number = OnceLock::new();
        }
    }

    /// Takes the steps of one evaluation; false where they are spent. An evaluation with derivatives takes as many
    /// times more as it has numbers.
    pub fn spend<D: Scalar>(&self) -> bool {
        let numbers = (size_of::<D>() / size_of::<f64>()) as u64;
        let steps = self.cost * numbers;
        self.spent.fetch_add(steps, Ordering::Relaxed) < self.granted.load(Ordering::Relaxed)
    }

    /// Remembers the first instant at which the effect is no number.
    pub fn note_no_number<D: Scalar>(&self, truth: &Kinematics<D>, parameters: &[f64]) {
        if let Ok(no_number) = self.no_number.read() {
            no_number.get_or_init(|| EffectFault::NoNumber {
                force: truth.specific_force.map(|v| v.re()).into(),
                rate: truth.angular_rate.map(|v| v.re()).into(),
                parameters: parameters.to_vec(),
            });
        }
    }

    /// Returns the fault, if there is one.
    pub fn fault(&self) -> Option<EffectFault> {
        let (spent, granted) = (
            self.spent.load(Ordering::Relaxed),
            self.granted.load(Ordering::Relaxed),
        );
        if spent > granted {
            return Some(EffectFault::StepsSpent);
        }
        self.no_number.read().ok()?.get().cloned()
    }
}
