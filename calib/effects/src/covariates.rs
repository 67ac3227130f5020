//! Covariates of effects beyond the signals of one instant: last change of force, vibration, slopes.

use nalgebra::Vector3;

/// A change of specific force below this, m/s², does not count as a change: the second of two
/// placements of the same face differs from the first by the hand's scatter only.
pub const SMALLEST_CHANGE: f64 = 0.05;

/// Sign of the last change of specific force per axis, after it went from `before` to `after` (m/s²):
/// −1 or 1, or the sign from before where the axis did not change.
pub fn last_change(
    sign_before: &Vector3<f64>,
    before: &Vector3<f64>,
    after: &Vector3<f64>,
) -> Vector3<f64> {
    Vector3::from_fn(|i, _| {
        let change = after[i] - before[i];
        if change.abs() < SMALLEST_CHANGE {
            sign_before[i]
        } else {
            change.signum()
        }
    })
}

/// [`last_change`] along a sequence of placements, given their mean specific force; 0 in the first.
pub fn last_changes(specific_force: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut signs = Vec::with_capacity(specific_force.len());
    let mut sign = Vector3::zeros();
    for (k, after) in specific_force.iter().enumerate() {
        if let Some(before) = k.checked_sub(1).and_then(|j| specific_force.get(j)) {
            sign = last_change(&sign, before, after);
        }
        signs.push(sign);
    }
    signs
}

/// Mean square of the vibration in every rest, (m/s²)² per axis, from the variance of a sample in each: what
/// there is beyond the quietest rest.
pub fn vibrations(variances: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let quietest = variances
        .iter()
        .fold(Vector3::repeat(f64::INFINITY), |least, v| least.inf(v));
    variances.iter().map(|v| v - quietest).collect()
}

/// Samples on either side that a slope is taken from.
const REACH: usize = 2;

/// `dv/dt` at sample `k`: the straight line through it and two neighbours on either side, least squares. Of
/// white noise `σ` it keeps `σ / (√10 Δt)`.
pub fn slope_at(t: &[f64], values: &[Vector3<f64>], k: usize) -> Vector3<f64> {
    let range = k.saturating_sub(REACH)..(k + REACH + 1).min(t.len());
    let count = range.len() as f64;
    let middle = t[range.clone()].iter().sum::<f64>() / count;
    let (mut moment, mut spread) = (Vector3::zeros(), 0.0);
    for (t, v) in t[range.clone()].iter().zip(&values[range]) {
        moment += v * (t - middle);
        spread += (t - middle).powi(2);
    }
    if spread > 0.0 {
        moment / spread
    } else {
        Vector3::zeros()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_parabola_is_that_of_its_tangent() {
        let t: Vec<f64> = (0..5).map(|k| 0.1 * f64::from(k)).collect();
        let values: Vec<_> = t
            .iter()
            .map(|t| Vector3::new(t * t, 3.0 * t, 1.0))
            .collect();
        let slope = slope_at(&t, &values, 2);
        assert!((slope - Vector3::new(0.4, 3.0, 0.0)).norm() < 1e-13);
    }

    #[test]
    fn the_quietest_rest_does_not_vibrate() {
        let variances = [Vector3::new(3.0, 1.0, 1.0), Vector3::new(2.0, 5.0, 1.0)];
        let found = vibrations(&variances);
        assert_eq!(found[0], Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(found[1], Vector3::new(0.0, 4.0, 0.0));
    }

    #[test]
    fn an_axis_that_did_not_change_keeps_its_history() {
        let f = [
            Vector3::new(0.0, 0.0, 9.8),
            Vector3::new(9.8, 0.0, 0.0),
            Vector3::new(9.79, 0.0, -1.0),
        ];
        let signs = last_changes(&f);
        assert_eq!(signs[0], Vector3::zeros());
        assert_eq!(signs[1], Vector3::new(1.0, 0.0, -1.0));
        assert_eq!(signs[2], Vector3::new(1.0, 0.0, -1.0));
    }
}
