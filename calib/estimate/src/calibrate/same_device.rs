//! Test that several recordings come from one device.

use findings::{Finding, Kind};
use recording::{Error, Recording};
use sensor::Sensor;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::methods::joint::JointFit;
use crate::methods::{AccelerometerFit, AccelerometerRequest, fit_accelerometer};
use crate::residuals::StaticMean;

/// Devices are told apart where chance makes so much difference in one parameter this rarely.
const LEVEL: f64 = 1e-7;

/// Differences of scale factors and misalignments below this are no other device: a fit's own misfit
/// may explain them.
const SAME: f64 = 1e-3;

/// Those beyond this are said where chance makes them this rarely: a temperature that changes them, and not the effects that they look like.
const NOTICED: f64 = 2e-4;
const SAID: f64 = 1e-5;

/// Standard errors within which scale factors are the same, and twice as many beyond which they differ.
const CHANCE: f64 = 3.0;

/// A gyroscope that differs by more is another: temperatures of a room and clocks of one maker do not make so much.
const ANOTHER_GYROSCOPE: f64 = 3e-3;

/// Largest change of a scale factor or misalignment per kelvin: several times what data sheets state.
const PER_KELVIN: f64 = 5e-4;

/// Refuses recordings whose scale factors or misalignments of the accelerometer differ by more than chance, misfit and their
/// temperatures make, each fitted on its own; those too short for that are passed. What their temperatures may make is said.
///
/// # Errors
/// The first two that differ, and in what.
pub fn of_one_device(
    recordings: &[&Recording],
    means: &[Vec<StaticMean>],
    gravity: f64,
) -> Result<Option<Finding>, Error> {
    let celsius: Vec<Option<f64>> = recordings.iter().map(|r| celsius(r)).collect();
    let names: Vec<String> = recordings.iter().map(|r| r.name.clone()).collect();
    let request = AccelerometerRequest {
        recordings: means.to_vec(),
        names,
        model: accelerometer::model(),
        gravity,
    };
    same_accelerometer(&request, &celsius)
}

/// The same of static means, at the temperatures that are known, °C.
pub(super) fn same_accelerometer(
    request: &AccelerometerRequest,
    celsius: &[Option<f64>],
) -> Result<Option<Finding>, Error> {
    let count = request.recordings.len();
    if count < 2 {
        return Ok(None);
    }
    let alone = (0..count).filter_map(|k| {
        let own = AccelerometerRequest {
            recordings: vec![request.recordings[k].clone()],
            names: vec![request.names[k].clone()],
            ..request.clone()
        };
        let fit = fit_accelerometer(&own).ok()?;
        let is_determined = spare(&fit) > 1.0 && fit.fitted.rank == fit.fitted.free.len();
        is_determined.then_some((k, fit))
    });
    let alone: Vec<(usize, AccelerometerFit)> = alone.collect();
    let mut warmer = None;
    for (k, (first, a)) in alone.iter().enumerate() {
        for (second, b) in &alone[k + 1..] {
            let Some(difference) = difference(a, b) else {
                continue;
            };
            let temperature = |k: usize| celsius.get(k).copied().flatten();
            let between = Temperatures::of(temperature(*first), temperature(*second));
            let of = |kind| {
                let found = Finding::of(kind)
                    .of_sensor(Sensor::Accelerometer)
                    .detail("first", request.names[*first].clone())
                    .detail("second", request.names[*second].clone())
                    .detail("parameter", difference.parameter.clone())
                    .detail("one", format!("{:.5}", difference.values[0]))
                    .detail("two", format!("{:.5}", difference.values[1]))
                    .detail("distance", format!("{:.0}", difference.distance));
                let found = match gravity_apart(a, b) {
                    Some(share) => found.number("gravity", share, "share"),
                    None => found,
                };
                between.add_to(found)
            };
            let is_another = difference.size > SAME && difference.p_value < LEVEL;
            if is_another && difference.size > between.allowed() {
                return Err(Error::input(of(Kind::DevicesDiffer)));
            }
            warmer.get_or_insert_with(|| of(Kind::RecordingsDiffer));
        }
    }
    Ok(warmer)
}

/// The same of the gyroscope by a fit to all: `recordings` are those of the fit.
///
/// # Errors
/// The recording whose gyroscope is another.
pub fn gyroscope_of_one_device(
    fit: &JointFit,
    recordings: &[&Recording],
    force_device: bool,
) -> Result<Option<Finding>, Error> {
    let Some(apart) = fit.gyroscope_apart() else {
        return Ok(None);
    };
    let size = apart.change.abs();
    if apart.p_value > SAID || size < NOTICED {
        return Ok(None);
    }
    let own = recordings[apart.recording];
    let others = recordings.iter().enumerate();
    let others = others.filter(|(k, _)| *k != apart.recording);
    let between = others.map(|(_, other)| Temperatures::of(celsius(own), celsius(other)));
    let between: Vec<Temperatures> = between.collect();
    let allowed = between.iter().map(Temperatures::allowed);
    let of = |kind| {
        Finding::of(kind)
            .in_recording(&own.name)
            .of_sensor(Sensor::Gyroscope)
            .detail("parameter", apart.parameter.trim_start_matches("gyro."))
            .number("change", apart.change, "share")
            .number("error", apart.std, "share")
    };
    let is_another = size > ANOTHER_GYROSCOPE.max(allowed.fold(0.0, f64::max));
    let is_another = is_another && apart.p_value < LEVEL;
    if is_another && !force_device {
        let found = of(Kind::GyroscopeOfOther);
        return Err(Error::input(match between.first() {
            Some(between) => between.add_to(found),
            None => found,
        }));
    }
    Ok(Some(of(Kind::GyroscopeDiffers)))
}

/// Mean temperatures of two recordings, where they are known, °C.
struct Temperatures(Option<[f64; 2]>);

/// The mean temperature of a recording, where it is known.
pub(super) fn celsius(recording: &Recording) -> Option<f64> {
    let temperature = recording.temperature.as_ref()?;
    temperature.mean(f64::NEG_INFINITY, f64::INFINITY)
}

impl Temperatures {
    fn of(one: Option<f64>, other: Option<f64>) -> Self {
        Self(one.zip(other).map(<[f64; 2]>::from))
    }

    /// Returns the largest change of a scale factor or misalignment between these temperatures.
    fn allowed(&self) -> f64 {
        self.0
            .map_or(0.0, |[one, other]| PER_KELVIN * (one - other).abs())
    }

    /// The finding with them, where they are known.
    fn add_to(&self, found: Finding) -> Finding {
        match self.0 {
            Some([one, other]) => found.detail("celsius", format!("{one:.0} and {other:.0} °C")),
            None => found,
        }
    }
}

fn spare(fit: &AccelerometerFit) -> f64 {
    fit.first.residuals.len() as f64 - fit.first.uncertainty.rank as f64
}

/// The share by which gravity would be another in the second fit, where all scale factors differ by the same and by more than chance.
fn gravity_apart(a: &AccelerometerFit, b: &AccelerometerFit) -> Option<f64> {
    let of = |axis: &str| {
        let name = format!("accel.s_{axis}");
        let value = |fit: &AccelerometerFit| fit.fitted.parameters.get(&name);
        let error = |fit: &AccelerometerFit| fit.fitted.standard_error(&name);
        let (x, y) = (value(a)?, value(b)?);
        Some((y / x - 1.0, (error(a)? / x).hypot(error(b)? / y)))
    };
    let all: Vec<(f64, f64)> = ["x", "y", "z"].iter().filter_map(|axis| of(axis)).collect();
    let mean = all.iter().map(|(change, _)| change).sum::<f64>() / 3.0;
    let is_common = |(change, std): &(f64, f64)| {
        (change - mean).abs() < CHANCE * std && mean.abs() > 2.0 * CHANCE * std
    };
    (all.len() == 3 && all.iter().all(is_common)).then_some(-mean)
}

/// A parameter in which two fits differ.
struct Difference {
    /// Difference as a share of the scale.
    size: f64,
    parameter: String,
    /// In both.
    values: [f64; 2],
    /// In standard errors.
    distance: f64,
    /// Chance of so much in one parameter.
    p_value: f64,
}

/// The parameter in which two fits differ most, where that is beyond chance.
fn difference(a: &AccelerometerFit, b: &AccelerometerFit) -> Option<Difference> {
    let law = StudentsT::new(0.0, 1.0, spare(a).min(spare(b))).ok()?;
    let scale = a.unit.scale.max(b.unit.scale);
    let of = |name: &String| {
        let (x, y) = (
            a.fitted.parameters.get(name)?,
            b.fitted.parameters.get(name)?,
        );
        let errors = [a, b].map(|fit| fit.fitted.standard_error(name));
        let t = (x - y).abs() / errors[0]?.hypot(errors[1]?);
        let size = (x - y).abs() / scale;
        let p_value = 2.0 * law.sf(t);
        let other = t.is_finite() && size > NOTICED && p_value < SAID;
        other.then(|| Difference {
            size,
            parameter: name.clone(),
            values: [x, y],
            distance: t,
            p_value,
        })
    };
    let names = a.fitted.free.iter();
    let own = names.filter(|name| name.starts_with("accel.") && !name.contains(".b_"));
    own.filter_map(of).max_by(|a, b| a.size.total_cmp(&b.size))
}
