//! Effect of steps wider than the noise on means.

use super::scatter::scatter;

findings::tuning! {
    /// Readings of one level spread by at most half a step, those that dither between two too: a variance of a quarter, and
    /// something for what the noise adds to a few.
    MOST: f64 = 0.3;

    /// Means that lie over so many steps have any place between two of them.
    MANY: f64 = 4.0;

    /// Terms of the series: noise of a tenth of a step takes the twentieth below a millionth.
    TERMS: i32 = 20;

    /// Halvings of the noise that is looked for.
    HALVINGS: usize = 40;
}

/// Standard deviation within stretches of rest: quiet ones too, whose readings stay on one level because of where between
/// two steps they lie.
pub(crate) fn spread(parts: &[Vec<f64>], step: f64) -> f64 {
    let rounded = |(sum, dof): &(f64, f64)| sum / dof <= MOST.get() * step * step;
    let kept = parts.iter().map(|p| scatter(p)).filter(rounded);
    let (sum, dof) = kept.fold((0.0, 0.0), |(s, d), (sum, dof)| (s + sum, d + dof));
    if dof > 0.0 { (sum / dof).sqrt() } else { 0.0 }
}

/// Variance by rounding of the means over stretches whose readings spread by `spread` all in all.
///
/// For normal noise of `σ`, steps of `Δ` and means anywhere between two steps it is `Δ² g(σ/Δ)`, `g(ρ) = Σ_k
/// exp(−4π²k²ρ²)/(2π²k²)`, from `Δ²/12` without noise to nothing (the Fourier series of the mean
/// error of rounding over the place between two steps); and the readings spread by `σ² + Δ²/12 − Δ² g`. Means that all lie between the same two steps, as a bias does, tell
/// nothing of the noise: `Δ²/12`.
pub(crate) fn of_means(parts: &[Vec<f64>], step: f64, spread: f64) -> f64 {
    let mean = |part: &Vec<f64>| part.iter().sum::<f64>() / part.len() as f64;
    let ends = |(low, high): (f64, f64), m: f64| (low.min(m), high.max(m));
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = parts.iter().map(mean).fold(start, ends);
    if high - low > MANY.get() * step {
        step * step * share(noise(spread / step))
    } else {
        step * step / 12.0
    }
}

/// `g(ρ)`.
fn share(ratio: f64) -> f64 {
    let pi = std::f64::consts::PI;
    let term = |k: i32| {
        let k = f64::from(k);
        (-(2.0 * pi * k * ratio).powi(2)).exp() / (2.0 * (pi * k).powi(2))
    };
    if ratio > 0.0 {
        (1..=TERMS.get()).map(term).sum()
    } else {
        1.0 / 12.0
    }
}

/// The noise in steps with which readings spread by so many steps.
fn noise(spread: f64) -> f64 {
    let (mut low, mut high) = (0.0, spread);
    for _ in 0..HALVINGS.get() {
        let middle = 0.5 * (low + high);
        if middle * middle + 1.0 / 12.0 - share(middle) < spread * spread {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal, Uniform};

    use super::*;

    /// Stretches of 500 readings with noise of `sigma` steps, their means anywhere.
    fn rounded(sigma: f64) -> (Vec<Vec<f64>>, f64) {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let places = Uniform::new(-50.0, 50.0).unwrap();
        let (mut parts, mut square) = (Vec::new(), 0.0);
        for _ in 0..400 {
            let place: f64 = places.sample(&mut random);
            let mut reading = || -> f64 {
                let noise: f64 = StandardNormal.sample(&mut random);
                (place + sigma * noise).round()
            };
            let part: Vec<f64> = (0..500).map(|_| reading()).collect();
            square += (part.iter().sum::<f64>() / 500.0 - place).powi(2);
            parts.push(part);
        }
        (parts, square / 400.0)
    }

    #[test]
    fn the_error_of_a_rounded_mean_is_the_one_that_its_spread_tells() {
        for sigma in [0.01, 0.125, 0.25, 0.4] {
            let (parts, square) = rounded(sigma);
            let spread = spread(&parts, 1.0);
            let told = of_means(&parts, 1.0, spread) + spread * spread / 500.0;
            assert!((told / square - 1.0).abs() < 0.2, "{sigma} {told} {square}");
        }
    }

    #[test]
    fn a_level_that_stays_tells_nothing_of_the_noise() {
        let parts = vec![vec![3.0; 100]; 20];
        assert_eq!(of_means(&parts, 1.0, 0.0), 1.0 / 12.0);
    }
}
