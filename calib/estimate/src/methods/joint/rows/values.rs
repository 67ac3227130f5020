//! The rows without derivatives, and what they mean to people.

use nalgebra::{Matrix3, Vector2, Vector3};
use recording::intervals::Span;
use sensor::{Base, Sensor};

use super::turn::rotation;
use crate::methods::joint::data::{Chunk, Mean, TurnSamples};
use crate::methods::joint::rows::{MeanRows, Rows};

findings::tuning! {
    /// Instants of a chunk that a slope is taken from.
    INSTANTS: u32 = 8;
}

impl Rows<'_> {
    /// The residuals at `x` (`m`).
    pub fn residuals(&self, x: &[f64]) -> Vec<f64> {
        let all: Vec<usize> = (0..self.count()).collect();
        self.residuals_of(x, &all)
    }

    pub(super) fn turn_residual(&self, x: &[f64], turn: &TurnSamples) -> Vector2<f64> {
        let predicted = self.rotation(x, turn) * self.direction(x, turn.from);
        let miss = predicted - self.direction(x, turn.from + 1);
        self.charts[turn.from + 1].across.transpose() * miss
    }

    pub(super) fn mean_residual(
        &self,
        x: &[f64],
        sensor: Sensor,
        MeanRows { chunk, mean, .. }: &MeanRows<'_>,
    ) -> Vector3<f64> {
        let p = self.local_at_rest(x, sensor, chunk.rest);
        let u = self.direction(x, chunk.rest);
        let truth = self.at_rest(chunk, mean, u);
        let reading = self.model(sensor).distort(&truth, &p);
        reading.map_or(Vector3::repeat(f64::NAN), |reading| reading - mean.value)
    }

    /// Returns the slope of a sensor's predicted reading within a chunk, per second, by a straight line through
    /// instants of it; zero without effects.
    pub fn slope_within(&self, x: &[f64], sensor: Sensor, chunk: &Chunk) -> Vector3<f64> {
        let (model, mean) = (self.model(sensor), chunk.mean(sensor));
        let Some(mean) = mean.filter(|_| !model.effects().is_empty()) else {
            return Vector3::zeros();
        };
        let p = self.local_at_rest(x, sensor, chunk.rest);
        let u = self.direction(x, chunk.rest);
        let (mut moment, mut spread) = (Vector3::zeros(), 0.0);
        for k in 0..INSTANTS.get() {
            let part = (f64::from(k) + 0.5) / f64::from(INSTANTS.get());
            let t = mean.span.from + part * mean.span.length();
            let span = Span { from: t, to: t };
            let truth = self.at_rest(chunk, &Mean { span, ..mean }, u);
            let Some(reading) = model.distort(&truth, &p) else {
                return Vector3::zeros();
            };
            let away = t - 0.5 * (mean.span.from + mean.span.to);
            moment += reading * away;
            spread += away * away;
        }
        moment / spread
    }

    /// The rotation over a turn at `x`: `v_after = R v_before`.
    pub fn rotation(&self, x: &[f64], turn: &TurnSamples) -> Matrix3<f64> {
        let p = self.local(x, Sensor::Gyroscope, turn.from);
        rotation(self.coning(turn), &self.rates(turn, &p), &turn.lengths)
    }

    /// The rotation over every turn.
    pub fn rotations(&self, x: &[f64]) -> Vec<Matrix3<f64>> {
        let turns = self.data.turns.iter();
        turns.map(|turn| self.rotation(x, turn)).collect()
    }

    /// The corrected rates of a turn, rad/s.
    pub(crate) fn rates(&self, turn: &TurnSamples, p: &[f64]) -> Vec<Vector3<f64>> {
        if self.gyroscope.effects().is_empty() {
            let base = Base::from_parameters(p);
            return turn.readings.iter().map(|w| base.correct(w)).collect();
        }
        let readings = turn.readings.iter().zip(&turn.known);
        readings
            .map(|(reading, known)| self.gyroscope.correct(reading, known, p))
            .collect()
    }

    /// The rest that each row speaks of; a turn's is the one before it.
    pub fn rest_of_row(&self) -> Vec<usize> {
        let mut rests = Vec::with_capacity(self.count());
        for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
            rests.extend(self.means(sensor).flat_map(|mean| [mean.chunk.rest; 3]));
        }
        rests.extend(self.data.turns.iter().flat_map(|turn| [turn.from; 2]));
        rests
    }

    /// The angle by which every turn misses the direction that the accelerometer shows after it, from
    /// the one it shows before, rad.
    pub fn chords(&self, x: &[f64]) -> Vec<f64> {
        self.data
            .turns
            .iter()
            .filter_map(|turn| {
                let before = self.force(x, turn.from)?.normalize();
                let after = self.force(x, turn.from + 1)?.normalize();
                Some((self.rotation(x, turn) * before - after).norm())
            })
            .collect()
    }

    /// `|f| − g` of every rest, m/s².
    pub fn norms(&self, x: &[f64]) -> Vec<f64> {
        (0..self.data.rests.len())
            .filter_map(|k| Some(self.force(x, k)?.norm() - self.gravity))
            .collect()
    }

    /// The corrected mean specific force of a rest, m/s².
    fn force(&self, x: &[f64], k: usize) -> Option<Vector3<f64>> {
        let rest = &self.data.rests[k];
        let p = self.local(x, Sensor::Accelerometer, k);
        let mean = self.data.mean_force(rest)?;
        Some(self.accelerometer.correct(&mean, &rest.known, &p))
    }
}
