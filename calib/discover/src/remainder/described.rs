//! Tests for shapes and wandering biases in the residuals of a model.

use estimate::methods::joint::BiasNoise;
use faer::Mat;
use findings::{Finding, Kind};
use sensor::Sensor;

use super::biases::biases;
use super::jumps::{Jumps, jumps};
use super::scatter::{Scatter, scatters};
use super::shape::Shape;
use super::shapes::shapes;
use crate::family::{Claim, Family};
use crate::gap::channel::Channel;
use crate::rank::{APART, Ranked, rank};
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

/// The tests that say what the rest looks like.
#[derive(Clone, Debug)]
pub struct Described {
    /// Families with the evidence for each.
    shapes: [(Vec<Family>, Vec<Ranked>); 2],
    scatters: Vec<Scatter>,
    jumps: Vec<Jumps>,
}

impl Described {
    /// Runs the tests on the residuals of a model.
    pub fn of(state: &State) -> Self {
        let levels = state.levels();
        let is_slow = |f: &Family| matches!(f.claim, Claim::Shape(Shape::SlowTime, _));
        let (slow, others): (Vec<Family>, Vec<Family>) =
            shapes(state).into_iter().partition(is_slow);
        // Slow changes are judged at the likeliest walk alone: with many coefficients they could stand for any walk.
        let likeliest = &levels[..levels.len().min(1)];
        let judged = [(slow, likeliest), (others, levels)];
        let sensors = biases(state, levels);
        Self {
            shapes: judged.map(|(families, levels)| {
                let ranked = rank(&state.projected, &families, levels);
                (families, ranked)
            }),
            scatters: scatters(&sensors),
            jumps: jumps(&sensors),
        }
    }

    /// Every test by itself; of shapes with a larger `−ln p` than `needed`, without the turns that speak for them most.
    pub(super) fn trials(&self, state: &State, needed: f64) -> Vec<Trial> {
        let turns = Turns::knocked(state);
        let of_shape = |family: &Family, ranked: &Ranked| {
            let mut ranked = ranked.clone();
            if let Some(turns) = turns.as_ref().filter(|_| -ranked.log_p > needed) {
                ranked.log_p += ranked.evidence - turns.evidence_without(state, family, &ranked);
            }
            of_shape(state, family, &ranked)
        };
        let shapes = self.shapes.iter().flat_map(|(families, ranked)| {
            let each = ranked.iter();
            each.map(|r| of_shape(&families[r.family], r))
        });
        let of_jumps = |jumps: &Jumps| {
            let is_same = |s: &&Scatter| (s.sensor, s.axis) == (jumps.sensor, jumps.axis);
            match self.scatters.iter().find(is_same) {
                // What may as well wander otherwise or go with the placement is not said to jump.
                Some(wanders) if jumps.log_p > wanders.log_p - APART || wanders.is_forgotten() => {
                    Trial {
                        log_p: jumps.log_p,
                        statistic: jumps.statistic,
                        dof: jumps.dof(),
                        ..of_scatter(wanders)
                    }
                }
                _ => of_jumps(state, jumps),
            }
        };
        let jumps = self.jumps.iter().map(of_jumps);
        let wanders = self.scatters.iter().map(of_scatter);
        shapes.chain(jumps).chain(wanders).collect()
    }
}

fn of_scatter(scatter: &Scatter) -> Trial {
    Trial {
        log_p: scatter.log_p,
        statistic: scatter.statistic,
        dof: 1.0,
        finding: scatter.finding(),
        of: None,
        channel: Some(channel_at_rest(scatter.sensor)),
        period: None,
        recording: None,
        columns: None,
        wandering: Some((scatter.sensor, scatter.axis)),
        predicted: None,
    }
}

fn of_jumps(state: &State, jumps: &Jumps) -> Trial {
    let columns = jumps.columns(state);
    Trial {
        log_p: jumps.log_p,
        statistic: jumps.statistic,
        dof: jumps.dof(),
        finding: jumps.finding(),
        of: None,
        channel: Some(channel_at_rest(jumps.sensor)),
        period: None,
        recording: None,
        predicted: Some(&columns * faer::Scale(jumps.change)),
        columns: Some(Shaped {
            columns,
            noise: jumps.noise,
        }),
        wandering: Some((jumps.sensor, jumps.axis)),
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
        None => Finding::of(Kind::MoreScatter),
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
    Trial {
        log_p: ranked.log_p + family.log_places,
        statistic: ranked.statistic,
        dof: ranked.dof,
        finding,
        of: shape.map(|shape| (shape, sensor)),
        channel: None,
        period,
        recording: recording.map(String::from),
        columns: Some(Shaped {
            columns: family.columns_of(ranked.hypothesis),
            noise: ranked.noise,
        }),
        wandering: None,
        predicted: Some(&columns * change),
    }
}

/// The channel in which static intervals show a sensor.
pub(super) fn channel_at_rest(sensor: Sensor) -> Channel {
    match sensor {
        Sensor::Accelerometer => Channel::StaticNorm,
        Sensor::Gyroscope | Sensor::Magnetometer => Channel::StaticRate,
    }
}
