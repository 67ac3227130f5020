//! Tests for shapes and wandering biases in the residuals of a model.

use estimate::methods::joint::BiasNoise;
use faer::Mat;
use findings::{Finding, Kind};
use sensor::{Quantity, Sensor};

use super::biases::biases;
use super::jumps::{Jumps, jumps};
use super::scatter::{Scatter, scatters};
use super::shape::Shape;
use super::shapes::shapes;
use crate::family::{Claim, Family};
use crate::gap::channel::Channel;
use crate::rank::{APART, Ranked, rank};
use crate::search::Name;
use crate::search::few_turns::Turns;
use crate::state::State;

/// The columns of a shape at the model that it was found beside.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaped {
    /// `m × k`, white-whitened.
    pub columns: Mat<f64>,
    /// Noise of the biases under it.
    pub noise: BiasNoise,
}

/// One of the tests for a rest: `ln p` with its search paid for, but not the number of tests.
pub(super) struct Trial {
    pub log_p: f64,
    /// Likelihood ratio or `χ²`, and its degrees of freedom.
    pub statistic: f64,
    /// The degrees of freedom.
    pub dof: f64,
    pub finding: Finding,
    /// The shape, of a trial that has one.
    pub of: Option<(Shape, Sensor)>,
    pub channel: Option<Channel>,
    pub period: Option<f64>,
    /// The only recording that shows it.
    pub recording: Option<String>,
    pub columns: Option<Shaped>,
    pub wandering: Option<(Sensor, usize)>,
    /// Contribution of the shape to the rows, white-whitened (`m × 1`).
    pub predicted: Option<Mat<f64>>,
}

/// The tests that say what the rest looks like, each by itself.
pub struct Described {
    pub(super) trials: Vec<Trial>,
}

impl Trial {
    /// A test of a statistic that has no shape.
    pub(super) fn plain(log_p: f64, (statistic, dof): (f64, f64), finding: Finding) -> Self {
        Self {
            log_p,
            statistic,
            dof,
            finding,
            of: None,
            channel: None,
            period: None,
            recording: None,
            columns: None,
            wandering: None,
            predicted: None,
        }
    }
}

impl Described {
    /// Runs the tests on the residuals of a model; of shapes with a larger `−ln p` than `needed`, without the turns that speak for
    /// them most.
    pub fn of(state: &State, needed: f64) -> Self {
        let levels = state.levels();
        let is_slow = |f: &Family| matches!(f.claim, Claim::Shape(Shape::SlowTime, _));
        let (slow, others): (Vec<Family>, Vec<Family>) =
            shapes(state).into_iter().partition(is_slow);
        // Slow changes are judged at the likeliest walk alone: with many coefficients they could stand for any walk.
        let likeliest = &levels[..levels.len().min(1)];
        let mut trials = Vec::new();
        let turns = Turns::knocked(state);
        for (families, levels) in [(slow, likeliest), (others, levels)] {
            for mut ranked in rank(&state.projected, &families, levels) {
                let family = &families[ranked.family];
                if let Some(turns) = turns.as_ref().filter(|_| -ranked.log_p > needed) {
                    ranked.log_p +=
                        ranked.evidence - turns.evidence_without(state, family, &ranked);
                }
                trials.push(of_shape(state, family, &ranked));
            }
        }
        let sensors = biases(state, levels);
        let scatters = scatters(&sensors);
        trials.extend(jumps(&sensors).iter().map(|jumps| {
            let is_same = |s: &&Scatter| (s.sensor, s.axis) == (jumps.sensor, jumps.axis);
            match scatters.iter().find(is_same) {
                // What may as well wander otherwise or go with the placement is not said to jump.
                Some(wanders)
                    if jumps.log_p > wanders.log_p - APART.get() || wanders.is_forgotten() =>
                {
                    Trial {
                        log_p: jumps.log_p,
                        statistic: jumps.statistic,
                        dof: jumps.dof(),
                        ..of_scatter(wanders)
                    }
                }
                _ => of_jumps(state, jumps),
            }
        }));
        trials.extend(scatters.iter().map(of_scatter));
        Self { trials }
    }

    /// Returns true if one shape has more evidence than `needed`, and no named effect already describes it.
    pub fn has_better(&self, needed: f64, names: &[Name]) -> bool {
        let search = (self.trials.len() as f64).ln();
        let is_named = |t: &Trial| t.of.is_some_and(|of| is_covered(of, names));
        let mut trials = self.trials.iter();
        trials.any(|t| !is_named(t) && -t.log_p - search > needed)
    }
}

/// Returns true if a named effect already describes the shape.
fn is_covered((shape, sensor): (Shape, Sensor), names: &[Name]) -> bool {
    let quantity = match shape {
        Shape::Heading => Quantity::Attitude,
        Shape::LastTurn => Quantity::LastTurn,
        _ => return false,
    };
    names.iter().any(|name| match &name.claim {
        Claim::Effect(effect) => effect.sensor() == sensor && effect.needs().contains(&quantity),
        _ => false,
    })
}

fn of_scatter(scatter: &Scatter) -> Trial {
    Trial {
        channel: Some(channel_at_rest(scatter.sensor)),
        wandering: Some((scatter.sensor, scatter.axis)),
        ..Trial::plain(scatter.log_p, (scatter.statistic, 1.0), scatter.finding())
    }
}

fn of_jumps(state: &State, jumps: &Jumps) -> Trial {
    let columns = jumps.columns(state);
    Trial {
        channel: Some(channel_at_rest(jumps.sensor)),
        predicted: Some(&columns * faer::Scale(jumps.change)),
        columns: Some(Shaped {
            columns,
            noise: jumps.noise,
        }),
        wandering: Some((jumps.sensor, jumps.axis)),
        ..Trial::plain(jumps.log_p, (jumps.statistic, jumps.dof()), jumps.finding())
    }
}

fn of_shape(state: &State, family: &Family, ranked: &Ranked) -> Trial {
    let (shape, sensor) = match family.claim {
        Claim::Shape(shape, sensor) => (Some(shape), sensor),
        ref other => (None, other.sensor()),
    };
    let way = &family.hypotheses[ranked.hypothesis];
    let value = way.shape.map(|(_, v)| v);
    let period = value.filter(|_| shape == Some(Shape::Periodic));
    let recording = way.place.filter(|_| shape == Some(Shape::OneRecording));
    let recording = recording.map(|k| state.fit.data.sources[k].name.as_str());
    let finding = match shape {
        Some(shape) => Finding::of(shape.kind()).of_sensor(sensor),
        None => Finding::of(Kind::MORE_SCATTER),
    };
    let finding = match (period, recording, value) {
        (Some(period), ..) => finding.number("period", period, "s"),
        (_, Some(name), Some(t)) => finding
            .detail("where", name)
            .detail("moves", format!("steps {t:.0} s into the recording")),
        (_, Some(name), None) => finding.detail("where", name).detail("moves", "drifts"),
        _ => finding,
    };
    let columns = family.columns_of(ranked.hypothesis);
    let change = Mat::from_fn(columns.ncols(), 1, |i, _| ranked.score.change[i]);
    let log_p = ranked.log_p + family.log_places;
    Trial {
        of: shape.map(|shape| (shape, sensor)),
        period,
        recording: recording.map(String::from),
        predicted: Some(&columns * change),
        columns: Some(Shaped {
            columns,
            noise: ranked.noise,
        }),
        ..Trial::plain(log_p, (ranked.statistic, ranked.dof), finding)
    }
}

/// The channel in which static intervals show a sensor.
pub(super) fn channel_at_rest(sensor: Sensor) -> Channel {
    match sensor {
        Sensor::Accelerometer => Channel::StaticNorm,
        Sensor::Gyroscope | Sensor::Magnetometer => Channel::StaticRate,
    }
}
