//! Motion of a placement that should be at rest.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::path::Path;
use super::profile::Profile;
use super::segment::{Move, Twist};
use crate::random::Random;
use crate::surroundings::Unsteady;

/// Sines that tremor and sway are made of.
const SINES: usize = 3;
/// Acceleration that goes with the angular rate of a tremor, (m/s²)/(rad/s).
const SHAKE: f64 = 3.0;
/// Time in which the device comes to rest, s.
const SETTLING: f64 = 1.0;
/// Time in which a motion begins or ends within a placement, s.
const RAMP: f64 = 0.3;

/// Rotations and displacements of the next placement on `path`, of `length` seconds.
pub(super) fn unsteady(
    spec: &Unsteady,
    path: &Path,
    length: f64,
    random: &mut Random,
) -> (Vec<Twist>, Vec<Move>) {
    let (mut twists, mut moves) = (Vec::new(), Vec::new());
    if random.uniform(0.0..1.0) >= spec.share {
        return (twists, moves);
    }
    let (start, end) = (path.end(), path.end() + length);
    let ramp = RAMP.min(0.25 * length);
    if spec.yaw != 0.0 {
        let up = path.attitude().inverse() * Vector3::z();
        twists.push(Twist::new(
            up * spec.yaw,
            Profile::Constant { start, end, ramp },
        ));
    }
    if spec.settling > 0.0 {
        let angle = spec.settling * random.uniform(0.3..1.0);
        twists.push(Twist::new(
            random.direction() * angle,
            Profile::Blend {
                start,
                end: start + SETTLING.min(0.5 * length),
            },
        ));
    }
    let mut sine = |[low, high]: [f64; 2]| {
        let (frequency, phase) = (random.uniform(low..high), random.uniform(0.0..TAU));
        let profile = Profile::Sway {
            start,
            end,
            ramp,
            frequency,
            phase,
        };
        (profile, TAU * frequency, random.direction())
    };
    // Sines of amplitude A have a mean square of A²/2.
    let amplitude = (2.0 / SINES as f64).sqrt();
    for _ in 0..if spec.tremor > 0.0 { SINES } else { 0 } {
        let (profile, rate, direction) = sine([6.0, 12.0]);
        let angle = amplitude * spec.tremor / rate;
        twists.push(Twist::new(direction * angle, profile));
        moves.push(Move::new(direction.yzx() * (angle * SHAKE / rate), profile));
    }
    for _ in 0..if spec.sway > 0.0 { SINES } else { 0 } {
        let (profile, _, direction) = sine([0.1, 0.5]);
        twists.push(Twist::new(direction * (amplitude * spec.sway), profile));
    }
    (twists, moves)
}

#[cfg(test)]
mod tests {
    use crate::{Simulation, Spec, Unsteady};

    fn rates(unsteady: Unsteady) -> Vec<nalgebra::Vector3<f64>> {
        let spec = Spec {
            unsteady: Some(unsteady),
            ..Spec::still(5, 100.0)
        };
        let simulation = Simulation::new(&spec).unwrap();
        let at = |k: i32| simulation.world().motion.at(f64::from(k) * 0.01);
        (0..10_000).map(|k| at(k).rate).collect()
    }

    #[test]
    fn a_tremor_has_the_rate_that_was_asked_for() {
        let rates = rates(Unsteady {
            tremor: 0.05,
            ..Unsteady::default()
        });
        let square: f64 = rates.iter().map(|r| r.norm_squared()).sum::<f64>() / 1e4;
        // Two frequencies may be close and beat; the mean over 100 s still comes within a tenth.
        assert!(
            (square.sqrt() / 0.05 - 1.0).abs() < 0.1,
            "{}",
            square.sqrt()
        );
    }

    #[test]
    fn a_constant_yaw_turns_about_the_vertical_by_rate_times_time() {
        let spec = Spec {
            unsteady: Some(Unsteady {
                yaw: 0.01,
                ..Unsteady::default()
            }),
            ..Spec::still(5, 100.0)
        };
        let simulation = Simulation::new(&spec).unwrap();
        let at = |t: f64| simulation.world().motion.at(t);
        assert!((at(50.0).rate - nalgebra::Vector3::z() * 0.01).norm() < 1e-15);
        let turned = at(100.0).attitude.angle_to(&at(0.0).attitude);
        // 0.3 s at both ends in which the rate rises and falls.
        assert!((turned - 0.01 * 99.7).abs() < 1e-9, "{turned}");
    }

    #[test]
    fn settling_is_over_after_a_second() {
        let rates = rates(Unsteady {
            settling: 0.01,
            ..Unsteady::default()
        });
        assert!(rates[50].norm() > 3e-3);
        assert!(rates[101..].iter().all(|r| r.norm() == 0.0));
        let angle = rates.iter().map(|r| r.norm()).sum::<f64>() * 0.01;
        assert!((0.003..0.0101).contains(&angle), "{angle}");
    }
}
