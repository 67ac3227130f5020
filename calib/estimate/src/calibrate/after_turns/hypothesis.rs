//! A hypothesis about errors that fade: one of them, or those of three axes.

use super::tested::Tested;
use super::way::Way;
use crate::methods::chance;

findings::tuning! {
    /// What of the means only those before the first turn tell has to be in the readings within the intervals too, as by chance in fewer recordings
    /// than this: something that changes with time may be in those means.
    IN_BOTH: f64 = 1e-2;
}

/// Whose error it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// That of one axis alone.
    Axis(usize),
    /// That of each axis, with factors of their own.
    Each,
    /// That of all axes, with one factor.
    Alike,
}

/// Factors of an error that are looked at together.
#[derive(Clone, Debug)]
pub struct Hypothesis {
    pub way: Way,
    pub whose: Whose,
    tested: Vec<Tested>,
}

impl Hypothesis {
    /// All that are made of these, which go with one time constant.
    pub fn all(tested: &[Tested]) -> Vec<Self> {
        let single = |own: &Tested| Self {
            way: own.way,
            whose: own.axis.map_or(Whose::Alike, Whose::Axis),
            tested: vec![*own],
        };
        // Of three axes the readings within intervals are independent, and the means are not.
        let each = |way: Way| {
            let own = tested
                .iter()
                .filter(|own| own.way == way && own.axis.is_some());
            let own: Vec<Tested> = own.filter(|own| !own.is_seen_in_means()).copied().collect();
            (own.len() == 3).then_some(Self {
                way,
                whose: Whose::Each,
                tested: own,
            })
        };
        let singles = tested.iter().map(single);
        singles
            .chain(Way::ALL.into_iter().filter_map(each))
            .collect()
    }

    /// Returns true if both are of the same errors.
    pub fn is_same(&self, other: &Self) -> bool {
        self.way == other.way && self.whose == other.whose
    }

    /// Returns true if the means say something of it.
    pub fn is_in_means(&self) -> bool {
        self.tested.iter().any(Tested::is_in_means)
    }

    /// What the means alone gain.
    pub fn gain_of_means(&self) -> f64 {
        self.tested.iter().map(Tested::gain_of_means).sum()
    }

    /// Log-likelihood over none.
    pub fn gain(&self) -> f64 {
        0.5 * self.square(Tested::score)
    }

    /// Probability of so much by chance, in this one test.
    pub fn p_value(&self) -> f64 {
        chance::of_chi2(self.square(Tested::score), self.tested.len() as f64)
    }

    /// Returns true if the readings and the means may have the same factors, and the readings show them where the means may have them of another.
    pub fn agrees(&self) -> bool {
        let within =
            || chance::of_chi2(self.square(Tested::score_within), self.tested.len() as f64);
        let is_told_by_first = self.is_in_means() && self.way != Way::Change;
        self.tested.iter().all(Tested::agrees) && (!is_told_by_first || within() < IN_BOTH.get())
    }

    fn square(&self, score: impl Fn(&Tested) -> f64) -> f64 {
        self.tested.iter().map(|own| score(own).powi(2)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::after_turns::tested::Factor;
    use crate::methods::joint::Evidence;

    fn one(value: f64) -> Factor {
        Factor {
            value,
            weight: 1.0,
            ..Factor::default()
        }
    }

    /// Twelve intervals that say `factor`, more or less, and means that say one half, much more sharply.
    fn of_all(way: Way, factor: f64) -> Hypothesis {
        let factors = (0..12).map(|k| one(factor + 0.5 * f64::from(k % 3 - 1)));
        let own = Tested::of(way, None, &factors.collect::<Vec<_>>()).unwrap();
        let square = 1e4;
        let own = own.with(Evidence {
            product: -0.5 * square,
            square,
            all: (0.25 * square + 20.0, 21),
        });
        Hypothesis::all(&[own]).remove(0)
    }

    #[test]
    fn what_only_readings_before_the_first_turn_tell_has_to_be_within_the_intervals_too() {
        assert!(of_all(Way::Change, 0.2).agrees());
        assert!(!of_all(Way::Force, 0.2).agrees());
        assert!(of_all(Way::Force, 0.5).agrees());
    }

    #[test]
    fn three_axes_that_say_a_little_say_enough_together() {
        let factors: Vec<_> = (0..12)
            .map(|k| one(0.5 + 0.5 * f64::from(k % 3 - 1)))
            .collect();
        let axes = [0, 1, 2].map(|axis| Tested::of(Way::Turn, Some(axis), &factors).unwrap());
        let all = Hypothesis::all(&axes);
        let [each] = &all[3..] else {
            panic!("{all:?}");
        };
        assert!(each.whose == Whose::Each && each.p_value() < 0.1 * all[0].p_value());
    }
}
