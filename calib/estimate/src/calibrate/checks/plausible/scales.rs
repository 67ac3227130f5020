//! The readings of an axis per unit of the signal, beside those of the other axes.

use nalgebra::{Matrix3, Vector3};
use sensor::inverse;

use crate::gravity::STANDARD_GRAVITY;

findings::tuning! {
    /// An axis that reads so much more or less than the other two is no axis of one sensor: five per cent either way are its own.
    APART: f64 = 1.075;
    /// The other two agree to this part of that.
    AGREE: f64 = 0.5;
    /// It is known so many times better.
    KNOWN: f64 = 5.0;
}

/// Raw units per SI unit of each axis of the readings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    sizes: Vector3<f64>,
    /// Standard errors as a share, where they are known.
    errors: Vector3<f64>,
}

impl Scales {
    /// Builds them from `corrected = T (raw − b)` with the standard errors of the diagonal; `None` where `T` has no
    /// inverse.
    pub fn of(t: &Matrix3<f64>, std: &[Option<f64>; 3]) -> Option<Self> {
        let s = inverse(t)?;
        let sizes = Vector3::from_fn(|axis, _| s.row(axis).norm());
        // Turned axes have theirs beside the diagonal.
        let error = |axis: usize| {
            let row = t.column(axis).iamax();
            std[row].map_or(0.0, |std| std / t[(row, axis)].abs())
        };
        let is_known = sizes.iter().all(|size| size.is_finite() && *size > 0.0);
        is_known.then(|| Self {
            sizes,
            errors: Vector3::from_fn(|axis, _| error(axis)),
        })
    }

    pub fn each(&self) -> [f64; 3] {
        self.sizes.into()
    }

    /// Their geometric mean.
    pub fn common(&self) -> f64 {
        self.sizes.product().cbrt()
    }

    /// By how much the largest is larger than the smallest, as a share.
    pub fn spread(&self) -> f64 {
        self.sizes.max() / self.sizes.min() - 1.0
    }

    /// True where a share of them is known.
    pub fn tell(&self, share: f64) -> bool {
        share > KNOWN.get() * self.errors.amax()
    }

    /// The axis that stands apart from the other two, and how many times as much it reads.
    pub fn odd(&self) -> Option<(usize, f64)> {
        let apart = |axis: usize| {
            let [one, other] = [1, 2].map(|step| self.sizes[(axis + step) % 3]);
            let factor = self.sizes[axis] / (one * other).sqrt();
            let (size, agree) = (factor.ln().abs(), (one / other).ln().abs());
            let is_known = self.tell(size);
            (size > APART.get().ln() && agree < AGREE.get() * size && is_known)
                .then_some((axis, factor))
        };
        let all = (0..3).filter_map(apart);
        all.max_by(|a, b| a.1.ln().abs().total_cmp(&b.1.ln().abs()))
    }

    /// The common scale where all axes lie on one side of 1 by more than `least`.
    pub fn all_off(&self, least: f64) -> Option<f64> {
        let above = self.sizes.iter().all(|size| size.recip() > 1.0 + least);
        let below = self.sizes.iter().all(|size| size.recip() < 1.0 - least);
        (above || below).then(|| self.common().recip())
    }
}

/// A factor with a cause: how it reads, and what undoes it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cause {
    factor: f64,
    words: &'static str,
    undone: f64,
}

const CAUSES: [Cause; 4] = [
    Cause {
        factor: 2.0,
        words: "twice",
        undone: 0.5,
    },
    Cause {
        factor: 0.5,
        words: "half",
        undone: 2.0,
    },
    Cause {
        factor: 1.0 / STANDARD_GRAVITY,
        words: "1/9.8 times",
        undone: STANDARD_GRAVITY,
    },
    Cause {
        factor: STANDARD_GRAVITY,
        words: "9.8 times",
        undone: 1.0 / STANDARD_GRAVITY,
    },
];
findings::tuning! {
    /// A sensor's own scale error beside such a factor.
    OWN: f64 = 0.08;
}

/// The cause of a factor, a range or a unit, if it has one.
pub(super) fn cause(factor: f64) -> Option<Cause> {
    let near = |known: &Cause| (factor / known.factor - 1.0).abs() < OWN.get();
    CAUSES.into_iter().find(near)
}

/// A factor in words, `twice` or `1.100 times`.
pub(super) fn in_words(factor: f64) -> String {
    cause(factor).map_or_else(
        || format!("{factor:.3} times"),
        |cause| cause.words.to_owned(),
    )
}

/// The factor that undoes another.
pub(super) fn undone(factor: f64) -> f64 {
    cause(factor).map_or_else(|| rounded(factor.recip()), |cause| cause.undone)
}

/// Four significant digits: no more is known of a factor.
pub(super) fn rounded(value: f64) -> f64 {
    let unit = 10f64.powf(value.abs().log10().floor() - 3.0);
    (value / unit).round() * unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_axis_apart_is_named_and_three_different_ones_are_not() {
        let odd = |sizes: [f64; 3]| {
            let t = Matrix3::from_diagonal(&Vector3::from(sizes).map(f64::recip));
            Scales::of(&t, &[Some(1e-4); 3]).unwrap().odd()
        };
        for axis in 0..3 {
            for factor in [2.0, 0.5, 9.80665, 0.102, 1.1, 0.9] {
                let mut sizes = [1.004, 0.997, 1.001];
                sizes[axis] *= factor;
                let (found, by) = odd(sizes).unwrap();
                assert!(found == axis && (by / factor - 1.0).abs() < 0.01);
            }
        }
        assert_eq!(odd([1.05, 0.96, 1.0]), None);
        assert_eq!(odd([1661.0, 1677.0, 1706.0]), None);
    }
}
