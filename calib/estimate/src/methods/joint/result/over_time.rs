//! Motion of the biases during a recording, and test of the earth's rotation against the latitude.

use faer::Mat;
use nalgebra::{Matrix3, Vector3};
use recording::intervals::Span;
use sensor::Sensor;

use crate::methods::joint::blocks::basis::Basis;
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::data::{Chunk, Mean};
use crate::methods::joint::fit::JointFit;

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
}

impl JointFit {
    /// Estimates the motion of a bias in a recording: the slope of the readings at the static intervals over time,
    /// beside everything that was fitted, walks counted as noise. `None` with fewer than two chunks.
    pub fn bias_motion(&self, sensor: Sensor, recording: usize) -> Option<BiasMotion> {
        let mean = |chunk: &Chunk| chunk.mean(sensor);
        let own = |chunk: &Chunk| self.data.rests[chunk.rest].recording == recording;
        let chunks: Vec<Mean> = self
            .data
            .chunks
            .iter()
            .filter(|c| own(c))
            .filter_map(mean)
            .collect();
        let span = Span {
            from: chunks.first()?.span.from,
            to: chunks.last()?.span.to,
        };
        let length: f64 = chunks.iter().map(|m| m.span.length()).sum();
        let middle = |m: &Mean| 0.5 * (m.span.from + m.span.to);
        let centre = chunks
            .iter()
            .map(|m| middle(m) * m.span.length())
            .sum::<f64>()
            / length;
        if span.length() <= 0.0 || chunks.len() < 2 {
            return None;
        }
        let mut columns = [const { Column::none() }; 3];
        let mut row = if sensor == Sensor::Accelerometer {
            0
        } else {
            self.first_rows[0]
        };
        for chunk in &self.data.chunks {
            let Some(m) = mean(chunk) else { continue };
            if own(chunk) {
                let share = (middle(&m) - centre) / span.length();
                for (axis, column) in columns.iter_mut().enumerate() {
                    column.set(row + axis, share);
                }
            }
            row += 3;
        }
        let columns = Columns::sparse(self.whitening.white.groups(), &columns.each_ref());
        let columns = self.whitening.whiten(columns);
        let (change, covariance) = self.beside(&columns)?;
        Some(BiasMotion {
            span,
            change,
            std: covariance.diagonal().map(|v| v.max(0.0).sqrt()),
            before: (centre - span.from) / span.length(),
        })
    }

    /// Estimates the coefficients of three whitened columns beside everything that was fitted, and their covariance.
    fn beside(&self, columns: &Columns) -> Option<(Vector3<f64>, Matrix3<f64>)> {
        let left = Basis::of(&self.jacobian).without(columns).to_dense();
        let r = Mat::from_fn(self.residuals.len(), 1, |i, _| self.residuals[i]);
        let gram = left.transpose() * &left;
        let right = left.transpose() * &r;
        let gram = Matrix3::from_fn(|i, k| gram[(i, k)]);
        let inverse = gram.cholesky()?.inverse();
        // Residuals are model less measurement.
        Some((-(inverse * Vector3::from_fn(|i, _| right[(i, 0)])), inverse))
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
