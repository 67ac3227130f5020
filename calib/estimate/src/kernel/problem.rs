//! The turns of a recording as a problem for the solver.

use faer::Mat;
use solver::Problem;

use super::affine::{Affine, FRAME_FIELDS, differentiate};
use super::curvature::curvature;
use super::features::Features;
use super::general::General;
use super::groups::{each_turn, over_groups, propagate_all};
use super::lanes::WIDTH;
use super::packed::{Group, pack};
use super::series::Degree;
use super::slopes::Slopes;
use crate::residuals::{Integrator, PropagatedGravity};

/// Method by which the turns are integrated and differentiated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// `ω = T (x − b) − F p`: the base model and effects that are linear in their parameters and do
    /// not depend on the rate itself.
    Affine,
    /// Any sensor model: dual numbers sample by sample, over the signal and the effects' parameters.
    General,
    /// Dual numbers straight through the integration: any integrator, and the oracle of the others.
    Straight,
}

/// [`PropagatedGravity`] made ready for many evaluations; rows and parameters are the same.
///
/// Same numbers in, same bits out, whatever the number of threads: no sum crosses a turn.
#[derive(Debug)]
pub struct TurnProblem<'a> {
    straight: PropagatedGravity<'a>,
    ready: Ready<'a>,
}

/// Data that each tier keeps between evaluations.
#[derive(Debug)]
enum Ready<'a> {
    Affine {
        features: Features,
        groups: Vec<Group>,
    },
    General(General<'a>),
    Straight,
}

impl<'a> TurnProblem<'a> {
    /// At the fastest tier that the model and the integrator allow.
    pub fn new(residual: PropagatedGravity<'a>) -> Self {
        [Tier::Affine, Tier::General]
            .into_iter()
            .find_map(|tier| Self::at(residual, tier))
            .unwrap_or(Self {
                straight: residual,
                ready: Ready::Straight,
            })
    }

    /// At a given tier; `None` where it cannot express the model or the integrator.
    pub fn at(residual: PropagatedGravity<'a>, tier: Tier) -> Option<Self> {
        let exponential = residual.integrator == Integrator::Exponential;
        let ready = match tier {
            Tier::Straight => Ready::Straight,
            _ if !exponential => return None,
            Tier::General => Ready::General(General::new(residual.model, residual.turns)),
            Tier::Affine => {
                let features = Features::of(residual.model, residual.turns)?;
                let groups = pack(residual.turns, &features);
                Ready::Affine { features, groups }
            }
        };
        Some(Self {
            straight: residual,
            ready,
        })
    }

    /// The tier.
    pub fn tier(&self) -> Tier {
        match self.ready {
            Ready::Affine { .. } => Tier::Affine,
            Ready::General(_) => Tier::General,
            Ready::Straight => Tier::Straight,
        }
    }

    /// Sets the standard deviation of a row, rad.
    pub fn weigh(&mut self, sigma: f64) {
        self.straight.sigma = sigma;
    }

    /// Gravity after each turn, turn by turn; `None` where a step is too long for the series.
    fn gravity(&self, x: &[f64]) -> Option<Vec<[f64; 3]>> {
        match &self.ready {
            Ready::Affine { features, groups } => {
                propagate_all(groups, &Affine::new(x, features), self.straight.turns.len())
            }
            Ready::General(general) => general.gravity(x),
            Ready::Straight => None,
        }
    }

    /// `d²/dt²` of gravity after each turn at `x + t v`; `None` where only the straight way knows it.
    fn curvature(&self, x: &[f64], v: &[f64]) -> Option<Vec<[f64; 3]>> {
        let Ready::Affine { features, groups } = &self.ready else {
            return None;
        };
        let (at, along) = (Affine::new(x, features), Affine::new(v, features));
        let turns = self.straight.turns.len();
        each_turn(groups, turns, &at, |group, degree, out| {
            curvature(group, &at, &along, degree, out);
        })
    }

    fn slopes(&self, x: &[f64], free: &[usize]) -> Option<Vec<(usize, Slopes)>> {
        match &self.ready {
            Ready::Affine { features, groups } => {
                differentiate_all(groups, &Affine::new(x, features), free)
            }
            Ready::General(general) => general.slopes(x, free),
            Ready::Straight => None,
        }
    }
}

impl Problem for TurnProblem<'_> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let Some(gravity) = self.gravity(x) else {
            return self.straight.values(x, out);
        };
        let weight = self.straight.sigma.recip();
        out.clear();
        for (turn, u) in self.straight.turns.iter().zip(&gravity) {
            out.extend((0..3).map(|i| (u[i] - turn.after[i]) * weight));
        }
    }

    fn linearize(&self, x: &[f64], free: &[usize], residuals: &mut Vec<f64>) -> Mat<f64> {
        let Some(slopes) = self.slopes(x, free) else {
            return self.straight.linearize(x, free, residuals);
        };
        let turns = self.straight.turns;
        residuals.clear();
        residuals.resize(3 * turns.len(), 0.0);
        let mut jacobian = Mat::zeros(3 * turns.len(), free.len());
        for (turn, slopes) in &slopes {
            let rows = slopes.rows(&turns[*turn], self.straight.sigma);
            for (i, (residual, derivatives)) in rows.into_iter().enumerate() {
                residuals[3 * turn + i] = residual;
                for (column, derivative) in derivatives.into_iter().enumerate() {
                    jacobian[(3 * turn + i, column)] = derivative;
                }
            }
        }
        jacobian
    }

    fn second_derivative(&self, x: &[f64], v: &[f64], out: &mut Vec<f64>) -> bool {
        let Some(curvature) = self.curvature(x, v) else {
            return self.straight.second_derivative(x, v, out);
        };
        let weight = self.straight.sigma.recip();
        out.clear();
        out.extend(curvature.iter().flatten().map(|c| c * weight));
        true
    }
}

fn differentiate_all(
    groups: &[Group],
    affine: &Affine<'_>,
    free: &[usize],
) -> Option<Vec<(usize, Slopes)>> {
    let fields = 2 * (FRAME_FIELDS + affine.features.entries().len());
    let each = over_groups(groups, |group| {
        let degree = Degree::for_angle(affine.longest_step(&group.bounds))?;
        let mut sums = vec![0.0; fields * WIDTH];
        differentiate(group, affine, degree, &mut sums);
        let lanes = group.turns.iter().enumerate();
        let slopes = lanes
            .map(|(lane, &turn)| (turn, Slopes::from_sums(&sums, lane, affine, free)))
            .collect::<Vec<_>>();
        Some(slopes)
    });
    let each: Option<Vec<_>> = each.into_iter().collect();
    Some(each?.into_iter().flatten().collect())
}
