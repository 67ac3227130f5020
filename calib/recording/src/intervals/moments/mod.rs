//! Mean and covariance of the samples in an interval.

pub(crate) mod running_sums;

use nalgebra::{Matrix3, Vector3};

/// First and second moments of a stretch of samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Number of samples.
    pub count: usize,
    /// Mean (3).
    pub mean: Vector3<f64>,
    /// Covariance of one sample (3 × 3), with `count − 1`; zero for a single sample.
    pub covariance: Matrix3<f64>,
}

impl Moments {
    /// Computes the moments of samples (`n × 3`); `None` without samples.
    pub fn of(values: &[Vector3<f64>]) -> Option<Self> {
        let count = values.len();
        if count == 0 {
            return None;
        }
        let mean = values.iter().sum::<Vector3<f64>>() / count as f64;
        let mut scatter = Matrix3::zeros();
        for value in values {
            let d = value - mean;
            scatter += d * d.transpose();
        }
        let covariance = scatter / (count.max(2) - 1) as f64;
        Some(Self {
            count,
            mean,
            covariance,
        })
    }

    /// Standard deviation of an axis of the mean by the white noise within, averaged over the axes.
    pub fn white_of_mean(&self) -> f64 {
        (self.covariance.trace() / 3.0 / self.count as f64).sqrt()
    }

    /// Standard deviation of one sample, per axis.
    pub fn std(&self) -> Vector3<f64> {
        self.covariance.diagonal().map(f64::sqrt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_two_samples_fit_in_the_head() {
        let m = Moments::of(&[Vector3::new(1.0, 0.0, 2.0), Vector3::new(3.0, 0.0, 2.0)]).unwrap();
        assert_eq!(m.mean, Vector3::new(2.0, 0.0, 2.0));
        assert_eq!(
            m.covariance,
            Matrix3::from_diagonal(&Vector3::new(2.0, 0.0, 0.0))
        );
    }
}
