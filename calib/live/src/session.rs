//! The state machine of a guided session: samples in, instructions out. Time is that of the stamps.

mod rails;

use calib::Recording;
use calib::calibrate::Request;
use calib::intervals::Span;
use calib::recording::Stream;
use nalgebra::Vector3;
use plan::{next_placement, session_efficiency, worth};

use self::rails::Rails;
use crate::attitude::Attitude;
use crate::direction::Direction;
use crate::instruction::{Instruction, Verdict};
use crate::motion::{Detector, Motion, WINDOW, moments};
use crate::promise::{PROMISE, Shortfall};

use crate::batch::{Batch, Event};
use crate::running::Estimate;

findings::tuning! {
    /// Time between two looks at the samples, s.
    STEP: f64 = 0.1;
    /// The placement that is asked for is reached within this of it: cos 20°.
    REACHED: f64 = 0.939_692_620_785_908_4;
    /// Another one is as good where it tells at least so much of what the wanted one would.
    AS_GOOD: f64 = 0.5;
    /// Placements this near to each other are one, cos 8°.
    SAME: f64 = 0.990_268_068_741_570_4;
    /// Efficiency relative to the plan at which the session is complete, once the planned number of placements is reached.
    ENOUGH: f64 = 0.8;
    /// Placements beyond the plan, as a factor, after which the session ends with what is determined.
    AT_MOST: f64 = 1.2;
    /// A hand, a shaken table or a rail is spoken of after so long, s.
    PATIENCE: f64 = 1.5;
    /// It is spoken of for so long, s.
    SPOKEN: f64 = 2.0;
    /// Cut off at the begin of a placement, s: touch-down rings.
    BEGIN: f64 = 0.15;
    /// Cut off at its end, s: the hand comes before the motion is seen.
    END: f64 = 0.3;
    /// Fewer placements are not calibrated.
    FEWEST: usize = 6;
}

/// An accelerometer in m/s² reads this at rest.
const SI: std::ops::Range<f64> = 5.0..15.0;
/// Rough rate of one count of a gyroscope whose unit is not known, rad/s: that of ±1000 °/s in 16 bits.
const COUNT: f64 = 5.3e-4;

/// Target of a session.
#[derive(Clone, Debug)]
pub struct Aim {
    /// Placements planned.
    pub placements: usize,
    /// Static time of each placement, s.
    pub hold: f64,
    /// Calibration request.
    pub request: Request,
}

impl Default for Aim {
    /// Twelve placements of 5 s.
    fn default() -> Self {
        Self {
            placements: 12,
            hold: 5.0,
            request: Request::default(),
        }
    }
}

/// A placement that was accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// When it lay still, s.
    pub span: Span,
    /// Direction of specific force (unit vector, raw).
    pub up: Vector3<f64>,
    /// Verdict on the placement.
    pub verdict: Verdict,
}

/// A guided session.
///
/// ```text
///              samples                       hold done
/// Wait ──► LayDown ──► Hold ──────────────────────────► Turn ──► Hold ──► … ──► Enough, Short
///             ▲         │ moved                          │ ▲
///             └─────────┘                    LetGo · Shaken · TooFast · Paused · Reconnecting
/// ```
///
/// # Examples
/// ```
/// use stillpoint_live::{Aim, Instruction, Session};
/// let session = Session::new(Aim::default());
/// assert_eq!(session.instruction(), Instruction::Wait);
/// ```
#[derive(Clone, Debug)]
pub struct Session {
    aim: Aim,
    recording: Recording,
    detector: Detector,
    rails: Rails,
    attitude: Attitude,
    /// The reading of gravity, once known.
    gravity: Option<f64>,
    /// The last instant looked at, s.
    at: Option<f64>,
    motion: Motion,
    /// When the motion of now began, s.
    since: f64,
    /// The placement of now has been counted.
    counted: bool,
    placements: Vec<Placement>,
    estimate: Estimate,
    wanted: Option<Direction>,
    /// Instruction shown for a limited time, and the time at which it ends, s.
    spoken: Option<(Instruction, f64)>,
    paused: bool,
    lost: bool,
    done: bool,
    /// Gyroscope samples that were looked at.
    seen: usize,
}

impl Session {
    /// Before the first sample.
    pub fn new(aim: Aim) -> Self {
        Self {
            aim,
            recording: Recording {
                name: "live".to_owned(),
                accelerometer: Some(Stream::default()),
                gyroscope: Some(Stream::default()),
                ..Recording::default()
            },
            detector: Detector::default(),
            rails: Rails::default(),
            attitude: Attitude::default(),
            gravity: None,
            at: None,
            motion: Motion::Unknown,
            since: 0.0,
            counted: false,
            placements: Vec::new(),
            estimate: Estimate::default(),
            wanted: None,
            spoken: None,
            paused: false,
            lost: false,
            done: false,
            seen: 0,
        }
    }

    /// Takes what came; every instruction that differs from the one before, in order.
    pub fn take(&mut self, batch: &Batch) -> Vec<Instruction> {
        let before = self.instruction();
        batch.events.iter().for_each(|event| self.note(event));
        append(&mut self.recording.accelerometer, &batch.accelerometer);
        append(&mut self.recording.gyroscope, &batch.gyroscope);
        let mut said = vec![before];
        self.say(&mut said);
        self.learn_gravity();
        while !self.done && self.look() {
            self.say(&mut said);
        }
        said.split_off(1)
    }

    fn say(&self, said: &mut Vec<Instruction>) {
        let now = self.instruction();
        if said.last().is_none_or(|last| !last.is_like(&now)) {
            said.push(now);
        }
    }

    /// Returns the current instruction.
    pub fn instruction(&self) -> Instruction {
        if self.done {
            return match self.shortfall() {
                Some(of) => Instruction::Short { of },
                None => Instruction::Enough,
            };
        }
        if self.lost {
            return Instruction::Reconnecting;
        }
        if self.paused {
            return Instruction::Paused;
        }
        if let Some((spoken, _)) = self.spoken {
            return spoken;
        }
        if self.at.is_none() {
            return Instruction::Wait;
        }
        if self.motion == Motion::Still && !self.counted {
            let lain = self.at.unwrap_or(self.since) - self.since;
            return Instruction::Hold {
                remaining: (self.aim.hold - lain).max(0.0),
            };
        }
        match (self.wanted, self.placements.last()) {
            (Some(to), Some(last)) => Instruction::Turn {
                to,
                last: last.verdict,
            },
            _ => Instruction::LayDown,
        }
    }

    /// The placements so far.
    pub fn placements(&self) -> &[Placement] {
        &self.placements
    }

    /// Standard errors now.
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// Returns the quantity that falls furthest short of the promise.
    pub fn shortfall(&self) -> Option<Shortfall> {
        PROMISE.shortfall(&self.estimate)
    }

    /// Returns the direction that is requested next.
    pub fn wanted(&self) -> Option<Direction> {
        self.wanted
    }

    /// Returns the current state of motion of the device.
    pub fn motion(&self) -> Motion {
        self.motion
    }

    /// Returns the target of the session.
    pub fn aim(&self) -> &Aim {
        &self.aim
    }

    /// The samples so far.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The rotation from the device to the room as w, x, y, z; its heading is free.
    pub fn attitude(&self) -> [f64; 4] {
        self.attitude.quaternion()
    }

    /// Specific force now (unit vector), where it is known.
    pub fn up(&self) -> Option<Vector3<f64>> {
        let last = self.recording.accelerometer.as_ref()?.values.last()?;
        last.try_normalize(0.0)
    }

    fn note(&mut self, event: &Event) {
        match event {
            Event::Paused => {
                self.paused = true;
                self.motion = Motion::Unknown;
            }
            Event::Resumed { .. } => self.paused = false,
            Event::Reconnecting { .. } => self.lost = true,
            Event::Reconnected => self.lost = false,
            Event::Restarted => *self = Self::new(self.aim.clone()),
            _ => {}
        }
    }

    /// Returns the factors from the sensors' units to units of gravity and to rad/s.
    fn units(&self) -> Option<[f64; 2]> {
        let gravity = self.gravity?;
        let rate = if SI.contains(&gravity) { 1.0 } else { COUNT };
        Some([gravity.recip(), rate])
    }

    /// Gravity's reading is the median of a second: a device in the hand is near it too.
    fn learn_gravity(&mut self) {
        let Some(stream) = self
            .recording
            .accelerometer
            .as_ref()
            .filter(|_| self.gravity.is_none())
        else {
            return;
        };
        if stream
            .t
            .first()
            .zip(stream.t.last())
            .is_none_or(|(a, b)| b - a < WINDOW.get())
        {
            return;
        }
        let mut norms: Vec<f64> = stream.values.iter().map(Vector3::norm).collect();
        norms.sort_by(f64::total_cmp);
        self.gravity = norms
            .get(norms.len() / 2)
            .copied()
            .filter(|norm| *norm > 0.0);
    }

    /// Looks one step on; false where there are no samples yet.
    fn look(&mut self) -> bool {
        let (Some(force), Some(rate), Some(units)) = (
            &self.recording.accelerometer,
            &self.recording.gyroscope,
            self.units(),
        ) else {
            return false;
        };
        let (Some(first), Some(last)) = (
            both(force, rate, |s| s.t.first(), f64::max),
            both(force, rate, |s| s.t.last(), f64::min),
        ) else {
            return false;
        };
        let at = self.at.map_or(first + WINDOW.get(), |at| at + STEP.get());
        if at > last {
            return false;
        }
        let force = within(force, at, units[0]);
        let rate = within(rate, at, units[1]);
        let motion = self.detector.judge(&force, &rate);
        self.at = Some(at);
        if force.is_empty() {
            self.skip(at);
        }
        self.follow(at, units);
        self.turn_to(motion, at);
        self.speak(at);
        if self.motion == Motion::Still && !self.counted && at - self.since >= self.aim.hold - 1e-9
        {
            self.count_placement(at, &rate);
        }
        true
    }

    /// Goes on to where samples come again: an interruption may be long.
    fn skip(&mut self, at: f64) {
        let stream = self.recording.accelerometer.as_ref();
        let next = stream.and_then(|s| s.t.get(s.t.partition_point(|t| *t <= at)));
        self.at = next.copied().or(self.at);
    }

    /// Attitude and rails by the samples up to `at`.
    fn follow(&mut self, at: f64, units: [f64; 2]) {
        let (Some(force), Some(rate)) = (&self.recording.accelerometer, &self.recording.gyroscope)
        else {
            return;
        };
        while let Some((&t, reading)) = rate
            .t
            .get(self.seen)
            .zip(rate.values.get(self.seen))
            .filter(|(t, _)| **t <= at)
        {
            self.seen += 1;
            if let Some(force) = force.at(t) {
                self.attitude
                    .advance(t, &(reading * units[1]), &(force * units[0]));
            }
            if let Some(axis) = self.rails.look_at(reading, units[1]) {
                self.spoken = Some((
                    Instruction::TooFast {
                        axis,
                        at: reading[axis],
                    },
                    at + SPOKEN.get(),
                ));
            }
        }
    }

    fn turn_to(&mut self, motion: Motion, at: f64) {
        if motion == self.motion {
            return;
        }
        if self.motion == Motion::Still
            && self.counted
            && let Some(placement) = self.placements.last_mut()
            && placement.span.from >= self.since
        {
            placement.span.to = (at - END.get()).max(placement.span.from);
        }
        self.motion = motion;
        self.counted = false;
        // A window that is still was so from its begin.
        self.since = if motion == Motion::Still {
            at - WINDOW.get()
        } else {
            at
        };
    }

    /// Selects a temporary instruction for a device that is held in the hand or shaken for long.
    fn speak(&mut self, at: f64) {
        if self.spoken.is_some_and(|(_, until)| at > until) {
            self.spoken = None;
        }
        let instruction = match self.motion {
            Motion::InHand => Instruction::LetGo { at: self.wanted },
            Motion::Shaken => Instruction::Shaken,
            Motion::Still => {
                self.spoken = None;
                return;
            }
            _ => return,
        };
        if at - self.since >= PATIENCE.get() {
            self.spoken = Some((instruction, at + STEP.get() / 2.0));
        }
    }

    /// Counts the placement that has lain for long enough.
    fn count_placement(&mut self, at: f64, rate: &[Vector3<f64>]) {
        self.counted = true;
        self.detector.learn(rate);
        let span = Span {
            from: self.since + BEGIN.get(),
            to: at,
        };
        let Some(up) = self.mean_direction(span) else {
            return;
        };
        let ups: Vec<_> = self.placements.iter().map(|p| p.up).collect();
        if let Some(last) = self.placements.last_mut()
            && last.up.dot(&up) > SAME.get()
        {
            // Touched, not turned: the longer of the two stands for it.
            if span.length() > last.span.length() {
                last.span = span;
            }
            return;
        }
        let verdict = match self.wanted {
            Some(wanted) if wanted.unit().dot(&up) < REACHED.get() => {
                if worth(&ups, &up, &wanted.unit()) >= AS_GOOD.get() {
                    Verdict::GoodToo
                } else {
                    Verdict::Repeated
                }
            }
            _ => Verdict::Good,
        };
        self.placements.push(Placement { span, up, verdict });
        let ups: Vec<_> = self.placements.iter().map(|p| p.up).collect();
        self.wanted = Some(Direction::nearest(&next_placement(&ups, Some(&up))));
        if self.placements.len() >= FEWEST.get() {
            let spans: Vec<Span> = self.placements.iter().map(|p| p.span).collect();
            self.estimate = Estimate::of(&self.recording, &spans, &self.aim.request);
        }
        self.done = self.is_enough(&ups);
    }

    /// The planned number with nearly the plan's information and what was promised, or so many that more would not help; in
    /// both cases only where everything is determined.
    fn is_enough(&self, ups: &[Vector3<f64>]) -> bool {
        let planned = self.aim.placements;
        let told = ups.len() >= planned && session_efficiency(ups, planned) >= ENOUGH.get();
        let at_most = (AT_MOST.get() * planned as f64).floor() as usize;
        let reached = told && self.shortfall().is_none();
        self.estimate.is_complete() && (reached || ups.len() >= at_most)
    }

    fn mean_direction(&self, span: Span) -> Option<Vector3<f64>> {
        let stream = self.recording.accelerometer.as_ref()?;
        moments(&stream.values[stream.between(span.from, span.to)])
            .0
            .try_normalize(0.0)
    }
}

findings::tuning! {
    /// Beyond this a step of time is lost in rounding, s.
    LATEST: f64 = 1e11;
    /// Beyond this the square of a reading is lost in rounding.
    LARGEST: f64 = 1e30;
}

/// Appends samples that are later than all before. What no clock and no sensor says is left out.
fn append(stream: &mut Option<Stream>, more: &Stream) {
    let stream = stream.get_or_insert_default();
    let is_sample = |t: f64, v: &Vector3<f64>| t.abs() <= LATEST.get() && v.amax() <= LARGEST.get();
    for (t, v) in more.t.iter().zip(&more.values) {
        if is_sample(*t, v) && stream.t.last().is_none_or(|last| t > last) {
            stream.t.push(*t);
            stream.values.push(*v);
        }
    }
}

/// The samples of the window before `at`, in `unit`.
fn within(stream: &Stream, at: f64, unit: f64) -> Vec<Vector3<f64>> {
    let range = stream.between(at - WINDOW.get(), at);
    stream.values[range].iter().map(|v| v * unit).collect()
}

/// A stamp of both streams.
fn both<'a>(
    a: &'a Stream,
    b: &'a Stream,
    stamp: impl Fn(&'a Stream) -> Option<&'a f64>,
    of: fn(f64, f64) -> f64,
) -> Option<f64> {
    Some(of(*stamp(a)?, *stamp(b)?))
}
