//! Residual of the stepwise fit to the norm of specific force, compared with the noise within the static intervals.

use effects::covariates::last_changes;
use nalgebra::{DMatrix, DVector, Vector3};
use sensor::Base;

use super::cut::Cut;
use super::noise;
use crate::methods::AccelerometerFit;
use crate::methods::joint::{Oriented, Pattern, Shown, StaticNumbers};

findings::tuning! {
    /// No mean is known better than this, m/s²: simulated rests may have no noise at all.
    LEAST_NOISE: f64 = 1e-7;
}

/// The products of a direction and a corrected reading that `T` is known by.
const PRODUCTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// The static intervals of a fit.
pub(super) struct StaticNorms {
    /// Every interval.
    pub all: Vec<StaticNorm>,
    rank: usize,
}

/// One of them.
pub(super) struct StaticNorm {
    /// Mean, in the unit of the readings.
    pub mean: Vector3<f64>,
    /// Corrected mean, m/s².
    pub force: Vector3<f64>,
    /// Its norm less gravity, m/s².
    pub residual: f64,
    /// The standard deviation of the norm, m/s².
    pub sigma: f64,
    /// `Tᵀ u`: along what the norm is measured.
    along: Vector3<f64>,
    /// Middle, s.
    time: f64,
    /// Place of its recording among all.
    recording: usize,
}

impl StaticNorms {
    /// Builds it from all static intervals; `None` where the residuals are not those of the intervals.
    pub fn of(fit: &AccelerometerFit, cut: &Cut<'_>) -> Option<Self> {
        let base = Base::from_parameters(fit.fitted.parameters.values());
        let mut all = Vec::new();
        for (place, (recording, segmentation)) in cut.each().enumerate() {
            let coloured = noise::long_run(recording.accelerometer.as_ref(), segmentation);
            for rest in &segmentation.statics {
                let Some(moments) = rest.accelerometer else {
                    continue;
                };
                let force = base.correct(&moments.mean);
                let u = force.normalize();
                let sigma = coloured * noise::of_norm(&moments, &base, &u);
                all.push(StaticNorm {
                    mean: moments.mean,
                    force,
                    residual: *fit.first.residuals.get(all.len())?,
                    sigma: sigma.max(LEAST_NOISE.get()),
                    along: base.t.transpose() * u,
                    time: 0.5 * (rest.span.from + rest.span.to),
                    recording: place,
                });
            }
        }
        (all.len() == fit.first.residuals.len()).then_some(Self {
            all,
            rank: fit.fitted.rank,
        })
    }

    /// `Σ (r/σ)² / (n − rank)`.
    pub fn reduced_chi2(&self) -> Option<f64> {
        let squares = self
            .all
            .iter()
            .map(|own| (own.residual / own.sigma).powi(2));
        per_degree_of_freedom(squares.sum(), self.all.len(), self.rank)
    }

    /// Finds the dependence of the residuals on the orientation that neither noise nor a random walk of a bias explains.
    pub fn pattern(&self) -> Option<Shown> {
        let (all, n) = (&self.all, self.all.len());
        let places = all.last()?.recording + 1;
        let of_place = |place: usize| all.iter().filter(move |own| own.recording == place);
        let changes: Vec<Vector3<f64>> = (0..places)
            .flat_map(|place| {
                let forces = of_place(place).map(|own| own.force);
                last_changes(&forces.collect::<Vec<_>>())
            })
            .collect();
        let middle = |place: usize| {
            let own = of_place(place);
            let (sum, count) = own.fold((0.0, 0.0), |(s, c), own| (s + own.time, c + 1.0));
            sum / count
        };
        let middles: Vec<f64> = (0..places).map(middle).collect();
        let row = |(own, last_change): (&StaticNorm, Vector3<f64>)| {
            let oriented = Oriented {
                direction: own.force.normalize(),
                last_change,
                time: own.time - middles[own.recording],
                recording: own.recording,
            };
            (oriented, own.along)
        };
        // A bias for every recording: a pattern that only common biases would show is left unsaid.
        let columns = PRODUCTS.len() + 3 * places;
        let slope = |k: usize, c: usize| match PRODUCTS.get(c) {
            Some((i, j)) => all[k].force[*i] * all[k].force[*j],
            None => {
                let own = c - PRODUCTS.len();
                let here = own / 3 == all[k].recording;
                if here { all[k].along[own % 3] } else { 0.0 }
            }
        };
        let numbers = StaticNumbers {
            rows: all.iter().zip(changes).map(row).collect(),
            residuals: DVector::from_fn(n, |k, _| all[k].residual),
            jacobian: DMatrix::from_fn(n, columns, slope),
            sigma: DVector::from_fn(n, |k, _| all[k].sigma),
        };
        numbers.settled().shown(&Pattern::OF_NORM)
    }
}

/// `Σ` over the rows that no parameter takes; `None` where none is left.
pub(super) fn per_degree_of_freedom(sum: f64, rows: usize, rank: usize) -> Option<f64> {
    let spare = rows.checked_sub(rank)?;
    (spare > 0 && sum.is_finite()).then(|| sum / spare as f64)
}
