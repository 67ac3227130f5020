//! First-order Butterworth filters, run forward and backward.

/// `y_n = b₀ x_n + b₁ x_{n−1} − a₁ y_{n−1}`, by the bilinear transform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FirstOrder {
    b: [f64; 2],
    a1: f64,
    /// State that a constant 1 before the first sample has left.
    settled: f64,
}

/// Samples mirrored through each end before filtering: three per order, as MATLAB's `filtfilt` does.
const MIRRORED: usize = 3;

impl FirstOrder {
    /// Low-pass with its −3 dB point at `cutoff` for samples at `rate` (same unit).
    pub(super) fn low_pass(cutoff: f64, rate: f64) -> Self {
        let k = (std::f64::consts::PI * cutoff / rate).tan();
        let (b, a1) = (k / (1.0 + k), (k - 1.0) / (k + 1.0));
        Self {
            b: [b, b],
            a1,
            settled: b * (1.0 - a1) / (1.0 + a1),
        }
    }

    /// High-pass with its −3 dB point at `cutoff` for samples at `rate` (same unit).
    pub(super) fn high_pass(cutoff: f64, rate: f64) -> Self {
        let k = (std::f64::consts::PI * cutoff / rate).tan();
        let (b, a1) = (1.0 / (1.0 + k), (k - 1.0) / (k + 1.0));
        Self {
            b: [b, -b],
            a1,
            settled: -b,
        }
    }

    /// Forward and backward over the samples, without phase. The samples are mirrored through both
    /// end points, and the filter starts as if it had always seen the first of them.
    pub(super) fn both_ways(&self, x: &[f64]) -> Vec<f64> {
        let (Some(&first), Some(&last)) = (x.first(), x.last()) else {
            return Vec::new();
        };
        let mirrored = MIRRORED.min(x.len() - 1);
        let before = (1..=mirrored).rev().map(|k| 2.0 * first - x[k]);
        let after = (1..=mirrored).map(|k| 2.0 * last - x[x.len() - 1 - k]);
        let mut y: Vec<f64> = before.chain(x.iter().copied()).chain(after).collect();
        for _ in 0..2 {
            self.run(&mut y);
            y.reverse();
        }
        y.drain(..mirrored);
        y.truncate(x.len());
        y
    }

    fn run(&self, y: &mut [f64]) {
        let mut state = self.settled * y.first().copied().unwrap_or(0.0);
        for value in y {
            let x = *value;
            *value = self.b[0] * x + state;
            state = self.b[1] * x - self.a1 * *value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: [f64; 8] = [1.0, 2.0, -1.0, 0.5, 4.0, 3.0, -2.0, 0.0];

    // scipy 1.17.1: b, a = butter(1, 3/50[, 'highpass']); filtfilt(b, a, X, padlen=3)
    #[test]
    fn filtering_both_ways_agrees_with_scipy() {
        for (filter, expected) in [
            (FirstOrder::low_pass(3.0, 100.0), LOW),
            (FirstOrder::high_pass(3.0, 100.0), HIGH),
        ] {
            for (found, expected) in filter.both_ways(&X).iter().zip(expected) {
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
        }
    }

    const LOW: [f64; 8] = [
        1.0584826349444851,
        0.9823342977185066,
        0.9055488593696506,
        0.8569133664257998,
        0.8031175547204145,
        0.6746007604396276,
        0.49828437515874574,
        0.3489543393616721,
    ];
    const HIGH: [f64; 8] = [
        0.5436793083850417,
        1.7455544530860105,
        -1.025682505447944,
        0.7066623515775532,
        4.482524637283447,
        3.879473686618482,
        -0.6197310715878595,
        1.9218265238315162,
    ];
}
