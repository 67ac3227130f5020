//! Errors that fade after turns, from the readings within static intervals.

use nalgebra::Vector3;
use recording::intervals::Span;

use super::rested::{Rested, changes};
use super::way::Way;
use crate::methods::small_sample::two_sided;

/// Time constants tried, s.
const TIME_CONSTANTS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];

/// Chance makes readings fade so in fewer recordings than this, over all that is tried.
const LEVEL: f64 = 1e-3;

/// A time constant is not ruled out where its log-likelihood is within this of the best (a 95 % interval).
const RULED_OUT: f64 = 2.0;

/// Static intervals of which the scatter tells what chance does.
const FEWEST: usize = 6;

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

/// A factor of an error, tested.
#[derive(Clone, Copy, Debug)]
struct Tested {
    way: Way,
    /// The axis that has it; `None` of all axes alike.
    axis: Option<usize>,
    factor: f64,
    /// Log-likelihood over none.
    gain: f64,
    /// Probability of so much by chance, in this one test.
    p_value: f64,
}

impl Tested {
    /// The weighted mean of the factors `(factor, weight)` by the intervals, against their own scatter (Student 1908): whatever the noise is
    /// within an interval, that of others is independent.
    fn of(way: Way, axis: Option<usize>, factors: &[(f64, f64)]) -> Option<Self> {
        let spare = factors.len().checked_sub(1)? as f64;
        let weight: f64 = factors.iter().map(|(_, w)| w).sum();
        let factor = factors.iter().map(|(f, w)| f * w).sum::<f64>() / weight;
        let scatter = factors.iter().map(|(f, w)| w * (f - factor).powi(2));
        let variance = scatter.sum::<f64>() / spare / weight;
        let square = factor * factor / variance;
        square.is_finite().then(|| Self {
            way,
            axis,
            factor,
            gain: 0.5 * (spare + 1.0) * (square / spare).ln_1p(),
            p_value: two_sided(square.sqrt(), spare),
        })
    }
}

/// The factor of an error that one interval shows, and its weight; `None` where the error would be nothing there.
fn factor((error, weight): &(Vector3<f64>, f64), along: Vector3<f64>) -> Option<(f64, f64)> {
    let square = along.norm_squared();
    (weight * square > 0.0).then(|| (along.dot(error) / square, weight * square))
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
        let sound = rests.iter().zip(&changes).filter(|(own, _)| own.is_sound);
        let seen: Vec<_> = sound
            .map(|(own, change)| (own, change, own.at_first(tau)))
            .collect();
        let mut tested = Vec::new();
        for way in Way::ALL {
            let alike = way.may_be_alike().then_some(None);
            for axis in (0..3).map(Some).chain(alike) {
                let factors = seen.iter().filter_map(|(own, change, at_first)| {
                    let along = way.of(&own.force, change);
                    factor(at_first, axis.map_or(along, |k| Vector3::ith(k, along[k])))
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

    /// The gain of an error of this way, of this axis or of all alike.
    fn gain(&self, of: &Tested) -> f64 {
        let mut own = self.tested.iter();
        let found = own.find(|own| own.way == of.way && own.axis == of.axis);
        found.map_or(0.0, |found| found.gain)
    }

    /// The error: where one axis shows it alone, each has a factor of its own.
    fn decay(&self, rests: &[Rested<'_>], found: &Tested) -> Decay {
        let own = |axis: Option<usize>| {
            let mut own = self.tested.iter();
            let own = own.find(|own| own.way == found.way && own.axis == axis);
            own.map_or(0.0, |own| own.factor)
        };
        let factors = match found.axis {
            None => Vector3::repeat(own(None)),
            Some(_) => Vector3::from_fn(|axis, _| own(Some(axis))),
        };
        let each = rests.iter().zip(&self.changes);
        let at_first = each.map(|(rest, change)| {
            let along = found.way.of(&rest.force, change);
            along.component_mul(&factors)
        });
        Decay {
            tau: self.tau,
            at_first: at_first.collect(),
        }
    }
}

/// The slowest decay of the likeliest way that the readings do not rule out, where chance does not explain them.
pub fn slowest(rests: &[Rested<'_>]) -> Option<Decay> {
    if rests.iter().filter(|own| own.is_sound).count() < FEWEST {
        return None;
    }
    let all = TIME_CONSTANTS.map(|tau| Tried::of(rests, tau));
    let tests: usize = all.iter().map(|own| own.tested.len()).sum();
    let tested = all.iter().flat_map(|own| &own.tested);
    let best = tested.max_by(|a, b| a.gain.total_cmp(&b.gain))?;
    if best.p_value * tests as f64 >= LEVEL {
        return None;
    }
    let mut slowest_first = all.iter().rev();
    let open = slowest_first.find(|own| own.gain(best) > best.gain - RULED_OUT)?;
    Some(open.decay(rests, best))
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
        let rest = |values| Rested {
            recording: 0,
            t: &t,
            values,
            unit: 1.0,
            turned: 0.0,
            force: Vector3::new(0.0, 0.0, 9.8),
            drift: Vector3::zeros(),
            is_sound: true,
        };
        let rests: Vec<_> = all.iter().map(|values| rest(values)).collect();
        slowest(&rests)
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
    fn noise_alone_fades_nowhere() {
        assert_eq!(decays(0.0, 2.0), None);
    }
}
