//! Readings of an accelerometer that still change after each turn, and what that does to the parameters.

mod decay;
mod hypothesis;
mod not_excluded;
mod rested;
mod tested;
mod way;

use faer::Mat;
use findings::{Finding, Findings, Kind};
use nalgebra::{DVector, Vector3};
use recording::Recording;
use sensor::{Quantity, Sensor};

use self::decay::Decay;
pub use self::decay::Trials;
pub use self::not_excluded::not_excluded;
pub use self::rested::Rested;
use crate::calibration::Calibration;
use crate::methods::joint::{BiasMotion, JointFit};

findings::tuning! {
    /// It is said where it moves a parameter by more than so many of its standard errors.
    WORTH: f64 = 1.0;
}

/// Readings that settle after the turns.
#[derive(Clone, Debug)]
pub struct AfterTurns {
    finding: Finding,
    /// True if that is the effect that the model lacks.
    is_what_lacks: bool,
    /// The parameters and how far the means of the static intervals put them off.
    off: Vec<(String, f64)>,
}

impl AfterTurns {
    /// Looks for readings that settle; `None` where they do not, or where it does not matter.
    pub fn of(
        fit: &JointFit,
        recordings: &[&Recording],
        within: &Trials<'_>,
        calibration: &Calibration,
    ) -> Option<Self> {
        let (decay, is_what_lacks) = decay_of(fit, recordings, within)?;
        let column = column_of(fit, &decay);
        let off = fit.moved_by(&column);
        let matters = off.iter().any(|(name, off)| {
            let std = calibration.standard_error_of(name);
            std.is_some_and(|std| off.abs() > WORTH.get() * std)
        });
        matters.then(|| Self {
            finding: said(&decay),
            is_what_lacks,
            off,
        })
    }

    /// Counts in the standard errors what the parameters are off by, and says it; that the model lacks an effect is said then.
    pub fn count(self, calibration: &mut Calibration, warnings: &mut Findings) {
        let values = calibration.parameter_values();
        let mut covariance = calibration.covariance_matrix();
        let own = |name: &String| {
            let mut off = self.off.iter();
            off.find(|(of, _)| of == name).map_or(0.0, |(_, off)| *off)
        };
        let off = calibration.parameters.iter().map(own);
        let off = DVector::from_iterator(calibration.parameters.len(), off);
        covariance += &off * off.transpose();
        calibration.write_parameters(&values, &covariance);
        let is_gyroscope = |found: &Finding| found.place.sensor == Some(Sensor::Gyroscope);
        if self.is_what_lacks {
            warnings.retain(|found| found.kind != Kind::EFFECT_MISSING || is_gyroscope(found));
        }
        // What is counted is not left out.
        let name = self.finding.kind.name();
        calibration.left_out.retain(|own| own.effect != name);
        warnings.push(self.finding);
    }
}

/// The readings in all static intervals; `None` where the model has an error after turns, or without an accelerometer.
pub fn rested_of<'a>(
    fit: &JointFit,
    recordings: &[&'a Recording],
    motions: &[Option<BiasMotion>],
) -> Option<Vec<Rested<'a>>> {
    let mut effects = fit.models[0].effects().iter();
    if effects.any(|effect| effect.needs().contains(&Quantity::SinceTurn)) {
        return None;
    }
    let rests = 0..fit.data.rests.len();
    rests.map(|k| rested(fit, recordings, motions, k)).collect()
}

/// The decay that the readings within the static intervals show, alone or with the means of the intervals, and whether it explains these best;
/// where an error that the catalogue knows explains the means better, these are not asked.
fn decay_of(
    fit: &JointFit,
    recordings: &[&Recording],
    within: &Trials<'_>,
) -> Option<(Decay, bool)> {
    let columns = within.seen_in_means();
    let columns = columns.iter().map(|own| column_of(fit, own));
    let columns: Vec<Vec<f64>> = columns.collect();
    let columns = Mat::from_fn(fit.residuals.len(), columns.len(), |i, k| columns[k][i]);
    let with_means = within.with_means(&fit.evidence_for(columns));
    let best = with_means.found().filter(|found| {
        found.is_in_means() && !fit.lacks_what_gains_more(recordings, found.gain_of_means())
    });
    if let Some(found) = best {
        return Some((with_means.slowest(&found)?, true));
    }
    let found = within.found()?;
    Some((within.slowest(&found)?, false))
}

/// The column that a decay adds to the rows.
fn column_of(fit: &JointFit, decay: &Decay) -> Vec<f64> {
    let mut column = vec![0.0; fit.residuals.len()];
    for own in fit.plain_rows().means(Sensor::Accelerometer) {
        let rest = own.chunk.rest;
        let left = decay.mean_left(&own.mean.span, fit.data.rests[rest].turned);
        let off = decay.at_first[rest] * left;
        column[own.row..own.row + 3].copy_from_slice(off.as_slice());
    }
    column
}

/// The readings in static interval `k`; `None` without an accelerometer.
fn rested<'a>(
    fit: &JointFit,
    recordings: &[&'a Recording],
    motions: &[Option<BiasMotion>],
    k: usize,
) -> Option<Rested<'a>> {
    let rests = &fit.data.rests;
    let rest = &rests[k];
    let mut flagged = fit.flagged.iter();
    let disturbed = flagged.any(|a| a.recording == rest.recording && a.interval == rest.interval);
    let is_first = k == 0 || rests[k - 1].recording != rest.recording;
    let stream = recordings.get(rest.recording)?.accelerometer.as_ref()?;
    let moved = motions.get(rest.recording).copied().flatten();
    let per_second = |own: BiasMotion| [own.change, own.std].map(|v| v / own.span.length());
    let [moved, moved_std] = moved.map(per_second).unwrap_or_default();
    let chunks = &fit.data.chunks[rest.chunks.clone()];
    let rows = fit.plain_rows();
    let x = &fit.parameters.values()[..rows.layout.disturbance(0)];
    let modelled = chunks
        .iter()
        .map(|chunk| rows.slope_within(x, Sensor::Accelerometer, chunk));
    let modelled = modelled.sum::<Vector3<f64>>() / chunks.len().max(1) as f64;
    let range = stream.between(rest.span.from, rest.span.to);
    Some(Rested {
        recording: rest.recording,
        t: &stream.t[range.clone()],
        values: &stream.values[range],
        unit: fit.force_unit.scale,
        turned: rest.turned,
        force: fit.data.mean_force(rest)?,
        drift: modelled + moved,
        drift_std: moved_std,
        follows_turn: !is_first,
        is_sound: !disturbed,
    })
}

/// The finding of a decay.
fn said(decay: &Decay) -> Finding {
    let squares = decay.at_first.iter().map(|error| error.norm_squared());
    let size = (squares.sum::<f64>() / decay.at_first.len().max(1) as f64).sqrt();
    Finding::of(Kind::SETTLES_AFTER_TURNS)
        .of_sensor(Sensor::Accelerometer)
        .number("size", size, "m/s^2")
        .number("within", decay.tau, "s")
        .affects("corrected_reading", size, "m/s^2")
}
