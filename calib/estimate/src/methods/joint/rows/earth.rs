//! The rotation of the earth in the rows, where no latitude is given.

use nalgebra::{Matrix3, Vector3};
use sensor::attitude::Attitude;
use sensor::{Base, Sensor, inverse};

use crate::methods::joint::blocks::columns::Columns;
use crate::methods::joint::rows::Rows;

impl Rows<'_> {
    /// Builds the columns of a unit rotation of the earth in the rows: the gyroscope at rest reads it, and turns
    /// contain it. The first columns are the vertical part (up) in every recording. The others are two horizontal parts
    /// in every stretch through which the heading can be followed, as each begins with a heading of its own
    /// (`m × (recordings + 2 headings)`).
    ///
    /// The vertical part is the same in all recordings of one place. Weights take it as independent in each recording,
    /// which keeps their rows apart; the stated errors are those of one common part (`JointFit::of_place`).
    pub fn earth_columns(&self, x: &[f64]) -> Columns {
        let attitudes = self.attitudes(x);
        let recordings = self.data.sources.len();
        // In the order of the axes of the level frame.
        let places = |rest: usize| {
            let rest = &self.data.rests[rest];
            let horizontal = recordings + 2 * rest.heading;
            [horizontal, horizontal + 1, rest.recording]
        };
        let mut of_group = vec![Vec::new(); recordings];
        for (k, rest) in self.data.rests.iter().enumerate() {
            of_group[rest.recording].extend(places(k));
        }
        for own in &mut of_group {
            own.sort_unstable();
            own.dedup();
        }
        let count = recordings + 2 * self.data.headings();
        let mut columns = Columns::zeros(self.groups(), count, of_group);
        for mean in self.means(Sensor::Gyroscope) {
            let rest = mean.chunk.rest;
            let base = Base::from_parameters(&self.local_at_rest(x, Sensor::Gyroscope, rest));
            let through = inverse(&base.t).unwrap_or_else(Matrix3::identity);
            let seen = through * into_body(attitudes.at_rest(rest));
            for i in 0..3 {
                for (k, place) in places(rest).into_iter().enumerate() {
                    columns.set(mean.row + i, place, seen[(i, k)]);
                }
            }
        }
        for (number, (row, turn)) in self.turns().enumerate() {
            let p = self.local(x, Sensor::Gyroscope, turn.from);
            let carried = self.carried(turn, &self.rates(turn, &p));
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
                for (k, place) in places(turn.from).into_iter().enumerate() {
                    columns.set(row + i, place, change[(i, k)]);
                }
            }
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
