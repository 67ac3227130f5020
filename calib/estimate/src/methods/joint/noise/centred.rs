//! Walks of the biases about their means over the rests, which is what a calibration states.

use faer::Mat;
use sensor::Sensor;

use super::weights::{Component, ComponentKind, White};
use crate::methods::joint::data::Chunk;
use crate::methods::joint::noise::rows::RowNoise;
use crate::methods::joint::result::analysis::whitened;
use crate::methods::joint::rows::Rows;

/// The components with every walk `b(t) − b(t_r)` carried over to `b(t) − b̄`, `b̄` the mean over the rests of
/// the recording.
///
/// The means over chunks have the rows `δ_k = −(b̄_k − b(t_r))`, so that `b̄ − b(t_r) = −Σ a_k δ_k` with the
/// chunks' shares `a_k` of the time at rest, and rows that take the total weight `T` of the bias
/// have `δ' = (I + T A) δ`. The columns of the biases are `T`: every other estimate stays what
/// it is. A bias at one time is known worse by far than the mean where the bias walks, and as well where it does
/// not; that of the mean is nearly the same either way, so that little hangs on what is believed
/// of the walk. A walk of the accelerometer's bias that `ends_with_rests` begins anew in every rest: there is no path
/// to centre.
pub fn centred(
    rows: &Rows<'_>,
    noise: &RowNoise,
    white: &White,
    (components, ends_with_rests): (&[Component], bool),
) -> Vec<Component> {
    let of = |component: &Component| {
        let (place, sensor) = match component.kind {
            ComponentKind::AccelerometerWalk if !ends_with_rests => (0, Sensor::Accelerometer),
            ComponentKind::AccelerometerFlicker(_) => (0, Sensor::Accelerometer),
            ComponentKind::GyroscopeWalk | ComponentKind::GyroscopeFlicker(_) => {
                (1, Sensor::Gyroscope)
            }
            _ => return component.clone(),
        };
        let mut total = Mat::<f64>::zeros(rows.count(), 3 * rows.data.sources.len());
        for exposure in whitened(&noise.exposures[place], white) {
            for (i, row) in exposure.rows.clone().enumerate() {
                for axis in 0..3 {
                    total[(row, 3 * exposure.recording + axis)] = exposure.total[(i, axis)];
                }
            }
        }
        Component {
            kind: component.kind,
            covariance: carried_over(&component.covariance, &total, &shares(rows, sensor, white)),
        }
    };
    components.iter().map(of).collect()
}

/// `(I + T A) C (I + T A)ᵀ`.
fn carried_over(c: &Mat<f64>, total: &Mat<f64>, shares: &Mat<f64>) -> Mat<f64> {
    let mean = shares * c;
    let of_mean = &mean * shares.transpose();
    let cross = total * &mean;
    c + &cross + cross.transpose() + total * &of_mean * total.transpose()
}

/// `A` (`3 recordings × m`) for rows that the white noise has whitened.
fn shares(rows: &Rows<'_>, sensor: Sensor, white: &White) -> Mat<f64> {
    let length = |chunk: &Chunk| chunk.mean(sensor).map_or(0.0, |m| m.span.length());
    let recording = |chunk: &Chunk| rows.data.rests[chunk.rest].recording;
    let mut sums = vec![0.0; rows.data.sources.len()];
    for (_, chunk) in rows.means(sensor) {
        sums[recording(chunk)] += length(chunk);
    }
    let first = rows.first_row(sensor);
    let mut shares = Mat::zeros(3 * sums.len(), rows.count());
    for (k, (_, chunk)) in rows.means(sensor).enumerate() {
        let place = recording(chunk);
        for axis in 0..3 {
            let row = first + 3 * k + axis;
            shares[(3 * place + axis, row)] = length(chunk) / sums[place] * white.std(row);
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::joint::noise::exposure::{Exposure, covariance};

    #[test]
    fn the_mean_over_the_rests_does_not_walk_and_differences_walk_as_before() {
        let spans = [(0.0, 2.0), (3.0, 7.0), (11.0, 12.0)];
        let exposures: Vec<Exposure> = spans
            .into_iter()
            .enumerate()
            .map(|(k, span)| Exposure::of_mean(3 * k..3 * k + 3, 0, span, 3.0, -1.0))
            .collect();
        let pinned = covariance(&exposures, 9);
        let total = Mat::from_fn(9, 3, |i, k| if i % 3 == k { -1.0 } else { 0.0 });
        let share = [2.0 / 7.0, 4.0 / 7.0, 1.0 / 7.0];
        let shares = Mat::from_fn(3, 9, |k, i| if i % 3 == k { share[i / 3] } else { 0.0 });
        let centred = carried_over(&pinned, &total, &shares);
        assert!((&shares * &centred).norm_max() < 1e-12);
        let between = |c: &Mat<f64>| c[(0, 0)] + c[(6, 6)] - 2.0 * c[(0, 6)];
        assert!((between(&centred) - between(&pinned)).abs() < 1e-12);
    }
}
