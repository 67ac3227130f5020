//! Effect of steps wider than the noise on the means over static intervals and on the turns.

use nalgebra::{Matrix2x3, Vector3};
use sensor::Sensor;

use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::data::{Source, TurnSamples};
use crate::methods::joint::rows::Rows;
use crate::methods::joint::rows::turn::MARGIN;

impl Rows<'_> {
    /// Builds the columns of the rounding of the gyroscope's readings in its means over the static intervals and in the
    /// turns, by recording and axis (`m × 3 recordings`); `None` where the noise averages it out.
    ///
    /// The rate in a static interval is the bias every time. Readings in steps wider than the noise are therefore off
    /// by the same amount in every interval, with the standard deviation `LSB/√12`, and several intervals do not
    /// average it out. The same holds for those samples of a turn in which an axis reads what it reads at rest.
    pub fn rounding_columns(&self, x: &[f64]) -> Option<Columns> {
        let is_coarse = |source: &Source| {
            let noise = source.gyroscope.as_ref();
            noise.is_some_and(|n| n.rounding.max() > 0.0)
        };
        if !self.data.sources.iter().any(is_coarse) {
            return None;
        }
        let recordings = 0..self.data.sources.len();
        let of_group = recordings.map(|k| vec![3 * k, 3 * k + 1, 3 * k + 2]);
        let count = 3 * self.data.sources.len();
        let mut columns = Columns::zeros(self.groups(), count, of_group.collect());
        let mut levels = vec![Vector3::zeros(); self.data.sources.len()];
        for own in self.means(Sensor::Gyroscope) {
            let recording = self.data.rests[own.chunk.rest].recording;
            if let Some(noise) = self.data.sources[recording].gyroscope {
                levels[recording] = own.mean.value;
                for axis in 0..3 {
                    let size = -noise.rounding[axis].sqrt();
                    columns.set(own.row + axis, 3 * recording + axis, size);
                }
            }
        }
        for (row, turn) in self.turns() {
            let Some(noise) = &self.data.sources[turn.recording].gyroscope else {
                continue;
            };
            let held = self.held(x, turn, &levels[turn.recording], &noise.step);
            for axis in 0..3 {
                let size = noise.rounding[axis].sqrt();
                for i in 0..2 {
                    columns.set(row + i, 3 * turn.recording + axis, size * held[(i, axis)]);
                }
            }
        }
        Some(columns)
    }

    /// Computes the derivative of the two rows of a turn by a shift, per axis, of the samples that read what they read
    /// at rest.
    fn held(
        &self,
        x: &[f64],
        turn: &TurnSamples,
        level: &Vector3<f64>,
        step: &Vector3<f64>,
    ) -> Matrix2x3<f64> {
        let mut held = Matrix2x3::zeros();
        for (reading, gain) in turn.readings[MARGIN..].iter().zip(self.gains(x, turn)) {
            for axis in 0..3 {
                if (reading[axis] - level[axis]).abs() < step[axis] {
                    held.set_column(axis, &(held.column(axis) + gain.column(axis)));
                }
            }
        }
        held
    }
}
