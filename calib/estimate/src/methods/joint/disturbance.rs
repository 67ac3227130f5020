//! Rests and turns that something disturbed: tests that need no refit.

pub(crate) mod belief;
pub(crate) mod broken;
pub(crate) mod judgement;
pub(crate) mod shake;
pub(crate) mod trial;
pub(crate) mod trim;

use nalgebra::{Matrix3, Vector3};
use recording::intervals::Span;
use sensor::Sensor;
use serde::Serialize;

use super::data::{Chunk, Mean};
use crate::methods::joint::blocks::column::Column;
use crate::methods::joint::disturbance::shake::Shake;
use crate::methods::joint::rows::Rows;
use crate::methods::small_sample::LEAST_SPARE;

/// Kind of a disturbance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Disturbance {
    /// The device crept while it should have rested: neighbouring turns miss in opposite ways.
    MountSlip,
    /// The specific force of a stretch of rest is not gravity's.
    DisturbedInterval,
    /// A turn misses the direction after it: lost or clipped samples.
    BadTurn,
    /// The mean rate of one static interval is off and that of its neighbours is not.
    RateExcursion,
    /// The device moved at once between two parts of a long static interval.
    SuddenSlip,
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
    /// Kind of the disturbance.
    pub kind: Disturbance,
    /// Why it has parameters of its own.
    pub reason: Reason,
    /// Place of the recording.
    pub recording: usize,
    /// Static interval (or the one before the turn), counted from 0.
    pub interval: usize,
    /// When.
    pub span: Span,
    /// Its fitted size: of a push in m/s², of a creep in rad, else 0.
    pub size: f64,
    /// True if the readings shook there.
    pub shook: bool,
    /// Further evidence of it.
    pub seen: Seen,
}

/// Chunks of a rest in which a drifting bias shows.
const LONG: usize = 3;

/// A suspect: what the rows of the fit would have of it.
#[derive(Clone, Debug)]
pub struct Suspect {
    /// Kind of the suspected disturbance.
    pub kind: Disturbance,
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

/// Everything that may have been disturbed at the parameters `x`, where the turns have these rotations.
pub fn suspects(rows: &Rows<'_>, x: &[f64], rotations: &[Matrix3<f64>]) -> Vec<Suspect> {
    // A device that sways at rest creeps a little in any interval.
    let may_creep = |k: &usize| {
        let recording = rows.data.rests[*k].recording;
        !rows.data.sources[recording].moves_at_rest()
    };
    let rests = (0..rows.data.rests.len()).filter(may_creep);
    let mut all: Vec<Suspect> = rests.map(|k| slip(rows, x, k, rotations)).collect();
    // Without placements to spare any of them, or a part of it, would make the others agree.
    if rows.spare_placements() > LEAST_SPARE {
        let means = rows.means(Sensor::Accelerometer).enumerate();
        all.extend(means.map(|(k, (place, _))| pushed(place, 3 * k)));
    }
    let first = rows.first_turn_row();
    all.extend((0..rows.data.turns.len()).map(|k| Suspect {
        kind: Disturbance::BadTurn,
        reason: Reason::default(),
        place: k,
        columns: unit_columns(first + 2 * k, 2),
        nuisance: Vec::new(),
        slopes: Vec::new(),
        seen: Seen::default(),
    }));
    all
}

/// Lists the suspects that a moving bias can imitate: the rate of one static interval alone, and a sudden slip within a
/// long one.
pub fn excursions(rows: &Rows<'_>, x: &[f64], rotations: &[Matrix3<f64>]) -> Vec<Suspect> {
    let mut all: Vec<Suspect> = Vec::new();
    for (rest, own) in rows.data.rests.iter().enumerate() {
        let mut columns = vec![Column::default(); 3];
        for (k, (place, _)) in rows.means(Sensor::Gyroscope).enumerate() {
            if own.chunks.contains(&place) {
                let row = rows.first_rate_row() + 3 * k;
                for (axis, column) in columns.iter_mut().enumerate() {
                    column.set(row + axis, -1.0);
                }
            }
        }
        all.push(plain(Disturbance::RateExcursion, rest, columns));
        let inner = own.chunks.clone().skip(1);
        all.extend(inner.map(|chunk| {
            let columns = sudden(rows, x, (rest, chunk), rotations);
            plain(Disturbance::SuddenSlip, chunk, columns)
        }));
    }
    all
}

fn plain(kind: Disturbance, place: usize, columns: Vec<Column>) -> Suspect {
    Suspect {
        kind,
        reason: Reason::default(),
        place,
        columns,
        nuisance: Vec::new(),
        slopes: Vec::new(),
        seen: Seen::default(),
    }
}

/// A rotation by `δ` (rad, body frame) before chunk `chunk` of rest `k`: `u` becomes `u + u × δ`. What comes after, the
/// turn that begins there among it, sees the new direction.
fn sudden(
    rows: &Rows<'_>,
    x: &[f64],
    (k, chunk): (usize, usize),
    rotations: &[Matrix3<f64>],
) -> Vec<Column> {
    let u = rows.direction(x, k);
    let rest = &rows.data.rests[k];
    let mut columns = vec![Column::default(); 3];
    for (axis, column) in columns.iter_mut().enumerate() {
        let moved = u.cross(&axis_vector(axis));
        for (place, (own, _)) in rows.means(Sensor::Accelerometer).enumerate() {
            if own >= chunk && rest.chunks.contains(&own) {
                for i in 0..3 {
                    column.set(3 * place + i, -rows.gravity * moved[i]);
                }
            }
        }
        for (place, turn) in rows.data.turns.iter().enumerate() {
            if turn.from == k {
                let q = rotations[place];
                let shift = rows.charts[k + 1].across.transpose() * (q * -moved);
                let row = rows.first_turn_row() + 2 * place;
                column.set(row, shift[0]);
                column.set(row + 1, shift[1]);
            }
        }
    }
    columns
}

fn unit_columns(row: usize, count: usize) -> Vec<Column> {
    (0..count).map(|k| Column::unit(row + k)).collect()
}

fn pushed(chunk: usize, row: usize) -> Suspect {
    Suspect {
        kind: Disturbance::DisturbedInterval,
        reason: Reason::default(),
        place: chunk,
        columns: unit_columns(row, 3),
        nuisance: Vec::new(),
        slopes: Vec::new(),
        seen: Seen::default(),
    }
}

/// A chunk that was seen to shake: any force, and a creep of its rest.
pub fn pushed_chunk(
    rows: &Rows<'_>,
    x: &[f64],
    (chunk, shake): (usize, &Shake),
    rotations: &[Matrix3<f64>],
) -> Option<Suspect> {
    let place = rows
        .means(Sensor::Accelerometer)
        .position(|(place, _)| place == chunk)?;
    let mut suspect = pushed(chunk, 3 * place);
    let rest = rows.data.chunks[chunk].rest;
    let creep = slip(rows, x, rest, rotations);
    suspect.columns.extend(creep.columns);
    suspect.seen = Seen::Shaken {
        time: shake.time,
        ratio: shake.ratio,
    };
    Some(suspect)
}

/// A creep at the constant rate `ω` (rad/s, body frame) through rest `k`: `u̇ = u × ω`. Its gyroscope reads `ω`,
/// its chunks see gravity move, the turns beside it start and end half the angle away from its
/// mean direction.
fn slip(rows: &Rows<'_>, x: &[f64], k: usize, rotations: &[Matrix3<f64>]) -> Suspect {
    let rest = &rows.data.rests[k];
    let u = rows.direction(x, k);
    let (middle, half) = (
        0.5 * (rest.span.from + rest.span.to),
        0.5 * rest.span.length(),
    );
    let mut columns = vec![Column::default(); 3];
    let mut slopes = Vec::new();
    let mut row = 0;
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        for (place, chunk) in rows.means(sensor) {
            if rest.chunks.contains(&place) {
                creep_rows(rows, sensor, chunk, (u, middle), row, &mut columns);
            }
            row += 3;
        }
    }
    for (place, turn) in rows.data.turns.iter().enumerate() {
        let row = rows.first_turn_row() + 2 * place;
        for (axis, column) in columns.iter_mut().enumerate() {
            let moved = u.cross(&axis_vector(axis));
            let shift = if turn.from + 1 == k {
                // The device is at u − half·u̇ when the turn ends.
                rows.charts[k].across.transpose() * (moved * -half)
            } else if turn.from == k {
                // It is at u + half·u̇ when the turn begins; the model carries u.
                let q = rotations[place];
                rows.charts[k + 1].across.transpose() * (q * (moved * -half))
            } else {
                continue;
            };
            column.set(row, shift[0]);
            column.set(row + 1, shift[1]);
        }
    }
    for (_, chunk) in rows
        .means(Sensor::Accelerometer)
        .filter(|(c, _)| rest.chunks.contains(c))
    {
        if let (Some(mean), Some(noise)) = (
            chunk.accelerometer,
            rows.data.sources[rest.recording].accelerometer,
        ) {
            slopes.extend(creep_slopes(
                &mean,
                &(noise.variance_in_sum() + noise.restless(&mean)),
                &u,
                rows.gravity,
            ));
        }
    }
    Suspect {
        kind: Disturbance::MountSlip,
        reason: Reason::default(),
        place: k,
        columns,
        nuisance: drift(rows, k),
        slopes,
        seen: Seen::default(),
    }
}

/// A bias of the accelerometer that drifts evenly through rest `k`: a long rest at the begin shows the warm-up of
/// the device, which is no creep. None where the rest has fewer than [`LONG`] chunks.
fn drift(rows: &Rows<'_>, k: usize) -> Vec<Column> {
    let rest = &rows.data.rests[k];
    if rest.chunks.len() < LONG {
        return Vec::new();
    }
    let middle = 0.5 * (rest.span.from + rest.span.to);
    let mut columns = vec![Column::default(); 3];
    for (place, (chunk, of)) in rows.means(Sensor::Accelerometer).enumerate() {
        let Some(mean) = of.accelerometer.filter(|_| rest.chunks.contains(&chunk)) else {
            continue;
        };
        let since = 0.5 * (mean.span.from + mean.span.to) - middle;
        for (axis, column) in columns.iter_mut().enumerate() {
            column.set(3 * place + axis, since);
        }
    }
    columns
}

fn axis_vector(axis: usize) -> Vector3<f64> {
    let mut unit = Vector3::zeros();
    unit[axis] = 1.0;
    unit
}

/// Rows are model less measurement: what the measurement gains, they lose.
fn creep_rows(
    rows: &Rows<'_>,
    sensor: Sensor,
    chunk: &Chunk,
    (u, middle): (Vector3<f64>, f64),
    row: usize,
    columns: &mut [Column],
) {
    for (axis, column) in columns.iter_mut().enumerate() {
        let unit = axis_vector(axis);
        let change = match (sensor, chunk.accelerometer, chunk.gyroscope) {
            (Sensor::Accelerometer, Some(mean), _) => {
                let since = 0.5 * (mean.span.from + mean.span.to) - middle;
                u.cross(&unit) * (rows.gravity * since)
            }
            (Sensor::Gyroscope, _, Some(_)) => unit,
            _ => continue,
        };
        for i in 0..3 {
            column.set(row + i, -change[i]);
        }
    }
}

/// The slope of specific force within a chunk, `g u × ω`, over its standard deviation.
fn creep_slopes(
    mean: &Mean,
    variance: &Vector3<f64>,
    u: &Vector3<f64>,
    gravity: f64,
) -> Vec<(Vec<f64>, f64)> {
    (0..3)
        .map(|i| {
            let sigma = (variance[i] / mean.spread).sqrt();
            let by = (0..3)
                .map(|axis| gravity * u.cross(&axis_vector(axis))[i] / sigma)
                .collect();
            (by, mean.slope[i] / sigma)
        })
        .collect()
}
