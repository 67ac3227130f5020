//! Recordings of one device of which one has its axes turned, as a phone's follow its screen.

use findings::{Finding, Kind, Remedy};
use nalgebra::{Matrix3, Vector3};
use recording::intervals::Segmentation;
use recording::{Error, Recording};
use sensor::{Base, Sensor, inverse, is_bias};

use super::axes::SignedAxes;
use super::columns::Columns;
use crate::methods::{AccelerometerRequest, fit_accelerometer, static_means};

findings::tuning! {
    /// Change of an accelerometer's bias from one recording to the next that tells nothing of axes, m/s².
    FORCE_BIAS: f64 = 0.007;
    /// The same of a gyroscope, rad/s.
    RATE_BIAS: f64 = 4e-4;
    /// The same of a scale factor or misalignment.
    ELEMENT: f64 = 1.5e-3;
    /// Turned axes are named where they take so much off the sum of squares ...
    GAIN: f64 = 20.0;
    /// ... and leave no more than this share of it, ...
    LEFT: f64 = 0.2;
    /// ... and no more than this for each number.
    EACH: f64 = 2.5;
}

/// Everything that a recording by itself tells of its device, in the axes of its readings: bias and scale matrix of the accelerometer,
/// bias of the gyroscope, each with its variance.
struct Own {
    force: (Vector3<f64>, Vector3<f64>),
    elements: (Matrix3<f64>, f64),
    rate: Option<(Vector3<f64>, f64)>,
}

/// Refuses recordings of which one is of the device of another in turned axes: one calibration of both is wrong for either.
///
/// # Errors
/// The two, and the call that turns one back.
pub fn none_is_turned<'a>(
    cut: impl IntoIterator<Item = (&'a Recording, &'a Segmentation)>,
    gravity: f64,
) -> Result<(), Error> {
    let cut: Vec<_> = cut.into_iter().collect();
    if cut.len() < 2 {
        return Ok(());
    }
    let own = cut.iter().map(|(r, s)| Some((*r, own(r, s, gravity)?)));
    let own: Vec<(&Recording, Own)> = own.flatten().collect();
    for (k, (second, b)) in own.iter().enumerate() {
        for (first, a) in &own[..k] {
            if let Some(axes) = turned(a, b) {
                return Err(Error::input(refusal(first, second, &axes)));
            }
        }
    }
    Ok(())
}

fn refusal(first: &Recording, second: &Recording, axes: &SignedAxes) -> Finding {
    let back = axes.inverse();
    let columns = [Sensor::Accelerometer, Sensor::Gyroscope]
        .map(|sensor| Columns::of(&[second], sensor).rearranged(&back));
    Finding::of(Kind::AXES_OF_OTHER_TURNED)
        .in_recording(&second.name)
        .detail("other", first.name.clone())
        .detail("axes", axes.in_words())
        .remedy(Remedy::TurnBack {
            recording: second.name.clone(),
            columns: columns.concat().join(","),
        })
}

fn own(recording: &Recording, segmentation: &Segmentation, gravity: f64) -> Option<Own> {
    let request = AccelerometerRequest {
        recordings: vec![static_means(recording, segmentation)],
        names: vec![recording.name.clone()],
        model: accelerometer::model(),
        gravity,
    };
    let fit = fit_accelerometer(&request).ok()?;
    let fitted = &fit.fitted;
    let spare = fit.first.residuals.len() > fit.fitted.free.len();
    if fitted.rank < fitted.free.len() || !spare {
        return None;
    }
    let std = |name: &str| Some(fitted.standard_error(name)? * fit.unit.scale);
    let bias_std = Vector3::new(std("accel.b_x")?, std("accel.b_y")?, std("accel.b_z")?);
    let base = Base::from_parameters(fitted.parameters.values());
    let t = base.t / fit.unit.scale;
    let bias = (base.bias - fit.unit.zero) * fit.unit.scale;
    inverse(&t)?;
    let worst = fitted.free.iter().filter(|name| !is_bias(name));
    let worst = worst.filter_map(|name| fitted.standard_error(name));
    let worst = worst.fold(0.0, f64::max) / fit.unit.scale;
    let rates = segmentation
        .statics
        .iter()
        .filter_map(|rest| rest.gyroscope);
    let rates: Vec<Vector3<f64>> = rates.map(|moments| moments.mean).collect();
    let n = rates.len() as f64;
    let mean = rates.iter().sum::<Vector3<f64>>() / n;
    let scatter = rates.iter().map(|r| (r - mean).norm_squared()).sum::<f64>() / (3.0 * n);
    // Counts of a gyroscope have no size that is known here.
    let is_si = Columns::of(&[recording], Sensor::Gyroscope).is_si(true);
    Some(Own {
        force: (bias, bias_std),
        elements: (t.transpose() * t, 2.0 * worst),
        // Twice the standard error: a bias that drifts in the one drifts from one to the other.
        rate: (rates.len() > 2 && is_si).then_some((mean, 2.0 * (scatter / n).sqrt())),
    })
}

/// The axes of the second by those of the first where they are others by what both tell.
fn turned(a: &Own, b: &Own) -> Option<SignedAxes> {
    let misfit = |axes: &SignedAxes| squares(a, b, axes);
    let all = SignedAxes::all();
    let (as_named, _) = misfit(all.first()?);
    let (axes, (left, count)) = all
        .iter()
        .skip(1)
        .map(|axes| (*axes, misfit(axes)))
        .min_by(|x, y| x.1.0.total_cmp(&y.1.0))?;
    let holds =
        as_named - left > GAIN.get() && left < LEFT.get() * as_named && left < EACH.get() * count;
    holds.then_some(axes)
}

/// `Σ d² / σ²` of what two recordings tell, the first turned by `axes`, and of how many numbers.
fn squares(a: &Own, b: &Own, axes: &SignedAxes) -> (f64, f64) {
    let turn = axes.matrix();
    let mut sum = 0.0;
    let variance = (turn * a.force.1).map(|v| v * v) + b.force.1.map(|v| v * v);
    let apart = turn * a.force.0 - b.force.0;
    for axis in 0..3 {
        sum += apart[axis].powi(2) / (variance[axis] + FORCE_BIAS.get() * FORCE_BIAS.get());
    }
    let apart = turn * a.elements.0 * turn.transpose() - b.elements.0;
    let variance = a.elements.1.powi(2) + b.elements.1.powi(2) + ELEMENT.get() * ELEMENT.get();
    for row in 0..3 {
        for column in row..3 {
            sum += apart[(row, column)].powi(2) / variance;
        }
    }
    let Some((one, other)) = a.rate.zip(b.rate) else {
        return (sum, 9.0);
    };
    let variance = one.1.powi(2) + other.1.powi(2) + RATE_BIAS.get() * RATE_BIAS.get();
    sum += (turn * one.0 - other.0).norm_squared() / variance;
    (sum, 12.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own_of(bias: [f64; 3], rate: [f64; 3]) -> Own {
        Own {
            force: (bias.into(), Vector3::repeat(2e-3)),
            elements: (
                Matrix3::new(1.003, -2e-3, 1e-3, -2e-3, 1.006, 0.0, 1e-3, 0.0, 0.999),
                5e-4,
            ),
            rate: Some((rate.into(), 1e-4)),
        }
    }

    #[test]
    fn a_phones_small_biases_tell_every_turn_of_its_axes() {
        let a = own_of([0.040, 0.005, -0.021], [2.6e-3, -1e-4, 1.2e-3]);
        let moved = own_of([0.041, 0.004, -0.013], [2.9e-3, -1e-4, 1.2e-3]);
        assert_eq!(turned(&a, &moved), None);
        for axes in SignedAxes::all().into_iter().skip(1) {
            let by = axes.matrix();
            let b = Own {
                force: (by * moved.force.0, moved.force.1),
                elements: (by * moved.elements.0 * by.transpose(), moved.elements.1),
                rate: moved.rate.map(|(rate, std)| (by * rate, std)),
            };
            if let Some(found) = turned(&a, &b) {
                assert_eq!(found, axes);
            } else {
                // Only an axis without bias can have changed its sign unseen.
                assert_eq!(axes.in_words(), "y is flipped");
            }
        }
    }

    #[test]
    fn biases_that_move_are_no_turned_axes() {
        let a = own_of([0.3, -0.1, 0.2], [0.02, -0.01, 0.005]);
        let b = own_of([0.33, -0.09, 0.17], [0.022, -0.013, 0.004]);
        assert_eq!(turned(&a, &b), None);
        let another = own_of([-0.2, 0.3, 0.25], [-0.03, 0.001, 0.01]);
        assert_eq!(turned(&a, &another), None);
    }
}
