//! A fault, where it may be, and what it adds to the rows of a fit there.

use findings::Kind;
use nalgebra::{Matrix3, Vector3};
use recording::intervals::Span;
use sensor::Sensor;

use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::data::Data;
use crate::methods::joint::rows::{MeanRows, Rows};

/// A fault of the registry.
pub type FaultRef = &'static Fault;

/// A fault: parameters `d` of its own that one place of a recording has, which change the rows by `∂r/∂d · d`.
#[derive(Debug)]
pub struct Fault {
    /// Kind of the finding that reports it; no two faults have the same.
    pub kind: Kind,
    /// Name in `findings.json`; faults of one cause share it.
    pub name: &'static str,
    /// Places where it may be.
    pub scope: Scope,
    /// Sensor whose wandering bias can be taken for it.
    pub sensor: Sensor,
    /// Unit of its size.
    pub unit: &'static str,
    /// Typical size of a parameter, in its own unit: one that moves the rows by much less than their noise is not seen.
    pub typical: f64,
    /// True if its parameters are rates: its size is what they come to over its span.
    pub is_rate: bool,
    /// True if a wandering bias imitates it: then only a search that weighs biases against it looks for it.
    pub is_imitated_by_bias: bool,
    /// True if it leaves the specific force of its place open.
    pub opens_force: bool,
    /// True if it is over with its static interval: what comes after is as without it.
    pub is_over_with_interval: bool,
    /// Lists every place where it may be, with what it adds to the rows there.
    pub suspects: fn(&Site<'_>) -> Vec<Suspect>,
    /// Evidence beside its test, from the length of its parameters, its span, gravity and what the readings show already.
    pub seen: fn(f64, Span, f64, Seen) -> Seen,
}

impl Fault {
    /// Length of the sum of its vectors, which are three parameters each: what all of them come to where the fault begins.
    pub fn length(&self, parameters: &[f64]) -> f64 {
        let mut sum = Vector3::<f64>::zeros();
        for (k, value) in parameters.iter().enumerate() {
            sum[k % 3] += value;
        }
        sum.norm()
    }

    /// Size where its parameters have the length `norm` over a span.
    pub fn size(&self, norm: f64, span: Span) -> f64 {
        match self.is_rate {
            true => norm * span.length(),
            false => norm,
        }
    }
}

impl PartialEq for Fault {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind
    }
}

impl Eq for Fault {}

/// Kind of place of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// A static interval, by its place among all.
    StaticInterval,
    /// A chunk of a static interval, by its place among all.
    Chunk,
    /// A turn, by its place among all.
    Turn,
}

impl Scope {
    /// The static interval of a place among all; `None` for a turn.
    pub fn static_interval(self, data: &Data, place: usize) -> Option<usize> {
        match self {
            Self::StaticInterval => Some(place),
            Self::Chunk => data.chunks.get(place).map(|chunk| chunk.rest),
            Self::Turn => None,
        }
    }

    /// The recording, the interval within it and the time of a place.
    pub(crate) fn when(self, data: &Data, place: usize) -> (usize, usize, Span) {
        match self {
            Self::Turn => {
                let turn = &data.turns[place];
                (turn.recording, turn.turn, turn.span)
            }
            Self::StaticInterval => {
                let rest = &data.rests[place];
                (rest.recording, rest.interval, rest.span)
            }
            Self::Chunk => {
                let chunk = &data.chunks[place];
                let rest = &data.rests[chunk.rest];
                let span = chunk.accelerometer.map_or(rest.span, |m| m.span);
                (rest.recording, rest.interval, span)
            }
        }
    }
}

/// A fit at which faults are tested.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// The rows.
    pub rows: &'a Rows<'a>,
    /// The parameters.
    pub x: &'a [f64],
    /// Rotations of the turns at these parameters.
    pub rotations: &'a [Matrix3<f64>],
}

impl Site<'_> {
    /// Change of the direction row of the turn at `place` where it begins (`at_begin`) or ends with the direction off by `moved`
    /// (body frame); `None` where the turn is not at that side of static interval `k`.
    pub(super) fn carried(
        &self,
        place: usize,
        k: usize,
        at_begin: bool,
        moved: Vector3<f64>,
    ) -> Option<[f64; 2]> {
        let turn = &self.rows.data.turns[place];
        let shift = if at_begin && turn.from == k {
            self.rows.charts[k + 1].across.transpose() * (self.rotations[place] * -moved)
        } else if !at_begin && turn.from + 1 == k {
            self.rows.charts[k].across.transpose() * moved
        } else {
            return None;
        };
        Some([shift[0], shift[1]])
    }

    /// Sets what that changes in the direction rows of the turns beside static interval `k`.
    pub(super) fn set_carried(
        &self,
        column: &mut Column,
        k: usize,
        at_begin: bool,
        moved: Vector3<f64>,
    ) {
        for (place, (row, _)) in self.rows.turns().enumerate() {
            if let Some(shift) = self.carried(place, k, at_begin, moved) {
                column.set(row, shift[0]);
                column.set(row + 1, shift[1]);
            }
        }
    }

    /// The means of a sensor over the chunks of static interval `k`.
    pub(super) fn means(&self, sensor: Sensor, k: usize) -> impl Iterator<Item = MeanRows<'_>> {
        let chunks = self.rows.data.rests[k].chunks.clone();
        let all = self.rows.means(sensor);
        all.filter(move |mean| chunks.contains(&mean.place))
    }
}

/// One column for each of `count` rows from `row` on.
pub(super) fn unit_columns(row: usize, count: usize) -> Vec<Column> {
    (0..count).map(|k| Column::unit(row + k)).collect()
}

/// Why something has parameters of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reason {
    /// It was disturbed.
    #[default]
    Disturbed,
    /// The bias stepped within it: its mean is a mixture of before and after, and no fault.
    BiasStepped,
}

/// Further evidence of a disturbance, beside its test.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Seen {
    /// Nothing beside its size.
    #[default]
    Nothing,
    /// The readings shook.
    Shaken {
        /// When most, s.
        time: f64,
        /// Ratio of the readings' standard deviation to the usual one.
        ratio: f64,
    },
    /// It cut a rest in two, of which the shorter part counts as part of a turn.
    Cut,
    /// The device crept.
    Crept {
        /// By this in all, rad.
        angle: f64,
        /// The specific force changed by up to this in a second, m/s³.
        slope: f64,
    },
    /// The device moved at once by this, rad.
    Slipped(f64),
    /// The specific force is off by this, m/s².
    Off(f64),
}

/// Something that was found disturbed and has parameters of its own since.
#[derive(Clone, Debug, PartialEq)]
pub struct Flagged {
    /// The fault.
    pub fault: FaultRef,
    /// Why it has parameters of its own.
    pub reason: Reason,
    /// Place of the recording.
    pub recording: usize,
    /// Static interval (or the one before the turn), counted from 0.
    pub interval: usize,
    /// Begin and end by the stamps, s.
    pub span: Span,
    /// Its fitted size, in the unit of the fault.
    pub size: f64,
    /// True if the readings shook there.
    pub shook: bool,
    /// Further evidence of it.
    pub seen: Seen,
}

/// A suspect: what the rows of the fit would have of it.
#[derive(Clone, Debug)]
pub struct Suspect {
    /// The suspected fault.
    pub fault: FaultRef,
    /// Why it has parameters of its own, where it has.
    pub reason: Reason,
    /// The rest, the chunk or the turn, by its place in the data.
    pub place: usize,
    /// `∂r/∂d`, one column per parameter.
    pub columns: Vec<Column>,
    /// Further evidence of it.
    pub seen: Seen,
    /// Columns of harmless causes that look like it: the part of the rows that these explain is no evidence.
    pub nuisance: Vec<Column>,
    /// Slopes of the accelerometer within chunks, whitened: the derivatives `∂s/∂d` and the slope `s`.
    pub slopes: Vec<(Vec<f64>, f64)>,
}

impl Suspect {
    /// A suspected fault at a place, with what its parameters add to the rows.
    pub fn new(fault: FaultRef, place: usize, columns: Vec<Column>) -> Self {
        Self {
            fault,
            reason: Reason::default(),
            place,
            columns,
            nuisance: Vec::new(),
            slopes: Vec::new(),
            seen: Seen::default(),
        }
    }
}
