//! Motion of the biases during a recording, and test of the earth's rotation against the latitude.

use faer::Mat;
use nalgebra::{DMatrix, DVector, Matrix2x3, Matrix3, Vector3};
use recording::intervals::Span;
use sensor::Sensor;

use crate::methods::chance;
use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::data::Mean;
use crate::methods::joint::fit::JointFit;
use crate::methods::joint::noise::bias::BiasNoise;
use crate::methods::joint::rows::MeanRows;
use crate::methods::joint::rows::turn::MARGIN;

findings::tuning! {
    /// A column of which a projection leaves a smaller square than this share is in the model: what is left is rounding.
    ROUNDING: f64 = 1e-16;
}

/// A bias that changes evenly with time, as far as the static intervals show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasMotion {
    /// From the begin of the first static interval to the end of the last, s.
    pub span: Span,
    /// Change from begin to end, near SI units (3).
    pub change: Vector3<f64>,
    /// Its standard error (3).
    pub std: Vector3<f64>,
    /// Share of the change that lies before the mean over the static intervals, for which the bias is stated.
    pub before: f64,
    /// Probability of a change as large as this by chance, walks among it; the larger of that and the one beside a bias that goes
    /// with the force, which the orientations at begin and end may show as a change.
    pub p_value: f64,
}

impl JointFit {
    /// The density of the random walk of a sensor's bias, near SI units per √s; 0 where there is none.
    pub fn walk(&self, sensor: Sensor) -> f64 {
        let kind = BiasNoise::walk_of(sensor);
        let own = self.levels.iter().find(|level| level.kind == kind);
        own.map_or(0.0, |level| level.size)
    }

    /// The motion of the biases of the accelerometer and the gyroscope in each recording; `None` of one with fewer than two chunks.
    pub fn bias_motions(&self) -> [Vec<Option<BiasMotion>>; 2] {
        // What the misfit depends on besides is no motion.
        let model = Basis::of(&self.jacobian.beside(&self.carried));
        [Sensor::Accelerometer, Sensor::Gyroscope].map(|sensor| {
            let recordings = 0..self.data.sources.len();
            let of = |recording| self.bias_motion(sensor, recording, &model);
            recordings.map(of).collect()
        })
    }

    /// Estimates the motion of a bias in a recording: the slope of the readings over time, at the static intervals and, of a
    /// gyroscope, in the turns, beside everything that was fitted, walks counted as noise. `None` with fewer than two chunks.
    fn bias_motion(&self, sensor: Sensor, recording: usize, model: &Basis) -> Option<BiasMotion> {
        let means = self.own_means(sensor, recording);
        let span = Span {
            from: means.first()?.mean.span.from,
            to: means.last()?.mean.span.to,
        };
        let length: f64 = means.iter().map(|own| own.mean.span.length()).sum();
        let middle = |m: &Mean| 0.5 * (m.span.from + m.span.to);
        let weighted = means
            .iter()
            .map(|own| middle(&own.mean) * own.mean.span.length());
        let centre = weighted.sum::<f64>() / length;
        if span.length() <= 0.0 || means.len() < 2 {
            return None;
        }
        let share = |t: f64| (t - centre) / span.length();
        let mut columns = [const { Column::none() }; 3];
        for own in &means {
            for (axis, column) in columns.iter_mut().enumerate() {
                column.set(own.row + axis, share(middle(&own.mean)));
            }
        }
        if sensor == Sensor::Gyroscope {
            self.add_turns(&mut columns, recording, share);
        }
        let chance = |change: &Vector3<f64>, covariance: &Matrix3<f64>| {
            let chi2 = change.dot(&(covariance.cholesky()?.solve(change)));
            Some(chance::of_chi2(chi2, 3.0))
        };
        let alone: Vec<&Column> = columns.iter().collect();
        let (change, covariance) = self.beside(&alone, model)?;
        let by_force = (sensor == Sensor::Gyroscope).then(|| {
            let by_force = columns_by_force(&means);
            let all: Vec<&Column> = columns.iter().chain(&by_force).collect();
            self.beside(&all, model)
        });
        let by_force = by_force
            .flatten()
            .and_then(|(change, covariance)| chance(&change, &covariance));
        let p_value = chance(&change, &covariance)?.max(by_force.unwrap_or(0.0));
        Some(BiasMotion {
            span,
            change,
            std: covariance.diagonal().map(|v| v.max(0.0).sqrt()),
            before: (centre - span.from) / span.length(),
            p_value,
        })
    }

    /// The means of a sensor in a recording, with their rows.
    fn own_means(&self, sensor: Sensor, recording: usize) -> Vec<MeanRows<'_>> {
        let is_own = |own: &MeanRows<'_>| self.data.rests[own.chunk.rest].recording == recording;
        self.rows().means(sensor).filter(is_own).collect()
    }

    /// Adds the effect of a bias that goes with time as `share` on the turns of a recording, as on the means: `−∂r/∂b`.
    fn add_turns(&self, columns: &mut [Column; 3], recording: usize, share: impl Fn(f64) -> f64) {
        let rows = self.rows();
        for (k, turn) in self.data.turns.iter().enumerate() {
            if turn.recording != recording {
                continue;
            }
            let gains = rows.gains(self.parameters.values(), turn);
            let t = turn.t[MARGIN..].iter();
            let by_bias: Matrix2x3<f64> = gains.iter().zip(t).map(|(g, t)| g * share(*t)).sum();
            let first = self.first_rows[1] + 2 * k;
            for (axis, column) in columns.iter_mut().enumerate() {
                (0..2).for_each(|i| column.set(first + i, -by_bias[(i, axis)]));
            }
        }
    }

    /// Estimates the coefficients of the first three of some columns beside the others and everything that was fitted, and their
    /// covariance; `None` where what was fitted leaves nothing of a column, as where the model has that drift.
    fn beside(&self, columns: &[&Column], model: &Basis) -> Option<(Vector3<f64>, Matrix3<f64>)> {
        let columns = Columns::sparse(self.whitening.white.groups(), columns);
        let whole = self.whitening.whiten(columns);
        let left = model.without(&whole).to_dense();
        let whole = whole.to_dense();
        let is_left = |k: usize| {
            let [left, whole] = [&left, &whole].map(|of| of.col(k).squared_norm_l2());
            left > ROUNDING.get() * whole
        };
        if !(0..left.ncols()).all(is_left) {
            return None;
        }
        let r = Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]);
        let gram = left.transpose() * &left;
        let right = left.transpose() * &r;
        let n = gram.nrows();
        let gram = DMatrix::from_fn(n, n, |i, k| gram[(i, k)]);
        let inverse = gram.cholesky()?.inverse();
        // Residuals are model less measurement.
        let all = -(&inverse * DVector::from_fn(n, |i, _| right[(i, 0)]));
        let first = Matrix3::from_fn(|i, k| inverse[(i, k)]);
        Some((Vector3::from_fn(|i, _| all[i]), first))
    }

    /// Estimates the change of a held parameter if it were free, and its standard error; `None` where there is no such
    /// parameter or it is unobservable.
    pub fn pull_of_held(&self, name: &str) -> Option<(f64, f64)> {
        let place = self.parameters.index(name)?;
        let linear = self.rows().linearize(self.parameters.values());
        let column = self.whitening.whiten(linear.jacobian.select(&[place]));
        let left = Basis::of(&self.jacobian).without(&column).to_dense();
        let square = left.squared_norm_l2();
        let of_left = left.col(0).iter().zip(&self.residuals);
        let moved: f64 = of_left.map(|(l, r)| l * r).sum();
        (square > 0.0).then(|| (-moved / square, square.sqrt().recip()))
    }
}

/// Columns of a gyroscope's bias that is proportional to the force at rest, on each axis by each component (9).
fn columns_by_force(rates: &[MeanRows<'_>]) -> Vec<Column> {
    let mut columns: Vec<Column> = (0..9).map(|_| Column::none()).collect();
    for own in rates {
        if let Some(force) = own.chunk.mean(Sensor::Accelerometer) {
            for (k, column) in columns.iter_mut().enumerate() {
                column.set(own.row + k / 3, force.value[k % 3]);
            }
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use recording::intervals::{Detector, segment};
    use simulate::Spec;

    use crate::methods::joint::{JointRequest, fit_joint};

    #[test]
    fn beside_a_drift_of_the_model_no_bias_moves() {
        let recording = Spec::hand_held(5).run().unwrap().recording;
        let segmentation = segment(&recording, &Detector::default()).unwrap();
        let gravity = Spec::hand_held(5).gravity;
        let mut request = JointRequest::new(vec![(&recording, &segmentation)], gravity);
        let mut all = effects::catalogue_of(sensor::Sensor::Accelerometer);
        let drift = all.find(|own| own.name() == "accel_drift").unwrap();
        request.accelerometer = request.accelerometer.with(drift);
        let moved = fit_joint(&request).unwrap().bias_motions();
        assert!(moved[0][0].is_none() && moved[1][0].is_some());
    }

    #[test]
    fn a_bias_moves_by_as_much_as_is_said() {
        let drifts = ["accel_drift", "gyro_drift"].into_iter().enumerate();
        for ((place, drift), size) in drifts.flat_map(|own| [(own, 0.0), (own, 30.0)]) {
            let session = Spec::hand_held(5).with_effect(drift, size).run().unwrap();
            let recording = &session.recording;
            let segmentation = segment(recording, &Detector::default()).unwrap();
            let gravity = Spec::hand_held(5).gravity;
            let request = JointRequest::new(vec![(recording, &segmentation)], gravity);
            let moved = fit_joint(&request).unwrap().bias_motions()[place][0].unwrap();
            assert_eq!(moved.p_value < 1e-3, size > 0.0, "{drift} {size}");
            for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                let slope = session.truth.get(&format!("{drift}.{name}")).unwrap_or(0.0);
                let truth = slope * moved.span.length();
                // A reading is the signal over a scale factor of a few percent.
                let allowed = 4.0 * moved.std[axis] + 0.04 * truth.abs();
                let (found, std) = (moved.change[axis], moved.std[axis]);
                assert!(
                    (found - truth).abs() < allowed,
                    "{drift} {size} {name}: {found} ± {std}, {truth}"
                );
            }
        }
    }
}
