//! Assignment of the stretches of a recording to two levels of a bias.
//!
//! For `s` in `{0, 1}` over the stretches the likelihood ratio of a bias `a s` is `(sᵀ b)²/(sᵀ A s)`, `A = BᵀB` and `b = Bᵀz`. Among
//! the `C(n − 1, k)` ways to put `k` jumps between `n` stretches the best is looked for step by step, and all of them are paid for.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use statrs::function::factorial::ln_binomial;

use crate::score::log_tail;

findings::tuning! {
    /// Jumps in as many places as these have a bias that differs from one stretch to the next, and no two levels.
    MOST_SHARE: f64 = 1.0 / 3.0;

    /// Flips after which the search ends.
    MOST_FLIPS: usize = 100;
    /// Share of the whole information below which two levels are one.
    FAINT: f64 = 1e-9;

    /// Stretches by which a jump may be earlier or later, to ask whether the data know.
    SHIFT: usize = 3;
}

/// Jumps at most between so many stretches.
fn most_jumps(stretches: usize) -> usize {
    (MOST_SHARE.get() * stretches as f64) as usize
}

/// `ln` of the ways to choose so many jumps, each number of them as likely as the others.
fn cost(stretches: usize, jumps: usize) -> f64 {
    let ways = ln_binomial(stretches.saturating_sub(1) as u64, jumps as u64);
    ways + (most_jumps(stretches) as f64).ln()
}

/// Two levels at one setting of the densities.
pub(super) struct TwoLevels {
    /// `s`.
    pub above: Vec<bool>,
    /// Number of jumps.
    pub count: usize,
    /// The likelihood ratio.
    pub ratio: f64,
    /// `a`.
    pub change: f64,
    /// Half of the ratio, less the cost.
    pub likelier: f64,
    /// `ln` of the number of ways that the data cannot tell from this one.
    alike: f64,
}

impl TwoLevels {
    /// `ln p` where the densities are these.
    pub fn log_p(&self) -> f64 {
        let search = cost(self.above.len(), self.count) - self.alike;
        (log_tail(self.ratio, 1.0) + search).min(0.0)
    }
}

/// Flips stretches in a row, as long as that makes the two levels likelier than it costs.
pub(super) fn search(gram: &DMatrix<f64>, right: &DVector<f64>) -> Option<TwoLevels> {
    let mut above = vec![false; right.len()];
    let mut best: Option<f64> = None;
    for _ in 0..MOST_FLIPS.get() {
        let Some((flipped, likelier)) = likeliest_flip(gram, right, &above) else {
            break;
        };
        if best.is_some_and(|best| likelier <= best) {
            break;
        }
        best = Some(likelier);
        above[flipped].iter_mut().for_each(|s| *s = !*s);
    }
    let sums = Sums::of(gram, right, &above);
    let (along, square) = (sums.along, sums.square);
    Some(TwoLevels {
        alike: alike(&sums, &above),
        count: above.windows(2).filter(|pair| pair[0] != pair[1]).count(),
        above,
        ratio: along * along / square,
        change: along / square,
        likelier: best?,
    })
}

/// `s`.
fn levels(above: &[bool]) -> DVector<f64> {
    DVector::from_iterator(above.len(), above.iter().map(|s| f64::from(u8::from(*s))))
}

/// The likelihood of two levels after a flip of stretches in a row.
///
/// With `e` what a flip adds to `s`, `s` being flipped from `i` to `j` has `sᵀb + Σ e b` and
/// `sᵀA s + 2 Σ e (A s) + Σ Σ e A e`, whose sums over `i..j` are differences of sums from the first stretch on.
struct Sums {
    along: f64,
    square: f64,
    by_right: Vec<f64>,
    by_pull: Vec<f64>,
    twice: DMatrix<f64>,
    /// Least value of `sᵀA s` at which two levels differ from one.
    faint: f64,
}

impl Sums {
    fn of(gram: &DMatrix<f64>, right: &DVector<f64>, above: &[bool]) -> Self {
        let n = above.len();
        let levels = levels(above);
        let flip = levels.map(|s| 1.0 - 2.0 * s);
        let pull = gram * &levels;
        let mut twice = DMatrix::<f64>::zeros(n + 1, n + 1);
        for j in 0..n {
            let mut column = 0.0;
            for i in 0..n {
                column += flip[i] * gram[(i, j)] * flip[j];
                twice[(i + 1, j + 1)] = twice[(i + 1, j)] + column;
            }
        }
        Self {
            along: levels.dot(right),
            square: pull.dot(&levels),
            by_right: summed(n, |k| flip[k] * right[k]),
            by_pull: summed(n, |k| flip[k] * pull[k]),
            twice,
            faint: FAINT.get() * gram.diagonal().sum(),
        }
    }

    /// The likelihood ratio after a flip.
    fn ratio(&self, flipped: &Range<usize>) -> f64 {
        let (i, j) = (flipped.start, flipped.end);
        let twice = &self.twice;
        let own = twice[(j, j)] - twice[(i, j)] - twice[(j, i)] + twice[(i, i)];
        let square = self.square + 2.0 * (self.by_pull[j] - self.by_pull[i]) + own;
        let along = self.along + self.by_right[j] - self.by_right[i];
        if square > self.faint {
            along * along / square
        } else {
            0.0
        }
    }
}

/// The stretches in a row whose flip makes the two levels likeliest, and how likely, the cost of the jumps taken off.
fn likeliest_flip(
    gram: &DMatrix<f64>,
    right: &DVector<f64>,
    above: &[bool],
) -> Option<(Range<usize>, f64)> {
    let n = above.len();
    let most = most_jumps(n);
    let sums = Sums::of(gram, right, above);
    let costs: Vec<f64> = (0..=most).map(|count| cost(n, count)).collect();
    let before = (1..n).filter(|k| jumps_at(above, *k)).count();
    let mut best: Option<(Range<usize>, f64)> = None;
    for i in 0..n {
        for j in i + 1..=n {
            // An end of what is flipped is a jump afterwards where it was none.
            let mut count = before;
            for end in [i, j].into_iter().filter(|end| *end > 0 && *end < n) {
                count = if jumps_at(above, end) {
                    count - 1
                } else {
                    count + 1
                };
            }
            if !(1..=most).contains(&count) {
                continue;
            }
            let likelier = 0.5 * sums.ratio(&(i..j)) - costs[count];
            if best.as_ref().is_none_or(|(_, so_far)| likelier > *so_far) {
                best = Some((i..j, likelier));
            }
        }
    }
    best
}

/// Returns true if `s` jumps before stretch `k`.
fn jumps_at(above: &[bool], k: usize) -> bool {
    k > 0 && k < above.len() && above[k - 1] != above[k]
}

/// `Σ ln Σ exp(−Δ)` over the jumps, `Δ` what the log-likelihood loses where a jump is some stretches earlier or later: so many ways
/// are one to the data, and paid for once.
fn alike(sums: &Sums, above: &[bool]) -> f64 {
    let n = above.len();
    let at = sums.ratio(&(0..0));
    let of_jump = |k: usize| {
        let is_level = |stretches: Range<usize>| {
            (stretches.start + 1..stretches.end).all(|k| !jumps_at(above, k))
        };
        let later = (1..=SHIFT.get())
            .map(|d| k..k + d)
            .filter(|s| s.end < n && is_level(s.start..s.end + 1));
        let earlier = (1..=SHIFT.get())
            .filter(|d| *d < k)
            .map(|d| k - d..k)
            .filter(|s| is_level(s.start - 1..s.end));
        let shifted = later
            .chain(earlier)
            .map(|s| (0.5 * (sums.ratio(&s) - at)).exp());
        (1.0 + shifted.sum::<f64>()).ln()
    };
    let jumps = (1..n).filter(|k| jumps_at(above, *k));
    jumps.map(of_jump).sum()
}

/// The sums of the first `0` to `n` values.
fn summed(n: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut sums = vec![0.0; n + 1];
    for k in 0..n {
        sums[k + 1] = sums[k] + value(k);
    }
    sums
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::StandardNormal;

    use super::*;

    /// Forty means with unit noise, of which a constant is taken out, and a bias on top.
    fn normal(
        random: &mut ChaCha8Rng,
        bias: impl Fn(usize) -> f64,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let n = 40;
        let b = DMatrix::identity(n, n).add_scalar(-1.0 / n as f64);
        let noisy = |k| bias(k) + random.sample::<f64, _>(StandardNormal);
        let z = DVector::from_iterator(n, (0..n).map(noisy));
        (b.transpose() * &b, b.transpose() * z)
    }

    #[test]
    fn jumps_are_found_where_they_are() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let jumped = |k: usize| (6..11).contains(&k) || (18..30).contains(&k) || k >= 34;
        let (gram, right) = normal(&mut random, |k| if jumped(k) { 6.0 } else { 0.0 });
        let found = search(&gram, &right).unwrap();
        let up: Vec<bool> = (0..40).map(jumped).collect();
        let down: Vec<bool> = up.iter().map(|s| !s).collect();
        assert!(
            found.above == up || found.above == down,
            "{:?}",
            found.above
        );
        assert_eq!(found.count, 5);
        assert!((found.change.abs() - 6.0).abs() < 1.5, "{}", found.change);
    }

    #[test]
    fn noise_has_two_levels_as_rarely_as_the_chance_says() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        let mut by_chance = || {
            let (gram, right) = normal(&mut random, |_| 0.0);
            let found = search(&gram, &right).unwrap();
            found.log_p() < 0.05_f64.ln()
        };
        let often = (0..400).filter(|_| by_chance()).count();
        // 5 % of 400, and the price of all ways is more than that of the ways that differ.
        assert!(often <= 20, "{often}");
    }

    #[test]
    fn the_flip_that_is_found_is_as_likely_as_it_says() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let (gram, right) = normal(&mut random, |k| if k % 9 < 4 { 3.0 } else { 0.0 });
        let mut above: Vec<bool> = (0..40).map(|k| (10..17).contains(&k)).collect();
        let (flipped, likelier) = likeliest_flip(&gram, &right, &above).unwrap();
        above[flipped].iter_mut().for_each(|s| *s = !*s);
        let s = levels(&above);
        let ratio = s.dot(&right).powi(2) / (&gram * &s).dot(&s);
        let count = above.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert!((likelier - (0.5 * ratio - cost(40, count))).abs() < 1e-9);
    }
}
