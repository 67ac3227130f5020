//! Remainders of gravity under a calibration, rest by rest and turn by turn.

use nalgebra::Vector3;
use recording::intervals::{Moments, Segmentation, Span, StaticInterval, Turn};
use recording::{Error, Recording, Stream};

use super::field::fields;
use crate::calibration::{Calibration, apply_with};
use crate::residuals::{Integrator, attitude_of};

findings::tuning! {
    /// One static interval or turn in so many may be spoilt, and is no error of the calibration.
    MAY_BE_SPOILT: usize = 8;
}

/// The places of residuals but the largest, some of which may be spoilt, the smallest first.
pub(crate) fn unspoilt<T>(all: &[T], size: impl Fn(&T) -> f64) -> Vec<usize> {
    let mut places: Vec<usize> = (0..all.len()).collect();
    places.sort_by(|&a, &b| size(&all[a]).total_cmp(&size(&all[b])));
    places.truncate(all.len() - all.len() / MAY_BE_SPOILT.get());
    places
}

/// Residual of a calibration in one static interval or one turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// Its place in [`Segmentation::statics`], or that of the rest before the turn.
    pub index: usize,
    /// Begin and end by the stamps, s.
    pub span: Span,
    /// `|f| − g`, m/s², or the angle by which the predicted direction of gravity misses, degrees.
    pub value: f64,
}

/// A residual by its components, and the variance of one by the noise of the readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Miss {
    /// Its components, as many as count, m/s² or rad.
    pub value: Vector3<f64>,
    pub count: usize,
    pub variance: f64,
}

impl Miss {
    pub fn size(&self) -> f64 {
        self.value.norm()
    }
}

/// The misfit of every rest and of every sound turn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Misfits {
    /// Residuals of gravity's norm in the static intervals, m/s².
    pub rests: Vec<Misfit>,
    /// Residuals of its direction after the turns, degrees.
    pub turns: Vec<Misfit>,
    /// Mean corrected rate in each rest, rad/s.
    pub rates: Vec<Vector3<f64>>,
    /// Norm of the magnetic field in each rest and its angle to the specific force, degrees.
    pub fields: Vec<[f64; 2]>,
    /// Residuals of the norm with their noise.
    pub(crate) norms: Vec<Miss>,
    /// Those of the direction.
    pub(crate) directions: Vec<Miss>,
}

/// Measures a calibration, or the raw readings with `None`, rest by rest and turn by turn.
///
/// # Errors
/// As [`crate::calibration::apply`].
pub fn misfits(
    recording: &Recording,
    segmentation: &Segmentation,
    calibration: Option<&Calibration>,
    gravity: f64,
) -> Result<Misfits, Error> {
    let corrected = match calibration {
        Some(c) => apply_with(c, recording, Some(segmentation))?,
        None => recording.clone(),
    };
    let spans: Vec<_> = segmentation.statics.iter().map(|rest| rest.span).collect();
    let rests = Segmentation::from_spans(&corrected, &spans, segmentation.multiplier);
    let norm = |(index, rest): (usize, &StaticInterval)| {
        Some(Misfit {
            index,
            span: rest.span,
            value: rest.accelerometer?.mean.norm() - gravity,
        })
    };
    let sound = segmentation.turns.iter().filter(|t| t.fault.is_none());
    let missed = |turn: &Turn| missed_by(corrected.gyroscope.as_ref()?, &rests, turn);
    let (turns, directions): (Vec<&Turn>, Vec<Miss>) =
        sound.filter_map(|turn| Some((turn, missed(turn)?))).unzip();
    let direction = |(turn, miss): (&&Turn, &Miss)| Misfit {
        index: turn.from,
        span: turn.span,
        value: miss.size().to_degrees(),
    };
    let of_force = rests.statics.iter().filter_map(|rest| rest.accelerometer);
    Ok(Misfits {
        norms: of_force
            .map(|own| Miss {
                value: Vector3::new(own.mean.norm() - gravity, 0.0, 0.0),
                count: 1,
                variance: of_mean(&own),
            })
            .collect(),
        rests: rests.statics.iter().enumerate().filter_map(norm).collect(),
        turns: turns.iter().zip(&directions).map(direction).collect(),
        directions,
        fields: fields(&corrected, &rests),
        rates: rests
            .statics
            .iter()
            .filter_map(|rest| Some(rest.gyroscope?.mean))
            .collect(),
    })
}

/// The variance of a component of a mean, by white noise.
fn of_mean(moments: &Moments) -> f64 {
    moments.covariance.trace() / 3.0 / moments.count as f64
}

/// The rotation by which the corrected rate misses gravity after a turn, rad.
fn missed_by(rate: &Stream, rests: &Segmentation, turn: &Turn) -> Option<Miss> {
    let (before, after) = (
        rests.statics.get(turn.from)?,
        rests.statics.get(turn.from + 1)?,
    );
    let bias: Vector3<f64> = 0.5 * (before.gyroscope?.mean + after.gyroscope?.mean);
    let values = &rate.values[turn.samples.clone()];
    let t = &rate.t[turn.samples.clone()];
    let attitude = attitude_of(Integrator::Exponential, t, |k| values[k] - bias);
    let predicted = attitude.into_body(&before.accelerometer?.mean);
    let measured = after.accelerometer?.mean;
    let axis = predicted.cross(&measured);
    let angle = predicted.angle(&measured);
    let noise = rate_noise(before, after)?;
    let length = turn.span.length();
    // Of the samples of the turn, of the bias that was taken off it, of gravity on both sides.
    let of_rate = noise.0 * length * rate.median_step()? + noise.1 * length * length;
    let of_gravity = of_mean(&before.accelerometer?) + of_mean(&after.accelerometer?);
    Some(Miss {
        value: axis.try_normalize(0.0).unwrap_or_default() * angle,
        count: 3,
        variance: of_rate + of_gravity / measured.norm_squared(),
    })
}

/// Variance of a component of the rate in the rests beside a turn, and of the mean of both.
fn rate_noise(before: &StaticInterval, after: &StaticInterval) -> Option<(f64, f64)> {
    let both = [before.gyroscope?, after.gyroscope?];
    let one = both.iter().map(|own| own.covariance.trace() / 6.0).sum();
    Some((one, 0.25 * both.iter().map(of_mean).sum::<f64>()))
}
