//! The few vector operations of the solver, on slices.

/// `a · b`, in four sums that do not wait for each other.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let length = a.len().min(b.len());
    let (a, a_rest) = a[..length].as_chunks::<4>();
    let (b, b_rest) = b[..length].as_chunks::<4>();
    // Counted loops over slices known to be as long: iterators zipped cost as much again where
    // vectors are this short.
    let (b, b_rest) = (&b[..a.len()], &b_rest[..a_rest.len()]);
    let mut sums = [0.0; 4];
    for i in 0..a.len() {
        for k in 0..4 {
            sums[k] += a[i][k] * b[i][k];
        }
    }
    let mut rest = 0.0;
    for i in 0..a_rest.len() {
        rest += a_rest[i] * b_rest[i];
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}

/// `‖a‖`, without overflow for entries whose squares overflow.
pub(crate) fn norm(a: &[f64]) -> f64 {
    let plain = dot(a, a);
    if plain.is_normal() {
        return plain.sqrt();
    }
    let largest = a.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return if a.iter().any(|v| v.is_nan()) {
            f64::NAN
        } else {
            largest
        };
    }
    largest * a.iter().map(|v| (v / largest).powi(2)).sum::<f64>().sqrt()
}

/// `‖D a‖` for a diagonal `D`.
pub(crate) fn scaled_norm(a: &[f64], scale: &[f64]) -> f64 {
    a.iter()
        .zip(scale)
        .map(|(a, s)| (a * s).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// `D⁻¹ a` for a diagonal `D`.
pub(crate) fn unscaled(a: &[f64], scale: &[f64]) -> Vec<f64> {
    a.iter().zip(scale).map(|(a, s)| a / s).collect()
}

/// `a + factor · b`.
pub(crate) fn add(a: &[f64], factor: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + factor * b).collect()
}

/// Adds `factor · b` to `a`.
#[inline]
pub(crate) fn add_to(a: &mut [f64], factor: f64, b: &[f64]) {
    let length = a.len().min(b.len());
    let (a, b) = (&mut a[..length], &b[..length]);
    for i in 0..length {
        a[i] += factor * b[i];
    }
}

/// Divides `a` by a number: by its inverse, a fraction of the time, where that loses nothing.
#[inline]
pub(crate) fn divide(a: &mut [f64], by: f64) {
    let inverse = 1.0 / by;
    if inverse.is_normal() {
        a.iter_mut().for_each(|value| *value *= inverse);
    } else {
        a.iter_mut().for_each(|value| *value /= by);
    }
}

/// `½ ‖r‖²`, infinite where it is not a number.
pub(crate) fn half_square(r: &[f64]) -> f64 {
    let sum = 0.5 * dot(r, r);
    if sum.is_nan() { f64::INFINITY } else { sum }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dot_of_every_length_is_the_plain_sum() {
        for length in 0..10 {
            let a: Vec<f64> = (0..length).map(f64::from).collect();
            // Σ i², exact in whole numbers.
            let sum: f64 = a.iter().map(|v| v * v).sum();
            assert_eq!(dot(&a, &a), sum, "{length}");
        }
    }

    #[test]
    fn norm_survives_overflow_and_underflow() {
        assert!((norm(&[3e200, 4e200]) / 5e200 - 1.0).abs() < 1e-15);
        assert!((norm(&[3e-200, 4e-200]) / 5e-200 - 1.0).abs() < 1e-15);
        assert_eq!(norm(&[0.0, 0.0]), 0.0);
        assert!(norm(&[f64::NAN, 1.0]).is_nan());
    }
}
