//! Means of any stretch of samples from sums that are made once.

use std::ops::Range;

use nalgebra::Vector3;

/// Sums of the samples before each, from which the mean of a stretch follows in two look-ups.
///
/// Taken about the first sample and with the rounding errors carried along (Neumaier 1974), so that a
/// mean is good to the last digits however long the recording is.
#[derive(Clone, Debug)]
pub(super) struct RunningSums {
    origin: Vector3<f64>,
    /// Sum and what rounding took from it, before each sample and after the last.
    sums: Vec<[Vector3<f64>; 2]>,
}

impl RunningSums {
    /// Of samples that are all finite; `None` of others, which would spoil every mean after them.
    pub fn of(values: &[Vector3<f64>]) -> Option<Self> {
        let origin = values.first().copied().unwrap_or_default();
        let mut sums = Vec::with_capacity(values.len() + 1);
        let (mut sum, mut lost) = (Vector3::zeros(), Vector3::zeros());
        sums.push([sum, lost]);
        for value in values {
            let d = value - origin;
            let next = sum + d;
            lost += rounding(&sum, &d, &next);
            sum = next;
            sums.push([sum, lost]);
        }
        let finite = (sum + lost).iter().all(|v| v.is_finite());
        finite.then_some(Self { origin, sums })
    }

    /// The mean of a stretch; `None` of an empty one.
    pub fn mean(&self, stretch: Range<usize>) -> Option<Vector3<f64>> {
        let count = stretch.len();
        let ([from, from_lost], [to, to_lost]) =
            (self.sums.get(stretch.start)?, self.sums.get(stretch.end)?);
        let sum = (to - from) + (to_lost - from_lost);
        (count > 0).then(|| self.origin + sum / count as f64)
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
