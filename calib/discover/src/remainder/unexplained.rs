//! Finding about the disagreement that no effect of the catalogue explains.

use estimate::methods::joint::{BiasNoise, Chunk, Mean, SensorNoise, orthonormal};
use findings::{Finding, Kind};
use nalgebra::Vector3;
use sensor::Sensor;
use serde::Serialize;

use super::biases::biases;
use super::described::{Described, Shaped, Trial, channel_at_rest};
use super::scatter::scatters;
use crate::gap::channel::Channel;
use crate::gap::sequence::{Misfit, Sequence};
use crate::score::log_tail;
use crate::state::State;

findings::tuning! {
    /// A period explains more than this share of what is more than the noise.
    MOST: f64 = 0.6;
}

/// A disagreement that no effect of the catalogue explains.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unexplained {
    /// The channel that shows most of it.
    pub channel: Channel,
    /// `√(χ²/dof)` of that channel.
    pub size: f64,
    /// Root mean square of what that channel leaves, in m/s², rad/s or rad.
    pub rms: Option<f64>,
    /// Chance of so much where nothing is missing, over all that was tested.
    pub p_value: f64,
    /// Likelihood ratio of the shape, or `χ²` where it has none, and its degrees of freedom.
    pub statistic: f64,
    /// The degrees of freedom.
    pub dof: f64,
    /// The finding; documents have its text as `shape`.
    #[serde(rename = "shape", serialize_with = "findings::texts::what")]
    pub finding: Finding,
    /// Period, where it has one, s.
    pub period: Option<f64>,
    /// The only recording that shows it, of several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recording: Option<String>,
    /// The effect of the catalogue that has its shape, for `calibrate --effects`.
    pub fitted_by: Option<String>,
    /// Names that were withdrawn because this explains more than they do, or what they do.
    pub instead_of: Vec<String>,
    /// The columns of its shape, white-whitened (`m × k`), and the noise that it was found with.
    #[serde(skip)]
    pub columns: Option<Shaped>,
    /// The sensor and the axis whose bias wanders, where that is what remains.
    #[serde(skip)]
    pub wandering: Option<(Sensor, usize)>,
}

impl Unexplained {
    /// The remainder in words.
    pub fn shape(&self) -> String {
        self.finding.what()
    }
}

/// The disagreement that a model leaves, where it is significant (family-wise chance `alpha`).
pub fn rest_of(state: &State, alpha: f64) -> Option<Unexplained> {
    rest_beside(state, &Described::of(state, -alpha.ln()), alpha)
}

/// The disagreement that a model leaves, with what shapes say of it.
pub fn rest_beside(state: &State, described: &Described, alpha: f64) -> Option<Unexplained> {
    let sequence = Sequence::of(state, state.noise);
    let misfits = sequence.misfits(state);
    let shapeless = shapeless(state, &misfits)?;
    let trials: Vec<&Trial> = described.trials.iter().chain(&shapeless).collect();
    let count = trials.len() as f64;
    let trials = trials.iter().copied();
    let worst = trials.clone().min_by(|a, b| a.log_p.total_cmp(&b.log_p))?;
    let is_significant = |trial: &Trial| trial.log_p + count.ln() <= alpha.ln();
    if !is_significant(worst) {
        return None;
    }
    // Whatever goes with the placement looks like a wandering that is forgotten from one to the next: a shape that leaves no
    // wandering says more.
    let shapes = trials.clone();
    let shapes = shapes.filter(|trial| trial.columns.is_some() && is_significant(trial));
    let likeliest = shapes.min_by(|a, b| a.log_p.total_cmp(&b.log_p));
    let shape = likeliest.filter(|shape| {
        worst.wandering.is_some()
            && !(shape.columns.as_ref()).is_some_and(|shape| wanders_beside(state, shape, alpha))
    });
    let worst = shape.unwrap_or(worst);
    // The best of many periods explains a part of any bias that goes from placement to placement: a period is what leaves little.
    let others = trials.filter(|trial| trial.period.is_none());
    let other = others.min_by(|a, b| a.log_p.total_cmp(&b.log_p));
    let is_rather = |other: &&Trial| worst.period.is_some() && is_significant(other);
    let worst = match other.filter(is_rather) {
        Some(other) if !explains_most(state, worst) => other,
        _ => worst,
    };
    let log_p = worst.log_p + count.ln();
    let excess = |k: usize| (misfits[k].chi2 - misfits[k].dof) / misfits[k].dof.max(1.0).sqrt();
    let most = (1..3).fold(0, |best, k| if excess(k) > excess(best) { k } else { best });
    // The channel that shows most of the shape, where there is one; else that with the most excess.
    let shown = worst.predicted.as_ref().map(|p| sequence.channel_of(p));
    let channel = worst.channel.or(shown).unwrap_or(Channel::ALL[most]);
    Some(Unexplained {
        channel,
        size: misfits[channel as usize].gap(),
        rms: state.rms(channel),
        p_value: log_p.exp(),
        statistic: worst.statistic,
        dof: worst.dof,
        finding: worst.finding.clone(),
        period: worst.period,
        recording: worst.recording.clone(),
        fitted_by: worst.of.and_then(|(shape, sensor)| {
            let effect = shape.effect(sensor)?;
            Some(effect.name().to_owned())
        }),
        instead_of: Vec::new(),
        columns: worst.columns.clone(),
        wandering: worst.wandering,
    })
}

/// Returns true if a shape explains more than [`MOST`] of the disagreement.
fn explains_most(state: &State, trial: &Trial) -> bool {
    let Some((shape, at)) = trial
        .columns
        .as_ref()
        .and_then(|shape| Some((shape, state.projected.at(shape.noise)?)))
    else {
        return true;
    };
    let columns = orthonormal(&state.projected.columns(shape.columns.as_ref()));
    let left = at.beside(&at.columns(&columns)).square;
    at.square - left > MOST.get() * (at.square - state.projected.dof() as f64)
}

/// Returns true if a bias wanders significantly, at level `alpha`, with the shape in the model.
fn wanders_beside(state: &State, shape: &Shaped, alpha: f64) -> bool {
    let mut levels = state.levels().to_vec();
    let columns = orthonormal(&state.projected.columns(shape.columns.as_ref()));
    for level in &mut levels {
        level.whitened = level.whitened.beside(&level.whitened.columns(&columns));
    }
    let found = scatters(&biases(state, &levels));
    let count = found.len().max(1) as f64;
    found
        .iter()
        .any(|scatter| scatter.log_p + count.ln() <= alpha.ln())
}

/// The tests that say that there is more than the noise.
fn shapeless(state: &State, misfits: &[Misfit; 3]) -> Option<Vec<Trial>> {
    let whitened = state.projected.at(state.noise)?;
    let more = |channel: Option<Channel>, chi2: f64, dof: f64| Trial {
        channel,
        ..Trial::plain(
            log_tail(chi2, dof),
            (chi2, dof),
            Finding::of(Kind::MORE_SCATTER),
        )
    };
    // Where the rate jumps between samples, that is why turns scatter, by more than one share for all can say.
    let is_knocked = state.fit.data.misses_something_between_samples();
    let mut trials = Vec::new();
    if !is_knocked {
        trials.push(more(None, whitened.square, state.projected.dof() as f64));
    }
    for (channel, misfit) in Channel::ALL.into_iter().zip(misfits) {
        if !is_knocked || channel != Channel::Direction {
            trials.push(more(Some(channel), misfit.chi2, misfit.dof));
        }
    }
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let (chi2, dof) = slopes(state, sensor, state.noise);
        let drifts = Finding::of(Kind::DRIFT_AT_REST).of_sensor(sensor);
        trials.push(Trial {
            channel: Some(channel_at_rest(sensor)),
            ..Trial::plain(log_tail(chi2, dof), (chi2, dof), drifts)
        });
    }
    Some(trials)
}

/// `Σ (slope/σ)²` over the chunks of rests that nothing disturbed, and the number of slopes.
fn slopes(state: &State, sensor: Sensor, noise: BiasNoise) -> (f64, f64) {
    let data = &state.fit.data;
    let disturbed = |chunk: &Chunk| {
        let rest = &data.rests[chunk.rest];
        state
            .fit
            .flagged
            .iter()
            .any(|a| a.recording == rest.recording && a.interval == rest.interval)
    };
    let rows = state.fit.plain_rows();
    let x = &state.fit.parameters.values()[..rows.layout.disturbance(0)];
    let (mut chi2, mut dof) = (0.0, 0.0);
    for chunk in data.chunks.iter().filter(|chunk| !disturbed(chunk)) {
        let source = &data.sources[data.rests[chunk.rest].recording];
        let (mean, white) = (chunk.mean(sensor), source.noise(sensor));
        let place = usize::from(sensor != Sensor::Accelerometer);
        if let (Some(mean), Some(white)) = (mean, white) {
            let length = mean.span.length();
            let of_bias = |axis| noise.slope_variance(place, axis, length);
            let beyond = mean.slope - rows.slope_within(x, sensor, chunk);
            chi2 += slope_chi2(&mean, &beyond, &white, of_bias);
            dof += 3.0;
        }
    }
    (chi2, dof)
}

fn slope_chi2(
    mean: &Mean,
    slope: &Vector3<f64>,
    noise: &SensorNoise,
    of_bias: impl Fn(usize) -> f64,
) -> f64 {
    let white: Vector3<f64> = noise.variance_of(mean) * (mean.count as f64 / mean.spread);
    (0..3)
        .map(|i| slope[i].powi(2) / (white[i] + of_bias(i)))
        .sum()
}
