//! Walks of the biases about their means over the rests, which is what a calibration states.

use faer::Mat;
use nalgebra::DMatrix;
use sensor::Sensor;

use super::chain::Chain;
use super::weights::{Component, ComponentKind, Form, White};
use crate::methods::joint::blocks::covariance::Covariance;
use crate::methods::joint::noise::exposure::Exposure;
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
        let exposures = whitened(&noise.exposures[place], white);
        let lengths = lengths(rows, sensor);
        let weights = |own: &[usize]| (total(own, &exposures), shares(own, &lengths, white));
        Component {
            kind: component.kind,
            covariance: component.covariance.map(|own, c| {
                let (total, shares) = weights(own);
                carried_over(c, &total, &shares)
            }),
            form: match &component.form {
                Form::Passed(chain) => Form::Passed(passed(chain, &component.covariance, weights)),
                Form::Columns(columns) => Form::Columns(columns.clone()),
            },
        }
    };
    components.iter().map(of).collect()
}

/// The same as what is passed on: `C + T Xᵀ + X Tᵀ` with `X = C Aᵀ + ½ T A C Aᵀ`.
fn passed(
    chain: &Chain,
    covariance: &Covariance,
    weights: impl Fn(&[usize]) -> (Mat<f64>, Mat<f64>),
) -> Chain {
    let mut of_row: Vec<Option<[f64; 6]>> = vec![None; covariance.size()];
    for (rows, c) in covariance.blocks() {
        let (total, shares) = weights(rows);
        let moved = c * shares.transpose();
        let x = &moved + faer::Scale(0.5) * (&total * (&shares * &moved));
        for (i, &row) in rows.iter().enumerate() {
            let of_axis = |k: usize| if k < 3 { total[(i, k)] } else { x[(i, k - 3)] };
            of_row[row] = Some(std::array::from_fn(of_axis));
        }
    }
    let all = chain.stations().all();
    chain.with_both(|station| {
        let rows = all[station].rows.clone();
        let own: Option<Vec<[f64; 6]>> = rows.map(|row| of_row[row]).collect();
        let own = own?;
        Some([0, 3].map(|first| DMatrix::from_fn(own.len(), 3, |i, k| own[i][first + k])))
    })
}

/// `(I + T A) C (I + T A)ᵀ`.
fn carried_over(c: &Mat<f64>, total: &Mat<f64>, shares: &Mat<f64>) -> Mat<f64> {
    let mean = shares * c;
    let of_mean = &mean * shares.transpose();
    let cross = total * &mean;
    c + &cross + cross.transpose() + total * &of_mean * total.transpose()
}

/// `T` (`k × 3`) of some rows.
fn total(rows: &[usize], exposures: &[Exposure]) -> Mat<f64> {
    let mut total = Mat::<f64>::zeros(rows.len(), 3);
    for exposure in exposures {
        let Ok(first) = rows.binary_search(&exposure.rows.start) else {
            continue;
        };
        for i in 0..exposure.rows.len() {
            for axis in 0..3 {
                total[(first + i, axis)] = exposure.total[(i, axis)];
            }
        }
    }
    total
}

/// Returns the duration, s, and the axis of the mean behind every row of a sensor; zeros for all other rows.
fn lengths(rows: &Rows<'_>, sensor: Sensor) -> Vec<(f64, usize)> {
    let mut lengths = vec![(0.0, 0); rows.count()];
    for own in rows.means(sensor) {
        for axis in 0..3 {
            lengths[own.row + axis] = (own.mean.span.length(), axis);
        }
    }
    lengths
}

/// `A` (`3 × k`) for some rows of a recording that the white noise has whitened.
fn shares(rows: &[usize], lengths: &[(f64, usize)], white: &White) -> Mat<f64> {
    let axis_of_first = |row: &&usize| lengths[**row].1 == 0;
    let whole: f64 = rows
        .iter()
        .filter(axis_of_first)
        .map(|&row| lengths[row].0)
        .sum();
    let mut shares = Mat::zeros(3, rows.len());
    for (k, &row) in rows.iter().enumerate() {
        let (length, axis) = lengths[row];
        if length > 0.0 {
            shares[(axis, k)] = length / whole * white.std(row);
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::joint::noise::exposure::covariance;

    #[test]
    fn the_mean_over_the_rests_does_not_walk_and_differences_walk_as_before() {
        let spans = [(0.0, 2.0), (3.0, 7.0), (11.0, 12.0)];
        let exposures: Vec<Exposure> = spans
            .into_iter()
            .enumerate()
            .map(|(k, span)| Exposure::of_mean(3 * k..3 * k + 3, 0, span, 3.0, -1.0))
            .collect();
        let pinned = covariance(&exposures, 9).to_dense();
        let total = Mat::from_fn(9, 3, |i, k| if i % 3 == k { -1.0 } else { 0.0 });
        let share = [2.0 / 7.0, 4.0 / 7.0, 1.0 / 7.0];
        let shares = Mat::from_fn(3, 9, |k, i| if i % 3 == k { share[i / 3] } else { 0.0 });
        let centred = carried_over(&pinned, &total, &shares);
        assert!((&shares * &centred).norm_max() < 1e-12);
        let between = |c: &Mat<f64>| c[(0, 0)] + c[(6, 6)] - 2.0 * c[(0, 6)];
        assert!((between(&centred) - between(&pinned)).abs() < 1e-12);
    }
}
