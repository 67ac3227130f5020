//! Misfit of the corrected magnetic field: its norm and its angle to the vertical should be the same everywhere.

use nalgebra::Vector3;
use recording::Recording;
use recording::averages::root_mean_square;
use recording::intervals::{Moments, Segmentation};
use serde::Serialize;

/// The magnetic field over the static intervals of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FieldMisfit {
    /// Number of static intervals with readings.
    pub static_intervals: usize,
    /// Mean of the norm, in the unit of the corrected readings.
    pub norm: f64,
    /// Standard deviation of the norm over its mean.
    pub norm_spread: f64,
    /// Mean angle to the specific force, which points up, degrees.
    pub angle: f64,
    /// Its standard deviation, degrees.
    pub angle_spread: f64,
}

/// Norm and angle to the specific force (degrees) in every static interval of a corrected recording.
pub fn fields(corrected: &Recording, rests: &Segmentation) -> Vec<[f64; 2]> {
    let Some(field) = &corrected.magnetometer else {
        return Vec::new();
    };
    let stream = &field.stream;
    let of = |rest: &recording::intervals::StaticInterval| {
        let up = rest.accelerometer?.mean;
        let samples = stream.between(rest.span.from, rest.span.to);
        let mean: Vector3<f64> = Moments::of(&stream.values[samples])?.mean;
        Some([mean.norm(), mean.angle(&up).to_degrees()])
    };
    rests.statics.iter().filter_map(of).collect()
}

impl FieldMisfit {
    /// Computes it from norms and angles (degrees); `None` of fewer than two.
    pub fn of(fields: &[[f64; 2]]) -> Option<Self> {
        if fields.len() < 2 {
            return None;
        }
        let count = fields.len() as f64;
        let [norm, angle] = [0, 1].map(|k| fields.iter().map(|f| f[k]).sum::<f64>() / count);
        let spread = |k: usize, mean: f64| {
            let deviations: Vec<f64> = fields.iter().map(|f| f[k] - mean).collect();
            root_mean_square(&deviations) * (count / (count - 1.0)).sqrt()
        };
        Some(Self {
            static_intervals: fields.len(),
            norm,
            norm_spread: spread(0, norm) / norm,
            angle,
            angle_spread: spread(1, angle),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_norms_a_tenth_apart() {
        let misfit = FieldMisfit::of(&[[0.95, 150.0], [1.05, 150.0]]).unwrap();
        assert!((misfit.norm_spread - 0.1 / 2f64.sqrt()).abs() < 1e-12);
        assert_eq!((misfit.angle, misfit.angle_spread), (150.0, 0.0));
        assert_eq!(FieldMisfit::of(&[[1.0, 0.0]]), None);
    }
}
