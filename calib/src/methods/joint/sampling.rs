//! What the rate does between samples.
//!
//! A gyroscope that is sampled at instants, without a filter before, does not see what a shock does between two
//! of them: the sum of samples times steps is not the angle. How far a sample is from where its neighbours
//! have it says how much may be missing,
//!
//! `e_k = (15 (ω_{k+1} + ω_{k−1}) − 6 (ω_{k+2} + ω_{k−2}) + (ω_{k+3} + ω_{k−3}))/20 − ω_k`,
//!
//! and the rows of a turn have the covariance `c² Σ (J_k e_k)(J_k e_k)ᵀ` more, with one `c` per recording.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `e_k` | what a polynomial of degree 5 through the neighbours misses at sample `k` | rad/s |
//! | `J_k` | `∂r/∂ω_k`, the sample's window in it | s |
//! | `c` | share of it that is missing in the angle | 1 |

use nalgebra::{Matrix2, SymmetricEigen, Vector2, Vector3};

use super::turn::MARGIN;

/// Variance of `e` for readings of unit variance: `1 + 2 (15² + 6² + 1)/20²`.
const NOISE: f64 = 1.0 + 2.0 * (225.0 + 36.0 + 1.0) / 400.0;

/// `e` below so many times its noise, in variance, is noise.
const VISIBLE: f64 = 9.0;

/// With `c = 1`, what is less than this share of the white noise of a turn does not matter.
const MATTERS: f64 = 0.02;

/// Shares tried: none of more than one, because no more can be missing than is seen.
const SHARES: (f64, f64, usize) = (0.01, 1.0, 60);

/// The share of turns that something else is wrong with, and by how much their variance is larger.
const WRONG: f64 = 0.02;
const BY: f64 = 100.0;

/// Log-likelihood that a share has to gain.
const WORTH_IT: f64 = 2.0;

/// What the white noise leaves of `e` at the inner samples of a turn, near SI units; empty where it does not
/// matter.
pub(super) fn shocks(readings: &[Vector3<f64>], noise: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let expected = VISIBLE * NOISE * noise.map(|s| s * s).sum();
    let at = |k: usize| {
        let pair = |d: usize| readings[k + d] + readings[k - d];
        let e = (pair(1) * 15.0 - pair(2) * 6.0 + pair(3)) / 20.0 - readings[k];
        e * (1.0 - expected / e.norm_squared().max(expected)).sqrt()
    };
    let inner = MARGIN..readings.len().saturating_sub(MARGIN);
    let white = inner.len() as f64 * noise.map(|s| s * s).sum();
    let all: Vec<Vector3<f64>> = inner.map(at).collect();
    let square: f64 = all.iter().map(Vector3::norm_squared).sum();
    if square > MATTERS * white {
        all
    } else {
        Vec::new()
    }
}

/// What is known of the two rows of a turn, whitened at a share `c`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// What the fit leaves of the rows.
    pub left: Vector2<f64>,
    /// Root of what it can leave of unit noise, `(I − H)^½`.
    pub spare: Matrix2<f64>,
    /// What a share of one adds to their covariance.
    pub by_share: Matrix2<f64>,
    /// What a floor of one radian adds.
    pub by_floor: Matrix2<f64>,
}

/// The share, and how sure it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// `c`.
    pub value: f64,
    /// Where the log-likelihood is half a unit lower, to both sides.
    pub between: [f64; 2],
    /// Log-likelihood gained over none.
    pub over_none: f64,
    /// Log-likelihood gained over a constant floor for all turns instead.
    pub over_floor: f64,
}

/// The root of `I − H` of two rows; nothing of a direction that the fit leaves nothing of.
pub(super) fn root_of_spare(hat: &Matrix2<f64>) -> Matrix2<f64> {
    let eigen = SymmetricEigen::new(Matrix2::identity() - hat);
    let roots = eigen.eigenvalues.map(|v| v.max(0.0).sqrt());
    eigen.eigenvectors * Matrix2::from_diagonal(&roots) * eigen.eigenvectors.transpose()
}

impl Evidence {
    /// Log-likelihood of the rows with the covariance `inner` before the fit, and the chance that nothing else is
    /// wrong with the turn.
    fn log_likelihood(&self, inner: &Matrix2<f64>) -> (f64, f64) {
        // A hundredth keeps a turn that the fit follows from having no variance.
        let v = self.spare * inner * self.spare + Matrix2::identity() * 1e-2;
        let Some(inverse) = v.try_inverse().filter(|_| v.determinant() > 0.0) else {
            return (f64::NEG_INFINITY, 0.0);
        };
        let square = self.left.dot(&(inverse * self.left));
        let sound = (1.0 - WRONG) * (-0.5 * square).exp();
        let wrong = WRONG / BY * (-0.5 * square / BY).exp();
        let sum = (sound + wrong).max(f64::MIN_POSITIVE);
        (-0.5 * v.determinant().ln() + sum.ln(), sound / sum)
    }

    /// Log-likelihood of the rows under their own noise.
    pub fn score(&self) -> f64 {
        self.log_likelihood(&Matrix2::identity()).0
    }

    /// The chance that nothing else is wrong with the turn, whose noise is `scale` times as large in variance.
    pub fn sound(&self, scale: f64) -> f64 {
        self.log_likelihood(&(Matrix2::identity() * scale)).1
    }
}

/// The likeliest share, turns that something else is wrong with apart; `now` is the one in the weights.
pub(super) fn likeliest(turns: &[Evidence], now: f64) -> Share {
    let at = |c: f64| -> f64 {
        let own = |t: &Evidence| Matrix2::identity() + t.by_share * (c * c - now * now);
        turns.iter().map(|t| t.log_likelihood(&own(t)).0).sum()
    };
    let (least, most, count) = SHARES;
    let grid: Vec<f64> = (0..count)
        .map(|k| least * (most / least).powf(k as f64 / (count - 1) as f64))
        .collect();
    let none = at(0.0);
    let values: Vec<f64> = grid.iter().map(|c| at(*c)).collect();
    let best = (0..count).max_by(|a, b| values[*a].total_cmp(&values[*b]));
    let Some(best) = best.filter(|&k| values[k] > none + WORTH_IT) else {
        return Share::default();
    };
    let near = |k: &usize| values[*k] > values[best] - 0.5;
    let low = (0..=best).rev().take_while(near).last().unwrap_or(best);
    let high = (best..count).take_while(near).last().unwrap_or(best);
    Share {
        value: grid[best],
        between: [grid[low], grid[high]],
        over_none: values[best] - none,
        over_floor: values[best] - with_floor(turns, now),
    }
}

/// Log-likelihood of the likeliest constant floor instead of a share.
fn with_floor(turns: &[Evidence], now: f64) -> f64 {
    let at = |floor: f64| -> f64 {
        let own = |t: &Evidence| {
            Matrix2::identity() - t.by_share * (now * now) + t.by_floor * (floor * floor)
        };
        turns.iter().map(|t| t.log_likelihood(&own(t)).0).sum()
    };
    // From a thousandth of a degree to ten degrees.
    let floors = (0..50).map(|k| 1e-3_f64.to_radians() * 1e4_f64.powf(f64::from(k) / 49.0));
    floors.map(at).fold(at(0.0), f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn normal2(random: &mut rand_chacha::ChaCha8Rng) -> Vector2<f64> {
        Vector2::from_fn(|_, _| StandardNormal.sample(random))
    }

    /// Turns with white noise and shocks of several sizes, `c` of which is missing.
    fn turns(c: f64, wrong: usize) -> Vec<Evidence> {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        (0..60)
            .map(|k| {
                let size = 3.0 * f64::from(k % 7);
                let shock = normal2(&mut random);
                let along: f64 = StandardNormal.sample(&mut random);
                let mut left = normal2(&mut random) + shock * (c * size * along);
                if k < wrong as i32 {
                    left *= 30.0;
                }
                Evidence {
                    left,
                    spare: Matrix2::identity(),
                    by_share: shock * shock.transpose() * (size * size),
                    by_floor: Matrix2::identity() * 1e8,
                }
            })
            .collect()
    }

    #[test]
    fn the_share_is_found_beside_turns_that_something_else_is_wrong_with() {
        for wrong in [0, 3] {
            let found = likeliest(&turns(0.6, wrong), 0.0);
            // Some 50 turns tell one number: 10 %, three of them.
            assert!((found.value / 0.6 - 1.0).abs() < 0.3, "{found:?}");
            assert!(
                found.between[0] < 0.6 && found.between[1] > 0.5,
                "{found:?}"
            );
            assert!(
                found.over_floor > 3.0 && found.over_none > 10.0,
                "{found:?}"
            );
        }
    }

    #[test]
    fn no_share_is_found_where_nothing_is_missing() {
        assert_eq!(likeliest(&turns(0.0, 0), 0.0), Share::default());
    }

    #[test]
    fn smooth_motion_has_no_shocks_and_a_jump_has() {
        let noise = Vector3::repeat(1e-3);
        let mut readings: Vec<Vector3<f64>> = (0..200)
            .map(|k| Vector3::new((0.03 * f64::from(k)).sin(), 0.0, 1.0))
            .collect();
        assert!(shocks(&readings, &noise).is_empty());
        readings.iter_mut().skip(100).for_each(|w| w.x += 0.5);
        let found = shocks(&readings, &noise);
        // At the sample before a step of one, e = (15 − 6 + 1)/20.
        assert!(
            (found[99 - MARGIN].x - 0.25).abs() < 1e-3,
            "{}",
            found[99 - MARGIN]
        );
        assert_eq!(found[20], Vector3::zeros());
    }
}
