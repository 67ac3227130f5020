//! Residual of the stepwise fit to the norm of specific force, compared with the noise within the static intervals.

use effects::covariates::last_changes;
use nalgebra::{DMatrix, DVector, Vector3};
use recording::Recording;
use recording::intervals::Moments;
use sensor::Base;

use super::noise;
use crate::methods::joint::{Oriented, Pattern, Shown, StaticNumbers};
use crate::methods::{AccelerometerFit, Choice};

/// No mean is known better than this, m/s²: simulated rests may have no noise at all.
const LEAST_NOISE: f64 = 1e-7;

/// The products of a direction and a corrected reading that `T` is known by.
const PRODUCTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// The static intervals of a fit.
pub(super) struct StaticNorms {
    residuals: Vec<f64>,
    /// Standard deviations of the norms, m/s².
    sigma: Vec<f64>,
    /// Means, in the unit of the readings.
    means: Vec<Vector3<f64>>,
    /// Corrected means, m/s².
    forces: Vec<Vector3<f64>>,
    /// `Tᵀ u`: along what a norm is measured.
    along: Vec<Vector3<f64>>,
    /// Middles, s.
    times: Vec<f64>,
    recordings: Vec<usize>,
    rank: usize,
}

/// One of them.
pub(super) struct StaticNorm<'a> {
    /// Mean, in the unit of the readings.
    pub mean: &'a Vector3<f64>,
    /// Corrected mean, m/s².
    pub force: &'a Vector3<f64>,
    /// Its norm less gravity, m/s².
    pub residual: f64,
    /// The standard deviation of the norm, m/s².
    pub sigma: f64,
}

impl StaticNorms {
    /// Builds it from all static intervals; `None` where the residuals are not those of the intervals.
    pub fn of(
        fit: &AccelerometerFit,
        recordings: &[&Recording],
        choices: &[Choice],
    ) -> Option<Self> {
        let base = Base::from_parameters(fit.fitted.parameters.values());
        let mut norms = Self {
            residuals: fit.first.residuals.clone(),
            sigma: Vec::new(),
            means: Vec::new(),
            forces: Vec::new(),
            along: Vec::new(),
            times: Vec::new(),
            recordings: Vec::new(),
            rank: fit.fitted.rank,
        };
        for (place, (recording, choice)) in recordings.iter().zip(choices).enumerate() {
            let coloured = noise::long_run(recording.accelerometer.as_ref(), &choice.segmentation);
            for rest in &choice.segmentation.statics {
                let Some(moments) = rest.accelerometer else {
                    continue;
                };
                let middle = 0.5 * (rest.span.from + rest.span.to);
                norms.push(&base, &moments, coloured, (place, middle));
            }
        }
        (norms.sigma.len() == norms.residuals.len()).then_some(norms)
    }

    fn push(&mut self, base: &Base<f64>, rest: &Moments, coloured: f64, at: (usize, f64)) {
        let force = base.correct(&rest.mean);
        let u = force.normalize();
        let sigma = coloured * noise::of_norm(rest, base, &u);
        self.sigma.push(sigma.max(LEAST_NOISE));
        self.along.push(base.t.transpose() * u);
        self.means.push(rest.mean);
        self.forces.push(force);
        self.recordings.push(at.0);
        self.times.push(at.1);
    }

    /// `Σ (r/σ)² / (n − rank)`.
    pub fn reduced_chi2(&self) -> Option<f64> {
        let rows = self.residuals.iter().zip(&self.sigma);
        let sum: f64 = rows.map(|(r, sigma)| (r / sigma).powi(2)).sum();
        per_degree_of_freedom(sum, self.residuals.len(), self.rank)
    }

    /// Every interval.
    pub fn each(&self) -> impl Iterator<Item = StaticNorm<'_>> {
        (0..self.residuals.len()).map(|k| StaticNorm {
            mean: &self.means[k],
            force: &self.forces[k],
            residual: self.residuals[k],
            sigma: self.sigma[k],
        })
    }

    /// Finds the dependence of the residuals on the orientation that neither noise nor a random walk of a bias explains.
    pub fn pattern(&self) -> Option<Shown> {
        let n = self.residuals.len();
        let places = self.recordings.last()? + 1;
        let changes: Vec<Vector3<f64>> = (0..places)
            .flat_map(|place| {
                let own = (0..n).filter(|&k| self.recordings[k] == place);
                last_changes(&own.map(|k| self.forces[k]).collect::<Vec<_>>())
            })
            .collect();
        let middle = |place: usize| {
            let own = (0..n).filter(|&k| self.recordings[k] == place);
            let (sum, count) = own.fold((0.0, 0.0), |(s, c), k| (s + self.times[k], c + 1.0));
            sum / count
        };
        let middles: Vec<f64> = (0..places).map(middle).collect();
        let row = |k: usize| {
            let oriented = Oriented {
                direction: self.forces[k].normalize(),
                last_change: changes[k],
                time: self.times[k] - middles[self.recordings[k]],
                recording: self.recordings[k],
            };
            (oriented, self.along[k])
        };
        // A bias for every recording: a pattern that only common biases would show is left unsaid.
        let columns = PRODUCTS.len() + 3 * places;
        let slope = |k: usize, c: usize| match PRODUCTS.get(c) {
            Some((i, j)) => self.forces[k][*i] * self.forces[k][*j],
            None => {
                let own = c - PRODUCTS.len();
                let here = own / 3 == self.recordings[k];
                if here { self.along[k][own % 3] } else { 0.0 }
            }
        };
        let numbers = StaticNumbers {
            rows: (0..n).map(row).collect(),
            residuals: DVector::from_column_slice(&self.residuals),
            jacobian: DMatrix::from_fn(n, columns, slope),
            sigma: DVector::from_column_slice(&self.sigma),
        };
        numbers.settled().shown(&Pattern::OF_NORM)
    }
}

/// `Σ` over the rows that no parameter takes; `None` where none is left.
pub(super) fn per_degree_of_freedom(sum: f64, rows: usize, rank: usize) -> Option<f64> {
    let spare = rows.checked_sub(rank)?;
    (spare > 0 && sum.is_finite()).then(|| sum / spare as f64)
}
