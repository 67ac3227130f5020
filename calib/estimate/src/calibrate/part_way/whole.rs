//! The gyroscope by all turns of a recording, whatever its unit and its axes.

use nalgebra::{Matrix3, Vector3};
use recording::Recording;
use recording::averages::{median, root_mean_square};
use recording::intervals::Segmentation;

use super::turn_sums::Turning;
use super::turns::robust_fit;
use crate::calibrate::checks::signed_axes;

findings::tuning! {
    /// Fewest turns.
    FEWEST: usize = 6;
    /// Passes of the linear fit about the last one.
    PASSES: usize = 5;
    /// Axes as they are named meet gravity so well, rad: no others are tried.
    MEETS: f64 = 0.35;
}
/// Scales that are tried: that of the readings, degrees per second for radians and the reverse, and twice and half of it.
const SCALES: [f64; 5] = [
    1.0,
    std::f64::consts::PI / 180.0,
    180.0 / std::f64::consts::PI,
    2.0,
    0.5,
];

/// The matrix that carries the rates of a recording to those of the turns.
pub(in crate::calibrate) struct ByTurns {
    /// To rad/s.
    pub t: Matrix3<f64>,
    /// By how much the turns miss gravity with it, root mean square, rad.
    pub missed: f64,
    /// About the standard error of its elements, as a share.
    pub std: f64,
}

/// The gyroscope by the turns between directions of gravity, `start` being what should carry its readings to rad/s.
pub(in crate::calibrate) fn gyroscope_by_turns(
    recording: &Recording,
    segmentation: &Segmentation,
    directions: &[Option<Vector3<f64>>],
    start: &Matrix3<f64>,
) -> Option<ByTurns> {
    let turns = super::turnings(recording, segmentation, directions);
    if turns.len() < FEWEST.get() {
        return None;
    }
    let start = first(&turns, start)?;
    let (t, carried) = robust_fit(&turns, start, PASSES.get())?;
    let angles: Vec<f64> = carried.iter().map(super::turn::Carried::angle).collect();
    let missed = root_mean_square(&angles);
    t.iter().all(|v| v.is_finite()).then(|| ByTurns {
        t,
        missed,
        std: 2.0 * missed / (turns.len() as f64).sqrt(),
    })
}

/// The best of the usual scales, and of the axes where none meets gravity.
fn first(turns: &[Turning<'_>], start: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let miss = |t: &Matrix3<f64>| {
        let each = turns.iter().map(|turn| turn.missed(t));
        median(each).unwrap_or(f64::INFINITY)
    };
    let best = |all: Vec<Matrix3<f64>>| {
        let each = all.into_iter().map(|t| (miss(&t), t));
        each.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let (least, named) = best(SCALES.map(|scale| start * scale).to_vec())?;
    if least < MEETS.get() {
        return Some(named);
    }
    let any = signed_axes().into_iter().map(|axes| axes * start);
    let (turned, axes) = best(any.collect())?;
    Some(if turned < least { axes } else { named })
}
