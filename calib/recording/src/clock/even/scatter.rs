//! Scatter of stamps: their period, the jitter of each stamp, and the random walk that adds up from step to step.

use crate::order_statistic::nth_smallest;

findings::tuning! {
    /// Scatter of the steps, in steps, below which stamps are exact.
    pub(super) EXACT: f64 = 1e-4;

    /// Steps that the period is taken over.
    pub(crate) LAG: usize = 64;

    /// Differences that suffice for a variance of 2 %.
    ENOUGH: usize = 8192;

    /// Share of the differences left out on either side: lost samples and stalls of the host.
    TRIMMED: f64 = 0.1;

    /// Whole stretches without a lost sample from which a variance is taken.
    LEAST: f64 = 32.0;

    /// Longer steps of stamps that are rounded to the others: fewer than this may be lost samples.
    FEWEST_LONGER: usize = 8;

    /// Stamps rounded to a step lie within it of an even clock.
    WITHIN: f64 = 1.1;
}

/// Variance of a normal variable over that of its central 80 %.
const CENTRAL: f64 = 2.285;

/// Stamps `s_k = t_k + ε_k` with `t_{k+1} = t_k + P + η_k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scatter {
    /// `P`, s.
    pub period: f64,
    /// Variance of `ε`, each stamp's own, s².
    pub own: f64,
    /// Variance of `η`, which adds up, s².
    pub adding: f64,
    /// By how much more than one step sixteen scatter.
    pub correlation: f64,
}

impl Scatter {
    /// From the differences over 1, 16 and 64 steps: the variance over `m` is `2 own + m adding`. `None` with
    /// fewer than 130 stamps.
    pub fn of(stamps: &[f64]) -> Option<Self> {
        let period = central(stamps, LAG.get())?.0 / LAG.get() as f64;
        Self::about(stamps, period)
    }

    /// The scatter of an even clock whose stamps are rounded to a step that is a little shorter than its own: now and then two of them pass
    /// from stamp to stamp. `None` of others, and where samples are lost: these leave the even clock.
    pub fn rounded(stamps: &[f64]) -> Option<Self> {
        let step = crate::recording::stream::median_step(stamps)?;
        let first = stamps.first()?;
        let steps = stamps.windows(2).map(|pair| (pair[1] - pair[0]) / step);
        let longer = steps.clone().filter(|steps| *steps > 1.5).count();
        let is_grid = |steps: f64| {
            (steps - steps.round()).abs() < EXACT.get() && (1.0..3.0).contains(&steps.round())
        };
        if longer < FEWEST_LONGER.get() || !steps.clone().all(is_grid) {
            return None;
        }
        // The line through all of them: their ends are rounded too.
        let middle = 0.5 * (stamps.len() - 1) as f64;
        let rows = || {
            stamps
                .iter()
                .enumerate()
                .map(|(k, stamp)| (k as f64 - middle, stamp - first))
        };
        let (square, product) = rows().fold((0.0, 0.0), |(square, product), (k, t)| {
            (square + k * k, product + k * t)
        });
        let period = product / square;
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = rows().fold(none, |(low, high), (k, t)| {
            let late = t - k * period;
            (late.min(low), late.max(high))
        });
        (high - low < WITHIN.get() * step).then_some(Self {
            period,
            own: step * step / 12.0,
            adding: 0.0,
            correlation: 1.0,
        })
    }

    /// The same of differences with as many samples as steps: lost samples have no part in it.
    pub fn unbroken(stamps: &[f64]) -> Option<Self> {
        let mut period = crate::recording::stream::median_step(stamps)?;
        let mut variances = [0.0; 4];
        for (lag, variance) in [1, 4, 16, LAG.get()].into_iter().zip(&mut variances) {
            let near = |d: &f64| (d / period - lag as f64).abs() < 0.5;
            let (sum, square, count) = differences(stamps, lag)
                .filter(near)
                .map(|d| d - lag as f64 * period)
                .fold((0.0, 0.0, 0.0), |(s, q, n), d| (s + d, q + d * d, n + 1.0));
            if count < LEAST.get() {
                // Whole stretches of this length are rare: what is known of shorter ones holds.
                *variance = f64::NAN;
                continue;
            }
            *variance = (square - sum * sum / count) / count;
            period += sum / (count * lag as f64);
        }
        let [v1, _, v16, v64] = variances;
        (period > 0.0).then(|| Self::with(period, v1, v16, v64))
    }

    fn about(stamps: &[f64], period: f64) -> Option<Self> {
        if period <= 0.0 || stamps.len() <= 2 * LAG.get() + 1 {
            return None;
        }
        let [v1, v16, v64] =
            [1, 16, LAG.get()].map(|lag| central(stamps, lag).map_or(0.0, |c| c.1));
        Some(Self::with(period, v1, v16, v64))
    }

    /// Builds the scatter from the variances over 1, 16 and 64 steps, s²; the longer ones may be missing (NaN).
    fn with(period: f64, v1: f64, v16: f64, v64: f64) -> Self {
        let v16 = if v16.is_nan() { v1 } else { v16 };
        let v64 = if v64.is_nan() { v16 } else { v64 };
        let adding = ((v16 - v1) / 15.0).min((v64 - v16) / 48.0).max(0.0);
        let own = (0.5 * (v1 - adding)).max(0.5 * v16 - 8.0 * adding);
        Self {
            period,
            own: own.max(0.0),
            adding,
            correlation: if v1 > 0.0 { v16 / v1 } else { 1.0 },
        }
    }
}

/// Mean of the central 80 % of the differences over `lag` steps, and their variance by those.
fn central(stamps: &[f64], lag: usize) -> Option<(f64, f64)> {
    let all: Vec<f64> = differences(stamps, lag).collect();
    let cut = (TRIMMED.get() * all.len() as f64) as usize;
    let low = nth_smallest(all.iter().copied(), cut)?;
    let high = nth_smallest(all.iter().copied(), all.len() - 1 - cut)?;
    let inside = || all.iter().filter(|d| (low..=high).contains(*d));
    // Rounded stamps have many differences equal to the limits: as many as belong to the central part count.
    let (mut sum, mut square, mut count) = (0.0, 0.0, 0.0);
    for d in inside().filter(|d| **d > low && **d < high) {
        (sum, square, count) = (sum + d, square + d * d, count + 1.0);
    }
    let below = all
        .iter()
        .filter(|d| **d <= low)
        .count()
        .saturating_sub(cut);
    let above = all
        .iter()
        .filter(|d| **d >= high)
        .count()
        .saturating_sub(cut);
    let ends = if low < high {
        [(low, below), (high, above)]
    } else {
        [(low, 1), (high, 0)]
    };
    for (d, n) in ends {
        let n = n as f64;
        (sum, square, count) = (sum + n * d, square + n * d * d, count + n);
    }
    let mean = sum / count;
    Some((mean, CENTRAL * (square / count - mean * mean).max(0.0)))
}

/// Differences over `lag` steps, all or evenly chosen ones.
fn differences(stamps: &[f64], lag: usize) -> impl Iterator<Item = f64> + Clone {
    let count = stamps.len().saturating_sub(lag);
    let stride = (count / ENOUGH.get()).max(1);
    (0..count)
        .step_by(stride)
        .map(move |k| stamps[k + lag] - stamps[k])
}
