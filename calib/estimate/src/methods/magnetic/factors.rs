//! The factors that are not linear: a placement's reading, and what fixes the common scale.

use nalgebra::{Matrix3, Vector3};
use sensor::{BASE_PARAMETERS, Base, Model, ModelScalar, PLACES};
use solver::scalar::{derivatives, variable};
use solver::{Factor, Jet, LANES, Scalar, lit};

use super::placement::Placement;

/// Coordinates of a field: inclination, and the logarithm of its strength over the first guess.
pub const FIELD: usize = 2;

/// Coordinates of a reading before those of the other sensors' errors: model, field, heading.
const OWN: usize = FIELD + 1;

/// The mean reading of a placement less that of the model, over its standard deviation (3 rows).
///
/// Blocks: the model's parameters, the field (`FIELD`), the heading (rad), the errors of the other sensors, and, of a
/// recording before the last, how far its bias lies from that of the last (3).
#[derive(Debug)]
pub struct Reading<'a> {
    model: &'a Model,
    placement: &'a Placement,
    /// Level axes in body axes.
    level: Matrix3<f64>,
    /// Strength of the field at a logarithm of 0.
    strength: f64,
    /// Standard deviation of an axis.
    sigma: f64,
    /// True if the recording has a bias of its own.
    own_bias: bool,
}

impl<'a> Reading<'a> {
    pub fn new(model: &'a Model, placement: &'a Placement, strength: f64, sigma: f64) -> Self {
        Self {
            model,
            placement,
            level: placement.reference(),
            strength,
            sigma,
            own_bias: false,
        }
    }

    /// The same with a bias of the recording's own.
    pub fn with_own_bias(self, own_bias: bool) -> Self {
        Self { own_bias, ..self }
    }

    /// The field in body axes for inclination, logarithm of the strength and heading.
    fn field<D: Scalar>(&self, field: &[D], heading: D) -> Vector3<D> {
        let (sine, cosine) = field[0].sin_cos();
        let strength = field[1].exp() * lit::<D>(self.strength);
        let (across, along) = heading.sin_cos();
        let level = Vector3::new(cosine * along, -(cosine * across), -sine) * strength;
        self.level.map(lit::<D>) * level
    }

    /// Rows for model, field, heading and a small rotation of the level frame.
    fn rows<D: ModelScalar>(&self, p: &[D], own: &[D], tilt: &Vector3<D>) -> Vector3<D> {
        let field = self.field(own, own[FIELD]);
        let mut truth = self.placement.known.lift::<D>();
        truth.magnetic_field = field + tilt.cross(&field);
        let read = self.model.distort(&truth, p);
        let read = read.unwrap_or_else(|| Vector3::from_element(lit(f64::NAN)));
        (self.placement.mean.map(lit::<D>) - read) * lit::<D>(1.0 / self.sigma)
    }

    fn parameters(&self, x: &[f64]) -> usize {
        x.len() - OWN - self.placement.tilt.len() - if self.own_bias { 3 } else { 0 }
    }

    fn tilt(&self, errors: &[f64]) -> Vector3<f64> {
        let each = self.placement.tilt.iter().zip(errors);
        each.map(|(by, error)| by * *error).sum()
    }
}

impl Factor for Reading<'_> {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let n = self.parameters(x);
        let mut rows = self.rows(&x[..n], &x[n..n + OWN], &self.tilt(&x[n + OWN..]));
        if self.own_bias {
            rows -= Vector3::from_column_slice(&x[x.len() - 3..]) / self.sigma;
        }
        out.clear();
        out.extend_from_slice(rows.as_slice());
    }

    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        self.values(x, residuals);
        let n = self.parameters(x);
        let inner: Vec<f64> = x[..n + OWN]
            .iter()
            .chain(self.tilt(&x[n + OWN..]).iter())
            .copied()
            .collect();
        let mut columns = vec![Vector3::zeros(); inner.len()];
        let mut point: Vec<Jet> = inner.iter().map(|&v| lit(v)).collect();
        for first in (0..inner.len()).step_by(LANES) {
            let lanes = first..(first + LANES).min(inner.len());
            for k in lanes.clone() {
                point[k] = variable(inner[k], k - first);
            }
            let tilt = Vector3::new(point[n + OWN], point[n + OWN + 1], point[n + OWN + 2]);
            let rows = self.rows(&point[..n], &point[n..n + OWN], &tilt);
            let slopes = rows.map(|row| derivatives(&row));
            for k in lanes {
                columns[k] = Vector3::from_fn(|i, _| slopes[i][k - first]);
                point[k] = lit(inner[k]);
            }
        }
        let by_tilt = Matrix3::from_columns(&columns[n + OWN..]);
        let errors = self.placement.tilt.iter().map(|by| by_tilt * by);
        let own_bias = (0..if self.own_bias { 3 } else { 0 }).map(|axis| {
            let mut column = Vector3::zeros();
            column[axis] = -1.0 / self.sigma;
            column
        });
        let columns = columns[..n + OWN].iter().copied().chain(errors);
        let columns: Vec<Vector3<f64>> = columns.chain(own_bias).collect();
        jacobian.clear();
        jacobian.extend((0..3).flat_map(|row| columns.iter().map(move |column| column[row])));
    }
}

/// `ln |det T| = 0` to within this share: the common scale of `T`, where the strength of the field is not given. Nothing
/// else sees that scale, so that the minimum is the same for any share.
#[derive(Debug)]
pub struct UnitDeterminant(pub f64);

impl Factor for UnitDeterminant {
    fn values(&self, x: &[f64], out: &mut Vec<f64>) {
        let t = Base::from_parameters(&x[..BASE_PARAMETERS]).t;
        out.clear();
        out.push(t.determinant().abs().ln() / self.0);
    }

    /// `∂ ln |det T| / ∂T = T⁻ᵀ`.
    fn linearize(&self, x: &[f64], residuals: &mut Vec<f64>, jacobian: &mut Vec<f64>) {
        self.values(x, residuals);
        let t = Base::from_parameters(&x[..BASE_PARAMETERS]).t;
        let inverse = t.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        jacobian.clear();
        jacobian.extend(PLACES.iter().map(|&(i, j)| inverse[(j, i)] / self.0));
        jacobian.resize(x.len(), 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::magnetic::placement::tests::at;

    fn reading() -> (Model, Placement) {
        let model = effects::catalogue_of(sensor::Sensor::Magnetometer)
            .fold(magnetometer::model(), Model::with);
        let mut placement = at(Vector3::new(0.3, 0.5, 0.8), Vector3::new(20.0, -10.0, 40.0));
        placement.known.temperature = 31.0;
        placement.tilt = vec![Vector3::new(0.1, 0.2, -0.3), Vector3::new(0.0, 0.4, 0.1)];
        (model, placement)
    }

    fn is_differentiated(factor: &impl Factor, x: &[f64]) {
        let (mut residuals, mut jacobian) = (Vec::new(), Vec::new());
        factor.linearize(x, &mut residuals, &mut jacobian);
        assert_eq!(jacobian.len(), residuals.len() * x.len());
        for k in 0..x.len() {
            let at = |step: f64| {
                let mut moved = x.to_vec();
                moved[k] += step;
                let mut out = Vec::new();
                factor.values(&moved, &mut out);
                out
            };
            let (after, before) = (at(1e-6), at(-1e-6));
            for row in 0..residuals.len() {
                let difference = (after[row] - before[row]) / 2e-6;
                let own = jacobian[row * x.len() + k];
                assert!((difference - own).abs() < 1e-5 * own.abs().max(1.0), "{k}");
            }
        }
    }

    #[test]
    fn jacobians_are_those_of_differences() {
        let (model, placement) = reading();
        let mut x = model.parameters().values().to_vec();
        for (k, v) in x.iter_mut().enumerate() {
            *v += 0.01 * (k as f64 - 4.0);
        }
        is_differentiated(&UnitDeterminant(0.1), &x);
        x.extend([1.1, 0.02, 0.7, 0.01, -0.02]);
        is_differentiated(&Reading::new(&model, &placement, 48.0, 0.5), &x);
        x.extend([0.3, -0.2, 0.1]);
        let reading = Reading::new(&model, &placement, 48.0, 0.5);
        is_differentiated(&reading.with_own_bias(true), &x);
    }

    #[test]
    fn a_level_device_that_looks_north_sees_the_field_ahead_and_below() {
        let placement = at(Vector3::z(), Vector3::zeros());
        let model = magnetometer::model();
        let factor = Reading::new(&model, &placement, 50.0, 1.0);
        let field = factor.field(&[60f64.to_radians(), 0.0], 0.0);
        let expected = Vector3::new(25.0, 0.0, -50.0 * 60f64.to_radians().sin());
        assert!((field - expected).norm() < 1e-12);
        // Turned to the west, counter-clockwise from above, north lies to the right.
        let field = factor.field(&[0.0, 0.0], 90f64.to_radians());
        assert!((field - Vector3::new(0.0, -50.0, 0.0)).norm() < 1e-12);
    }
}
