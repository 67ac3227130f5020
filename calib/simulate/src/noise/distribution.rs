//! Distribution of single samples of white noise.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::random::Random;

/// Distribution of the white noise, of the same variance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Kurtosis 3.
    #[default]
    Normal,
    /// `exp(−√2 |x|/σ)/(√2 σ)`: kurtosis 6, often far out.
    Laplace,
}

impl Distribution {
    /// Three independent numbers of mean 0 and variance 1.
    pub(crate) fn draw3(self, random: &mut Random) -> Vector3<f64> {
        match self {
            Self::Normal => random.normal3(),
            Self::Laplace => Vector3::from_fn(|_, _| laplace(random.uniform(-0.5..0.5))),
        }
    }
}

/// The quantile function of a Laplace distribution of variance 1, at `u + 1/2`.
fn laplace(u: f64) -> f64 {
    let tail = (1.0 - 2.0 * u.abs()).max(f64::MIN_POSITIVE);
    -u.signum() * tail.ln() * std::f64::consts::FRAC_1_SQRT_2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;

    #[test]
    fn variance_is_one_and_the_kurtosis_three_or_six() {
        for (distribution, kurtosis, tolerance) in [
            (Distribution::Normal, 3.0, 0.06),
            // The fourth power of a Laplace number has a standard deviation of 50: over 900,000 of them
            // 0.053; four of them.
            (Distribution::Laplace, 6.0, 0.25),
        ] {
            let mut random = Random::new(4, Purpose::Motion);
            let drawn: Vec<f64> = (0..300_000)
                .flat_map(|_| <[f64; 3]>::from(distribution.draw3(&mut random)))
                .collect();
            let moment = |n: i32| drawn.iter().map(|x| x.powi(n)).sum::<f64>() / drawn.len() as f64;
            assert!((moment(2) - 1.0).abs() < 0.01, "{}", moment(2));
            let found = moment(4) / moment(2).powi(2);
            assert!((found - kurtosis).abs() < tolerance, "{found}");
        }
    }
}
