//! A bias that jumps to and fro between two levels, as that of a sensor with random telegraph noise does.

use estimate::methods::joint::{BiasNoise, Column};
use faer::Mat;
use findings::{Finding, Kind};
use sensor::Sensor;

use super::biases::{AtLevel, OfSensor};
use super::two_levels::{TwoLevels, search};
use crate::rank::log_sum;
use crate::state::State;

findings::tuning! {
    /// Stretches that a recording is cut into at most: the search takes as long as the square of their number.
    STRETCHES: usize = 120;

    /// One jump is a step, which is an effect of the catalogue, and two are an excursion.
    LEAST_JUMPS: usize = 3;
}

/// A bias on two levels.
#[derive(Clone, Debug)]
pub(super) struct Jumps {
    /// The sensor.
    pub sensor: Sensor,
    /// The axis.
    pub axis: usize,
    /// Number of jumps.
    pub count: usize,
    /// The rows of the chunks on the upper level.
    above: Vec<usize>,
    /// Height of the upper level above the other, m/s² or rad/s; negative where it is the lower one.
    pub change: f64,
    /// The noise of the biases beside it.
    pub noise: BiasNoise,
    /// The likelihood ratio.
    pub statistic: f64,
    /// `ln p`, the places of the jumps paid for.
    pub log_p: f64,
}

impl Jumps {
    /// The finding.
    pub fn finding(&self) -> Finding {
        Finding::of(Kind::BIAS_TWO_LEVELS)
            .of_sensor(self.sensor)
            .detail("axis", ["x", "y", "z"][self.axis])
            .count("count", self.count)
    }

    /// Degrees of freedom: how far it jumps, and when.
    pub fn dof(&self) -> f64 {
        1.0 + self.count as f64
    }

    /// Returns the indicator column of the chunks on the upper level, white-whitened (`m × 1`).
    pub fn columns(&self, state: &State) -> Mat<f64> {
        let mut column = Column::none();
        self.above.iter().for_each(|&row| column.set(row, 1.0));
        state.sparse(&[&column]).to_dense()
    }
}

/// The likeliest jumps of every axis that has some.
///
/// How a bias jumps is looked for at every setting of the densities; the chance is a mean over them, as of effects.
pub(super) fn jumps(sensors: &[OfSensor]) -> Vec<Jumps> {
    let of_sensor = |own: &OfSensor| -> Vec<Jumps> {
        let stretches = Stretches::of(own);
        let all = own.axes.iter().enumerate();
        all.filter_map(|(axis, levels)| of_axis(own, &stretches, (axis, levels)))
            .collect()
    };
    sensors.iter().flat_map(of_sensor).collect()
}

fn of_axis(
    own: &OfSensor,
    stretches: &Stretches,
    (axis, levels): (usize, &Vec<AtLevel>),
) -> Option<Jumps> {
    let found = |level: &AtLevel| {
        let (gram, right) = level.biases.normal(&stretches.of_part, stretches.count);
        search(&gram, &right)
    };
    let all = levels.iter();
    let all: Vec<(&AtLevel, TwoLevels)> = all.filter_map(|l| Some((l, found(l)?))).collect();
    let likelihood = |(level, found): &(&AtLevel, TwoLevels)| level.gained + found.likelier;
    let (level, likeliest) = all
        .iter()
        .max_by(|a, b| likelihood(a).total_cmp(&likelihood(b)))?;
    // A mean over what the densities may be under it, as of effects.
    let weighed = all.iter().map(|of| likelihood(of) + of.1.log_p());
    let log_p = log_sum(weighed) - log_sum(all.iter().map(likelihood));
    let rows = stretches.of_chunk.iter().zip(&own.rows);
    let above = rows.filter(|(stretch, _)| likeliest.above[**stretch]);
    Some(Jumps {
        sensor: own.sensor,
        axis,
        count: likeliest.count,
        above: above.map(|(_, row)| row + axis).collect(),
        change: likeliest.change,
        noise: level.noise,
        statistic: 2.0 * level.gained + likeliest.ratio,
        log_p: if likeliest.count < LEAST_JUMPS.get() {
            0.0
        } else {
            log_p
        },
    })
}

/// Chunks that are taken together, in the order of time, recording after recording.
struct Stretches {
    count: usize,
    /// The stretch of every chunk.
    of_chunk: Vec<usize>,
    /// The stretch of the chunks of every part.
    of_part: Vec<Vec<usize>>,
}

impl Stretches {
    fn of(own: &OfSensor) -> Self {
        let n = own.times.len();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| {
            let (a, b) = (own.times[a], own.times[b]);
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        let count = n.min(STRETCHES.get());
        let mut of_chunk = vec![0; n];
        for (place, chunk) in order.into_iter().enumerate() {
            of_chunk[chunk] = place * count / n;
        }
        let of_part = own.together.iter();
        let of_part = of_part.map(|part| part.iter().map(|&chunk| of_chunk[chunk]).collect());
        Self {
            count,
            of_part: of_part.collect(),
            of_chunk,
        }
    }
}
