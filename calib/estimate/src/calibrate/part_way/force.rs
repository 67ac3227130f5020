//! An accelerometer that is another one from some static interval on: `‖T (A' − b)‖ = g`, `A'` the reading with a
//! change taken off from there on.

use nalgebra::{Matrix3, Vector3};
use recording::averages::median;
use recording::intervals::{Moments, Span, StaticInterval};

use super::change::{Change, Place};
use super::hypothesis::{CHANGES, Hypothesis, OWN, What};
use super::sure::{BASE, Sure};
use super::weigh::{Explanation, solved_in_place};
use crate::methods::{RawUnit, accelerometer_unit};

/// Most parameters of both.
const ALL: usize = BASE + OWN;

findings::tuning! {
    /// Fewest static intervals on either side.
    SIDE: usize = 3;
    /// Most static intervals that are looked at.
    MOST: usize = 200;
    /// Most places that are tried.
    PLACES: usize = 48;

    /// A sum of squares below so many times that of the measured noise asks for no explanation.
    NOISE: f64 = 9.0;

    /// Signs and columns leave so much of the base's sum of squares.
    CLEAR: f64 = 1e-2;

    /// Places whose criteria differ by less than this are not told apart.
    INDIFFERENT: f64 = 10.0;

    /// Turned axes explain the rows so much better, by the criterion, than biases that step or drift: about a bias, the norm alone hardly
    /// tells a rotation from them. Six is strong evidence (Kass and Raftery, Bayes Factors, 1995, section 3.2).
    MUCH: f64 = 6.0;

    /// Steps of a fit.
    STEPS: usize = 30;
}

/// The accelerometer by its static intervals.
#[derive(Clone, Debug)]
pub(super) struct Force {
    /// The change, where there is one.
    pub change: Option<Change>,
    /// Directions of specific force, by static interval; none where the intervals do not determine it.
    pub directions: Vec<Option<Vector3<f64>>>,
}

/// Fits the base and looks for a change; `None` of too few intervals.
pub(super) fn force(rests: &[StaticInterval], gravity: f64) -> Option<Force> {
    let means = rests.iter().enumerate();
    let means = means.filter_map(|(place, rest)| Some((place, rest.span, rest.accelerometer?)));
    let stride = means.clone().count().div_ceil(MOST.get()).max(1);
    let used: Vec<(usize, Span, Moments)> = means.step_by(stride).collect();
    let raw: Vec<Vector3<f64>> = used.iter().map(|(.., force)| force.mean).collect();
    if raw.len() < BASE + 3 {
        return None;
    }
    let unit = unit_of(&raw, gravity)?;
    let raw: Vec<Vector3<f64>> = raw.iter().map(|v| unit.to_si(v)).collect();
    let nothing = Hypothesis {
        what: What::Nothing,
        at: raw.len(),
        mixed: false,
    };
    let base = Fit::of(&raw, gravity, nothing)?;
    let white = median(used.iter().map(|(.., force)| force.white_of_mean()))?;
    let floor = raw.len() as f64 * (unit.scale * white).powi(2).max(f64::MIN_POSITIVE);
    let found = if base.left > NOISE.get() * floor {
        best(&raw, gravity, &base, floor)
    } else {
        None
    };
    let change = found.as_ref().and_then(|fit| {
        let kind = fit.hypothesis.what.kind(&fit.p[BASE..])?;
        let (first, last) = as_good(fit, &raw, gravity, floor);
        let (after, before) = (used[first - 1], used[last.min(used.len() - 1)]);
        Some(Change {
            kind,
            place: Place {
                after: (after.0, after.1.to),
                before: (before.0, before.1.from),
            },
        })
    });
    let fit = found.unwrap_or(base);
    let from = used
        .get(fit.hypothesis.at)
        .map_or(usize::MAX, |(place, ..)| *place);
    let sure = Sure::of(fit.rows(&raw, gravity).map(|(_, slope)| slope));
    let noise = unit.scale * white;
    let direction = |(place, rest): (usize, &StaticInterval)| {
        let passed = passed(place, rests.len());
        let force = unit.to_si(&rest.accelerometer?.mean);
        let force = fit.corrected(&force, passed, place >= from);
        let is_sure = sure.knows(&fit.base().0, &force, noise);
        Some(force.normalize()).filter(|u| is_sure && u.norm().is_finite())
    };
    Some(Force {
        change,
        directions: rests.iter().enumerate().map(direction).collect(),
    })
}

/// Returns the unit that brings the readings near SI units.
///
/// It keeps zero where it is, so that a change of sign is one, unless zero is farther from the readings than gravity
/// (counts around 32768), where no fit from there converges.
fn unit_of(raw: &[Vector3<f64>], gravity: f64) -> Option<RawUnit> {
    let about_zero = RawUnit {
        scale: gravity / median(raw.iter().map(Vector3::norm))?,
        zero: Vector3::zeros(),
    };
    let unit = accelerometer_unit(raw, gravity)
        .filter(|unit| unit.zero.norm() * unit.scale > gravity)
        .unwrap_or(about_zero);
    unit.scale.is_finite().then_some(unit)
}

/// The explanation that leaves least, if it is one.
fn best(raw: &[Vector3<f64>], gravity: f64, base: &Fit, floor: f64) -> Option<Fit> {
    let n = raw.len();
    let places = SIDE.get()..=n.checked_sub(SIDE.get())?;
    let stride = (n / PLACES.get()).max(1);
    let mut hypotheses = Vec::new();
    for at in places.step_by(stride) {
        for mixed in [false, true] {
            if at + usize::from(mixed) + SIDE.get() <= n {
                hypotheses.extend(CHANGES.map(|what| Hypothesis { what, at, mixed }));
            }
        }
    }
    let tried = hypotheses.len();
    let fits = hypotheses
        .into_iter()
        .filter_map(|hypothesis| Fit::of(raw, gravity, hypothesis));
    let criterion = |fit: &Fit| fit.explanation().criterion(n, floor);
    let best = fits.min_by(|a, b| criterion(a).total_cmp(&criterion(b)))?;
    let best = match best.hypothesis.what {
        What::Turned => or_rival(best, raw, gravity, floor),
        _ => best,
    };
    // Against the base without a mixed row: that one interval disagrees is no change of the others.
    let (base, lost) = if best.hypothesis.mixed {
        let what = What::Nothing;
        let without = Hypothesis {
            what,
            ..best.hypothesis
        };
        (Fit::of(raw, gravity, without)?.left, 1)
    } else {
        (base.left, 0)
    };
    let own = Explanation {
        left: best.left,
        parameters: best.hypothesis.what.parameters(),
    };
    // Without a parameter of its own it is no more likely by chance, but there are many of them.
    let clear = own.parameters > 0 || own.left < CLEAR.get() * base;
    (clear && own.holds(base, n - BASE - lost, tried)).then_some(best)
}

/// Turned axes, or the biases that step or drift where these explain the rows about as well or better.
fn or_rival(turned: Fit, raw: &[Vector3<f64>], gravity: f64, floor: f64) -> Fit {
    let n = raw.len();
    let places = (SIDE.get()..n).flat_map(|at| [false, true].map(|mixed| (at, mixed)));
    let steps = places.filter(|&(at, mixed)| at + usize::from(mixed) + SIDE.get() <= n);
    let drift = Hypothesis {
        what: What::Drift,
        at: 0,
        mixed: false,
    };
    let rivals = steps
        .map(|(at, mixed)| Hypothesis {
            what: What::Biases,
            at,
            mixed,
        })
        .chain([drift]);
    let criterion = |fit: &Fit| fit.explanation().criterion(n, floor);
    let fits = rivals.filter_map(|rival| Fit::of(raw, gravity, rival));
    let best = fits.min_by(|a, b| criterion(a).total_cmp(&criterion(b)));
    let limit = criterion(&turned) + MUCH.get();
    best.filter(|rival| criterion(rival) < limit)
        .unwrap_or(turned)
}

/// The share of the static intervals before one.
fn passed(place: usize, count: usize) -> f64 {
    place as f64 / count.saturating_sub(1).max(1) as f64
}

/// The first and the last row from which on the same change is about as good: where it lies is not known better.
fn as_good(best: &Fit, raw: &[Vector3<f64>], gravity: f64, floor: f64) -> (usize, usize) {
    let Hypothesis { what, at, mixed } = best.hypothesis;
    let limit = best.explanation().criterion(raw.len(), floor) + INDIFFERENT.get();
    let good = |at: &usize| {
        let moved = Hypothesis {
            what,
            at: *at,
            mixed: false,
        };
        Fit::of(raw, gravity, moved)
            .is_some_and(|fit| fit.explanation().criterion(raw.len(), floor) < limit)
    };
    let before = (SIDE.get()..at).rev().take_while(good).last();
    let after = (at + 1..=raw.len() - SIDE.get()).take_while(good).last();
    let own = at + usize::from(mixed);
    (before.unwrap_or(at), after.unwrap_or(own).max(own))
}

/// A fit of the base and a change.
#[derive(Clone, Debug)]
struct Fit {
    hypothesis: Hypothesis,
    p: Vec<f64>,
    left: f64,
}

impl Fit {
    fn of(raw: &[Vector3<f64>], gravity: f64, hypothesis: Hypothesis) -> Option<Self> {
        let m = BASE + hypothesis.what.parameters();
        let mut p = vec![0.0; m];
        [p[0], p[3], p[5]] = [1.0; 3];
        let mut fit = Self {
            hypothesis,
            p,
            left: f64::INFINITY,
        };
        fit.left = fit.rows(raw, gravity).map(|(r, _)| r * r).sum();
        let mut damping = 1e-3;
        for _ in 0..STEPS.get() {
            let mut normal = [[0.0; ALL]; ALL];
            let mut right = [0.0; ALL];
            for (r, slope) in fit.rows(raw, gravity) {
                for i in 0..m {
                    right[i] -= r * slope[i];
                    for k in 0..=i {
                        normal[i][k] += slope[i] * slope[k];
                    }
                }
            }
            let step = solved_in_place(normal, right, m, damping)?;
            let mut next = fit.clone();
            next.p
                .iter_mut()
                .zip(step.iter())
                .for_each(|(p, s)| *p += s);
            next.left = next.rows(raw, gravity).map(|(r, _)| r * r).sum();
            if next.left < fit.left {
                let done = next.left > (1.0 - 1e-9) * fit.left;
                fit = next;
                damping *= 0.1;
                if done {
                    break;
                }
            } else {
                damping = (damping * 10.0).max(1e-9);
                if damping > 1e6 {
                    break;
                }
            }
        }
        fit.left.is_finite().then_some(fit)
    }

    fn explanation(&self) -> Explanation {
        Explanation {
            left: self.left,
            parameters: self.hypothesis.what.parameters() + usize::from(self.hypothesis.mixed),
        }
    }

    fn base(&self) -> (Matrix3<f64>, Vector3<f64>) {
        let p = &self.p;
        let t = Matrix3::new(p[0], p[1], p[2], 0.0, p[3], p[4], 0.0, 0.0, p[5]);
        (t, Vector3::new(p[6], p[7], p[8]))
    }

    fn corrected(&self, raw: &Vector3<f64>, passed: f64, changed: bool) -> Vector3<f64> {
        let (t, bias) = self.base();
        let raw = if changed {
            let p = &self.p[BASE..];
            self.hypothesis.what.undone(raw, passed, p).0
        } else {
            *raw
        };
        t * (raw - bias)
    }

    /// Residuals of the norm and their derivatives.
    fn rows<'a>(
        &'a self,
        raw: &'a [Vector3<f64>],
        gravity: f64,
    ) -> impl Iterator<Item = (f64, [f64; ALL])> + 'a {
        let Hypothesis { what, at, mixed } = self.hypothesis;
        let (t, bias) = self.base();
        let n = raw.len();
        let rows = raw.iter().enumerate();
        rows.filter(move |(k, _)| !(mixed && *k == at))
            .map(move |(k, raw)| {
                let (raw, extra) = if k >= at {
                    what.undone(raw, passed(k, n), &self.p[BASE..])
                } else {
                    (*raw, [Vector3::zeros(); OWN])
                };
                let d = raw - bias;
                let y = t * d;
                let u = y / y.norm().max(f64::MIN_POSITIVE);
                let of_bias = -(t.transpose() * u);
                let [first, second, third] = extra.map(|e| u.dot(&(t * e)));
                let slope = [
                    u.x * d.x,
                    u.x * d.y,
                    u.x * d.z,
                    u.y * d.y,
                    u.y * d.z,
                    u.z * d.z,
                    of_bias.x,
                    of_bias.y,
                    of_bias.z,
                    first,
                    second,
                    third,
                ];
                (y.norm() - gravity, slope)
            })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    #[test]
    fn counts_about_a_far_zero_begin_there_and_a_small_bias_stays() {
        let faces = [Vector3::x(), Vector3::y(), Vector3::z()];
        let means = |zero: Vector3<f64>, size: f64| -> Vec<Vector3<f64>> {
            let both = faces.iter().flat_map(|f| [*f, -f]);
            both.map(|f| zero + f * size).collect()
        };
        let far = Vector3::new(32768.0, 33000.0, 31000.0);
        let found = unit_of(&means(far, 4096.0), 9.8).unwrap();
        assert!((found.zero - far).norm() < 1e-6);
        assert!((found.scale - 9.8 / 4096.0).abs() < 1e-9);
        let near = unit_of(&means(Vector3::new(20.0, -30.0, 10.0), 1000.0), 9.8).unwrap();
        assert_eq!(near.zero, Vector3::zeros());
    }

    #[test]
    fn the_base_fits_counts_about_a_far_zero_as_well_as_readings_about_none() {
        let bias = Vector3::new(0.1, -0.2, 0.05);
        let about = |zero: Vector3<f64>, unit: f64| -> Vec<Vector3<f64>> {
            let at = |k: usize| Rotation3::from_euler_angles(0.7 * k as f64, 1.3 * k as f64, 0.0);
            let forces = (0..24).map(|k| at(k) * Vector3::new(0.0, 0.0, 9.8) + bias);
            forces.map(|f| zero + f / unit).collect()
        };
        let left = |raw: &[Vector3<f64>]| {
            let unit = unit_of(raw, 9.8).unwrap();
            let raw: Vec<Vector3<f64>> = raw.iter().map(|v| unit.to_si(v)).collect();
            let nothing = Hypothesis {
                what: What::Nothing,
                at: raw.len(),
                mixed: false,
            };
            Fit::of(&raw, 9.8, nothing).unwrap().left
        };
        let counts = about(Vector3::new(32768.0, 32700.0, 32800.0), 1.2e-3);
        assert!(left(&counts) < 1e-9, "{}", left(&counts));
        assert!(left(&about(Vector3::zeros(), 1.0)) < 1e-9);
    }

    /// Means of static intervals about a bias, in 24 attitudes, with a change.
    fn changed(change: impl Fn(usize, Vector3<f64>) -> Vector3<f64>) -> Vec<Vector3<f64>> {
        let bias = Vector3::new(0.1, -0.2, 0.15);
        let at = |k: usize| Rotation3::from_euler_angles(0.7 * k as f64, 1.3 * k as f64, 0.0);
        let noise = |k: usize| {
            let wave = |m: f64| (78.233 * m * (k + 1) as f64).sin();
            NOISE_OF_MEAN * Vector3::new(wave(1.0), wave(1.7), wave(2.9))
        };
        let scale = Vector3::new(1.01, 0.99, 1.02);
        let mean = |k: usize| {
            let force = at(k) * Vector3::new(0.0, 0.0, 9.8);
            change(k, force.component_mul(&scale) + bias) + noise(k)
        };
        (0..24).map(mean).collect()
    }

    const NOISE_OF_MEAN: f64 = 3e-4;

    fn fit(raw: &[Vector3<f64>], what: What, at: usize) -> Fit {
        let mixed = false;
        Fit::of(raw, 9.8, Hypothesis { what, at, mixed }).unwrap()
    }

    #[test]
    fn axes_that_turn_are_told_from_biases_that_step_or_drift() {
        let floor = 24.0 * NOISE_OF_MEAN.powi(2);
        let told = |raw: &[Vector3<f64>]| {
            let turned = fit(raw, What::Turned, 12);
            or_rival(turned, raw, 9.8, floor).hypothesis.what
        };
        let turned = changed(|k, raw| match k < 12 {
            true => raw,
            false => Rotation3::from_euler_angles(0.0, 0.1, 0.05) * raw,
        });
        assert_eq!(told(&turned), What::Turned);
        let base = fit(&turned, What::Nothing, 24);
        let found = best(&turned, 9.8, &base, floor).unwrap();
        assert_eq!(found.hypothesis.what, What::Turned);
        let step = Vector3::new(0.02, -0.015, 0.03);
        let stepped = changed(|k, raw| if k < 12 { raw } else { raw + step });
        assert_eq!(told(&stepped), What::Biases);
        let drifting = changed(|k, raw| raw + step * (k as f64 / 12.0));
        assert_eq!(told(&drifting), What::Drift);
    }
}
