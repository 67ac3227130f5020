//! Means of any stretch of samples from sums that are made once.

use std::ops::Range;

use nalgebra::Vector3;

/// Samples between two sums that are kept.
const STRIDE: usize = 64;

/// Sums of the samples before every 64th, from which the mean of a stretch follows in two look-ups and
/// a few additions.
///
/// Taken about the first sample and with the rounding errors carried along (Neumaier 1974), so that a
/// mean is good to the last digits however long the recording is.
#[derive(Clone, Debug)]
pub(crate) struct RunningSums<'a> {
    values: &'a [Vector3<f64>],
    origin: Vector3<f64>,
    /// Before each sample whose index the stride divides.
    sums: Vec<Sum>,
}

/// A sum and what rounding took from it.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sum: Vector3<f64>,
    lost: Vector3<f64>,
}

impl Sum {
    /// With `d` added.
    fn plus(self, d: Vector3<f64>) -> Self {
        let sum = self.sum + d;
        Self {
            sum,
            lost: self.lost + rounding(&self.sum, &d, &sum),
        }
    }
}

impl<'a> RunningSums<'a> {
    /// Computes the running sums of samples (`n × 3`); `None` if one is not finite, which would spoil every mean after it.
    pub fn of(values: &'a [Vector3<f64>]) -> Option<Self> {
        let origin = values.first().copied().unwrap_or_default();
        let mut sums = Vec::with_capacity(values.len() / STRIDE + 1);
        let mut sum = Sum::default();
        for block in values.chunks(STRIDE) {
            sums.push(sum);
            sum = block
                .iter()
                .fold(sum, |sum, value| sum.plus(value - origin));
        }
        if values.len().is_multiple_of(STRIDE) {
            sums.push(sum);
        }
        let finite = (sum.sum + sum.lost).iter().all(|v| v.is_finite());
        finite.then_some(Self {
            values,
            origin,
            sums,
        })
    }

    /// The mean of a stretch; `None` of an empty one.
    pub fn mean(&self, stretch: Range<usize>) -> Option<Vector3<f64>> {
        let count = stretch.len();
        let (from, to) = (self.before(stretch.start)?, self.before(stretch.end)?);
        let sum = (to.sum - from.sum) + (to.lost - from.lost);
        (count > 0).then(|| self.origin + sum / count as f64)
    }

    /// The sum of the samples before `index`; `None` beyond the last.
    fn before(&self, index: usize) -> Option<Sum> {
        let kept = index / STRIDE;
        let block = self.values.get(kept * STRIDE..index)?;
        let sum = *self.sums.get(kept)?;
        Some(
            block
                .iter()
                .fold(sum, |sum, value| sum.plus(value - self.origin)),
        )
    }
}

/// `(a + b) − next` for `next` the rounded `a + b`, exactly (Knuth's two-sum).
fn rounding(a: &Vector3<f64>, b: &Vector3<f64>, next: &Vector3<f64>) -> Vector3<f64> {
    let of_b = next - a;
    let of_a = next - of_b;
    (a - of_a) + (b - of_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_from_running_sums_are_those_of_the_samples() {
        let value = |k: usize| {
            let phase = (k * k % 997) as f64;
            Vector3::new(9.8 + 1e-3 * phase.sin(), 1e4 * phase.cos(), phase)
        };
        let values: Vec<_> = (0..50_000).map(value).collect();
        let sums = RunningSums::of(&values).unwrap();
        for stretch in [0..50_000, 17..18, 30_000..30_300, 49_000..50_000] {
            let n = stretch.len() as f64;
            let plain = values[stretch.clone()].iter().sum::<Vector3<f64>>() / n;
            let error = sums.mean(stretch).unwrap() - plain;
            assert!(error.component_div(&plain).amax() < 1e-12);
        }
        assert_eq!(sums.mean(5..5), None);
    }

    #[test]
    fn a_sample_that_is_not_a_number_has_no_sums() {
        assert!(RunningSums::of(&[Vector3::zeros(), Vector3::repeat(f64::NAN)]).is_none());
    }
}
