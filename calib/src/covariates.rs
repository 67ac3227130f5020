//! What effects need to know of a recording beyond the signals of one instant.

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

#[cfg(test)]
mod tests {
    use super::*;

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
