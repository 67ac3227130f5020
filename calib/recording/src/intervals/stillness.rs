//! Selection of static intervals from the quiet stretches.

use nalgebra::Vector3;
use sensor::Base;

use super::rejected::{Reason, Rejected};
use super::spans::Span;
use super::stamps::Stamps;
use super::tilt::{means, tilt, turned_over};
use super::unexplained_turn::{MeanRate, turning};
use crate::readings::Range;
use crate::recording::{Recording, Stream};

findings::tuning! {
    /// Pieces whose scatter gives the standard error of a mean rate.
    PIECES: usize = 10;
}

/// Parts the quiet stretches into static intervals and those in which the device turns about the vertical,
/// is turned over slowly or, where `no_tilt` asks for it, tilts steadily. `base` carries the accelerometer's readings to m/s²,
/// `scale` the gyroscope's to rad/s.
pub(super) fn static_and_rejected(
    recording: &Recording,
    quiet: Vec<Span>,
    base: &Base<f64>,
    scale: f64,
    no_tilt: bool,
) -> (Vec<Span>, Vec<Rejected>) {
    let Some(force) = &recording.accelerometer else {
        return (quiet, Vec::new());
    };
    let stamps = Stamps::of(&force.t);
    let mut reasons: Vec<Option<Reason>> = match &recording.gyroscope {
        Some(gyroscope) => turns(force, &stamps, gyroscope, &quiet, base, scale),
        None => vec![None; quiet.len()],
    };
    let range = Range::of(&force.values);
    for (span, reason) in quiet.iter().zip(&mut reasons) {
        let samples = &force.values[stamps.between(span.from, span.to)];
        *reason = reason.or_else(|| range.spoils(samples).map(Reason::Clipped));
    }
    for (span, reason) in quiet.iter().zip(&mut reasons) {
        let samples = stamps.between(span.from, span.to);
        let Some(pieces) = means(force, samples, base).filter(|_| reason.is_none()) else {
            continue;
        };
        let steadily = no_tilt.then(|| tilt(&pieces)).flatten();
        *reason = steadily
            .or_else(|| turned_over(&pieces))
            .map(Reason::Tilting);
    }
    let (mut kept, mut rejected) = (Vec::new(), Vec::new());
    for (span, reason) in quiet.into_iter().zip(reasons) {
        match reason {
            Some(reason) => rejected.push(Rejected { span, reason }),
            None => kept.push(span),
        }
    }
    (kept, rejected)
}

fn turns(
    force: &Stream,
    of_force: &Stamps<'_>,
    gyroscope: &Stream,
    quiet: &[Span],
    base: &Base<f64>,
    scale: f64,
) -> Vec<Option<Reason>> {
    let of_rate = Stamps::of(&gyroscope.t);
    let rate = |span: &Span| {
        let rates = gyroscope.values.get(of_rate.between(span.from, span.to))?;
        let forces = force.values.get(of_force.between(span.from, span.to))?;
        let (mean, error) = mean_and_error(rates)?;
        let force = base.correct(&mean_and_error(forces)?.0);
        let spread: f64 = forces
            .iter()
            .map(|f| (base.correct(f) - force).norm_squared())
            .sum();
        Some(MeanRate {
            mean: mean * scale,
            error: error * scale,
            up: force.normalize(),
            seconds: span.to - span.from,
            spread: (spread / forces.len() as f64).sqrt() / force.norm(),
        })
    };
    let rates: Option<Vec<MeanRate>> = quiet.iter().map(rate).collect();
    // A stretch without samples of both cannot be judged, and the others not without it.
    let turning = rates.map_or_else(|| vec![None; quiet.len()], |rates| turning(&rates));
    turning
        .into_iter()
        .map(|rate| rate.map(Reason::Turning))
        .collect()
}

/// The mean and the standard error of one of its axes, by the scatter of the means of ten pieces.
fn mean_and_error(values: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    if values.is_empty() {
        return None;
    }
    let mean = values.iter().sum::<Vector3<f64>>() / values.len() as f64;
    let length = values.len().div_ceil(PIECES.get());
    let pieces = values.chunks_exact(length);
    let count = pieces.len().max(2) as f64;
    let scatter: f64 = pieces
        .map(|piece| (piece.iter().sum::<Vector3<f64>>() / length as f64 - mean).norm_squared())
        .sum();
    Some((mean, (scatter / 3.0 / (count - 1.0) / count).sqrt()))
}
