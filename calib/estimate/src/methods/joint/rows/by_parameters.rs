//! The derivatives of an effect by its parameters.

use nalgebra::Vector3;
use sensor::{EffectRef, Kinematics};
use solver::scalar::{derivatives, variable};
use solver::{Jet, LANES, lit};

/// The derivatives of an effect by some of its parameters, for many instants.
pub struct ByParameters<'a> {
    effect: &'a EffectRef,
    passes: Passes,
}

/// Evaluations of the effect at every instant.
enum Passes {
    /// Unit parameters of an effect `F p`: the errors are the columns of `F`.
    Units(Vec<Vec<f64>>),
    /// Its error with derivatives by so many of the parameters at once.
    Jets(Vec<(Vec<Jet>, usize)>),
}

impl Passes {
    fn units(count: usize, wanted: &[usize]) -> Self {
        let unit = |k: &usize| {
            let mut unit = vec![0.0; count];
            unit[*k] = 1.0;
            unit
        };
        Self::Units(wanted.iter().map(unit).collect())
    }

    fn jets(p: &[f64], wanted: &[usize]) -> Self {
        let jets = |group: &[usize]| {
            let mut point: Vec<Jet> = p.iter().map(|&v| lit(v)).collect();
            for (lane, &k) in group.iter().enumerate() {
                point[k] = variable(p[k], lane);
            }
            (point, group.len())
        };
        Self::Jets(wanted.chunks(LANES).map(jets).collect())
    }
}

impl<'a> ByParameters<'a> {
    /// By the parameters `wanted` at their values `p`.
    pub fn new(effect: &'a EffectRef, p: &[f64], wanted: &[usize]) -> Self {
        let passes = if effect.is_linear() {
            Passes::units(p.len(), wanted)
        } else {
            Passes::jets(p, wanted)
        };
        Self { effect, passes }
    }

    /// By all parameters, as of an effect that is not linear in them.
    #[cfg(test)]
    pub fn by_jets(effect: &'a EffectRef, p: &[f64]) -> Self {
        let all: Vec<usize> = (0..p.len()).collect();
        let passes = Passes::jets(p, &all);
        Self { effect, passes }
    }

    /// Pushes them at one instant.
    pub fn at(&self, truth: &Kinematics<f64>, out: &mut Vec<Vector3<f64>>) {
        match &self.passes {
            Passes::Units(units) => {
                out.extend(units.iter().map(|unit| self.effect.error_f64(truth, unit)));
            }
            Passes::Jets(passes) => {
                let lifted = truth.lift();
                for (point, count) in passes {
                    let error = self.effect.error_jet(&lifted, point);
                    let by_lane = [0, 1, 2].map(|i| derivatives(&error[i]));
                    out.extend((0..*count).map(|lane| Vector3::from_fn(|i, _| by_lane[i][lane])));
                }
            }
        }
    }
}
