//! Information of a sequence of placements and turns about both sensors.

use nalgebra::{DMatrix, Matrix2, Matrix3, Matrix3x2, SMatrix, Vector3};
use sensor::{Sensor, base_names};
use serde::Serialize;

use crate::accelerometer::{
    FORCE_NAMES, FORCE_PARAMETERS, FORCE_PLACES, ForceMatrix, force_covariance, reading_error,
};
use crate::turn::{Carried, Pace, Turn};

/// Parameters of both base models: nine of the accelerometer, nine and a bias of the gyroscope.
pub const PARAMETERS: usize = FORCE_PARAMETERS + 12;

/// An information matrix or a covariance of both sensors' parameters, SI units.
pub type Information = SMatrix<f64, PARAMETERS, PARAMETERS>;

/// The names in the order of [`Information`].
pub fn parameter_names() -> Vec<String> {
    let force = FORCE_NAMES.iter().map(|name| (*name).to_owned());
    force.chain(base_names(Sensor::Gyroscope)).collect()
}

/// The noise that a plan counts on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Noise {
    /// White noise density of the accelerometer, m/s²/√Hz.
    pub force: f64,
    /// White noise density of the gyroscope, rad/s/√Hz.
    pub rate: f64,
    /// Error of a placement beyond white noise on each axis, m/s².
    pub placement: f64,
    /// Error of a turn beyond white noise, rad.
    pub turn: f64,
    /// Local gravity, m/s².
    pub gravity: f64,
}

impl Default for Noise {
    /// A phone's.
    fn default() -> Self {
        Self {
            force: 2e-3,
            rate: 1e-4,
            placement: 0.0,
            turn: 0.0,
            gravity: 9.80665,
        }
    }
}

/// Durations of static intervals and turns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// The first rest, s.
    pub first_rest: f64,
    /// The others, s.
    pub rest: f64,
    /// Time cut off at either end of a static interval, s. The adjacent turn, with its noise, is longer by the same
    /// time. Detector and guard take 0.41 s in simulated sessions (`plan-study`). The other 0.14 s account for the
    /// estimation of the noise levels: the observed errors match 0.55 s.
    pub cut: f64,
    /// Pace of the turns.
    pub pace: Pace,
}

impl Default for Timing {
    fn default() -> Self {
        Self {
            first_rest: 60.0,
            rest: 6.0,
            cut: 0.55,
            pace: Pace::default(),
        }
    }
}

impl Timing {
    /// Seconds of the rest in place `k` that count.
    pub fn used(&self, k: usize) -> f64 {
        let rest = if k == 0 { self.first_rest } else { self.rest };
        (rest - 2.0 * self.cut).max(0.1)
    }
}

/// Two directions across `up`.
pub(crate) fn across(up: &Vector3<f64>) -> Matrix3x2<f64> {
    let own = Vector3::ith(up.iamin(), 1.0);
    let first = up.cross(&own).normalize();
    Matrix3x2::from_columns(&[first, up.cross(&first)])
}

/// One turn between two placements, in the coordinates across their directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// `∂(direction after)/∂(direction before)`.
    forward: Matrix2<f64>,
    /// By the gyroscope's twelve.
    by_rate: SMatrix<f64, 2, 12>,
    /// 1/rad².
    weight: f64,
}

impl Link {
    pub(crate) fn new(
        from: &Vector3<f64>,
        to: &Vector3<f64>,
        carried: &Carried,
        noise: &Noise,
        cut: f64,
    ) -> Self {
        let (before, after) = (across(from), across(to));
        let mut by_parameter = carried.by_parameter;
        // What is cut off the rests beside it: the bias alone, turned with the body before the turn.
        let mut bias = by_parameter.fixed_columns_mut::<3>(9);
        bias -= (carried.rotation + Matrix3::identity()) * cut;
        let small = after.transpose() * to.cross_matrix() * by_parameter;
        let duration = carried.duration + 2.0 * cut;
        Self {
            forward: after.transpose() * carried.rotation * before,
            by_rate: small,
            weight: 1.0 / (noise.rate.powi(2) * duration + noise.turn.powi(2)),
        }
    }
}

/// One placement: its direction and for how long it counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    up: Vector3<f64>,
    time: f64,
}

/// Adds up placements and turns; the direction of the one before is eliminated as the next comes.
///
/// Rows, `E` two directions across `u`: the mean of the accelerometer `−g δT u + δb + g E δ`, the mean of the gyroscope
/// `δb`, and the turn `δ' − Eᵀ R E δ − E'ᵀ [u']× (small rotation)`; all in readings over their noise.
#[derive(Clone, Debug)]
pub(crate) struct Chain<'a> {
    noise: &'a Noise,
    shared: Information,
    /// Information about the last placement's direction, and its cross terms with the shared parameters.
    own: Matrix2<f64>,
    with: SMatrix<f64, 2, PARAMETERS>,
}

impl<'a> Chain<'a> {
    pub(crate) fn new(known: &Information, noise: &'a Noise) -> Self {
        Self {
            noise,
            shared: *known,
            own: Matrix2::zeros(),
            with: SMatrix::zeros(),
        }
    }

    /// The first placement, or one after a break.
    pub(crate) fn begin(&mut self, place: &Place) {
        self.close();
        self.rest(place);
    }

    /// A turn and the placement after it.
    pub(crate) fn turn_to(&mut self, link: &Link, place: &Place) {
        let w = link.weight;
        let f = link.forward;
        let mut g = SMatrix::<f64, 2, PARAMETERS>::zeros();
        g.fixed_columns_mut::<12>(FORCE_PARAMETERS)
            .copy_from(&-link.by_rate);
        // The placement before: its own rows and its part of the turn.
        let own = self.own + f.transpose() * f * w;
        let with = self.with - f.transpose() * g * w;
        let rate = link.by_rate.transpose() * link.by_rate * w;
        let mut shared = self
            .shared
            .fixed_view_mut::<12, 12>(FORCE_PARAMETERS, FORCE_PARAMETERS);
        shared += rate;
        // It is eliminated.
        let cross = -f * w;
        let inverse = own.try_inverse().unwrap_or_else(Matrix2::zeros);
        let through = inverse * with;
        self.shared -= with.transpose() * through;
        self.own = Matrix2::identity() * w - cross * inverse * cross.transpose();
        self.with = g * w - cross * through;
        self.rest(place);
    }

    fn rest(&mut self, place: &Place) {
        let Noise {
            force,
            rate,
            placement,
            gravity,
            ..
        } = *self.noise;
        let w = 1.0 / (force * force / place.time + placement * placement);
        let mut j = SMatrix::<f64, 3, FORCE_PARAMETERS>::zeros();
        for (k, (row, column)) in FORCE_PLACES.iter().enumerate() {
            j[(*row, k)] = -gravity * place.up[*column];
        }
        for k in 0..3 {
            j[(k, 6 + k)] = 1.0;
        }
        let e = across(&place.up) * gravity;
        let mut shared = self
            .shared
            .fixed_view_mut::<FORCE_PARAMETERS, FORCE_PARAMETERS>(0, 0);
        shared += j.transpose() * j * w;
        self.own += e.transpose() * e * w;
        let mut with = self.with.fixed_columns_mut::<FORCE_PARAMETERS>(0);
        with += e.transpose() * j * w;
        for k in PARAMETERS - 3..PARAMETERS {
            self.shared[(k, k)] += place.time / (rate * rate);
        }
    }

    /// The information when the last direction is eliminated too.
    pub(crate) fn close(&mut self) -> Information {
        if let Some(inverse) = self.own.try_inverse() {
            self.shared -= self.with.transpose() * inverse * self.with;
        }
        (self.own, self.with) = (Matrix2::zeros(), SMatrix::zeros());
        self.shared
    }
}

/// A placement of a session: in place `k` of it.
pub(crate) fn place(up: &Vector3<f64>, k: usize, timing: &Timing) -> Place {
    Place {
        up: *up,
        time: timing.used(k),
    }
}

/// The information of placements with the turns between them (one fewer), beside what is known.
pub fn session_information(
    ups: &[Vector3<f64>],
    turns: &[Turn],
    known: &Information,
    noise: &Noise,
    timing: &Timing,
) -> Information {
    let mut chain = Chain::new(known, noise);
    for (k, up) in ups.iter().enumerate() {
        let next = place(up, k, timing);
        match k.checked_sub(1).and_then(|before| turns.get(before)) {
            Some(turn) => {
                let carried = turn.carry(&timing.pace);
                chain.turn_to(
                    &Link::new(&ups[k - 1], up, &carried, noise, timing.cut),
                    &next,
                );
            }
            None => chain.begin(&next),
        }
    }
    chain.close()
}

/// Predicted accuracy of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Prediction {
    /// Standard error of every parameter, in the order of [`parameter_names`]: 1, m/s², rad/s; infinite where one is open.
    pub standard_errors: Vec<f64>,
    /// Root mean square over all directions of the error of a corrected accelerometer reading at 1 g, m/s².
    pub force_error: f64,
    /// The same of a corrected gyroscope reading at 1 rad/s, rad/s.
    pub rate_error: f64,
}

impl Prediction {
    /// With an error that the elements of the accelerometer's `T` have together.
    #[must_use]
    pub(crate) fn with_scale(mut self, moved: &[f64; 6], noise: &Noise) -> Self {
        for (error, moved) in self.standard_errors.iter_mut().zip(moved) {
            *error = error.hypot(*moved);
        }
        let square: f64 = moved.iter().map(|v| v * v).sum();
        self.force_error = self
            .force_error
            .hypot((square / 3.0).sqrt() * noise.gravity);
        self
    }
}

findings::tuning! {
    /// Below this share of the largest a scaled pivot is rounding.
    OPEN: f64 = 1e-11;
}

/// Variances by information with parameters of different units, from the columns of the inverted factor; `None` where a
/// parameter is open.
pub(crate) fn variances(information: &Information) -> Option<[f64; PARAMETERS]> {
    let scale = information
        .diagonal()
        .map(|v| if v > 0.0 { v.sqrt().recip() } else { 0.0 });
    if scale.min() == 0.0 {
        return None;
    }
    let scaled = Information::from_fn(|i, j| information[(i, j)] * scale[i] * scale[j]);
    let factor = scaled.cholesky()?;
    let l = factor.l_dirty();
    let least = l.diagonal().min();
    if least * least < OPEN.get() {
        return None;
    }
    let mut all = [0.0; PARAMETERS];
    for (k, variance) in all.iter_mut().enumerate() {
        let mut column = [0.0; PARAMETERS];
        for i in k..PARAMETERS {
            let own = if i == k { 1.0 } else { 0.0 };
            let sum: f64 = (k..i).map(|j| l[(i, j)] * column[j]).sum();
            column[i] = (own - sum) / l[(i, i)];
        }
        *variance = column.iter().map(|v| v * v).sum::<f64>() * scale[k] * scale[k];
    }
    Some(all)
}

/// Predicts the accuracy from the information. If the gyroscope is undetermined, the accelerometer is judged by its own
/// part.
pub fn predict(information: &Information, noise: &Noise) -> Prediction {
    if let Some(variances) = variances(information) {
        let [force_error, rate_error] = reading_errors(&variances, noise.gravity);
        return Prediction {
            standard_errors: variances.iter().map(|v| v.sqrt()).collect(),
            force_error,
            rate_error,
        };
    }
    let mut errors = vec![f64::INFINITY; PARAMETERS];
    let own = information.fixed_view::<FORCE_PARAMETERS, FORCE_PARAMETERS>(0, 0);
    // Of unit size, with biases over gravity.
    let unit = |k: usize| if k < 6 { 1.0 } else { noise.gravity };
    let scaled = ForceMatrix::from_fn(|i, j| own[(i, j)] * unit(i) * unit(j));
    let mut force_error = f64::INFINITY;
    if let Some(c) = force_covariance(&scaled) {
        for (k, error) in errors.iter_mut().take(FORCE_PARAMETERS).enumerate() {
            *error = c[(k, k)].sqrt() * unit(k);
        }
        force_error = reading_error(&c) * noise.gravity;
    }
    Prediction {
        standard_errors: errors,
        force_error,
        rate_error: f64::INFINITY,
    }
}

/// Errors of corrected readings of both sensors, at gravity and at 1 rad/s.
pub(crate) fn reading_errors(d: &[f64; PARAMETERS], gravity: f64) -> [f64; 2] {
    let force = (0..6).map(|k| d[k] * gravity * gravity / 3.0).sum::<f64>()
        + (6..9).map(|k| d[k]).sum::<f64>();
    let rate = (9..18).map(|k| d[k] / 3.0).sum::<f64>() + (18..21).map(|k| d[k]).sum::<f64>();
    [force.sqrt(), rate.sqrt()]
}

/// Information from the covariance of some parameters by name. `None` where the covariance is no such.
pub fn information_of(names: &[String], covariance: &[Vec<f64>]) -> Option<Information> {
    let wanted = parameter_names();
    let places: Vec<(usize, usize)> = wanted
        .iter()
        .enumerate()
        .filter_map(|(k, name)| Some((k, names.iter().position(|n| n == name)?)))
        .collect();
    let own = DMatrix::from_fn(places.len(), places.len(), |i, j| {
        let row = covariance.get(places[i].1);
        row.and_then(|row| row.get(places[j].1))
            .copied()
            .unwrap_or(f64::NAN)
    });
    let inverse = own.cholesky()?.inverse();
    let mut information = Information::zeros();
    for (i, (a, _)) in places.iter().enumerate() {
        for (j, (b, _)) in places.iter().enumerate() {
            information[(*a, *b)] = inverse[(i, j)];
        }
    }
    Some(information)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accelerometer::{force_covariance, force_information};
    use crate::direction::edges;
    use crate::turn::{Leg, Speed, Way};

    /// About the axis across both, whether the body has it or not.
    fn short_ways(ups: &[Vector3<f64>]) -> Vec<Turn> {
        let short = |w: &[Vector3<f64>]| {
            let across = w[1].cross(&w[0]);
            if across.norm() < 1e-6 {
                return crate::turn::ways(&w[0], &w[1]).remove(0);
            }
            let angle = across.norm().atan2(w[0].dot(&w[1]));
            Turn {
                way: Way::Short,
                speed: Speed::Usual,
                legs: vec![Leg {
                    axis: across.normalize(),
                    angle,
                }],
            }
        };
        ups.windows(2).map(short).collect()
    }

    #[test]
    fn without_turns_the_accelerometer_is_what_the_norms_tell() {
        let ups = edges();
        let noise = Noise {
            rate: 1e3,
            ..Noise::default()
        };
        let timing = Timing {
            first_rest: 6.0,
            ..Timing::default()
        };
        let known = Information::zeros();
        let whole = session_information(&ups, &short_ways(&ups), &known, &noise, &timing);
        let norms = force_covariance(&force_information(&ups)).unwrap();
        let own = whole
            .fixed_view::<9, 9>(0, 0)
            .into_owned()
            .try_inverse()
            .unwrap();
        let sigma = noise.force / timing.used(1).sqrt();
        for k in 0..9 {
            let unit = if k < 6 { sigma / noise.gravity } else { sigma };
            let expected = norms[(k, k)].sqrt() * unit;
            assert!((own[(k, k)].sqrt() / expected - 1.0).abs() < 1e-4, "{k}");
        }
    }

    #[test]
    fn variances_are_those_of_the_inverse() {
        let ups = edges();
        let (noise, timing) = (Noise::default(), Timing::default());
        let known = Information::zeros();
        let whole = session_information(&ups, &short_ways(&ups), &known, &noise, &timing);
        let inverse = whole.cholesky().unwrap().inverse();
        for (k, found) in variances(&whole).unwrap().iter().enumerate() {
            assert!((found / inverse[(k, k)] - 1.0).abs() < 1e-6, "{k}");
        }
        assert!(variances(&known).is_none());
    }

    #[test]
    fn a_known_calibration_comes_back_from_its_covariance() {
        let ups = edges();
        let (noise, timing) = (Noise::default(), Timing::default());
        let whole = session_information(
            &ups,
            &short_ways(&ups),
            &Information::zeros(),
            &noise,
            &timing,
        );
        let c = whole.cholesky().unwrap().inverse();
        let rows: Vec<Vec<f64>> = (0..PARAMETERS)
            .map(|i| c.row(i).iter().copied().collect())
            .collect();
        let back = information_of(&parameter_names(), &rows).unwrap();
        for (i, j) in [(4, 12), (0, 0), (20, 20)] {
            assert!((back[(i, j)] - whole[(i, j)]).abs() < 1e-6 * whole.amax());
        }
    }

    /// Generalised least squares of the same rows with a numerical Jacobian (numpy, written from the documents' equations).
    #[test]
    fn both_sensors_errors_are_those_of_an_independent_computation() {
        let ups: Vec<Vector3<f64>> = [
            [0, 1, 1],
            [1, 0, 1],
            [1, 1, 0],
            [0, -1, 1],
            [-1, 0, 1],
            [-1, 1, 0],
            [0, 1, -1],
            [1, 0, -1],
            [1, -1, 0],
            [0, -1, -1],
            [-1, 0, -1],
            [-1, -1, 0],
        ]
        .map(|u| Vector3::from(u).map(f64::from).normalize())
        .to_vec();
        let expected = [
            6.722_376_44e-5,
            6.576_822_95e-5,
            6.433_151_34e-5,
            8.170_522_08e-5,
            8.392_149_71e-5,
            6.717_555_40e-5,
            4.063_218_91e-4,
            3.976_046_13e-4,
            3.783_585_48e-4,
            2.565_538_86e-4,
            1.841_777_03e-4,
            2.121_557_38e-4,
            2.468_963_06e-4,
            1.433_936_71e-4,
            1.414_006_50e-4,
            1.738_241_46e-4,
            2.137_144_72e-4,
            2.542_294_16e-4,
            9.368_087_66e-6,
            9.368_087_66e-6,
            9.368_087_66e-6,
        ];
        let (noise, timing) = (Noise::default(), Timing::default());
        let known = Information::zeros();
        let whole = session_information(&ups, &short_ways(&ups), &known, &noise, &timing);
        let found = predict(&whole, &noise).standard_errors;
        for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "{k}: {found} {expected}"
            );
        }
    }
}
