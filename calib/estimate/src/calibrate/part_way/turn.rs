//! One turn: the direction of gravity carried through it, and what moves that.

use nalgebra::{Matrix3, Rotation3, Vector3};
use recording::Stream;

/// Gravity carried through a turn: its error and the derivatives by the matrix of the gyroscope.
#[derive(Clone, Debug)]
pub(super) struct Carried {
    /// By how much gravity is missed, in the frame of the turn's begin: `C u₁ − u₀`.
    pub miss: Vector3<f64>,
    /// `∂miss/∂T_ij`, rad, column 3 i + j.
    pub slopes: [Vector3<f64>; 9],
}

impl Carried {
    /// The angle by which gravity is missed, rad.
    pub fn angle(&self) -> f64 {
        2.0 * (0.5 * self.miss.norm()).min(1.0).asin()
    }

    /// The derivative of the miss along a change of the matrix, rad.
    pub fn along(&self, change: &Matrix3<f64>) -> Vector3<f64> {
        let element = |(i, slope): (usize, &Vector3<f64>)| slope * change[(i / 3, i % 3)];
        self.slopes.iter().enumerate().map(element).sum()
    }
}

/// Rates of a turn by raw readings less their bias, with their stamps.
#[derive(Clone, Debug)]
pub(super) struct Rates<'a> {
    pub stream: &'a Stream,
    pub samples: std::ops::Range<usize>,
    pub bias: Vector3<f64>,
}

/// From one sample to the next: raw readings less the bias, and the time between them.
#[derive(Clone, Copy, Debug)]
struct Step {
    ends: [Vector3<f64>; 2],
    dt: f64,
}

/// The order of rotations within a step, in twelfths of `dt² ω₀ × ω₁`: two where samples are of instants and two and a half where they are means
/// over their steps, for a rate that changes smoothly and rests before and after the turn.
const ORDER: f64 = 2.25;

impl Step {
    /// The mean of the raw readings.
    fn mean(&self) -> Vector3<f64> {
        0.5 * (self.ends[0] + self.ends[1])
    }

    /// The rotation with `ω = T W`.
    fn rotation(&self, t: &Matrix3<f64>) -> Rotation3<f64> {
        let [first, last] = self.ends.map(|raw| t * raw * self.dt);
        Rotation3::new(0.5 * (first + last) + ORDER / 12.0 * first.cross(&last))
    }
}

impl Rates<'_> {
    fn steps(&self) -> impl Iterator<Item = Step> + '_ {
        let t = &self.stream.t[self.samples.clone()];
        let values = &self.stream.values[self.samples.clone()];
        let pairs = t.windows(2).zip(values.windows(2));
        pairs.map(|(t, v)| Step {
            ends: [v[0] - self.bias, v[1] - self.bias],
            dt: t[1] - t[0],
        })
    }

    /// The rotation from the turn's end to its begin with `ω = T (W − b)`.
    pub fn rotation(&self, t: &Matrix3<f64>) -> Matrix3<f64> {
        let steps = self.steps();
        steps.fold(Matrix3::identity(), |c, step| c * step.rotation(t).matrix())
    }

    /// Gravity carried from `before` to `after`.
    pub fn carry(&self, t: &Matrix3<f64>, before: &Vector3<f64>, after: &Vector3<f64>) -> Carried {
        let mut c = Matrix3::identity();
        let mut turned = [Matrix3::zeros(); 3];
        for step in self.steps() {
            let (raw, next) = (step.mean(), c * step.rotation(t).matrix());
            let middle = (c + next) * (0.5 * step.dt);
            for (axis, sum) in turned.iter_mut().enumerate() {
                *sum += middle * raw[axis];
            }
            c = next;
        }
        // C e^[θ×] u₁ = C u₁ + θ × u₀: what T adds to the rotation θ turns the end into the begin.
        let slope = |k: usize| turned[k % 3].column(k / 3).into_owned().cross(before);
        Carried {
            miss: c * after - before,
            slopes: std::array::from_fn(slope),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_central_differences() {
        let stream = Stream {
            t: (0..201).map(|k| 0.01 * f64::from(k)).collect(),
            values: (0..201)
                .map(|k| {
                    let s = (0.0157 * f64::from(k)).sin();
                    Vector3::new(s, 0.4 * s * s, -0.3 * s)
                })
                .collect(),
        };
        let rates = Rates {
            stream: &stream,
            samples: 0..201,
            bias: Vector3::new(0.01, 0.02, -0.01),
        };
        let t = Matrix3::new(1.01, 0.01, 0.0, 0.02, 0.98, 0.01, 0.0, -0.01, 1.0);
        let before = Vector3::new(0.3, -0.5, 0.8).normalize();
        let after = rates.rotation(&t).transpose() * before;
        let carried = rates.carry(&t, &before, &after);
        assert!(carried.miss.norm() < 1e-12);
        for k in 0..9 {
            let mut moved = [t; 2];
            moved[0][(k / 3, k % 3)] += 1e-5;
            moved[1][(k / 3, k % 3)] -= 1e-5;
            let [more, less] = moved.map(|t| rates.rotation(&t) * after);
            let slope = (more - less) / 2e-5;
            assert!((slope - carried.slopes[k]).norm() < 1e-4, "{k}");
        }
    }

    #[test]
    fn a_fast_turn_whose_axis_moves_leads_where_it_leads() {
        // A rate at 100 Hz that rests before and after, as instants and as means, and the rotation in steps of a hundredth of that.
        let rate = |t: f64| {
            let s = (std::f64::consts::PI * t.clamp(0.0, 1.0)).sin().powi(2);
            Vector3::new(
                8.0 * s,
                6.0 * s * (5.0 * t).cos(),
                6.0 * s * (5.0 * t).sin(),
            )
        };
        let fine = |k: usize| rate((k as f64 + 0.5) * 1e-4) * 1e-4;
        let right = (0..10_000).fold(Matrix3::identity(), |c, k| {
            c * Rotation3::new(fine(k)).matrix()
        });
        let mean = |k: usize| (0..100).map(|i| fine(100 * k + i)).sum::<Vector3<f64>>() / 1e-2;
        let samples = (0..100).map(mean).collect::<Vec<_>>();
        let instants = (0..100).map(|k| rate((k as f64 + 0.5) * 1e-2)).collect();
        for values in [samples, instants] {
            let stream = Stream {
                t: (0..100).map(|k| (f64::from(k) + 0.5) * 1e-2).collect(),
                values,
            };
            let rates = Rates {
                stream: &stream,
                samples: 0..100,
                bias: Vector3::zeros(),
            };
            let off = rates.rotation(&Matrix3::identity()) * right.transpose();
            let off = Rotation3::from_matrix_unchecked(off).angle();
            assert!(off < 5e-4, "{off}");
        }
    }
}
