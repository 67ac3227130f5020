//! Sensors of one dimension, after those that say how the device lay.
//!
//! The means `y_k` over static intervals whose true signal `s_k` is known give the parameters, `min Σ (h(s_k, truth_k, p) − y_k)²`. Their
//! standard errors are by what is left: `σ² = ‖r‖² / (m − n)`.

use findings::{Finding, Kind};
use recording::{Error, Recording};
use sensor::{Kinematics, ScalarSensorRef};
use solver::{Jet, Mask, Options, Parameters, Report, from_fn, lit, solve};

use super::outcome::Outcome;
use super::request::Request;
use crate::calibration::{Calibration, EffectParameter, ScalarValues};
use crate::methods::Choice;
use crate::truth::{Models, Truth, require_of_instants};

/// A static interval as a sensor of one dimension sees it.
struct Mean {
    reading: f64,
    signal: f64,
    truth: Kinematics<f64>,
}

/// The outcome with every sensor of one dimension that was asked for and recorded.
///
/// # Errors
/// [`Error::NotEnough`] where a sensor needs what cannot be known, where too few static intervals have a true signal, or where they leave
/// a parameter open; [`Error::NotConverged`] where its equation has no fit.
pub(super) fn with_scalars(
    mut outcome: Outcome,
    recordings: &[&Recording],
    request: &Request,
) -> Result<Outcome, Error> {
    for sensor in &request.sensors {
        let all = recordings.iter().copied().zip(&outcome.choices);
        let recorded: Vec<_> = all
            .filter(|(r, _)| r.scalar(sensor.name()).is_some())
            .collect();
        if recorded.is_empty() {
            continue;
        }
        let means = means(sensor, &recorded, &outcome.calibration)?;
        let values = fitted(sensor, &means)?;
        outcome.calibration.scalars.push(values);
    }
    Ok(outcome)
}

/// The static intervals in which the true signal is known.
fn means(
    sensor: &ScalarSensorRef,
    recorded: &[(&Recording, &Choice)],
    calibration: &Calibration,
) -> Result<Vec<Mean>, Error> {
    let mut all = Vec::new();
    for (recording, choice) in recorded {
        let intervals = &choice.segmentation;
        let models = Models::of_recording(calibration, &recording.name);
        require_of_instants(sensor, recording, Some(intervals), &models)?;
        let truth = Truth::as_far_as_known(recording, Some(intervals), models);
        let stream = recording.scalar(sensor.name());
        for (k, rest) in intervals.statics.iter().enumerate() {
            let means = stream.and_then(|own| own.means(rest.span.from, rest.span.to));
            all.extend(means.map(|[reading, signal]| Mean {
                reading,
                signal,
                truth: truth.at_rest(k),
            }));
        }
    }
    Ok(all)
}

fn fitted(sensor: &ScalarSensorRef, means: &[Mean]) -> Result<ScalarValues, Error> {
    let mut start = Parameters::new();
    for p in sensor.params() {
        start.push(&*p.name, &*p.unit, p.nominal);
    }
    let count = start.len();
    if means.len() <= count {
        return Err(Error::not_enough(
            Finding::of(Kind::SCALAR_FEW_MEANS)
                .detail("name", sensor.name())
                .count("parameters", count)
                .count("means", means.len()),
        ));
    }
    let problem = from_fn(|p: &[Jet], rows: &mut Vec<Jet>| {
        let row = |own: &Mean| {
            sensor.reading_jet(lit(own.signal), &own.truth, p) - lit::<Jet>(own.reading)
        };
        rows.extend(means.iter().map(row));
    });
    let unsolved = |why: String| {
        let found = Finding::of(Kind::SCALAR_UNSOLVED).detail("name", sensor.name());
        Error::not_converged(found.detail("why", why))
    };
    let report = solve(&problem, &start, &Mask::all(count), &Options::default())
        .map_err(|error| unsolved(error.to_string()))?;
    if let Some(open) = report.uncertainty.unobservable.first() {
        return Err(Error::not_enough(
            Finding::of(Kind::SCALAR_UNDETERMINED)
                .detail("name", sensor.name())
                .detail("what", open.clone()),
        ));
    }
    if !report.termination.converged() {
        return Err(unsolved(report.termination.to_string()));
    }
    Ok(values(sensor, &report, means.len()))
}

/// The fit as it is written down.
fn values(sensor: &ScalarSensorRef, report: &Report, static_intervals: usize) -> ScalarValues {
    let variance = report.variance.unwrap_or(f64::NAN);
    let row = |row: &Vec<f64>| row.iter().map(|v| v * variance).collect();
    let parameters = sensor.params().iter().enumerate();
    let parameters = parameters.map(|(k, p)| EffectParameter {
        name: p.name.to_string(),
        value: report.parameters.values()[k],
        std: report.standard_error(k),
        unit: p.unit.to_string(),
    });
    ScalarValues {
        name: sensor.name().to_owned(),
        unit: sensor.unit().to_owned(),
        model: sensor.equation().to_owned(),
        parameters: parameters.collect(),
        covariance: report.uncertainty.covariance.iter().map(row).collect(),
        residual_rms: report.rms(),
        static_intervals,
        sensor: Some(sensor.clone()),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use findings::Kind;
    use sensor::{Param, Quantity, ScalarSensor};
    use simulate::Spec;
    use solver::Scalar;

    use super::*;
    use crate::calibrate::calibrate;
    use crate::calibration::apply;

    /// `P = p + b + c dT + k f_z`.
    struct Barometer;

    impl ScalarSensor for Barometer {
        const NAME: &'static str = "barometer";
        const UNIT: &'static str = "hPa";
        const EQUATION: &'static str = "P = p + b + c dT + k f_z";
        const PARAMS: &'static [Param] = &[
            Param::new("b", "hPa", 0.0),
            Param::new("c", "hPa/K", 0.0),
            Param::new("k", "hPa/(m/s^2)", 0.0),
        ];
        const NEEDS: &'static [Quantity] = &[Quantity::SpecificForce, Quantity::Temperature];

        fn reading<D: Scalar>(&self, signal: D, truth: &Kinematics<f64>, p: &[D]) -> D {
            signal + p[0] + p[1] * (truth.temperature - 25.0) + p[2] * truth.specific_force.z
        }
    }

    const TRUE: [f64; 3] = [0.8, -0.03, 0.004];
    const PRESSURE: f64 = 1013.25;

    fn request() -> Request {
        let sensor: Arc<dyn sensor::AnyScalarSensor> = Arc::new(Barometer);
        Request {
            gravity: Spec::hand_held(1).gravity,
            sensors: vec![sensor.into()],
            ..Request::default()
        }
    }

    /// A session that warms up, without a barometer.
    fn session() -> Recording {
        let spec = Spec::hand_held(11).with_effect("accel_temperature", 0.0);
        spec.run().unwrap().recording
    }

    /// Readings of it at every tenth stamp, with noise of `sigma` that is the same within a static interval.
    fn with_barometer(recording: &Recording, sigma: f64, draw: u32) -> Recording {
        let stream = recording.accelerometer.as_ref().unwrap();
        let temperature = recording.temperature.as_ref().unwrap();
        let slow = |t: f64| ((t / 3.0).floor() * 12.9898 + f64::from(draw)).sin() * 43758.5453;
        let noise = |t: f64| sigma * (slow(t).fract() - 0.5);
        let t: Vec<f64> = stream.t.iter().step_by(10).copied().collect();
        let readings = t.iter().map(|&t| {
            let [celsius, force] = [temperature.at(t).unwrap(), stream.at(t).unwrap().z];
            PRESSURE + TRUE[0] + TRUE[1] * (celsius - 25.0) + TRUE[2] * force + noise(t)
        });
        let truth = vec![PRESSURE; t.len()];
        let readings: Vec<f64> = readings.collect();
        recording
            .clone()
            .with_scalar("barometer", &t, &readings, &truth)
            .unwrap()
    }

    #[test]
    fn parameters_are_found_within_their_errors_and_readings_corrected() {
        let bare = session();
        let recording = with_barometer(&bare, 0.05, 0);
        let outcome = calibrate(&[&recording], &[], &request()).unwrap();
        let (mut squares, mut count) = (0.0, 0.0);
        for draw in 0..40 {
            let own = with_barometer(&bare, 0.05, draw);
            let mut again = outcome.clone();
            again.calibration.scalars.clear();
            let again = with_scalars(again, &[&own], &request()).unwrap();
            for (p, truth) in again.calibration.scalars[0].parameters.iter().zip(TRUE) {
                squares += ((p.value - truth) / p.std.unwrap()).powi(2);
                count += 1.0;
            }
        }
        let mean: f64 = squares / count;
        assert!(
            (0.6..1.6).contains(&mean),
            "mean square error over variance {mean}"
        );

        let corrected = apply(&outcome.calibration, &recording).unwrap();
        let values = &corrected.scalars[0].values;
        let worst = values
            .iter()
            .map(|v| (v - PRESSURE).abs())
            .fold(0.0, f64::max);
        // The noise of a reading is at most a quarter of this.
        assert!(worst < 0.1, "{worst}");
    }

    #[test]
    fn a_calibration_is_read_again_with_its_sensor_or_leaves_the_readings() {
        let recording = with_barometer(&session(), 0.05, 0);
        let outcome = calibrate(&[&recording], &[], &request()).unwrap();
        let text = serde_json::to_string(&outcome.calibration).unwrap();
        let read: Calibration = serde_json::from_str(&text).unwrap();
        assert_eq!(read.edited(), None);
        let raw = apply(&read, &recording).unwrap();
        assert_eq!(raw.scalars, recording.scalars);
        let left = |found: &Finding| found.kind == Kind::SCALAR_LEFT_AS_READ;
        assert!(raw.warnings.iter().any(left));
        let known = read.with_sensors(&request().sensors).unwrap();
        let again = apply(&known, &recording).unwrap();
        let first = apply(&outcome.calibration, &recording).unwrap();
        assert_eq!(again.scalars, first.scalars);
        let mut moved = known.clone();
        moved.scalars[0].parameters[0].value += 1.0;
        assert!(moved.edited().is_some());
        let mut other = known;
        other.scalars[0].parameters[0].name = "zero".into();
        let refused = other.with_sensors(&request().sensors).unwrap_err();
        assert!(
            refused.to_string().contains("scalars.barometer.parameters"),
            "{refused}"
        );
    }

    #[test]
    fn what_the_recording_does_not_say_is_refused_by_name() {
        let warm = with_barometer(&session(), 0.05, 0);
        let said = |recording: &Recording| {
            let refused = calibrate(&[recording], &[], &request()).unwrap_err();
            refused.to_string()
        };
        let mut even = warm.clone();
        if let Some(temperature) = &mut even.temperature {
            temperature.celsius.fill(25.0);
        }
        let open = said(&even);
        assert!(open.contains("do not say how large c is"), "{open}");
        let cold = Recording {
            temperature: None,
            ..warm.clone()
        };
        let needs = said(&cold);
        assert!(
            needs.contains("the barometer needs the temperature"),
            "{needs}"
        );
        let mut unknown = warm;
        unknown.scalars[0].truth.clear();
        let few = said(&unknown);
        assert!(
            few.contains("0 static intervals with a known true value"),
            "{few}"
        );
    }
}
