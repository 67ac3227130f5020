//! What a session can tell at most of its three sensors: Fisher information at the truth.
//!
//! Measured are the mean readings of each static interval and what the gyroscope says of each turn between two of them:
//!
//! ```text
//! accelerometer  T⁻¹ Rᵀ g + b        gyroscope  b        magnetometer  T⁻¹ Rᵀ h + b
//! turn           log( (Π exp(T (w − b) dt))ᵀ R_before ᵀ R_after )
//! ```
//! with white noise of the simulator's densities. Unknown are the parameters, the attitude `R` of every interval, and
//! inclination and strength of the field `h`.

use calib::Error;
use calib::intervals::Span;
use calib::simulate::{Simulation, Truth};
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, UnitQuaternion, Vector3};
use sensor::{BASE_PARAMETERS, Base, Sensor, base_names};

/// Step of central differences. All is near linear, in 1, rad, m/s², rad/s and µT.
const STEP: f64 = 1e-5;

/// Longest step of the true rate's integral, s.
const LONGEST: f64 = 5e-3;

/// Shortest time from one static interval to the next, s: one that was found in two parts still has a known rotation between.
const SHORTEST: f64 = 1e-2;

/// What fixes a direction that nothing measures counts as known so well.
const TIED: f64 = 1e-7;

/// Standard errors of the best unbiased estimates, by name.
#[derive(Clone, Debug)]
pub struct Bound {
    names: Vec<String>,
    variances: Vec<f64>,
}

impl Bound {
    /// Of one parameter; `None` where it is fixed or not there.
    pub fn of(&self, name: &str) -> Option<f64> {
        let place = self.names.iter().position(|n| n == name)?;
        let variance = self.variances[place];
        (variance > 4.0 * TIED * TIED).then(|| variance.sqrt())
    }
}

/// The bound for static intervals at these `spans`, with the magnetometer or without. Parameters whose names are not `free` are
/// known; the magnetometer's `T` has the determinant 1.
///
/// # Errors
/// [`Error::NotEnough`] where the intervals do not determine the parameters.
pub fn bound(
    simulation: &Simulation,
    truth: &Truth,
    spans: &[Span],
    magnetometer: bool,
    free: impl Fn(&str) -> bool,
) -> Result<Bound, Error> {
    let mut known = Information::new(simulation, truth, spans, magnetometer);
    known.add_static_intervals();
    known.add_turns();
    known.tie(magnetometer, free);
    known.bound()
}

struct Information<'a> {
    simulation: &'a Simulation,
    truth: &'a Truth,
    spans: &'a [Span],
    sensors: Vec<Sensor>,
    /// Parameters of the sensors, one after the other, then inclination and logarithm of the strength.
    values: Vec<f64>,
    /// Body to level in each interval.
    attitudes: Vec<Rotation3<f64>>,
    /// Parameters, then a small rotation of each interval in body axes.
    matrix: DMatrix<f64>,
}

/// What is held of a sensor's parameters in the truth; the magnetometer's with a determinant of 1.
pub(super) fn parameters(truth: &Truth, sensor: Sensor) -> [f64; BASE_PARAMETERS] {
    let mut base = Base::from_parameters(truth.parameters(sensor).values());
    if sensor == Sensor::Magnetometer {
        base.t /= base.t.determinant().cbrt();
    }
    base.parameters()
}

/// Strength of the field in the unit of a magnetometer whose `T` has the determinant 1.
fn strength(truth: &Truth) -> f64 {
    let field = truth.spec.magnetic_field.unwrap_or_default().strength;
    let base = Base::from_parameters(truth.parameters(Sensor::Magnetometer).values());
    field / base.t.determinant().cbrt()
}

fn read(p: &[f64], signal: &Vector3<f64>) -> Vector3<f64> {
    let read = Base::from_parameters(p).distort(signal);
    read.unwrap_or_else(|| Vector3::repeat(f64::NAN))
}

impl<'a> Information<'a> {
    fn new(
        simulation: &'a Simulation,
        truth: &'a Truth,
        spans: &'a [Span],
        magnetometer: bool,
    ) -> Self {
        let mut sensors = vec![Sensor::Accelerometer, Sensor::Gyroscope];
        let mut values: Vec<f64> = Vec::new();
        if magnetometer {
            sensors.push(Sensor::Magnetometer);
        }
        for &sensor in &sensors {
            values.extend(parameters(truth, sensor));
        }
        if magnetometer {
            let field = truth.spec.magnetic_field.unwrap_or_default();
            values.extend([field.inclination.to_radians(), strength(truth).ln()]);
        }
        let attitude = |span: &Span| {
            let q = simulation.kinematics(0.5 * (span.from + span.to)).attitude;
            let q = nalgebra::Quaternion::new(q.w, q.v.x, q.v.y, q.v.z);
            UnitQuaternion::from_quaternion(q).to_rotation_matrix()
        };
        let size = values.len() + 3 * spans.len();
        Self {
            simulation,
            truth,
            spans,
            sensors,
            values,
            attitudes: spans.iter().map(attitude).collect(),
            matrix: DMatrix::zeros(size, size),
        }
    }

    fn places(&self, sensor: Sensor) -> Vec<usize> {
        let before = self.sensors.iter().take_while(|s| **s != sensor).count();
        (0..BASE_PARAMETERS)
            .map(|k| before * BASE_PARAMETERS + k)
            .collect()
    }

    fn rotation(&self, interval: usize) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.values.len() + 3 * interval + axis)
    }

    /// Adds what a measurement of three numbers tells of the unknowns at `places`: `JᵀWJ`. Unknowns beyond the parameters are
    /// rotations, zero at the truth.
    fn add(
        &mut self,
        places: &[usize],
        weight: &Matrix3<f64>,
        measured: impl Fn(&[f64]) -> Vector3<f64>,
    ) {
        let at = |place: &usize| self.values.get(*place).copied().unwrap_or(0.0);
        let x: Vec<f64> = places.iter().map(at).collect();
        let column = |k: usize| {
            let moved = |step: f64| {
                let mut x = x.clone();
                x[k] += step;
                measured(&x)
            };
            (moved(STEP) - moved(-STEP)) / (2.0 * STEP)
        };
        let columns: Vec<Vector3<f64>> = (0..x.len()).map(column).collect();
        for (i, a) in places.iter().zip(&columns) {
            for (j, b) in places.iter().zip(&columns) {
                self.matrix[(*i, *j)] += a.dot(&(weight * b));
            }
        }
    }

    fn add_static_intervals(&mut self) {
        let up = Vector3::z() * self.truth.spec.gravity;
        for (k, span) in self.spans.iter().enumerate() {
            let attitude = self.attitudes[k];
            for sensor in self.sensors.clone() {
                let white = self.truth.spec.noise(sensor).white;
                let weight = Matrix3::identity() * (span.length() / (white * white));
                let mut places = self.places(sensor);
                match sensor {
                    Sensor::Gyroscope => {
                        self.add(&places, &weight, |p| read(p, &Vector3::zeros()));
                    }
                    Sensor::Accelerometer => {
                        places.extend(self.rotation(k));
                        self.add(&places, &weight, |x| {
                            let (p, turn) = x.split_at(BASE_PARAMETERS);
                            read(p, &in_body(&attitude, turn, &up))
                        });
                    }
                    Sensor::Magnetometer => {
                        places.extend(self.rotation(k));
                        places.extend([self.values.len() - 2, self.values.len() - 1]);
                        self.add(&places, &weight, |x| {
                            let (p, rest) = x.split_at(BASE_PARAMETERS);
                            let (down, north) = rest[3].sin_cos();
                            let field = Vector3::new(0.0, north, -down) * rest[4].exp();
                            read(p, &in_body(&attitude, &rest[..3], &field))
                        });
                    }
                }
            }
        }
    }

    fn add_turns(&mut self) {
        let white = self.truth.spec.noise(Sensor::Gyroscope).white;
        for k in 1..self.spans.len() {
            let turn = Turn::of(
                self.simulation,
                self.truth,
                self.spans[k - 1].to,
                self.spans[k].from,
            );
            let Some(weight) = turn.covariance(white).try_inverse() else {
                continue;
            };
            let mut places = self.places(Sensor::Gyroscope);
            places.extend(self.rotation(k - 1));
            places.extend(self.rotation(k));
            let between = self.attitudes[k - 1].inverse() * self.attitudes[k];
            self.add(&places, &weight, |x| {
                let (p, turns) = x.split_at(BASE_PARAMETERS);
                let before = small(&turns[..3]);
                let after = small(&turns[3..]);
                let own = turn.rotation(&Base::from_parameters(p));
                angles(&(own.inverse() * before.inverse() * between * after))
            });
        }
    }

    /// Fixes what nothing measures (the heading without a field, the common scale of a magnetometer and its field) and what is known.
    fn tie(&mut self, magnetometer: bool, free: impl Fn(&str) -> bool) {
        if magnetometer {
            // d ln det T = tr(T⁻¹ dT)
            let places = self.places(Sensor::Magnetometer);
            let at = |step: f64, k: usize| {
                let mut p: Vec<f64> = places.iter().map(|i| self.values[*i]).collect();
                p[k] += step;
                Base::from_parameters(&p).t.determinant().ln()
            };
            let slopes: Vec<f64> = (0..BASE_PARAMETERS)
                .map(|k| (at(STEP, k) - at(-STEP, k)) / (2.0 * STEP))
                .collect();
            self.tie_along(&places, &slopes);
        } else if let Some(first) = self.attitudes.first() {
            let up = first.inverse() * Vector3::z();
            self.tie_along(&self.rotation(0), up.as_slice());
        }
        for (k, name) in self.names().iter().enumerate() {
            if !free(name) {
                self.tie_along(&[k], &[1.0]);
            }
        }
    }

    /// Fixes one combination of unknowns.
    fn tie_along(&mut self, places: &[usize], slopes: &[f64]) {
        for (i, a) in places.iter().zip(slopes) {
            for (j, b) in places.iter().zip(slopes) {
                self.matrix[(*i, *j)] += a * b / (TIED * TIED);
            }
        }
    }

    fn names(&self) -> Vec<String> {
        self.sensors.iter().flat_map(|s| base_names(*s)).collect()
    }

    fn bound(&self) -> Result<Bound, Error> {
        let size = self.matrix.nrows();
        let scale = DVector::from_fn(size, |k, _| self.matrix[(k, k)].sqrt().recip());
        let scaled = DMatrix::from_fn(size, size, |i, j| self.matrix[(i, j)] * scale[i] * scale[j]);
        let inverse = scaled
            .cholesky()
            .map(|factor| factor.inverse())
            .ok_or_else(|| Error::not_enough("the information is singular"))?;
        let names = self.names();
        let variance = |k: usize| inverse[(k, k)] * scale[k] * scale[k];
        Ok(Bound {
            variances: (0..names.len()).map(variance).collect(),
            names,
        })
    }
}

/// The rotation vector of a small rotation: that of the library takes an arc cosine near 1.
fn angles(r: &Rotation3<f64>) -> Vector3<f64> {
    Vector3::new(
        r[(2, 1)] - r[(1, 2)],
        r[(0, 2)] - r[(2, 0)],
        r[(1, 0)] - r[(0, 1)],
    ) * 0.5
}

fn small(turn: &[f64]) -> Rotation3<f64> {
    Rotation3::new(Vector3::from_column_slice(turn))
}

/// A vector of the level frame in body axes, where the attitude is off by a small rotation in body axes.
fn in_body(attitude: &Rotation3<f64>, turn: &[f64], v: &Vector3<f64>) -> Vector3<f64> {
    small(turn).inverse() * (attitude.inverse() * v)
}

/// What the gyroscope reads from one static interval to the next.
struct Turn {
    readings: Vec<Vector3<f64>>,
    step: f64,
    base: Base<f64>,
}

impl Turn {
    fn of(simulation: &Simulation, truth: &Truth, from: f64, to: f64) -> Self {
        let base = Base::from_parameters(&parameters(truth, Sensor::Gyroscope));
        let time = (to - from).max(SHORTEST);
        let count = (time / LONGEST).ceil();
        let step = time / count;
        let reading = |k: usize| {
            let rate = simulation
                .kinematics(from + (k as f64 + 0.5) * step)
                .angular_rate;
            base.distort(&rate).unwrap_or(rate)
        };
        Self {
            readings: (0..count as usize).map(reading).collect(),
            step,
            base,
        }
    }

    fn rotation(&self, base: &Base<f64>) -> Rotation3<f64> {
        let steps = self.readings.iter();
        let steps = steps.map(|w| Rotation3::new(base.correct(w) * self.step));
        steps.fold(Rotation3::identity(), |all, step| all * step)
    }

    /// Of its rotation vector, in the axes after it: `N² Σ M Mᵀ dt` with `M = R(t → end) T`.
    fn covariance(&self, white: f64) -> Matrix3<f64> {
        let mut to_end = Rotation3::identity();
        let mut sum = Matrix3::zeros();
        for reading in self.readings.iter().rev() {
            let own = to_end.inverse() * self.base.t;
            sum += own * own.transpose() * (white * white * self.step);
            to_end = Rotation3::new(self.base.correct(reading) * self.step) * to_end;
        }
        sum
    }
}
