//! A person with a device in the hand.

use live::{Direction, Instruction};
use nalgebra::{UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// What a person does besides what is asked.
#[derive(Clone, Copy, Debug, Default)]
pub struct Habits {
    /// Share of placements that are held in the hand until the person is told to let go.
    pub in_the_hand: f64,
    /// Share of placements on another face than the one asked for.
    pub wrong_face: f64,
    /// Turns are too fast for the gyroscope until the person is told.
    pub hasty: bool,
    /// How often a placement is touched before it is complete, percent of the samples.
    pub impatient: f64,
}

#[derive(Clone, Copy, Debug)]
enum Doing {
    /// Lying, or held, since a time.
    Resting { since: f64, in_the_hand: bool },
    /// Turning by a rotation vector in the device's frame.
    Turning {
        from: f64,
        seconds: f64,
        by: Vector3<f64>,
    },
}

/// The person.
#[derive(Clone, Debug)]
pub struct Person {
    rng: ChaCha8Rng,
    habits: Habits,
    /// Rotation from the device to the room at the begin of what is being done.
    attitude: UnitQuaternion<f64>,
    doing: Doing,
    told: Instruction,
    told_at: f64,
    /// What was done last.
    done: Instruction,
    /// Delay before the person follows, s.
    reaction: f64,
    /// Placements made, each orientation that the device was brought to.
    pub placements: usize,
    phases: [f64; 6],
}

/// Before an instruction that has been followed already is followed once more, s.
const WAIT: f64 = 6.0;
/// Rotation of the device while it is laid out of the hand, rad.
const LAID: f64 = 0.05;

impl Person {
    /// Who has just taken the device.
    pub fn new(habits: Habits, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let phases = std::array::from_fn(|_| rng.random_range(0.0..std::f64::consts::TAU));
        Self {
            rng,
            habits,
            attitude: UnitQuaternion::identity(),
            doing: Doing::Resting {
                since: 0.0,
                in_the_hand: true,
            },
            told: Instruction::Wait,
            told_at: 0.0,
            done: Instruction::Wait,
            reaction: 0.7,
            placements: 0,
            phases,
        }
    }

    /// Hears what is said at time `t`, s.
    pub fn hear(&mut self, instruction: Instruction, t: f64) {
        let same = std::mem::discriminant(&instruction) == std::mem::discriminant(&self.told);
        if same && !matches!(instruction, Instruction::Turn { .. }) || instruction == self.told {
            return;
        }
        if let Instruction::TooFast { .. } = instruction {
            self.habits.hasty = false;
        }
        self.told = instruction;
        self.told_at = t;
        self.reaction = self.rng.random_range(0.3..1.2);
    }

    /// Angular rate (rad/s) and specific force (units of gravity) in the device's frame at time `t`.
    pub fn motion(&mut self, t: f64) -> [Vector3<f64>; 2] {
        self.act(t);
        let up = |attitude: UnitQuaternion<f64>| attitude.inverse() * Vector3::z();
        match self.doing {
            Doing::Turning { from, seconds, by } => {
                let s = ((t - from) / seconds).clamp(0.0, 1.0);
                let (angle, rate) = (
                    s * s * s * (s * (6.0 * s - 15.0) + 10.0),
                    30.0 * s * s * (1.0 - s) * (1.0 - s) / seconds,
                );
                let attitude = self.attitude * UnitQuaternion::from_scaled_axis(by * angle);
                let push = 0.05 * (std::f64::consts::TAU * s).sin();
                [
                    by * rate,
                    up(attitude) + self.attitude.inverse() * Vector3::new(push, -push, 0.5 * push),
                ]
            }
            Doing::Resting { in_the_hand, .. } => {
                let size = if in_the_hand { 1.0 } else { 0.0 };
                let wave = |k: usize, f: f64| {
                    size * (std::f64::consts::TAU * f * t + self.phases[k]).sin()
                };
                let rate = Vector3::new(wave(0, 8.3), wave(1, 9.1), wave(2, 10.4)) * 0.07;
                let force = Vector3::new(wave(3, 8.7), wave(4, 9.6), wave(5, 7.9)) * 0.012;
                [rate, up(self.attitude) + force]
            }
        }
    }

    /// Whether the person presses play now.
    pub fn presses_play(&self, t: f64) -> bool {
        matches!(self.told, Instruction::Paused) && t > self.told_at + 2.0 * self.reaction
    }

    fn act(&mut self, t: f64) {
        if let Doing::Turning { from, seconds, by } = self.doing {
            if t >= from + seconds {
                self.attitude *= UnitQuaternion::from_scaled_axis(by);
                let is_placement = by.norm() > 1.5 * LAID;
                let in_the_hand = is_placement && self.chance(self.habits.in_the_hand);
                self.placements += usize::from(is_placement);
                self.doing = Doing::Resting {
                    since: t,
                    in_the_hand,
                };
            }
            return;
        }
        let Doing::Resting { since, in_the_hand } = self.doing else {
            return;
        };
        let is_new = self.told != self.done || t > since + WAIT;
        if !is_new || t < self.told_at.max(since) + self.reaction {
            return;
        }
        let nudge = |person: &mut Self| Doing::Turning {
            from: t,
            seconds: 0.6,
            by: person.any().normalize() * LAID,
        };
        let told = self.told;
        match told {
            Instruction::LayDown | Instruction::LetGo { .. }
                if in_the_hand && self.placements == 0 =>
            {
                let k = self.rng.random_range(0..6);
                self.turn_to(&Direction::all()[k], t);
            }
            Instruction::LetGo { .. } if in_the_hand => self.doing = nudge(self),
            Instruction::Turn { to, .. } => {
                self.done = self.told;
                let wrong = self.chance(self.habits.wrong_face);
                let to = if wrong { self.another() } else { to };
                self.turn_to(&to, t);
            }
            Instruction::Hold { remaining }
                if remaining > 1.0 && self.chance(self.habits.impatient / 100.0) =>
            {
                self.doing = nudge(self);
            }
            _ => {}
        }
    }

    fn turn_to(&mut self, to: &Direction, t: f64) {
        let aim = (to.unit() + self.any() * 0.08).normalize();
        let heading = self.rng.random_range(0.0..std::f64::consts::TAU);
        let spin = UnitQuaternion::from_scaled_axis(Vector3::z() * heading);
        let raised = UnitQuaternion::rotation_between(&aim, &Vector3::z());
        let raised = raised.unwrap_or_else(|| {
            UnitQuaternion::from_scaled_axis(Vector3::x() * std::f64::consts::PI)
        });
        let by = (self.attitude.inverse() * spin * raised).scaled_axis();
        let seconds = if self.habits.hasty {
            0.35
        } else {
            self.rng.random_range(1.2..2.2)
        };
        self.doing = Doing::Turning {
            from: t,
            seconds,
            by,
        };
    }

    fn another(&mut self) -> Direction {
        let all = Direction::all();
        all[self.rng.random_range(0..all.len())]
    }

    fn chance(&mut self, share: f64) -> bool {
        self.rng.random_range(0.0..1.0) < share
    }

    fn any(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| StandardNormal.sample(&mut self.rng))
    }
}
