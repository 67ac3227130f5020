//! Accelerometer stamps that are late: only the moving accelerometer shows them.

use estimate::methods::chance;
use estimate::methods::joint::TurnSensitivity;
use nalgebra::{Matrix4, Vector3, Vector4};
use sensor::Kinematics;

use crate::state::State;

findings::tuning! {
    /// Turns that a verdict needs beyond the four coefficients.
    SPARE_TURNS: usize = 6;

    /// Steps of Gauss and Newton at most.
    STEPS: usize = 10;
    /// The last of them moves the delay by less than this share of its standard error.
    SETTLED: f64 = 0.01;
}

/// Time offset of the stamps, estimated from the accelerometer during motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// Stamps are late by this, s.
    pub delay: f64,
    /// Standard error, s.
    pub std: f64,
    /// `t²` of the estimate that is linear about punctual stamps.
    pub statistic: f64,
    /// `ln p`, two-sided.
    pub log_p: f64,
    /// Root mean square of what the turns say of a delay, each by itself, over its scatter about the common one: 1 of punctual
    /// stamps, the four coefficients counted.
    pub gap_before: f64,
    /// The ratio for turns that the estimate did not see.
    pub held_out_gap_before: f64,
    /// With the delay of the other turns.
    pub held_out_gap_after: f64,
}

/// Normal equations of one turn.
#[derive(Clone, Copy, Debug)]
struct Turn {
    a: Matrix4<f64>,
    b: Vector4<f64>,
}

/// Estimates the delay `d` from the turns: what the accelerometer reads is of the motion `d` ago,
///
/// `f(t) = [g u + α × r + ω × (ω × r) + hand](t − d)`, `∂(g u)/∂d = −g (u × ω)`,
///
/// `u` the direction of gravity that the gyroscope carries, `r` the arm from the centre of the rotation to the
/// accelerometer, `hand` its translation: it is no white noise, but independent from turn to turn, so
/// that the covariance is that of clusters (Liang & Zeger 1986), with `t` of as many degrees of freedom as there
/// are turns less the four coefficients.
///
/// `None` with too few turns.
pub fn delay(state: &State) -> Option<Delay> {
    of_turns(state, |_| true)
}

/// The delay of every recording by its own turns, where there are several.
pub fn delays(state: &State) -> Vec<(usize, Delay)> {
    let count = state.fit.data.sources.len();
    let recordings = if count > 1 { 0..count } else { 0..0 };
    let of = |recording| Some((recording, of_turns(state, |own| own == recording)?));
    recordings.filter_map(of).collect()
}

/// The delay by the turns of the recordings that are wanted.
fn of_turns(state: &State, is_wanted: impl Fn(usize) -> bool) -> Option<Delay> {
    let found = by_equations(&equations(state, &is_wanted, 0.0))?;
    let steps = std::iter::successors(Some((found, f64::INFINITY)), |(last, _)| {
        let next = by_equations(&equations(state, &is_wanted, last.delay))?;
        Some((next, (next.delay - last.delay).abs()))
    });
    let mut steps = steps.take(STEPS.get());
    let settled = steps.find(|(found, step)| *step < SETTLED.get() * found.std);
    let settled = settled.map_or(found, |(settled, _)| settled);
    // The test is of stamps that are punctual: it is linear about those.
    Some(Delay {
        statistic: found.statistic,
        log_p: found.log_p,
        ..settled
    })
}

/// Normal equations of the turns that are wanted, linear about the delay `late`.
fn equations(state: &State, is_wanted: &impl Fn(usize) -> bool, late: f64) -> Vec<Turn> {
    let gravity = state.fit.gravity;
    let all = state.sensitivities.turns.iter();
    all.filter(|turn| is_wanted(state.fit.data.turns[turn.turn].recording))
        .map(|turn| {
            let mut sums = Turn {
                a: Matrix4::zeros(),
                b: Vector4::zeros(),
            };
            for (t, truth) in turn.t.iter().zip(&turn.truth) {
                let Motion {
                    u,
                    rate,
                    acceleration,
                } = Motion::at(turn, t - late);
                let g = u * gravity;
                let by_delay = -g.cross(&rate);
                let cross = rate.cross_matrix();
                let arm = acceleration.cross_matrix() + cross * cross;
                let y = truth.specific_force - g + by_delay * late;
                for i in 0..3 {
                    let x = Vector4::new(by_delay[i], arm[(i, 0)], arm[(i, 1)], arm[(i, 2)]);
                    sums.a += x * x.transpose();
                    sums.b += x * y[i];
                }
            }
            sums
        })
        .collect()
}

/// The motion at an instant of a turn.
struct Motion {
    /// Up, in the body's frame.
    u: Vector3<f64>,
    /// Angular rate, rad/s.
    rate: Vector3<f64>,
    /// Angular acceleration, rad/s².
    acceleration: Vector3<f64>,
}

impl Motion {
    /// Linear between the samples; before the first and after the last as there.
    fn at(turn: &TurnSensitivity, t: f64) -> Self {
        let next = turn.t.partition_point(|other| *other < t);
        let (i, j) = (next.saturating_sub(1), next.min(turn.t.len() - 1));
        let length = turn.t[j] - turn.t[i];
        let share = if length > 0.0 {
            (t - turn.t[i]) / length
        } else {
            0.0
        };
        let (a, b) = (&turn.truth[i], &turn.truth[j]);
        let up = |of: &Kinematics<f64>| of.attitude.into_body(&Vector3::z());
        Self {
            u: up(a).lerp(&up(b), share),
            rate: a.angular_rate.lerp(&b.angular_rate, share),
            acceleration: a.angular_acceleration.lerp(&b.angular_acceleration, share),
        }
    }
}

fn by_equations(turns: &[Turn]) -> Option<Delay> {
    if turns.len() < 4 + SPARE_TURNS.get() {
        return None;
    }
    let count = turns.len() as f64;
    let a: Matrix4<f64> = turns.iter().map(|t| t.a).sum();
    let b: Vector4<f64> = turns.iter().map(|t| t.b).sum();
    let inverse = a.try_inverse()?;
    let estimate = inverse * b;
    let scores = turns.iter().map(|t| t.b - t.a * estimate);
    let meat: Matrix4<f64> = scores.map(|s| s * s.transpose()).sum();
    let covariance = inverse * meat * inverse * (count / (count - 4.0));
    let std = covariance[(0, 0)].sqrt();
    let t = estimate[0] / std;
    let p = chance::of_t(t, count - 4.0);
    // What a turn says of the delay alone, the arm taken out of it: the hand's translation is in all else that it reads.
    let arm = a.fixed_view::<3, 3>(1, 1).try_inverse()? * a.fixed_view::<3, 1>(1, 0);
    let own = Vector4::new(1.0, -arm[0], -arm[1], -arm[2]);
    let square = |t: &Turn, x: &Vector4<f64>| own.dot(&(t.b - t.a * x)).powi(2);
    let without = |a: &Matrix4<f64>, b: &Vector4<f64>| {
        let arm = a.fixed_view::<3, 3>(1, 1).try_inverse()? * b.fixed_rows::<3>(1);
        Some(Vector4::new(0.0, arm[0], arm[1], arm[2]))
    };
    let all = |x: &Vector4<f64>| turns.iter().map(|t| square(t, x)).sum::<f64>();
    let after = all(&estimate) / (count - 4.0);
    let mut held = [0.0; 2];
    for turn in turns {
        let (a, b) = (a - turn.a, b - turn.b);
        held[0] += square(turn, &without(&a, &b)?);
        held[1] += square(turn, &(a.try_inverse()? * b));
    }
    Some(Delay {
        delay: estimate[0],
        std,
        statistic: t * t,
        log_p: p.max(f64::MIN_POSITIVE).ln(),
        gap_before: (all(&without(&a, &b)?) / (count - 3.0) / after).sqrt(),
        held_out_gap_before: (held[0] / count / after).sqrt(),
        held_out_gap_after: (held[1] / count / after).sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use simulate::Spec;

    use super::*;
    use crate::{Extension, Request, Session};

    fn found(late: f64) -> Delay {
        let mut spec = Spec::hand_held(21);
        if late > 0.0 {
            let given = std::collections::BTreeMap::from([("d".to_owned(), late)]);
            spec.effects.insert("time_offset".into(), given);
        }
        let recordings = [spec.run().unwrap().recording];
        let session = Session::new(&recordings, &Request::new(spec.gravity)).unwrap();
        delay(&State::fit(&session, Extension::default()).unwrap()).unwrap()
    }

    #[test]
    fn late_stamps_are_measured_and_punctual_ones_are_not_late() {
        let late = found(8e-3);
        assert!((late.delay - 8e-3).abs() < 4.0 * late.std, "{late:?}");
        assert!(late.log_p < -9.0, "{late:?}");
        // Turns that were not looked at are predicted by the others: by what is left of the gap.
        assert!(
            late.gap_before > 2.0 && late.held_out_gap_after < 1.5,
            "{late:?}"
        );
        let very_late = found(0.2);
        assert!(
            (very_late.delay - 0.2).abs() < 4.0 * very_late.std,
            "{very_late:?}"
        );
        let punctual = found(0.0);
        assert!(punctual.delay.abs() < 4.0 * punctual.std, "{punctual:?}");
        assert!(punctual.log_p > -7.0, "{punctual:?}");
    }
}
