//! The rotation of the earth in the rows, where no latitude is given.

use faer::Mat;
use nalgebra::{Matrix3, Vector3};
use sensor::attitude::Attitude;
use sensor::{Base, Sensor, inverse};

use crate::methods::joint::rows::Rows;

impl Rows<'_> {
    /// What a unit rotation of the earth does to the rows: the gyroscope at rest reads it, turns contain it. The first
    /// column is the vertical part (up), then two horizontal ones for every recording, as each begins with a
    /// heading of its own (`m × (1 + 2 recordings)`).
    pub fn earth_columns(&self, x: &[f64]) -> Mat<f64> {
        let attitudes = self.attitudes(x);
        let mut columns = Mat::zeros(self.count(), 1 + 2 * self.data.sources.len());
        let places = |recording: usize| [1 + 2 * recording, 2 + 2 * recording, 0];
        let mut row = self.first_rate_row();
        for (_, chunk) in self.means(Sensor::Gyroscope) {
            let recording = self.data.rests[chunk.rest].recording;
            let base = Base::from_parameters(&self.local(x, Sensor::Gyroscope, recording));
            let through = inverse(&base.t).unwrap_or_else(Matrix3::identity);
            let seen = through * into_body(attitudes.at_rest(chunk.rest));
            for i in 0..3 {
                for (k, place) in places(recording).into_iter().enumerate() {
                    columns[(row + i, place)] = seen[(i, k)];
                }
            }
            row += 3;
        }
        for (number, turn) in self.data.turns.iter().enumerate() {
            let p = self.local(x, Sensor::Gyroscope, turn.recording);
            let (carried, _) = self.carried(turn, &p);
            let by_rotation = self.by_rotation(x, turn, &carried.rotation);
            let sum: Matrix3<f64> = carried
                .gains
                .iter()
                .zip(attitudes.in_turn(number))
                .map(|(gain, attitude)| gain * into_body(attitude))
                .sum();
            // The corrected rate contains it: what the rows gain at rest they lose here.
            let change = -(by_rotation * sum);
            for i in 0..2 {
                for (k, place) in places(turn.recording).into_iter().enumerate() {
                    columns[(row + i, place)] = change[(i, k)];
                }
            }
            row += 2;
        }
        columns
    }
}

/// The rotation from the level frame into the body's.
fn into_body(attitude: &Attitude<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[
        attitude.into_body(&Vector3::x()),
        attitude.into_body(&Vector3::y()),
        attitude.into_body(&Vector3::z()),
    ])
}
