//! Any sensor model: values of the signal first, then the turns side by side, then the derivative of
//! the sensor at each sample against the two vectors that the turn hands back.

use nalgebra::Vector3;
use rayon::prelude::*;
use sensor::{Base, Kinematics, Model};

use super::adjoint::{Adjoints, adjoints};
use super::affine::Affine;
use super::features::Features;
use super::groups::{over_groups, propagate_all};
use super::packed::{Group, pack_signals};
use super::sensitivity::Sensitivity;
use super::series::Degree;
use super::slopes::Slopes;
use crate::residuals::TurnData;
use crate::truth::unneeded;

/// Turns of any model.
#[derive(Debug)]
pub(super) struct General<'a> {
    model: &'a Model,
    turns: &'a [TurnData],
}

impl<'a> General<'a> {
    pub fn new(model: &'a Model, turns: &'a [TurnData]) -> Self {
        Self { model, turns }
    }

    /// Gravity after each turn; `None` where a step is too long for the series.
    pub fn gravity(&self, x: &[f64]) -> Option<Vec<[f64; 3]>> {
        let groups = pack_signals(self.turns, &self.signals(x));
        propagate_all(&groups, &perfect(&Features::default()), self.turns.len())
    }

    /// The slopes of each turn; `None` where a step is too long for the series.
    pub fn slopes(&self, x: &[f64], free: &[usize]) -> Option<Vec<(usize, Slopes)>> {
        let signals = self.signals(x);
        let groups = pack_signals(self.turns, &signals);
        let each = over_groups(&groups, one_group);
        let each: Option<Vec<Vec<(usize, Adjoints)>>> = each.into_iter().collect();
        let each: Vec<(usize, Adjoints)> = each?.into_iter().flatten().collect();
        let slopes = each.into_par_iter().map(|(k, adjoints)| {
            let mut sensitivity = Sensitivity::new(self.model, x, free);
            for (sample, signal) in signals[k].iter().enumerate() {
                let turn = &self.turns[k];
                let known = known(turn, sample);
                let weight = adjoints.of_sample(&turn.t, sample);
                sensitivity.add(&turn.readings[sample], signal, &known, &weight);
            }
            let slopes = Slopes {
                frame: adjoints.frame,
                gradients: sensitivity.gradients(),
            };
            (k, slopes)
        });
        Some(slopes.collect())
    }

    /// The corrected rate at each sample of each turn, rad/s.
    fn signals(&self, x: &[f64]) -> Vec<Vec<Vector3<f64>>> {
        let of_turn = |turn: &TurnData| {
            let readings = turn.readings.iter().enumerate();
            let correct = |(k, raw)| self.model.correct(raw, &known(turn, k), x);
            readings.map(correct).collect()
        };
        self.turns.par_iter().map(of_turn).collect()
    }
}

/// Returns the kinematics of a sample besides the reading.
fn known(turn: &TurnData, sample: usize) -> Kinematics<f64> {
    turn.rest.get(sample).copied().unwrap_or_else(unneeded)
}

/// A sensor that reads the truth.
fn perfect(none: &Features) -> Affine<'_> {
    Affine {
        base: Base::identity(),
        effects: &[],
        features: none,
    }
}

fn one_group(group: &Group) -> Option<Vec<(usize, Adjoints)>> {
    let none = Features::default();
    let affine = perfect(&none);
    let degree = Degree::for_angle(affine.longest_step(&group.bounds))?;
    Some(adjoints(group, &affine, degree))
}
