//! Mean rates over windows of uneven length, from samples.
//!
//! A sum of samples times windows is the trapezoidal rule, which misses `h³ ω″/12` of every step. With even
//! steps those sum to nothing over a turn that begins and ends at rest; with uneven ones they do not:
//! 0.003° to 0.02° a turn by hand at 20 % of 10 ms or 2 % of 40 ms. The readings here make up for it:
//!
//! `ω̄_k = ω_k − (h₋³ + h₊³)/(24 l_k) ω″_k + h²/12 ω″_k`
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `h₋`, `h₊` | steps before and after sample `k` | s |
//! | `l_k` | its window, `(h₋ + h₊)/2` | s |
//! | `h` | the median step: with even steps nothing changes | s |
//! | `ω″` | second divided difference over the three samples | rad/s³ |
//!
//! A second difference divides by the shorter step: between steps that differ by more than a factor of [`ALIKE`] it is noise
//! times that factor, and the trapezoidal rule is left alone there.

use nalgebra::Vector3;

findings::tuning! {
    /// Steps longer than so many usual ones are gaps: nothing is known of what the rate does in them.
    GAP: f64 = 3.5;

    /// Steps on either side of a sample that differ by more than this factor tell no second difference: stamps of arrival, some
    /// microseconds after the one before. Steps that scatter by 20 % of their length differ by more once in a hundred samples.
    ALIKE: f64 = 5.0;

    /// Steps that differ by less than this share are even.
    EVEN: f64 = 1e-6;
}

/// Estimates the mean rates over the windows of samples at times `t` (s).
pub(crate) fn means_over_windows(t: &[f64], samples: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut steps: Vec<f64> = t.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut means = samples.to_vec();
    let middle = steps.len() / 2;
    if steps.is_empty() {
        return means;
    }
    let (_, &mut usual, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
    for k in 1..t.len().saturating_sub(1) {
        let (before, after) = (t[k] - t[k - 1], t[k + 1] - t[k]);
        let even = (before - usual).abs().max((after - usual).abs()) < EVEN.get() * usual;
        let (shorter, longer) = (before.min(after), before.max(after));
        let usable = shorter > 0.0 && longer < GAP.get() * usual && longer < ALIKE.get() * shorter;
        if even || !usable {
            continue;
        }
        let slopes = [
            (samples[k] - samples[k - 1]) / before,
            (samples[k + 1] - samples[k]) / after,
        ];
        let bend = (slopes[1] - slopes[0]) * (2.0 / (before + after));
        let cubes = before.powi(3) + after.powi(3);
        means[k] -= bend * (cubes / (12.0 * (before + after)) - usual * usual / 12.0);
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A smooth turn of a second, sampled every 40 ms with a jitter of `share` of the step.
    fn turn(share: f64) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let jitter = |k: usize| share * (((k * k * 31 + 7 * k) % 101) as f64 / 50.0 - 1.0);
        let t: Vec<f64> = (0..60).map(|k| 0.04 * (k as f64 + jitter(k))).collect();
        let rate = |t: f64| 3.0 * (-((t - 1.2) / 0.25).powi(2)).exp();
        let samples = t.iter().map(|&t| Vector3::new(rate(t), 0.0, 0.0)).collect();
        (t, samples)
    }

    fn angle(t: &[f64], rates: &[Vector3<f64>]) -> f64 {
        (1..t.len() - 1)
            .map(|k| rates[k].x * 0.5 * (t[k + 1] - t[k - 1]))
            .sum()
    }

    #[test]
    fn the_angle_of_uneven_samples_is_that_of_the_motion() {
        let truth = 3.0 * 0.25 * std::f64::consts::PI.sqrt();
        let (t, samples) = turn(0.2);
        let sum = (angle(&t, &samples) - truth).abs();
        let means = (angle(&t, &means_over_windows(&t, &samples)) - truth).abs();
        assert!(sum > 2e-4 && means < 0.2 * sum, "{sum:.1e} {means:.1e}");
    }

    #[test]
    fn samples_right_after_another_do_not_magnify_the_noise() {
        let noise = |k: usize| 1e-3 * (((k * k * 31 + 7 * k) % 101) as f64 / 50.0 - 1.0);
        for shortest in [1e-7, 5e-5, 3e-4] {
            // Every third stamp is that of the sample before and a little.
            let t: Vec<f64> = (0..60)
                .map(|k| match k % 3 {
                    1 => 0.01 * (k - 1) as f64 + shortest,
                    _ => 0.01 * k as f64,
                })
                .collect();
            let samples: Vec<Vector3<f64>> =
                (0..60).map(|k| Vector3::new(noise(k), 0.0, 0.0)).collect();
            let means = means_over_windows(&t, &samples);
            let worst = means.iter().map(|mean| mean.x.abs()).fold(0.0, f64::max);
            // Weights of neighbours no more than that of the sample itself.
            assert!(worst < 2e-3, "{shortest}: {worst}");
        }
    }

    #[test]
    fn even_samples_stay_as_they_are() {
        let (t, samples) = turn(0.0);
        assert_eq!(means_over_windows(&t, &samples), samples);
    }
}
