//! Recordings as the joint problem sees them: means of chunks of rests, and turns between them.

mod add;
pub(crate) mod budget;
pub(crate) mod mean;
mod temperature;

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};
use recording::Recording;
use recording::intervals::{Segmentation, Span, TurnFault};
use sensor::{Kinematics, Sensor};

use super::clock::{ClockMode, SourceClock, TurnClock};
use super::noise::SensorNoise;
use crate::methods::joint::blocks::groups::RowGroups;
pub use crate::methods::joint::data::mean::Mean;
use crate::methods::joint::disturbance::shake::Shake;
use crate::truth::RawUnit;

findings::tuning! {
    /// More disturbances than this share of the rests, and the noise is at fault, not the rests.
    pub(crate) MOST_DISTURBED: f64 = 0.2;
}

/// A part of a rest, short against the drift of a bias.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chunk {
    /// Place of its rest among all.
    pub rest: usize,
    /// The accelerometer.
    pub accelerometer: Option<Mean>,
    /// The gyroscope.
    pub gyroscope: Option<Mean>,
    /// Mean temperature, °C, where it was recorded.
    pub temperature: Option<f64>,
    /// Its derivative, K/s, and whether it rises (1) or falls (−1).
    pub thermal: [f64; 2],
}

impl Chunk {
    /// The mean of a sensor; the joint estimate has none of a magnetometer.
    pub fn mean(&self, sensor: Sensor) -> Option<Mean> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer,
            Sensor::Gyroscope => self.gyroscope,
            Sensor::Magnetometer => None,
        }
    }
}

/// A static interval: one direction of specific force.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Place of its recording.
    pub recording: usize,
    /// Place in the recording's segmentation.
    pub interval: usize,
    /// The stretch through which the heading can be followed, among all: another one begins with every recording and after
    /// every turn that is not used.
    pub heading: usize,
    /// Span of the interval after trimming.
    pub span: Span,
    /// When the turn before it ended, s.
    pub turned: f64,
    /// Time, temperature and history.
    pub known: Kinematics<f64>,
    /// Its chunks among all.
    pub chunks: Range<usize>,
}

/// A turn between two rests.
#[derive(Clone, Debug)]
pub struct TurnSamples {
    /// Place of its recording.
    pub recording: usize,
    /// Place in the recording's segmentation.
    pub turn: usize,
    /// The rest before it; the one after it is the next.
    pub from: usize,
    /// Begin and end by the stamps, s.
    pub span: Span,
    /// Middle of each sample's window, s; a few samples of the rests at either end.
    pub t: Vec<f64>,
    /// Length of each sample's window, s.
    pub lengths: Vec<f64>,
    /// The readings, near SI units.
    pub samples: Vec<Vector3<f64>>,
    /// Mean rates over the samples' windows, near SI units.
    pub readings: Vec<Vector3<f64>>,
    /// Other inputs of the effects at the samples; empty where nothing asks for them.
    pub known: Vec<Kinematics<f64>>,
    /// The clocks behind stamps that scatter; empty where there is nothing to choose.
    pub clocks: Vec<TurnClock>,
    /// Interpolation errors of the inner samples from their neighbours, less the part that noise explains, rad/s; empty
    /// where they are negligible.
    pub shocks: Vec<Vector3<f64>>,
}

/// A turn that is not used.
#[derive(Clone, Debug, PartialEq)]
pub struct LostTurn {
    /// Place of its recording.
    pub recording: usize,
    /// Place in the recording's segmentation.
    pub turn: usize,
    /// Begin and end by the stamps, s.
    pub span: Span,
    /// Why.
    pub fault: TurnFault,
}

/// Noise and clock of one recording.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name, as the user gave it.
    pub name: String,
    /// Noise of the accelerometer, near SI units.
    pub accelerometer: Option<SensorNoise>,
    /// Noise of the gyroscope, near SI units.
    pub gyroscope: Option<SensorNoise>,
    /// True if its temperature was recorded.
    pub has_thermometer: bool,
    /// The time that walks of the biases are counted from while the noise is judged, s: the edge of a chunk
    /// near the middle. The biases of a fit are means over the rests.
    pub reference: f64,
    /// The clock of the gyroscope in turns.
    pub clock: SourceClock,
    /// Shares of the variance that means over rests have of what batches of readings say, accelerometer and gyroscope.
    pub noise_shares: [f64; 2],
}

impl Source {
    /// The noise of a sensor, near SI units.
    pub fn noise(&self, sensor: Sensor) -> Option<SensorNoise> {
        match sensor {
            Sensor::Accelerometer => self.accelerometer,
            Sensor::Gyroscope => self.gyroscope,
            Sensor::Magnetometer => None,
        }
    }

    /// Returns true if the device sways at rest and comes back, so that turns begin and end off its mean direction
    /// there.
    pub fn moves_at_rest(&self) -> bool {
        self.noise_shares.iter().any(|share| *share < 1.0)
    }

    /// Returns true if a sensor without coarse steps shows that the device sways: readings in steps wider than the
    /// noise vary by themselves.
    pub fn sways(&self) -> bool {
        let sensors = [&self.accelerometer, &self.gyroscope].into_iter();
        let mut shares = sensors.zip(self.noise_shares);
        shares.any(|(noise, share)| {
            share < 1.0 && noise.is_some_and(|noise| noise.rounding.amax() == 0.0)
        })
    }
}

/// All recordings.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// The recordings.
    pub sources: Vec<Source>,
    /// Their rests, in order.
    pub rests: Vec<Rest>,
    /// The chunks of the rests, in order.
    pub chunks: Vec<Chunk>,
    /// The sound turns.
    pub turns: Vec<TurnSamples>,
    /// The others.
    pub lost: Vec<LostTurn>,
    /// The chunks that shake, by their place.
    pub shaken: Vec<(usize, Shake)>,
    /// Touches that broke a static interval, each with the places of its recording and of its turn.
    pub broken: Vec<(usize, usize, Span)>,
    /// The rests with gaps in them.
    pub gaps: Vec<(usize, Span)>,
    /// `T` of the gyroscope in its static intervals, near SI units. It is not fitted there: static intervals show the bias
    /// and turns show `T`. Where a bias steps, or depends on the orientation, the intervals would outweigh the turns, and
    /// `T` would follow the bias.
    pub axes_at_rest: Matrix3<f64>,
}

/// One recording on its way into [`Data`].
#[derive(Clone, Copy, Debug)]
pub struct Cut<'a> {
    /// The recording.
    pub recording: &'a Recording,
    /// Its rests and turns.
    pub segmentation: &'a Segmentation,
    /// The unit of the accelerometer.
    pub force_unit: RawUnit,
    /// The unit of the gyroscope.
    pub rate_unit: RawUnit,
    /// Clock by which the turns are integrated.
    pub clock: ClockMode,
}

impl Data {
    /// Returns the cost of one step of the solver, in samples of turns: their integration, and the factorisation of a
    /// matrix that grows with the static intervals.
    pub fn cost_of_a_step(&self) -> usize {
        let samples: usize = self.turns.iter().map(|turn| turn.readings.len()).sum();
        samples + self.rests.len().pow(3) / 4
    }

    /// The rows of every recording: means of the accelerometer, of the gyroscope, three rows each, then turns, two each.
    pub fn row_groups(&self) -> RowGroups {
        let of_chunk = |chunk: &Chunk| self.rests[chunk.rest].recording;
        let of_means = |sensor: Sensor| {
            let own = self.chunks.iter().filter(move |c| c.mean(sensor).is_some());
            own.flat_map(move |chunk| [of_chunk(chunk); 3])
        };
        let force = of_means(Sensor::Accelerometer);
        let rate = of_means(Sensor::Gyroscope);
        let turns = self.turns.iter().flat_map(|turn| [turn.recording; 2]);
        RowGroups::of_count(force.chain(rate).chain(turns).collect(), self.sources.len())
    }

    /// The mean specific force of a rest near SI units, m/s²; `None` without an accelerometer.
    pub(crate) fn mean_force(&self, rest: &Rest) -> Option<Vector3<f64>> {
        let means = self.chunks[rest.chunks.clone()].iter();
        let means = means.filter_map(|chunk| chunk.accelerometer);
        let (sum, count) = means.fold((Vector3::zeros(), 0.0), |(sum, n), mean| {
            (sum + mean.value * mean.count as f64, n + mean.count as f64)
        });
        (count > 0.0).then(|| sum / count)
    }

    /// Stretches through which the heading can be followed.
    pub(crate) fn headings(&self) -> usize {
        self.rests.last().map_or(0, |rest| rest.heading + 1)
    }

    /// Returns true if the rate of a recording jumps between samples in any turn.
    pub(crate) fn jumps(&self, recording: usize) -> bool {
        let mut own = self.turns.iter().filter(|t| t.recording == recording);
        own.any(|turn| !turn.shocks.is_empty())
    }

    /// Returns true if a recording moves between its samples, so that its turns miss by more than noise.
    pub fn misses_something_between_samples(&self) -> bool {
        let mut shares = self.sources.iter().map(|s| s.clock.sampling.value);
        shares.any(|share| share > 0.0)
    }

    /// Returns true if the device sways at rest in any recording.
    pub fn moves_at_rest(&self) -> bool {
        self.sources.iter().any(Source::moves_at_rest)
    }

    /// Returns the number of static intervals that shake, where they are too many to have been touched one by one.
    pub fn shakes_throughout(&self) -> Option<usize> {
        let mut rests: Vec<usize> = self
            .shaken
            .iter()
            .map(|(chunk, _)| self.chunks[*chunk].rest)
            .collect();
        rests.sort_unstable();
        rests.dedup();
        let most = (MOST_DISTURBED.get() * self.rests.len() as f64).ceil() as usize;
        (rests.len() > most).then_some(rests.len())
    }
}
