//! Means over a sample's window, exact to rounding.

use std::ops::{Add, Mul};

/// Quantity that can be averaged.
pub(crate) trait Mean: Copy + Add<Output = Self> + Mul<f64, Output = Self> {}
impl<V: Copy + Add<Output = V> + Mul<f64, Output = V>> Mean for V {}

/// Nodes and weights of the five-point Gauss–Legendre rule on [−1, 1], exact to degree 9
/// (Abramowitz & Stegun 1964, table 25.4); the weights are halved so that they add up to 1.
const RULE: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.118_463_442_528_094_54),
    (-0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.0, 0.284_444_444_444_444_44),
    (0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.906_179_845_938_664, 0.118_463_442_528_094_54),
];

/// Longest panel, s. A 10 Hz tremor turns by 0.6 rad in it; the rule's error is then below 1e-13.
const PANEL: f64 = 0.01;

/// The mean of `f` over `[from, to]`, split at `knots` (ascending), where `f` need not be smooth;
/// `f(from)` if the window is empty.
pub(crate) fn mean_over<V: Mean>(knots: &[f64], from: f64, to: f64, f: impl Fn(f64) -> V) -> V {
    if to <= from {
        return f(from);
    }
    let inner = knots.partition_point(|&k| k <= from)..knots.partition_point(|&k| k < to);
    let mut sum: Option<V> = None;
    let mut left = from;
    for right in knots[inner].iter().copied().chain([to]) {
        let panels = ((right - left) / PANEL).ceil().max(0.0);
        let width = (right - left) / panels;
        for k in 0..panels as usize {
            let middle = left + (k as f64 + 0.5) * width;
            for (node, weight) in RULE {
                let term = f(middle + 0.5 * width * node) * (weight * width / (to - from));
                sum = Some(sum.map_or(term, |s| s + term));
            }
        }
        left = right;
    }
    sum.unwrap_or_else(|| f(from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_instant_has_its_own_value_also_on_a_knot() {
        for at in [0.5, 1.0] {
            assert_eq!(mean_over(&[1.0, 2.0], at, at, |t| 3.0 * t), 3.0 * at);
        }
    }

    #[test]
    fn a_polynomial_of_degree_nine_is_averaged_exactly() {
        let mean = mean_over(&[], 0.0, 0.01, |t| (100.0 * t).powi(9));
        assert!((mean - 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_kink_at_a_knot_costs_nothing() {
        let mean = mean_over(&[0.003], 0.0, 0.01, |t| (t - 0.003_f64).abs());
        let exact = (0.003_f64.powi(2) + 0.007_f64.powi(2)) / 2.0 / 0.01;
        assert!((mean - exact).abs() < 1e-17);
    }

    #[test]
    fn long_windows_are_cut_into_panels() {
        let mean = mean_over(&[], 0.0, 0.5, |t| (60.0 * t).sin());
        assert!((mean - (1.0 - 30.0_f64.cos()) / 30.0).abs() < 1e-14);
    }
}
