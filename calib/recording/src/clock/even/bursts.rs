//! Stamps of samples that arrive in bursts: the stamps say when the host read them.

use super::line::lines;

/// A step shorter than this share of the mean is within a burst.
const WITHIN: f64 = 0.2;

/// Share of such steps from which stamps come in bursts.
const MANY: f64 = 0.4;

/// Seconds on either side that a sample's time is taken from.
const REACH: f64 = 15.0;

/// An interruption: this many mean steps, beyond a whole burst.
const INTERRUPTION: f64 = 5.0;

/// Samples that arrive together, and the even clock behind them.
#[derive(Clone, Debug, PartialEq)]
pub struct Bursts {
    /// Samples of a burst, on average.
    pub size: f64,
    /// The even clock, s.
    pub even: Vec<f64>,
}

/// The even clock behind stamps that come in bursts; `None` where they do not.
pub fn bursts(t: &[f64]) -> Option<Bursts> {
    let whole = t.last()? - t.first()?;
    let mean = whole / (t.len() - 1) as f64;
    let count = t
        .windows(2)
        .filter(|pair| pair[1] - pair[0] < WITHIN * mean)
        .count();
    if t.len() < 100 || (count as f64) < MANY * (t.len() - 1) as f64 {
        return None;
    }
    let size = (t.len() - 1) as f64 / (t.len() - 1 - count) as f64;
    let most = (INTERRUPTION + 2.0 * size) * mean;
    let mut even = Vec::with_capacity(t.len());
    for run in t.chunk_by(|a, b| b - a <= most) {
        let ticks: Vec<u32> = (0..).take(run.len()).collect();
        let step = match run {
            [first, .., last] => (last - first) / (run.len() - 1) as f64,
            _ => mean,
        };
        let steady = |k: usize| run[0] + k as f64 * step;
        let excess: Vec<f64> = (0..run.len()).map(|k| run[k] - steady(k)).collect();
        let line = lines(&ticks, &excess, REACH / step);
        even.extend((0..run.len()).map(|k| steady(k) + line[k]));
    }
    let increases = even.windows(2).all(|pair| pair[0] < pair[1]);
    increases.then_some(Bursts { size, even })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_that_arrive_by_tens_are_on_an_even_clock_again() {
        let truth: Vec<f64> = (0..20_000).map(|k| f64::from(k) * 0.01).collect();
        let arrived: Vec<f64> = (0..20_000)
            .map(|k| truth[k - k % 10 + 9] + 1e-4 * (k % 10) as f64)
            .collect();
        let found = bursts(&arrived).unwrap();
        assert!((found.size - 10.0).abs() < 0.1);
        // A burst is stamped when its last sample is taken: all are late by the same, some 50 ms.
        let late: Vec<f64> = found.even.iter().zip(&truth).map(|(a, b)| a - b).collect();
        assert!(late.iter().all(|l| (l - late[10_000]).abs() < 2e-3));
        assert_eq!(bursts(&truth), None);
    }
}
