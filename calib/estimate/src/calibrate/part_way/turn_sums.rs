//! Normal equations of the misses of turns, and the changes of a gyroscope that are tried on them.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use sensor::Sensor;

use super::change::{Kind, Place};
use super::turn::{Carried, Rates};
use super::weigh::solved;

/// Elements of the matrix.
pub(super) const BASE: usize = 9;

findings::tuning! {
    /// Misses below this are alike, squared, rad².
    pub(super) FLOOR: f64 = 1e-12;
}

/// A turn between two static intervals.
#[derive(Clone, Debug)]
pub(super) struct Turning<'a> {
    pub rates: Rates<'a>,
    pub before: Vector3<f64>,
    pub after: Vector3<f64>,
    pub place: Place,
}

impl Turning<'_> {
    /// The angle by which gravity is missed with a matrix, rad.
    pub fn missed(&self, t: &Matrix3<f64>) -> f64 {
        let end: Vector3<f64> = self.rates.rotation(t) * self.after;
        end.angle(&self.before)
    }
}

pub(super) fn all_carried(turns: &[Turning<'_>], t: &Matrix3<f64>) -> Vec<Carried> {
    let carry = |turn: &Turning<'_>| turn.rates.carry(t, &turn.before, &turn.after);
    turns.iter().map(carry).collect()
}

pub(super) fn left(carried: &Carried, step: &DVector<f64>) -> Vector3<f64> {
    let moves = carried.slopes.iter().zip(step.iter());
    moves.fold(carried.miss, |sum, (slope, s)| sum + slope * *s)
}

/// Normal equations of the misses.
pub(super) struct Sums {
    pub normal: DMatrix<f64>,
    pub right: DVector<f64>,
    /// Weighted sum of their squares.
    pub squares: f64,
}

impl Sums {
    pub fn new(size: usize) -> Self {
        Self {
            normal: DMatrix::zeros(size, size),
            right: DVector::zeros(size),
            squares: 0.0,
        }
    }

    pub fn add(&mut self, carried: &Carried, extra: &[Vector3<f64>], weight: f64) {
        let columns: Vec<&Vector3<f64>> = carried.slopes.iter().chain(extra).collect();
        for (i, one) in columns.iter().enumerate() {
            self.right[i] -= weight * one.dot(&carried.miss);
            for (j, other) in columns.iter().enumerate() {
                self.normal[(i, j)] += weight * one.dot(other);
            }
        }
        self.squares += weight * carried.miss.norm_squared();
    }

    pub fn solution(&self) -> Option<DVector<f64>> {
        solved(&self.normal, &self.right, 0.0)
    }

    /// Sum of squares at the solution.
    pub fn left(&self, solution: &DVector<f64>) -> f64 {
        (self.squares - self.right.dot(solution)).max(0.0)
    }
}

/// Change to try: the readings are multiplied by `1 + Σ pᵢ Mᵢ`.
#[derive(Clone, Copy, Debug)]
pub(super) enum What {
    Scale(usize),
    AllScales,
    Turned,
}

impl What {
    pub const ALL: [Self; 5] = [
        Self::Scale(0),
        Self::Scale(1),
        Self::Scale(2),
        Self::AllScales,
        Self::Turned,
    ];

    pub fn generators(self) -> Vec<Matrix3<f64>> {
        match self {
            Self::Scale(k) => {
                let mut one = Matrix3::zeros();
                one[(k, k)] = 1.0;
                vec![one]
            }
            Self::AllScales => vec![Matrix3::identity()],
            Self::Turned => {
                let unit = |k| Vector3::ith(k, 1.0);
                (0..3).map(|k| unit(k).cross_matrix()).collect()
            }
        }
    }

    /// Returns the change of the readings that `p` reverses.
    pub fn kind(self, p: &[f64]) -> Kind {
        let share = |p: f64| 1.0 / (1.0 + p) - 1.0;
        let sensor = Sensor::Gyroscope;
        match self {
            Self::Scale(k) => Kind::Scale(sensor, Some(k), share(p[0])),
            Self::AllScales => Kind::Scale(sensor, None, share(p[0])),
            Self::Turned => Kind::Turned(sensor, Vector3::from_column_slice(p).norm()),
        }
    }
}
