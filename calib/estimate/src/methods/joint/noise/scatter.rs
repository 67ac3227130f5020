//! Scatter of values about their mean.

findings::tuning! {
    /// Noise below this (m/s² or rad/s) is rounding: keeps noise-free recordings weighted, and sensibly.
    pub(crate) FLOOR: f64 = 1e-9;
}

/// Sum of squares about the mean, and its degrees of freedom.
pub(crate) fn scatter(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let sum = values.iter().map(|v| (v - mean).powi(2)).sum();
    (sum, values.len().saturating_sub(1).max(1) as f64)
}
