//! Motion of the rate between samples.
//!
//! A gyroscope that samples instantaneous values, without a filter before, misses part of a shock between two samples:
//! the sum of samples times steps is not the angle. The distance of a sample from the interpolation of its neighbours
//! shows how much may be missing,
//!
//! `e_k = (15 (ω_{k+1} + ω_{k−1}) − 6 (ω_{k+2} + ω_{k−2}) + (ω_{k+3} + ω_{k−3}))/20 − ω_k`,
//!
//! and the covariance of a turn's rows grows by `c² Σ (J_k e_k)(J_k e_k)ᵀ`, with one `c` per recording.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `e_k` | what a polynomial of degree 5 through the neighbours misses at sample `k` | rad/s |
//! | `J_k` | `∂r/∂ω_k`, the sample's window in it | s |
//! | `c` | share of it that is missing in the angle | 1 |

use nalgebra::{Matrix2, SymmetricEigen, Vector2, Vector3};

use crate::methods::joint::rows::turn::MARGIN;

/// Variance of `e` for readings of unit variance: `1 + 2 (15² + 6² + 1)/20²`.
const NOISE: f64 = 1.0 + 2.0 * (225.0 + 36.0 + 1.0) / 400.0;

findings::tuning! {
    /// `e` below so many times its noise, in variance, is noise.
    VISIBLE: f64 = 9.0;

    /// With `c = 1`, what is less than this share of the white noise of a turn does not matter.
    MATTERS: f64 = 0.02;

    /// A direction that the fit leaves less than this share of says nothing.
    LEFT: f64 = 0.05;

    /// The share of turns that something else is wrong with.
    WRONG: f64 = 0.02;
    /// Their variance is so many times larger.
    BY: f64 = 100.0;

    /// Log-likelihood that a share has to gain.
    WORTH_IT: f64 = 2.0;
}

/// Shares tried: none of more than one, because no more can be missing than is seen.
const SHARES: (f64, f64, usize) = (0.01, 1.0, 44);

/// Scatters tried, rad: from a thousandth of a degree to five degrees.
const FLOORS: (f64, f64, usize) = (1.7e-5, 0.087, 16);

/// Computes the interpolation errors `e` at the inner samples of a turn, reduced by the part that white noise explains,
/// rad/s near SI units; empty where their sum of squares is negligible against the white noise.
pub(crate) fn shocks(readings: &[Vector3<f64>], noise: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let expected = VISIBLE.get() * NOISE * noise.map(|s| s * s).sum();
    let at = |k: usize| {
        let pair = |d: usize| readings[k + d] + readings[k - d];
        let e = (pair(1) * 15.0 - pair(2) * 6.0 + pair(3)) / 20.0 - readings[k];
        e * (1.0 - expected / e.norm_squared().max(expected)).sqrt()
    };
    let inner = MARGIN..readings.len().saturating_sub(MARGIN);
    let white = inner.len() as f64 * noise.map(|s| s * s).sum();
    let all: Vec<Vector3<f64>> = inner.map(at).collect();
    let square: f64 = all.iter().map(Vector3::norm_squared).sum();
    if square > MATTERS.get() * white {
        all
    } else {
        Vec::new()
    }
}

/// Evidence of one turn: its two rows, whitened by noise with a share and a floor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evidence {
    /// Residuals of the rows after the fit, scaled to unit variance: `(I − H)^−½` times the remainder.
    pub left: Vector2<f64>,
    /// Number of directions of the two rows that the fit leaves free: the eigenvalues of `I − H` that exceed `LEFT`.
    pub spare: f64,
    /// Covariance that a share of one adds to the scaled residuals.
    by_share: Matrix2<f64>,
    /// Covariance that a floor of one radian adds.
    by_floor: Matrix2<f64>,
}

/// Levels of noise beside the white one: a share, and a scatter that is the same for all turns (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Levels {
    /// `c`.
    pub share: f64,
    /// The scatter, rad.
    pub floor: f64,
}

/// The share, and how sure it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// `c`.
    pub value: f64,
    /// Interval in which the log-likelihood is within half a unit of its maximum.
    pub between: [f64; 2],
    /// Log-likelihood gained over none, a constant scatter of the turns being allowed for.
    pub over_none: f64,
    /// Log-likelihood gained over the noise of the readings alone.
    pub over_noise: f64,
    /// The same without the turn that gains most: a single one is an outlier, whatever its rate does.
    pub over_noise_without_one: f64,
}

impl Evidence {
    /// Scales the residuals `left` of two rows, with the block `hat` of the hat matrix `H` and the covariances `C` that
    /// share and floor add.
    ///
    /// `left = (I − H) r`, so that `u = (I − H)^−½ left` has the covariance `I + (I − H)^½ C (I − H)^½`. A direction in
    /// which `I − H` is close to zero carries no information and is left out.
    pub fn new(
        left: &Vector2<f64>,
        hat: &Matrix2<f64>,
        by_share: &Matrix2<f64>,
        by_floor: &Matrix2<f64>,
    ) -> Self {
        let eigen = SymmetricEigen::new(Matrix2::identity() - hat);
        let (mut root, mut inverse) = (Matrix2::zeros(), Matrix2::zeros());
        let mut spare = 0.0;
        for (value, vector) in eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
        {
            if *value > LEFT.get() {
                let part = vector * vector.transpose();
                root += part * value.sqrt();
                inverse += part / value.sqrt();
                spare += 1.0;
            }
        }
        Self {
            left: inverse * left,
            spare,
            by_share: root * by_share * root,
            by_floor: root * by_floor * root,
        }
    }

    /// Their covariance at other levels than those of the weights.
    fn covariance(&self, at: Levels, now: Levels) -> Matrix2<f64> {
        let square = |a: f64, b: f64| a * a - b * b;
        Matrix2::identity()
            + self.by_share * square(at.share, now.share)
            + self.by_floor * square(at.floor, now.floor)
    }

    /// Log-likelihood of the rows with a covariance, and the chance that nothing else is wrong with the turn.
    fn log_likelihood(&self, v: &Matrix2<f64>) -> (f64, f64) {
        let determinant = v.determinant();
        let Some(inverse) = v
            .try_inverse()
            .filter(|_| determinant > 0.0 && v[(0, 0)] > 0.0)
        else {
            return (f64::NEG_INFINITY, 0.0);
        };
        let square = self.left.dot(&(inverse * self.left));
        let sound = (1.0 - WRONG.get()) * (-0.5 * square).exp();
        let wrong = WRONG.get() / BY.get() * (-0.5 * square / BY.get()).exp();
        let sum = (sound + wrong).max(f64::MIN_POSITIVE);
        (-0.5 * determinant.ln() + sum.ln(), sound / sum)
    }

    /// Log-likelihood of the rows under the noise of the weights.
    pub fn score(&self) -> f64 {
        self.log_likelihood(&Matrix2::identity()).0
    }

    /// The chance that nothing else is wrong with the turn, whose noise is `scale` times as large in variance.
    pub fn sound(&self, scale: f64) -> f64 {
        self.log_likelihood(&(Matrix2::identity() * scale)).1
    }

    /// The share of the floor in the noise of the weights.
    pub fn of_floor(&self, now: Levels) -> f64 {
        0.5 * self.by_floor.trace() * now.floor * now.floor
    }
}

/// The likeliest share and floor, turns that something else is wrong with apart; `now` are those in the weights.
/// Whether there is a share is `decided` or for the turns to say; where it is decided that there is one, it is the whole scatter.
pub(crate) fn likeliest(turns: &[Evidence], now: Levels, decided: Option<bool>) -> (Share, f64) {
    let at = |share: f64, floor: f64| -> f64 {
        let own = |t: &Evidence| t.covariance(Levels { share, floor }, now);
        turns.iter().map(|t| t.log_likelihood(&own(t)).0).sum()
    };
    let shares = grid(SHARES);
    let floors: Vec<f64> = std::iter::once(0.0).chain(grid(FLOORS)).collect();
    // Beside a share.
    let beside = match decided {
        Some(true) => &floors[..1],
        Some(false) | None => &floors[..],
    };
    let best = |values: &mut dyn Iterator<Item = (f64, f64)>| {
        values.fold((f64::NEG_INFINITY, 0.0), |best, (l, value)| {
            if l > best.0 { (l, value) } else { best }
        })
    };
    let (none, floor) = best(&mut floors.iter().map(|&f| (at(0.0, f), f)));
    // For each share the likeliest floor.
    let profile: Vec<(f64, f64)> = shares
        .iter()
        .map(|&c| best(&mut beside.iter().map(|&f| (at(c, f), f))))
        .collect();
    let values = profile
        .iter()
        .zip(0..)
        .map(|((l, _), k)| (*l, f64::from(k)));
    let (most, place) = best(&mut values.collect::<Vec<_>>().into_iter());
    let of_noise = at(0.0, 0.0);
    let is_likelier = match decided {
        Some(decided) => decided && most > of_noise + WORTH_IT.get(),
        None => most > none + WORTH_IT.get(),
    };
    if !is_likelier {
        return (Share::default(), floor);
    }
    let place = place as usize;
    let near = |k: &usize| profile[*k].0 > most - 0.5;
    let low = (0..=place).rev().take_while(near).last().unwrap_or(place);
    let high = (place..shares.len())
        .take_while(near)
        .last()
        .unwrap_or(place);
    let floor = profile[place].1;
    let found = Levels {
        share: shares[place],
        floor,
    };
    let gain = |t: &Evidence| {
        let of = |levels| t.log_likelihood(&t.covariance(levels, now)).0;
        of(found) - of(Levels::default())
    };
    let share = Share {
        value: shares[place],
        between: [shares[low], shares[high]],
        over_none: most - none,
        over_noise: most - of_noise,
        over_noise_without_one: most - of_noise - turns.iter().map(gain).fold(0.0, f64::max),
    };
    (share, floor)
}

/// Numbers from the first to the second in equal ratios.
fn grid((least, most, count): (f64, f64, usize)) -> Vec<f64> {
    let at = |k: usize| least * (most / least).powf(k as f64 / (count - 1) as f64);
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

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
                let by_share = shock * shock.transpose() * (size * size);
                let by_floor = Matrix2::identity() * 1e8;
                Evidence::new(&left, &Matrix2::zeros(), &by_share, &by_floor)
            })
            .collect()
    }

    #[test]
    fn the_share_is_found_beside_turns_that_something_else_is_wrong_with() {
        for wrong in [0, 3] {
            let found = likeliest(&turns(0.6, wrong), Levels::default(), None).0;
            // Some 50 turns tell one number: 10 %, three of them.
            assert!((found.value / 0.6 - 1.0).abs() < 0.3, "{found:?}");
            assert!(
                found.between[0] < 0.6 && found.between[1] > 0.5,
                "{found:?}"
            );
            assert!(
                found.over_none > 10.0 && found.over_noise > 10.0,
                "{found:?}"
            );
        }
    }

    #[test]
    fn a_scatter_that_is_the_same_for_all_turns_is_no_share() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(2);
        let mut all = turns(0.0, 0);
        for turn in &mut all {
            turn.left += normal2(&mut random) * 4.0;
        }
        let (share, floor) = likeliest(&all, Levels::default(), None);
        assert_eq!(share.value, 0.0);
        // Of a variance of 17 with 1e8 rad² for one: 4e-4 rad, on a grid of steps of 1.8.
        assert!((2e-4..8e-4).contains(&floor), "{floor}");
    }

    #[test]
    fn one_turn_that_jumps_and_misses_is_no_evidence_for_all() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let jump = Vector2::new(40.0, 0.0);
        let by_floor = Matrix2::identity() * 1e8;
        let turn = |k: usize| {
            let (left, by_share) = match k {
                7 => (jump * 0.5, jump * jump.transpose()),
                _ => (normal2(&mut random), Matrix2::zeros()),
            };
            Evidence::new(&left, &Matrix2::zeros(), &by_share, &by_floor)
        };
        let all: Vec<Evidence> = (0..30).map(turn).collect();
        let one = likeliest(&all, Levels::default(), None).0;
        assert!(one.over_noise > 3.0, "{one:?}");
        assert!(one.over_noise_without_one < 1.0, "{one:?}");
        let many = likeliest(&turns(0.6, 0), Levels::default(), None).0;
        assert!(many.over_noise_without_one > 10.0, "{many:?}");
    }

    #[test]
    fn no_share_is_found_where_nothing_is_missing() {
        assert_eq!(
            likeliest(&turns(0.0, 0), Levels::default(), None).0,
            Share::default()
        );
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
