//! Errors that fade after turns, from the readings within static intervals and their means.

use nalgebra::Vector3;
use recording::intervals::Span;

use super::hypothesis::{Hypothesis, Whose};
use super::rested::{AtFirst, Rested, changes};
use super::tested::{Factor, Tested};
use super::way::Way;
use crate::methods::joint::Evidence;

/// Time constants tried, s.
const TIME_CONSTANTS: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];

findings::tuning! {
    /// Slower than this, s, is tried only what the means of the intervals see: within the intervals it is a slope of any size.
    SLOWEST_WITHIN: f64 = 16.0;

    /// Chance makes readings fade so in fewer recordings than this, over all that is tried.
    LEVEL: f64 = 1e-3;

    /// A time constant is not ruled out where its log-likelihood is within this of the best (a 95 % interval).
    RULED_OUT: f64 = 2.0;

    /// Static intervals of which the scatter tells what chance does.
    FEWEST: usize = 6;
}

/// An error after each turn that fades.
#[derive(Clone, Debug, PartialEq)]
pub struct Decay {
    /// Time constant, s.
    pub tau: f64,
    /// The error right after the turn before each static interval, m/s².
    pub at_first: Vec<Vector3<f64>>,
}

impl Decay {
    /// The share of the error that is left, on the average over a span after a turn that ended at `turned`.
    pub fn mean_left(&self, span: &Span, turned: f64) -> f64 {
        let left = |t: f64| (-(t - turned).max(0.0) / self.tau).exp();
        self.tau * (left(span.from) - left(span.to)) / span.length().max(f64::MIN_POSITIVE)
    }
}

/// The factor of an error that one interval shows; `None` where the error would be nothing there.
fn factor(rest: &Rested<'_>, own: &AtFirst, along: Vector3<f64>) -> Option<Factor> {
    let square = along.norm_squared();
    (own.weight * square > 0.0).then(|| Factor {
        value: along.dot(&own.error) / square,
        weight: own.weight * square,
        by_drift: along.component_mul(&rest.drift_std) * (own.by_drift / square),
    })
}

/// All errors that fade with one time constant.
struct Tried {
    tau: f64,
    changes: Vec<Vector3<f64>>,
    tested: Vec<Tested>,
}

impl Tried {
    fn of(rests: &[Rested<'_>], tau: f64) -> Self {
        let changes = changes(rests, tau);
        let sound = rests.iter().zip(&changes);
        let sound = sound.filter(|(own, _)| own.shows_decay());
        let seen: Vec<_> = sound
            .map(|(own, change)| (own, change, own.at_first(tau)))
            .collect();
        let mut tested = Vec::new();
        for way in Way::ALL {
            let alike = way.may_be_alike().then_some(None);
            for axis in (0..3).map(Some).chain(alike) {
                let factors = seen.iter().filter_map(|(own, change, at_first)| {
                    let along = way.of(&own.force, change);
                    let along = axis.map_or(along, |k| Vector3::ith(k, along[k]));
                    factor(own, at_first, along)
                });
                tested.extend(Tested::of(way, axis, &factors.collect::<Vec<_>>()));
            }
        }
        Self {
            tau,
            changes,
            tested,
        }
    }

    fn find(&self, way: Way, axis: Option<usize>) -> Option<&Tested> {
        let mut own = self.tested.iter();
        own.find(|own| own.way == way && own.axis == axis)
    }

    /// The error with these factors of the axes.
    fn decay(&self, rests: &[Rested<'_>], way: Way, factors: &Vector3<f64>) -> Decay {
        let each = rests.iter().zip(&self.changes);
        let at_first = each.map(|(rest, change)| {
            let factors = factors * f64::from(u8::from(rest.follows_turn));
            way.of(&rest.force, change).component_mul(&factors)
        });
        Decay {
            tau: self.tau,
            at_first: at_first.collect(),
        }
    }

    /// The error of a factor of one.
    fn of_one(&self, rests: &[Rested<'_>], of: &Tested) -> Decay {
        let ones = Vector3::repeat(1.0);
        let factors = of.axis.map_or(ones, |axis| Vector3::ith(axis, 1.0));
        self.decay(rests, of.way, &factors)
    }

    /// The error as found: where one axis shows it alone, each has a factor of its own.
    fn as_found(&self, rests: &[Rested<'_>], found: &Hypothesis) -> Decay {
        let own = |axis| self.find(found.way, axis).map_or(0.0, Tested::factor);
        let factors = match found.whose {
            Whose::Alike => Vector3::repeat(own(None)),
            Whose::Axis(_) | Whose::Each => Vector3::from_fn(|axis, _| own(Some(axis))),
        };
        self.decay(rests, found.way, &factors)
    }

    /// What is asked of these errors: within the intervals the slowest are slopes of any size, so that those are only asked of means that say
    /// something of them.
    fn asked(&self) -> Vec<Hypothesis> {
        let mut all = Hypothesis::all(&self.tested);
        all.retain(|own| self.tau <= SLOWEST_WITHIN.get() || own.is_in_means());
        all
    }
}

/// All errors that are tried.
pub struct Trials<'a> {
    rests: &'a [Rested<'a>],
    all: Vec<Tried>,
}

impl<'a> Trials<'a> {
    /// By the readings within the intervals; `None` where these are too few.
    pub fn within(rests: &'a [Rested<'a>]) -> Option<Self> {
        let shows = rests.iter().filter(|own| own.shows_decay());
        (shows.count() >= FEWEST.get()).then(|| Self {
            rests,
            all: TIME_CONSTANTS.map(|tau| Tried::of(rests, tau)).into(),
        })
    }

    /// The errors of a factor of one that the means of the intervals can tell from scale factors and biases.
    pub fn seen_in_means(&self) -> Vec<Decay> {
        let of = |tried: &Tried| {
            let own = tried.tested.iter().filter(|own| own.is_seen_in_means());
            let own = own.map(|own| tried.of_one(self.rests, own));
            own.collect::<Vec<_>>()
        };
        self.all.iter().flat_map(of).collect()
    }

    /// The slowest errors of each axis that come again after every turn, a factor of one each.
    pub fn slowest_alike(&self) -> Vec<(Decay, &Tested)> {
        let slowest = self.all.last().into_iter();
        let alike = slowest.flat_map(|tried| {
            let own = tried.tested.iter();
            let own = own.filter(|own| own.axis.is_some() && own.way.comes_again());
            own.map(|own| (tried.of_one(self.rests, own), own))
        });
        alike.collect()
    }

    /// The trials with what the means say of those, in their order.
    pub fn with_means(&self, evidence: &[Evidence]) -> Self {
        let mut evidence = evidence.iter().copied();
        let mut with = |own: &Tested| match own.is_seen_in_means() {
            true => own.with(evidence.next().unwrap_or_default()),
            false => *own,
        };
        let all = self.all.iter().map(|tried| Tried {
            tau: tried.tau,
            changes: tried.changes.clone(),
            tested: tried.tested.iter().map(&mut with).collect(),
        });
        Self {
            rests: self.rests,
            all: all.collect(),
        }
    }

    /// The least likely error by chance, where chance does not explain it and nothing contradicts it.
    pub fn found(&self) -> Option<Hypothesis> {
        let asked: Vec<Hypothesis> = self.all.iter().flat_map(Tried::asked).collect();
        let tests = asked.len() as f64;
        let agreeing = asked.into_iter().filter(Hypothesis::agrees);
        let p_values = agreeing.map(|own| (own.p_value(), own));
        let (p, best) = p_values.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (p * tests < LEVEL.get()).then_some(best)
    }

    /// The slowest decay of that error that nothing rules out.
    pub fn slowest(&self, found: &Hypothesis) -> Option<Decay> {
        let least = found.gain() - RULED_OUT.get();
        let mut slowest_first = self.all.iter().rev();
        let is_open = |own: &&Tried| {
            let same = own.asked().into_iter().find(|own| own.is_same(found));
            same.is_some_and(|own| own.gain() > least)
        };
        let open = slowest_first.find(is_open)?;
        Some(open.as_found(self.rests, found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Even noise between -.5 and .5 by place and seed (splitmix64).
    fn noise(place: u64, seed: u64) -> f64 {
        let mut z = (place << 32 | seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    /// An interval with z up.
    fn rested<'a>(t: &'a [f64], values: &'a [Vector3<f64>], follows_turn: bool) -> Rested<'a> {
        Rested {
            recording: 0,
            t,
            values,
            unit: 1.0,
            turned: 0.0,
            force: 9.8 * Vector3::z(),
            drift: Vector3::zeros(),
            drift_std: Vector3::zeros(),
            follows_turn,
            is_sound: true,
        }
    }

    /// Eight intervals of 6 s whose readings of x are off by `error` right after the turn, with a ripple for noise.
    fn decays(error: f64, tau: f64) -> Option<Decay> {
        let t: Vec<f64> = (0..600).map(|k| f64::from(k) * 0.01).collect();
        let values = |seed: u64| -> Vec<Vector3<f64>> {
            let of = |(k, t): (u64, &f64)| {
                let x = error * (-t / tau).exp() + 0.05 * noise(k, seed);
                let [y, z] = [1000, 2000].map(|axis| 0.05 * noise(k + axis, seed));
                Vector3::new(x, y, 9.8 + z)
            };
            (0..).zip(&t).map(of).collect()
        };
        let all: Vec<_> = (0..8).map(values).collect();
        let rests: Vec<_> = all.iter().map(|values| rested(&t, values, true)).collect();
        let trials = Trials::within(&rests)?;
        trials.slowest(&trials.found()?)
    }

    #[test]
    fn a_bias_that_fades_is_found_and_its_share_in_a_mean_is_not_stated_too_small() {
        let found = decays(0.05, 2.0).unwrap();
        assert!(found.tau >= 2.0, "{found:?}");
        let span = Span { from: 0.0, to: 6.0 };
        let off = found.at_first[3].x * found.mean_left(&span, 0.0);
        // Of .05 that fade with 2 s a mean of 6 s has .0158.
        assert!((0.014..0.15).contains(&off), "{off}: {found:?}");
    }

    #[test]
    fn before_the_first_turn_nothing_fades() {
        let (t, values) = ([0.0, 1.0], [9.8 * Vector3::z(); 2]);
        let rests = [false, true].map(|follows_turn| rested(&t, &values, follows_turn));
        let tried = Tried {
            tau: 2.0,
            changes: vec![Vector3::zeros(); 2],
            tested: Vec::new(),
        };
        let decay = tried.decay(&rests, Way::Force, &Vector3::repeat(1.0));
        assert_eq!(decay.at_first, [Vector3::zeros(), 9.8 * Vector3::z()]);
    }

    #[test]
    fn noise_alone_fades_nowhere() {
        assert_eq!(decays(0.0, 2.0), None);
    }
}
