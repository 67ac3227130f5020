//! One error that fades, tested by readings within static intervals and by their means.

use nalgebra::Vector3;

use super::way::Way;
use crate::methods::joint::Evidence;
use crate::methods::small_sample::normal_score;

findings::tuning! {
    /// Readings and means that differ by more standard errors than this speak of two errors.
    APART: f64 = 3.0;
}

/// A factor of an error by the readings within one interval.
#[derive(Clone, Copy, Debug, Default)]
pub struct Factor {
    pub value: f64,
    pub weight: f64,
    /// How far a standard error of the slope of each axis would put it off, which is that of all intervals.
    pub by_drift: Vector3<f64>,
}

/// A factor of an error, tested.
#[derive(Clone, Copy, Debug)]
pub struct Tested {
    pub way: Way,
    /// The axis that has it; `None` of all axes alike.
    pub axis: Option<usize>,
    /// By the readings within intervals, and its variance.
    factor: f64,
    variance: f64,
    /// Degrees of freedom of that.
    spare: f64,
    /// By the means of the intervals.
    means: Evidence,
}

impl Tested {
    /// The weighted mean of the factors by the intervals, against their own scatter (Student 1908): whatever the noise is within an interval,
    /// that of others is independent. A slope of all readings that is not known well puts all off alike.
    pub fn of(way: Way, axis: Option<usize>, factors: &[Factor]) -> Option<Self> {
        let spare = factors.len().checked_sub(1)? as f64;
        let weight: f64 = factors.iter().map(|own| own.weight).sum();
        let factor = factors
            .iter()
            .map(|own| own.value * own.weight)
            .sum::<f64>()
            / weight;
        let scatter = factors
            .iter()
            .map(|own| own.weight * (own.value - factor).powi(2));
        let drift: Vector3<f64> = factors.iter().map(|own| own.by_drift * own.weight).sum();
        let drift = (drift / weight).norm_squared();
        let variance = scatter.sum::<f64>() / spare / weight + drift;
        (factor * factor / variance).is_finite().then(|| Self {
            way,
            axis,
            factor,
            variance,
            spare,
            means: Evidence::default(),
        })
    }

    /// Returns true if the means of static intervals tell it from scale factors and biases. What comes again after every turn looks like those, but
    /// for what was read before the first turn: that tells one factor, and not one of each axis.
    pub fn is_seen_in_means(&self) -> bool {
        match self.way {
            Way::Change => true,
            Way::Force => self.axis.is_none(),
            Way::Turn => false,
        }
    }

    /// The factor by the readings within intervals, and its variance.
    pub fn within(&self) -> (f64, f64) {
        (self.factor, self.variance)
    }

    /// The same error with what the means of the intervals say of it.
    pub fn with(self, means: Evidence) -> Self {
        Self { means, ..self }
    }

    /// The factor by both.
    pub fn factor(&self) -> f64 {
        let (own, means) = self.weights();
        (self.factor * own + self.means.factor() * means) / (own + means)
    }

    /// Returns true if the means say something of it.
    pub fn is_in_means(&self) -> bool {
        self.means.variance().is_some()
    }

    /// Gain by the means alone.
    pub fn gain_of_means(&self) -> f64 {
        self.means.most()
    }

    /// Returns true if the readings and the means may have one factor.
    pub fn agrees(&self) -> bool {
        let apart = self.factor - self.means.factor();
        let means = self.means.variance();
        means.is_none_or(|(means, _)| {
            apart * apart < APART.get() * APART.get() * (self.variance + means)
        })
    }

    /// The normal score of the readings within intervals.
    pub fn score_within(&self) -> f64 {
        normal_score(self.factor / self.variance.sqrt(), self.spare)
    }

    /// Information of the readings and of the means on the factor: inverse variances.
    fn weights(&self) -> (f64, f64) {
        let means = self.means.variance();
        let means = means.map_or(0.0, |(variance, _)| variance.recip());
        (self.variance.recip(), means)
    }

    /// The normal score of both together, each weighted by what it knows (Stouffer 1949): no part of a mean is in the readings about it, so
    /// that the two are independent.
    pub fn score(&self) -> f64 {
        let within = self.score_within();
        let means = self.means.variance().map_or(0.0, |(variance, spare)| {
            normal_score(self.means.factor() / variance.sqrt(), spare)
        });
        let (own, other) = self.weights();
        (within * own.sqrt() + means * other.sqrt()) / (own + other).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A factor that an error of the slope of x puts off.
    fn of(value: f64, by_drift: f64) -> Factor {
        Factor {
            value,
            weight: 1.0,
            by_drift: by_drift * Vector3::x(),
        }
    }

    #[test]
    fn intervals_that_agree_tell_nothing_that_a_slope_may_make() {
        let score = |by_drift: f64| {
            let factors = (0..12).map(|k| of(0.5 + 0.01 * f64::from(k % 3), by_drift));
            let own = Tested::of(Way::Turn, Some(0), &factors.collect::<Vec<_>>());
            own.unwrap().score_within()
        };
        assert!(score(0.0) > 5.0 && score(0.5).abs() < 1.1);
    }

    /// Twelve intervals of which each says one half, more or less; the means say `factor`, as sharply as all of them.
    fn tested(factor: f64) -> Tested {
        let factors: Vec<_> = (0..12).map(|k| of(f64::from(k % 3) * 0.5, 0.0)).collect();
        let own = Tested::of(Way::Change, None, &factors).unwrap();
        let square = 2.0 / own.variance;
        own.with(Evidence {
            product: -factor * square,
            square,
            all: (factor * factor * square + 10.0, 21),
        })
    }

    #[test]
    fn two_that_agree_say_more_than_one() {
        let both = tested(0.5);
        let alone = both.with(Evidence::default());
        assert!(both.agrees() && both.score() > 1.3 * alone.score());
        assert!((both.factor() - 0.5).abs() < 1e-12, "{both:?}");
    }

    #[test]
    fn two_that_contradict_each_other_agree_on_nothing() {
        let both = tested(-0.5);
        assert!(!both.agrees(), "{both:?}");
    }
}
