//! Effects that a model leaves out; the standard errors assume that the sensors have none of them.

use faer::Mat;
use findings::Kind;
use nalgebra::{DMatrix, Vector3};
use sensor::{EffectRef, Kinematics, Model, Quantity, Role, Sensor};
use solver::Problem;

use super::static_norm::StaticNorms;
use crate::calibration::{LeftOut, catalogue};
use crate::methods::joint::{ErrorLeftOut, JointFit, effect_slopes};
use crate::methods::left_out::{squares_added, squares_added_beside};
use crate::methods::{AccelerometerFit, Fitted};
use crate::residuals::{GravityNorm, StaticMean};
use crate::truth::supposed;

/// The effects that a joint fit leaves out: all of the catalogue that are functions of what their sensor measures, whatever
/// else happens, and errors `after_turns` of the accelerometer, together.
pub(super) fn left_out(
    fit: &JointFit,
    fitted: &Fitted,
    after_turns: &[ErrorLeftOut],
) -> Vec<LeftOut> {
    let rows = fit.left_out_rows();
    let effects: Vec<EffectRef> = candidates(&fit.models).collect();
    let added = rows.squares_added_by(&effects);
    let each = effects.iter().zip(added);
    let each = each.filter_map(|(effect, added)| {
        of_joint(fit, fitted, (effect.name(), effect.sensor()), added?)
    });
    let name = Kind::SETTLES_AFTER_TURNS.name();
    let slow = (!after_turns.is_empty())
        .then(|| rows.squares_added_by_errors(after_turns))
        .flatten()
        .and_then(|added| of_joint(fit, fitted, (name, Sensor::Accelerometer), added));
    each.chain(slow).collect()
}

/// The same of the accelerometer's fit to the norm of specific force, where one bias holds for all recordings.
pub(super) fn left_out_by_norms(fit: &AccelerometerFit, norms: &StaticNorms) -> Vec<LeftOut> {
    let Some(parameters) = slopes_of_norms(fit, norms) else {
        return Vec::new();
    };
    let residuals = norms.all.iter().map(|norm| norm.residual / norm.sigma);
    let residuals: Vec<f64> = residuals.collect();
    let residuals = Mat::from_fn(residuals.len(), 1, |i, _| residuals[i]);
    let of = |effect: EffectRef| {
        let columns = columns_of_norms(norms, &effect);
        let added = squares_added(&parameters, &columns, &residuals, |k| effect.typical_of(k))?;
        let own = (effect.name(), effect.sensor());
        worst(own, &fit.fitted, fit.fitted.free.iter().zip(added))
    };
    candidates(std::slice::from_ref(&fit.model))
        .filter(|effect| effect.sensor() == Sensor::Accelerometer)
        .filter_map(of)
        .collect()
}

/// The same of a magnetometer whose field is in units of so many `microtesla`; `larger` fits a model with one effect more, its parameters the
/// last: values and covariance.
pub(super) fn left_out_of_magnetometer(
    model: &Model,
    fitted: &Fitted,
    microtesla: f64,
    larger: impl Fn(&Model) -> Option<(Vec<f64>, DMatrix<f64>)>,
) -> Vec<LeftOut> {
    let of = |effect: EffectRef| {
        let (values, covariance) = larger(&model.clone().with(effect.clone()))?;
        let sizes = (0..effect.params().len()).map(|k| effect.typical_of(k));
        let sizes: Vec<f64> = sizes.collect();
        let sizes = in_unit(&effect, sizes, microtesla);
        let added = squares_added_beside(&values, &covariance, &sizes)?;
        let own = (effect.name(), effect.sensor());
        worst(own, fitted, fitted.free.iter().zip(added))
    };
    candidates(std::slice::from_ref(model))
        .filter(|effect| effect.sensor() == Sensor::Magnetometer)
        .filter_map(of)
        .collect()
}

/// Coefficients of an effect of the magnetometer in a unit of so many `microtesla`, where all errors are that much smaller.
fn in_unit(effect: &EffectRef, sizes: Vec<f64>, microtesla: f64) -> Vec<f64> {
    let error = |field: f64| {
        let truth = Kinematics {
            magnetic_field: Vector3::repeat(field),
            ..Kinematics::at_rest(Vector3::zeros())
        };
        effect.error_f64(&truth, &sizes).norm()
    };
    let factor = error(microtesla) / microtesla / error(1.0);
    sizes.iter().map(|size| size * factor).collect()
}

/// The effects of the catalogue that are functions of their sensor's signal, with coefficients alone, and that no model has.
fn candidates(models: &[Model]) -> impl Iterator<Item = EffectRef> + use<'_> {
    let own = models.iter().flat_map(|model| model.effects());
    let known: Vec<&str> = own.map(|effect| effect.name()).collect();
    catalogue().filter(move |effect| {
        let signal = Quantity::signal_of(effect.sensor());
        let mut params = effect.params().iter();
        effect.needs() == [signal]
            && params.all(|p| p.role == Role::Coefficient)
            && !known.contains(&effect.name())
    })
}

/// The parameter of the sensor that the effect of that name puts most off; `added` are mean squares in the unit of the parameters.
fn worst<'a>(
    (effect, sensor): (&str, Sensor),
    fitted: &Fitted,
    added: impl Iterator<Item = (&'a String, f64)>,
) -> Option<LeftOut> {
    let prefix = format!("{}.", sensor.prefix());
    let own = added.filter(|(name, _)| name.starts_with(&prefix) && !name.contains('['));
    let ratio = |(name, added): &(&String, f64)| Some(added.sqrt() / fitted.standard_error(name)?);
    let each = own.filter_map(|own| Some((own, ratio(&own)?)));
    let ((name, added), _) = each.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(LeftOut {
        effect: effect.into(),
        parameter: name.clone(),
        std_added: added.sqrt(),
    })
}

/// `added` are the mean squares for the free shared parameters, near SI units.
fn of_joint(
    fit: &JointFit,
    fitted: &Fitted,
    effect: (&str, Sensor),
    added: Vec<f64>,
) -> Option<LeftOut> {
    let shared = fit.free.iter().copied().filter(|&k| k < fit.shared);
    let each = shared.zip(added).map(|(k, added)| {
        let (unit, place) = fit.unit_of(k);
        let name = &fit.parameters.names()[k];
        (name, added * unit.factor(place).powi(2))
    });
    worst(effect, fitted, each)
}

/// `∂|T (A − b)|/∂p` over the standard deviation of each norm (`n × free parameters`); `None` where recordings have biases
/// of their own.
fn slopes_of_norms(fit: &AccelerometerFit, norms: &StaticNorms) -> Option<Mat<f64>> {
    if fit.own_bias {
        return None;
    }
    let parameters = &fit.fitted.parameters;
    let free: Vec<usize> = (fit.fitted.free.iter())
        .map(|name| parameters.index(name))
        .collect::<Option<_>>()?;
    let means: Vec<StaticMean> = (norms.all.iter())
        .map(|norm| StaticMean::bare(norm.mean))
        .collect();
    let problem = GravityNorm {
        model: &accelerometer::model(),
        means: &means,
        gravity: 0.0,
    };
    let mut slopes = problem.linearize(parameters.values(), &free, &mut Vec::new());
    for (row, norm) in norms.all.iter().enumerate() {
        slopes
            .row_mut(row)
            .iter_mut()
            .for_each(|slope| *slope /= norm.sigma);
    }
    Some(slopes)
}

/// Computes the change of the norms by unit coefficients of an effect, over their standard deviations (`n × q`).
fn columns_of_norms(norms: &StaticNorms, effect: &EffectRef) -> Mat<f64> {
    let count = effect.params().len();
    let mut columns = Mat::zeros(norms.all.len(), count);
    let (nothing, wanted) = (vec![0.0; count], (0..count).collect::<Vec<_>>());
    let mut errors = Vec::with_capacity(count);
    for (row, norm) in norms.all.iter().enumerate() {
        let truth = supposed(norm.force, Vector3::zeros());
        errors.clear();
        effect_slopes(effect, &truth, &nothing, &wanted, &mut errors);
        let u = norm.force.normalize();
        for (k, error) in errors.iter().enumerate() {
            columns[(row, k)] = u.dot(error) / norm.sigma;
        }
    }
    columns
}
