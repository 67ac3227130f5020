//! Detection of motion in a recording, as an Allan analysis requires a static one.

use nalgebra::Vector3;
use recording::averages::median;
use recording::intervals::{Span, complement, union};

use super::changes::Mean;
use super::coarse::{Coarse, LeastSteps};

/// Length of a block in which the spread is measured, s.
const BLOCK: f64 = 1.0;

findings::tuning! {
    /// Fewest samples in a block, where a second holds fewer.
    FEWEST: usize = 10;

    /// Share of the blocks that is taken to be at rest.
    QUIET_SHARE: f64 = 0.1;

    /// A block whose spread is this many times that at rest moves. A hand shakes a phone by a hundred
    /// times its noise; the noise of one second repeats to a tenth.
    MOVING: f64 = 10.0;

    /// An accelerometer moves throughout where even its quiet blocks spread by this share of gravity ...
    SHAKEN: f64 = 0.03;
    /// ... and neighbours differ by this share of it.
    TILTED: f64 = 0.01;
}

/// The spread and the mean of one sensor's readings, block by block: a few numbers a second, however long the
/// recording.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spreads {
    closed: Vec<Closed>,
    open: Option<Block>,
    first: Option<f64>,
    latest: f64,
    least_steps: LeastSteps,
}

/// A block that is full: when, and the standard deviation and the mean of each axis.
#[derive(Clone, Copy, Debug)]
struct Closed {
    span: Span,
    spread: Vector3<f64>,
    mean: Vector3<f64>,
}

/// Running mean and sum of squares (Welford).
#[derive(Clone, Copy, Debug)]
struct Block {
    span: Span,
    count: usize,
    mean: Vector3<f64>,
    squares: Vector3<f64>,
}

impl Block {
    fn starting(t: f64) -> Self {
        Self {
            span: Span { from: t, to: t },
            count: 0,
            mean: Vector3::zeros(),
            squares: Vector3::zeros(),
        }
    }

    fn add(&mut self, t: f64, value: &Vector3<f64>) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before.component_mul(&(value - self.mean));
        self.span.to = t;
    }

    fn is_full(&self) -> bool {
        self.count >= FEWEST.get() && self.span.lasts(BLOCK)
    }

    fn closed(&self) -> Closed {
        Closed {
            span: self.span,
            spread: (self.squares / self.count as f64).map(f64::sqrt),
            mean: self.mean,
        }
    }
}

impl Spreads {
    /// The next sample; stamps ascend.
    pub(crate) fn push(&mut self, t: f64, value: &Vector3<f64>) {
        self.first.get_or_insert(t);
        self.latest = t;
        self.least_steps.push(value);
        let mut block = self.open.take().unwrap_or_else(|| Block::starting(t));
        block.add(t, value);
        if block.is_full() {
            self.closed.push(block.closed());
        } else {
            self.open = Some(block);
        }
    }

    /// From the first sample to the last.
    pub(crate) fn covered(&self) -> Option<Span> {
        let to = self.latest;
        self.first.map(|from| Span { from, to })
    }

    /// The means of the blocks, by axis.
    pub(crate) fn means(&self) -> [Vec<Mean>; 3] {
        let blocks = &self.closed;
        std::array::from_fn(|k| {
            blocks
                .iter()
                .map(|block| (block.span, block.mean[k]))
                .collect()
        })
    }

    /// The axes that read in steps wider than their noise.
    pub(crate) fn coarse(&self) -> [Option<Coarse>; 3] {
        let steps = self.least_steps.by_axis();
        std::array::from_fn(|k| {
            let blocks = self.closed.iter();
            Coarse::of(
                steps[k],
                blocks.map(|block| (block.spread[k], block.mean[k])),
            )
        })
    }

    /// Returns true if these are an accelerometer's and it moves throughout.
    pub(crate) fn never_rest(&self) -> bool {
        let shares = self.closed.iter().map(|b| b.spread.norm() / b.mean.norm());
        let mut shares: Vec<f64> = shares.collect();
        if shares.len() < FEWEST.get() {
            return false;
        }
        let rank = (QUIET_SHARE.get() * (shares.len() - 1) as f64) as usize;
        let quiet = *shares.select_nth_unstable_by(rank, f64::total_cmp).1;
        let neighbours = self.closed.windows(2);
        let differ = neighbours.map(|w| (w[1].mean - w[0].mean).norm() / w[0].mean.norm());
        // What has no gravity in it is no accelerometer.
        (SHAKEN.get()..0.5).contains(&quiet)
            && median(differ).is_some_and(|usual| usual > TILTED.get())
    }

    /// The time covered, and the blocks that move. The level at rest is that of the quietest tenth,
    /// and at least a step of the readings: a coarse sensor at rest shows the same number for seconds.
    fn motions(mut self) -> (Option<Span>, Vec<Span>) {
        if let Some(block) = self.open.take().filter(|block| block.count >= FEWEST.get()) {
            self.closed.push(block.closed());
        }
        let whole = self.closed.first().zip(self.closed.last());
        let whole = whole.map(|(first, last)| Span {
            from: first.span.from,
            to: last.span.to,
        });
        let mut spreads: Vec<f64> = self
            .closed
            .iter()
            .map(|block| block.spread.norm())
            .collect();
        if spreads.is_empty() {
            return (whole, Vec::new());
        }
        let rank = (QUIET_SHARE.get() * (spreads.len() - 1) as f64) as usize;
        let quiet = *spreads.select_nth_unstable_by(rank, f64::total_cmp).1;
        let limit = MOVING.get() * quiet.max(self.least_steps.least().unwrap_or(0.0));
        let moving = self
            .closed
            .iter()
            .filter(|block| block.spread.norm() > limit);
        (whole, moving.map(|block| block.span).collect())
    }
}

/// When a recording moved and when it was still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stillness {
    /// The motions, in order.
    pub motions: Vec<Span>,
    /// The stretches between them, in order.
    pub rests: Vec<Span>,
}

/// Part of a recording that an Allan analysis may use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtRest {
    /// All of it: nothing moved.
    Throughout,
    /// This stretch, the longest without motion.
    For(Span),
    /// Nothing: the longest stretch without motion is too short.
    TooShort(Option<Span>),
}

findings::tuning! {
    /// A shorter stretch at rest in a recording that also moves is not worth analysing, s.
    SHORTEST_REST: f64 = 60.0;
}

impl Stillness {
    /// The stillness of a recording in motion from beginning to end.
    pub(crate) fn nowhere(whole: Span) -> Self {
        Self {
            motions: vec![whole],
            rests: Vec::new(),
        }
    }

    /// Returns the part that may be analysed.
    pub fn at_rest(&self) -> AtRest {
        let longest = self.longest_rest();
        match longest.filter(|rest| rest.length() >= SHORTEST_REST.get()) {
            _ if self.motions.is_empty() => AtRest::Throughout,
            Some(rest) => AtRest::For(rest),
            None => AtRest::TooShort(longest),
        }
    }

    /// From the spreads of the sensors there are.
    pub(crate) fn of(sensors: impl IntoIterator<Item = Spreads>) -> Self {
        let (mut wholes, mut moving) = (Vec::new(), Vec::new());
        for spreads in sensors {
            let (whole, motions) = spreads.motions();
            wholes.extend(whole);
            // A motion may begin at the end of the block before and end in the one after.
            moving.extend(motions.into_iter().map(|m| Span {
                from: m.from - BLOCK,
                to: m.to + BLOCK,
            }));
        }
        let Some(whole) = wholes.into_iter().reduce(|a, b| Span {
            from: a.from.min(b.from),
            to: a.to.max(b.to),
        }) else {
            return Self::default();
        };
        let motions = union(moving);
        Self {
            rests: complement(whole, &motions),
            motions,
        }
    }

    /// The longest rest.
    pub fn longest_rest(&self) -> Option<Span> {
        let longer = |a: &&Span, b: &&Span| a.length().total_cmp(&b.length());
        self.rests.iter().max_by(longer).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A minute at 50 Hz that flips between two readings, and between ten times as far in a turn.
    fn spreads(turn: Option<Span>, size: f64) -> Spreads {
        let mut spreads = Spreads::default();
        for k in 0..3000 {
            let t = f64::from(k) * 0.02;
            let turning = turn.is_some_and(|turn| turn.from <= t && t <= turn.to);
            let sign = if k % 2 == 0 { size } else { -size };
            let noise = Vector3::new(sign, 0.0, 0.0);
            spreads.push(t, &if turning { noise * 100.0 } else { noise });
        }
        spreads
    }

    #[test]
    fn a_rest_has_no_motion_and_is_one_rest() {
        let found = Stillness::of([spreads(None, 1e-3), spreads(None, 1e-5)]);
        assert_eq!(found.motions, []);
        assert_eq!(found.rests.len(), 1);
        assert!(found.longest_rest().unwrap().length() > 59.0);
    }

    #[test]
    fn a_turn_seen_by_either_sensor_cuts_the_recording() {
        let turn = Some(Span {
            from: 20.3,
            to: 21.8,
        });
        let found = Stillness::of([spreads(None, 1e-3), spreads(turn, 1e-5)]);
        let [motion] = found.motions[..] else {
            panic!("{found:?}");
        };
        // Known to two blocks on either side.
        assert!(motion.from <= 20.3 && motion.from > 18.0, "{motion:?}");
        assert!(motion.to >= 21.8 && motion.to < 24.0, "{motion:?}");
        assert_eq!(found.longest_rest().unwrap().from, motion.to);
    }

    /// A sensor whose step is larger than its noise: 59 s of one number, then a flicker of one step.
    #[test]
    fn a_flicker_of_the_last_digit_is_no_motion() {
        let mut coarse = Spreads::default();
        for k in 0..3000 {
            let flicker = if k > 2900 && k % 3 == 0 { 0.01 } else { 0.0 };
            coarse.push(f64::from(k) * 0.02, &Vector3::new(flicker, 0.0, 9.8));
        }
        assert_eq!(Stillness::of([coarse]).motions, []);
    }

    #[test]
    fn a_walk_never_rests_and_a_noisy_accelerometer_does() {
        let of = |walks: bool| {
            let mut spreads = Spreads::default();
            for k in 0..3000 {
                let t = f64::from(k) * 0.02;
                let sign = if k % 2 == 0 { 0.5 } else { -0.5 };
                let tilt = if walks { (0.9 * t).sin() } else { 0.0 };
                spreads.push(t, &Vector3::new(sign, tilt, 9.8));
            }
            spreads.never_rest()
        };
        assert!(of(true) && !of(false));
    }

    #[test]
    fn no_samples_are_no_motion() {
        assert_eq!(Stillness::of([Spreads::default()]), Stillness::default());
    }
}
