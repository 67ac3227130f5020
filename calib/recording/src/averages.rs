//! Median, quantiles and root mean square.

/// Standard deviation of a normal variable over the median of its sizes, `1/Φ⁻¹(3/4)`.
pub const NORMAL_OVER_MEDIAN: f64 = 1.4826;

/// The middle value, of an even number of them the upper of the two; `None` of none.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The value that a `share` of them lies below, the greatest where the share is 1; `None` of none.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut values = values.to_vec();
    let place = ((share * values.len() as f64) as usize).min(values.len().checked_sub(1)?);
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

/// `√(Σ v² / n)`; 0 of none.
pub fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}
