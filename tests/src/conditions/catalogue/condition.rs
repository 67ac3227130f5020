//! A row of the study.

use calib::calibrate::{Method, Request};
use calib::simulate::{Clock, Grade, HandHeld, Motion, Spec};

use crate::conditions::kind::Kind;

/// Whether the error of the best estimate is known: even clocks or true stamps, white noise, nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// That of the same device and motion on a good day.
    Known,
    /// Not known.
    Unknown,
}

/// A condition that recordings are made under.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    /// Name of the row.
    pub name: &'static str,
    /// In words.
    pub about: &'static str,
    /// Whether the model of the estimate can hold.
    pub holds: bool,
    /// Whether the best error is known.
    pub bound: Bound,
    /// What the user says beside the recording.
    pub ask: fn(&Spec, &mut Request),
    grade: Grade,
    build: fn(&mut Spec),
    right: &'static [Kind],
    /// What else is right of a method that keeps the stamps as they are.
    right_by_stamps: &'static [Kind],
}

/// A row at consumer grade that the model holds for, of unknown bound, under which no cause is right.
pub(super) const fn row(
    name: &'static str,
    about: &'static str,
    build: fn(&mut Spec),
) -> Condition {
    Condition {
        name,
        about,
        holds: true,
        bound: Bound::Unknown,
        ask: |_, _| {},
        grade: Grade::Consumer,
        build,
        right: &[],
        right_by_stamps: &[],
    }
}

impl Condition {
    pub(super) const fn tactical(mut self) -> Self {
        self.grade = Grade::Tactical;
        self
    }

    pub(super) const fn bounded(mut self) -> Self {
        self.bound = Bound::Known;
        self
    }

    pub(super) const fn beyond_the_model(mut self) -> Self {
        self.holds = false;
        self
    }

    pub(super) const fn right(mut self, kinds: &'static [Kind]) -> Self {
        self.right = kinds;
        self
    }

    pub(super) const fn right_by_stamps(mut self, kinds: &'static [Kind]) -> Self {
        self.right_by_stamps = kinds;
        self
    }

    pub(super) const fn ask(mut self, ask: fn(&Spec, &mut Request)) -> Self {
        self.ask = ask;
        self
    }

    /// What is simulated.
    pub fn spec(&self, seed: u64) -> Spec {
        let mut spec = Spec::hand_held(seed);
        spec.grade = self.grade;
        (self.build)(&mut spec);
        spec
    }

    /// The same device and motion with even clocks and right stamps.
    pub fn good_day(&self, seed: u64) -> Spec {
        let mut spec = self.spec(seed);
        for sensor in [&mut spec.accelerometer, &mut spec.gyroscope] {
            sensor.clock = Clock {
                rate: sensor.clock.rate,
                ..Clock::default()
            };
        }
        spec
    }

    /// Whether words of this kind are no false alarm here.
    pub fn is_right(&self, kind: Kind, by: Method) -> bool {
        kind.names_nothing() || self.tells(kind, by)
    }

    /// Whether words of this kind name the condition or its visible consequence.
    pub fn tells(&self, kind: Kind, by: Method) -> bool {
        let by_stamps = by == Method::Stepwise && self.right_by_stamps.contains(&kind);
        by_stamps || self.right.contains(&kind)
    }
}

/// Changes the hand-held motion.
pub(super) fn by_hand(spec: &mut Spec, change: impl FnOnce(&mut HandHeld)) {
    let mut hand = HandHeld::default();
    change(&mut hand);
    spec.motion = Motion::HandHeld(hand);
}
