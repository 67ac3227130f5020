//! Location of a disagreement between model and data: channel, intervals, covariate.

use estimate::methods::joint::{BiasNoise, Instant, Sampling, error_columns};
use faer::Mat;
use nalgebra::Vector3;
use sensor::Sensor;
use serde::Serialize;

use crate::gap::channel::Channel;
use crate::gap::sequence::Sequence;
use crate::rank::log_p_of;
use crate::score::log_tail;
use crate::state::State;

findings::tuning! {
    /// A channel disagrees where chance would show as much in one of so many recordings.
    CHANCE: f64 = 0.01;

    /// Intervals named per channel.
    INTERVALS: usize = 3;
}

/// A disagreement of one channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Disagreement {
    /// The channel.
    pub channel: Channel,
    /// The intervals that are missed most when the others predict them.
    #[serde(rename = "where")]
    pub place: String,
    /// Name of the covariate that correlates best with it.
    pub covariate: String,
    /// `√(χ²/dof)`.
    pub size: f64,
    /// Root mean square of it, in m/s², rad/s or rad.
    pub rms: Option<f64>,
}

/// The channels that disagree under this noise of the biases, largest first.
pub fn disagreements(state: &State, noise: BiasNoise) -> Vec<Disagreement> {
    let misfits = Sequence::of(state, noise).misfits(state);
    let mut all: Vec<Disagreement> = Channel::ALL
        .into_iter()
        .zip(misfits)
        .filter(|(_, misfit)| {
            misfit.dof > 0.0 && log_tail(misfit.chi2, misfit.dof) < CHANCE.get().ln()
        })
        .map(|(channel, misfit)| Disagreement {
            channel,
            place: worst_intervals(state, channel),
            covariate: best_covariate(state, channel).into(),
            size: misfit.gap(),
            rms: state.rms(channel),
        })
        .collect();
    all.sort_by(|a, b| b.size.total_cmp(&a.size));
    all
}

/// The intervals with the largest deleted residuals, `χ²` of their rows when all others predict them.
fn worst_intervals(state: &State, channel: Channel) -> String {
    let rows = state.rows();
    let [rate, turns] = state.fit.first_rows;
    let range = [0..rate, rate..turns, turns..rows][channel as usize].clone();
    let bare = state.projected.white();
    let mut misses: Vec<(f64, usize)> = (0..state.fit.data.rests.len())
        .filter_map(|rest| {
            let own: Vec<usize> = range
                .clone()
                .filter(|&i| state.fit.rest_of_row[i] == rest)
                .collect();
            let seen = bare.by_recording(state.projected.units(&own));
            let (mut p, y) = seen.normal(0..own.len(), &bare.z);
            (0..own.len()).for_each(|k| p[(k, k)] += 1e-9);
            let chi2 = y.dot(&p.cholesky()?.solve(&y));
            (!own.is_empty()).then_some((chi2 / own.len() as f64, rest))
        })
        .collect();
    misses.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut named: Vec<usize> = misses.iter().take(INTERVALS.get()).map(|m| m.1).collect();
    named.sort_unstable();
    let data = &state.fit.data;
    let several = data.sources.len() > 1;
    let names: Vec<String> = named
        .into_iter()
        .map(|k| {
            let rest = &data.rests[k];
            let source = if several {
                format!("{}:", data.sources[rest.recording].name)
            } else {
                String::new()
            };
            format!("{source}{}", rest.interval + 1)
        })
        .collect();
    format!("intervals {}", names.join(", "))
}

/// Candidate covariate of an error: its name and its value on each axis at one instant.
type Covariate = (&'static str, fn(&Instant<'_>) -> Vector3<f64>);

const COVARIATES: [Covariate; 11] = [
    ("time", |i| Vector3::repeat(i.truth.time)),
    ("temperature", |i| Vector3::repeat(i.truth.temperature)),
    ("specific force", |i| i.truth.specific_force),
    ("specific force squared", |i| {
        i.truth.specific_force.map(|f| f * f)
    }),
    ("size of specific force per axis", |i| {
        i.truth.specific_force.abs()
    }),
    ("rate squared", |i| i.truth.angular_rate.map(|w| w * w)),
    ("size of rate per axis", |i| i.truth.angular_rate.abs()),
    ("direction of the last turn", |i| i.truth.last_change),
    ("vibration", |i| i.truth.vibration),
    ("derivative of the temperature", |i| {
        Vector3::repeat(i.truth.temperature_rate)
    }),
    ("warming up or cooling down", |i| {
        Vector3::repeat(i.truth.warming)
    }),
];

/// The covariate whose coefficients, one per axis, explain most, where chance would not.
fn best_covariate(state: &State, channel: Channel) -> &'static str {
    let sensor = match channel {
        Channel::StaticNorm => Sensor::Accelerometer,
        _ => Sensor::Gyroscope,
    };
    let statistic = |covariate: &Covariate| {
        let columns = error_columns(
            &state.sensitivities,
            state.rows(),
            (sensor, Sampling::Every),
            3,
            |i, out| {
                let values = covariate.1(i);
                for axis in 0..3 {
                    let mut e = Vector3::zeros();
                    e[axis] = values[axis];
                    out.push(e);
                }
            },
        );
        let scales: Vec<f64> = columns.col_iter().map(|c| c.norm_max()).collect();
        let scaled = Mat::from_fn(columns.nrows(), 3, |i, k| {
            if scales[k] > 0.0 {
                columns[(i, k)] / scales[k]
            } else {
                0.0
            }
        });
        let columns = state.whitened(scaled);
        log_p_of(&state.projected, (sensor, &columns), state.walks())
    };
    let by_chance = (CHANCE.get() / COVARIATES.len() as f64).ln();
    COVARIATES
        .iter()
        .map(|c| (statistic(c), c.0))
        .filter(|(log_p, _)| *log_p < by_chance)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or("nothing tried", |best| best.1)
}
