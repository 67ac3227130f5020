//! A turn by hand from one placement to the next.

use nalgebra::{UnitQuaternion, Vector3};

use super::path::Path;
use super::profile::Profile;
use super::segment::{Move, Twist};
use crate::random::Random;

/// Acceleration of a tremor of size 1, m/s².
const TREMOR_ACCELERATION: f64 = 0.3;
/// Angular rate of a tremor of size 1, rad/s.
const TREMOR_RATE: f64 = 0.1;
/// Time constant of a table contact, s: the knock lasts 20 ms to the eye and is over after 0.4 s.
const KNOCK_DECAY: f64 = 0.008;
/// A knock leaves this share of its acceleration (m/s²) as angular acceleration (rad/s²).
const KNOCK_SPIN: f64 = 2.0;

/// Properties of a hand that turns the device.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hand {
    /// Height by which it lifts the device, m.
    pub lift: f64,
    /// Tremor: 1 is 0.3 m/s² and 0.1 rad/s at 6 to 10 Hz.
    pub tremor: f64,
    /// Peak acceleration when the device touches the table, m/s²; 0 for none.
    pub shock: f64,
    /// Short knocks in each turn.
    pub knocks: usize,
    /// Peak angular rate of a knock, rad/s.
    pub knock_rate: f64,
}

/// Appends a turn of `length` seconds that ends in `target`.
///
/// Two rotations overlap in time, so that the axis changes all the way; the hand lifts the device,
/// carries it sideways and trembles.
pub(crate) fn turn_to(
    path: &mut Path,
    target: &UnitQuaternion<f64>,
    length: f64,
    hand: &Hand,
    random: &mut Random,
    [shocks, knocks]: [&mut Random; 2],
) {
    let (start, end) = (path.end(), path.end() + length);
    let mut twists = two_rotations(&(path.attitude().inverse() * target), start, end, random);
    let mut moves = hand_moves(hand, (start, end), random, &mut twists);
    if hand.shock > 0.0 {
        knock(hand.shock, end, shocks, &mut twists, &mut moves);
    }
    for k in 0..hand.knocks {
        let last = k + 1 == hand.knocks;
        twists.push(quick_knock(hand.knock_rate, start, end, last, knocks));
    }
    path.movement(length, twists, moves);
}

/// Adds what a hand adds to rotations between two times, s: it lifts, carries sideways and trembles. Returns the displacements.
pub(crate) fn hand_moves(
    hand: &Hand,
    (start, end): (f64, f64),
    random: &mut Random,
    twists: &mut Vec<Twist>,
) -> Vec<Move> {
    let mut moves = carry(hand.lift, start, end, random);
    if hand.tremor > 0.0 {
        tremble(hand.tremor, start, end, random, twists, &mut moves);
    }
    moves
}

/// `exp(r₁) exp(r₂) = turn` with `r₁` about half of it, off its axis.
fn two_rotations(
    turn: &UnitQuaternion<f64>,
    start: f64,
    end: f64,
    random: &mut Random,
) -> Vec<Twist> {
    let whole = turn.scaled_axis();
    let aside = random.normal3() * (0.2 * whole.norm());
    let first = whole * random.uniform(0.4..0.6) + aside;
    let second = (UnitQuaternion::from_scaled_axis(-first) * turn).scaled_axis();
    let length = end - start;
    let middle = (start + 0.3 * length, start + 0.7 * length);
    vec![
        Twist::new(
            first,
            Profile::Blend {
                start,
                end: middle.1,
            },
        ),
        Twist::new(
            second,
            Profile::Blend {
                start: middle.0,
                end,
            },
        ),
    ]
}

fn carry(lift: f64, start: f64, end: f64, random: &mut Random) -> Vec<Move> {
    let up = Vector3::z() * (lift * random.uniform(0.5..1.5));
    let aside = Vector3::new(random.normal(), random.normal(), 0.0) * lift;
    vec![
        Move::new(up, Profile::Bump { start, end }),
        Move::new(aside, Profile::Blend { start, end }),
    ]
}

fn tremble(
    size: f64,
    start: f64,
    end: f64,
    random: &mut Random,
    twists: &mut Vec<Twist>,
    moves: &mut Vec<Move>,
) {
    for _ in 0..2 {
        let frequency = random.uniform(6.0..10.0);
        let phase = random.uniform(0.0..std::f64::consts::TAU);
        let profile = Profile::Tremor {
            start,
            end,
            frequency,
            phase,
        };
        let rate = std::f64::consts::TAU * frequency;
        let rotation = random.direction() * (size * TREMOR_RATE / rate);
        let displacement = random.direction() * (size * TREMOR_ACCELERATION / (rate * rate));
        twists.push(Twist::new(rotation, profile));
        moves.push(Move::new(displacement, profile));
    }
}

fn knock(peak: f64, end: f64, random: &mut Random, twists: &mut Vec<Twist>, moves: &mut Vec<Move>) {
    let span = Profile::Knock {
        start: 0.0,
        decay: KNOCK_DECAY,
    }
    .span();
    let profile = Profile::Knock {
        start: end - (span.1 - span.0),
        decay: KNOCK_DECAY,
    };
    let size = peak * random.uniform(0.5..1.5);
    let displacement = (Vector3::z() + random.normal3() * 0.3) * size;
    twists.push(Twist::new(
        random.direction() * (size * KNOCK_SPIN),
        profile,
    ));
    moves.push(Move::new(displacement, profile));
}

/// Time constant of a quick knock, s: half of it is over within 10 ms.
const QUICK: f64 = 0.002;
/// Largest first derivative of [`Profile::Knock`] over its time constant, at `u = 3 − √3`.
const STEEPEST: f64 = 0.783_706;

/// A knock somewhere in the turn, or at its end.
fn quick_knock(rate: f64, start: f64, end: f64, last: bool, random: &mut Random) -> Twist {
    let mut profile = Profile::Knock {
        start: 0.0,
        decay: QUICK,
    };
    let (_, length) = profile.span();
    let at = random.uniform(start + 0.1 * (end - start)..end - length);
    if let Profile::Knock { start, .. } = &mut profile {
        *start = if last { end - length } else { at };
    }
    let peak = rate * random.uniform(0.5..1.5);
    Twist::new(random.direction() * (peak / (STEEPEST * QUICK)), profile)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;

    #[test]
    fn a_quick_knock_reaches_its_rate_and_turns_by_nothing() {
        let mut random = Random::new(1, Purpose::Knocks);
        for _ in 0..50 {
            let twist = quick_knock(2.0, 10.0, 12.0, false, &mut random);
            let (from, to) = twist.profile.span();
            let at = |k: i32| twist.profile.at(from + (to - from) * f64::from(k) / 1e4);
            let size = twist.rotation.norm();
            let peak = (0..=10_000)
                .map(|k| at(k).first.abs() * size)
                .fold(0.0, f64::max);
            assert!((1.0..3.001).contains(&peak), "{peak}");
            assert!(at(9_999).value.abs() * size < 1e-12);
            assert!(from >= 10.0 && to <= 12.0 + 1e-12);
        }
    }
}
