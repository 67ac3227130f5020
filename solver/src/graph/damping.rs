//! Rules of the damping: as in the dense solver, but for its quick fall where steps do what is promised.

use crate::search::Damping;

/// Least and largest damping.
const LEAST: f64 = 1e-20;
const MOST: f64 = 1e20;

/// Nearness to 1 of the gain ratio where a step did what the linearised problem said, and by what the damping falls
/// then under Nielsen's rule, which by itself takes a third: from 1e-4 it would hold back the slow directions of a
/// long chain for as many steps as it has to fall by powers of three. A second failure shows that it fell too far; from then on
/// it falls by a third at most.
const ALIKE: f64 = 0.1;
const FALL: f64 = 0.01;

/// The damping up to the first step that fails: next to none. A start from which the linearised problem is good then takes
/// the steps of Gauss and Newton, and one that is not pays for one more solution.
const NEXT_TO_NONE: f64 = 1e-8;

/// The damping `λ` of `H + λ D²`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lambda {
    pub value: f64,
    rule: Damping,
    rise: f64,
    /// First damping once a step has failed, until then.
    first: Option<f64>,
    /// True where it may fall by [`FALL`].
    quick: bool,
}

impl Lambda {
    /// Begins at `first` once a step has failed.
    pub fn new(rule: Damping, first: f64) -> Self {
        Self {
            value: first.min(NEXT_TO_NONE),
            rule,
            rise: 2.0,
            first: Some(first),
            quick: true,
        }
    }

    /// After a step taken whose fall of the cost was `ratio` of the predicted one.
    pub fn accepted(&mut self, ratio: f64) {
        let factor = match self.rule {
            Damping::Marquardt => 0.1,
            Damping::Nielsen if self.quick && (ratio - 1.0).abs() <= ALIKE => FALL,
            Damping::Nielsen => (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0),
            Damping::DelayedGratification if ratio > 0.1 => 1.0 / 3.0,
            Damping::DelayedGratification => 1.0,
        };
        self.value = (self.value * factor).max(LEAST);
        self.rise = 2.0;
    }

    /// After a step not taken.
    pub fn rejected(&mut self) {
        if let Some(first) = self.first.take().filter(|first| *first > self.value) {
            self.value = first;
            return;
        }
        self.quick = false;
        self.value *= match self.rule {
            Damping::Marquardt => 10.0,
            Damping::Nielsen => {
                self.rise *= 2.0;
                0.5 * self.rise
            }
            Damping::DelayedGratification => 2.0,
        };
    }

    /// True where a step is shorter than rounding.
    pub fn exhausted(&self) -> bool {
        self.value > MOST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_damping_begins_with_the_first_step_that_fails() {
        let mut lambda = Lambda::new(Damping::Nielsen, 1e-4);
        assert_eq!(lambda.value, NEXT_TO_NONE);
        lambda.rejected();
        assert_eq!(lambda.value, 1e-4);
        lambda.rejected();
        assert_eq!(lambda.value, 2e-4);
    }

    #[test]
    fn the_quick_fall_ends_with_the_second_step_that_fails() {
        let mut lambda = Lambda::new(Damping::Nielsen, 1e-4);
        lambda.rejected();
        lambda.accepted(1.0);
        assert!((lambda.value / 1e-6 - 1.0).abs() < 1e-12);
        lambda.rejected();
        let before = lambda.value;
        lambda.accepted(1.0);
        assert!((lambda.value / before - 1.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_first_damping_below_next_to_none_is_where_it_begins() {
        let mut lambda = Lambda::new(Damping::Marquardt, 1e-12);
        assert_eq!(lambda.value, 1e-12);
        lambda.rejected();
        assert_eq!(lambda.value, 1e-11);
    }
}
