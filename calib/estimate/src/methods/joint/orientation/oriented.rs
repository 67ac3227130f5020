//! The static intervals of a joint fit as the tests of their orientation see them.

use nalgebra::{DMatrix, DVector, Vector3};
use sensor::{Base, Sensor};

use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::data::Mean;
use crate::methods::joint::faults::Suspect;
use crate::methods::joint::orientation::interval::Oriented;
use crate::methods::joint::orientation::{Pattern, Shown, StaticNumbers};
use crate::methods::joint::result::analysis::Analysis;
use crate::methods::joint::rows::{Linear, Rows};

/// A linearised problem.
pub struct At<'a> {
    /// The rows.
    pub rows: &'a Rows<'a>,
    /// Parameters at which it is linearised.
    pub x: &'a [f64],
    /// Residuals and Jacobian there, disturbances left out.
    pub linear: &'a Linear,
    /// The free parameters.
    pub free: &'a [usize],
    /// Columns of the earth's rotation in the rows, where it is not given.
    pub earth: Option<&'a Columns>,
}

impl At<'_> {
    /// Adds what depends on the orientation to the noise of either sensor, where the static intervals that nothing
    /// disturbed show it and it is not there yet; whether any was added.
    pub fn allow_patterns(
        &self,
        disturbed: &[&Suspect],
        analysis: &mut Analysis,
        shown: &mut Vec<(Sensor, Shown)>,
    ) -> bool {
        let mut any = false;
        for (sensor, patterns) in [
            (Sensor::Accelerometer, &Pattern::OF_NORM[..]),
            (Sensor::Gyroscope, &[Pattern::Force][..]),
        ] {
            if shown.iter().any(|(known, _)| *known == sensor) {
                continue;
            }
            let numbers = self.numbers(sensor, disturbed);
            if let Some(found) = numbers.shown(patterns) {
                analysis.allow_orientation(self.rows, sensor, &self.errors(patterns));
                shown.push((sensor, found));
                any = true;
            }
        }
        any
    }

    /// Returns the misfit of the norm of specific force at the static intervals that nothing disturbed, m/s²; zero
    /// where chance explains it.
    pub fn misfit_of_norm(&self, disturbed: &[&Suspect]) -> f64 {
        self.numbers(Sensor::Accelerometer, disturbed).misfit()
    }

    /// The norm of specific force, or the rate, of every static interval that nothing disturbed.
    fn numbers(&self, sensor: Sensor, disturbed: &[&Suspect]) -> StaticNumbers {
        let rows = self.rows;
        let shared: Vec<usize> = self
            .free
            .iter()
            .copied()
            .filter(|&k| k < rows.layout.shared())
            .collect();
        let earth = self
            .earth
            .filter(|_| sensor == Sensor::Gyroscope)
            .map_or(0, Columns::ncols);
        let mut out = Numbers::default();
        for rest in 0..rows.data.rests.len() {
            if self.is_disturbed(rest, disturbed) {
                continue;
            }
            let chunks = self.chunks(sensor, rest);
            let total: f64 = chunks.iter().map(|(_, m, _)| m.count as f64).sum();
            let Some(oriented) = self.oriented(rest).filter(|_| total > 0.0) else {
                continue;
            };
            for along in self.along(sensor, rest) {
                let mut number = Number::new(shared.len() + earth);
                for (row, mean, variance) in &chunks {
                    let share = mean.count as f64 / total;
                    number.variance += share.powi(2) * along.component_mul(variance).dot(&along);
                    for i in 0..3 {
                        let weight = share * along[i];
                        number.residual += weight * self.linear.residuals[row + i];
                        for (slope, &k) in number.slopes.iter_mut().zip(&shared) {
                            *slope += weight * self.linear.jacobian.get(row + i, k);
                        }
                        if let Some(columns) = self.earth.filter(|_| earth > 0) {
                            let own = number.slopes.iter_mut().skip(shared.len());
                            for (k, slope) in own.enumerate() {
                                *slope += weight * columns.get(row + i, k);
                            }
                        }
                    }
                }
                out.push((oriented, along), number);
            }
        }
        out.finish()
    }

    /// The rows of a sensor's chunks in a rest: first row, mean, variance of the mean.
    fn chunks(&self, sensor: Sensor, rest: usize) -> Vec<(usize, Mean, Vector3<f64>)> {
        let source = &self.rows.data.sources[self.rows.data.rests[rest].recording];
        let noise = source.noise(sensor);
        let means = self.rows.means(sensor);
        means
            .filter(|own| own.chunk.rest == rest)
            .filter_map(|own| Some((own.row, own.mean, noise?.variance_of(&own.mean))))
            .collect()
    }

    /// Along what a rest is measured: `Tᵀ u` for the norm, the three axes for the rate.
    fn along(&self, sensor: Sensor, rest: usize) -> Vec<Vector3<f64>> {
        match sensor {
            Sensor::Accelerometer => {
                let p = self.rows.local(self.x, sensor, rest);
                let base = Base::from_parameters(&p);
                vec![base.t.transpose() * self.rows.direction(self.x, rest)]
            }
            Sensor::Gyroscope | Sensor::Magnetometer => {
                (0..3).map(|k| Vector3::ith(k, 1.0)).collect()
            }
        }
    }

    fn oriented(&self, rest: usize) -> Option<Oriented> {
        let own = self.rows.data.rests.get(rest)?;
        let reference = self.rows.data.sources[own.recording].reference;
        Some(Oriented {
            direction: self.rows.direction(self.x, rest),
            last_change: own.known.last_change,
            time: 0.5 * (own.span.from + own.span.to) - reference,
            recording: own.recording,
        })
    }

    fn is_disturbed(&self, rest: usize, disturbed: &[&Suspect]) -> bool {
        let data = self.rows.data;
        let interval = |s: &&Suspect| s.fault.scope.static_interval(data, s.place);
        disturbed.iter().any(|s| interval(s) == Some(rest))
    }

    /// The errors of unit size of all patterns in every rest (3 × q).
    fn errors(&self, patterns: &[Pattern]) -> Vec<DMatrix<f64>> {
        let rests = 0..self.rows.data.rests.len();
        let all = rests.filter_map(|rest| self.oriented(rest));
        all.map(|oriented| {
            let axes = StaticNumbers {
                rows: (0..3).map(|i| (oriented, Vector3::ith(i, 1.0))).collect(),
                residuals: DVector::zeros(3),
                jacobian: DMatrix::zeros(3, 0),
                sigma: DVector::repeat(3, 1.0),
            };
            let columns: Vec<DVector<f64>> = patterns
                .iter()
                .flat_map(|&pattern| {
                    let own = axes.columns(pattern);
                    own.column_iter()
                        .map(|c| c.into_owned())
                        .collect::<Vec<_>>()
                })
                .collect();
            DMatrix::from_columns(&columns)
        })
        .collect()
    }
}

/// One number of a static interval.
struct Number {
    residual: f64,
    variance: f64,
    slopes: Vec<f64>,
}

impl Number {
    fn new(count: usize) -> Self {
        Self {
            residual: 0.0,
            variance: 0.0,
            slopes: vec![0.0; count],
        }
    }
}

#[derive(Default)]
struct Numbers {
    rows: Vec<(Oriented, Vector3<f64>)>,
    numbers: Vec<Number>,
}

impl Numbers {
    fn push(&mut self, row: (Oriented, Vector3<f64>), number: Number) {
        self.rows.push(row);
        self.numbers.push(number);
    }

    fn finish(self) -> StaticNumbers {
        let n = self.numbers.len();
        let columns = self.numbers.first().map_or(0, |number| number.slopes.len());
        StaticNumbers {
            rows: self.rows,
            residuals: DVector::from_fn(n, |i, _| self.numbers[i].residual),
            jacobian: DMatrix::from_fn(n, columns, |i, k| self.numbers[i].slopes[k]),
            sigma: DVector::from_fn(n, |i, _| self.numbers[i].variance.max(0.0).sqrt()),
        }
        .settled()
    }
}
