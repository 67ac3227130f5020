//! Test that all data come from one device.

use findings::{Finding, Findings, Kind};
use nalgebra::{DMatrix, DVector};
use recording::{Error, Recording};
use sensor::{BasePart, Sensor, base_part};

use crate::calibration::Calibration;
use crate::methods::chance;
use crate::methods::joint::{Apart, JointFit, Portion};
use crate::methods::{AccelerometerFit, AccelerometerRequest, fit_accelerometer};
use crate::residuals::StaticMean;

findings::tuning! {
    /// Devices are told apart where chance makes so much difference this rarely.
    LEVEL: f64 = 1e-7;

    /// Differences of scale factors and misalignments below this are no other device: a fit's own misfit
    /// may explain them.
    SAME: f64 = 1e-3;

    /// Differences beyond this are said where chance seldom makes them: a temperature that changes the device, and not the effects that
    /// they look like.
    NOTICED: f64 = 2e-4;
    /// Chance makes them in one of so many calibrations.
    SAID: f64 = 2e-3;

    /// The same of a sensor that misfits: an error of it that other placements show otherwise looks like a difference.
    SAID_BESIDE_MISFIT: f64 = 1e-5;

    /// Standard errors within which scale factors are the same, and twice as many beyond which they differ.
    CHANCE: f64 = 3.0;

    /// A gyroscope that differs by more is another: temperatures of a room and clocks of one maker do not make so much.
    ANOTHER_GYROSCOPE: f64 = 3e-3;

    /// Largest change of a scale factor or misalignment per kelvin: several times what data sheets state.
    PER_KELVIN: f64 = 5e-4;
}

/// Refuses recordings whose scale factors or misalignments of the accelerometer differ by more than chance, misfit and their
/// temperatures make, each fitted on its own; those too short for that are passed. Smaller [`differences`] are of the joint fit.
///
/// # Errors
/// The first two that differ, and in what.
pub fn of_one_device(
    recordings: &[&Recording],
    means: &[Vec<StaticMean>],
    gravity: f64,
) -> Result<(), Error> {
    let celsius: Vec<Option<f64>> = recordings.iter().map(|r| celsius(r)).collect();
    let names: Vec<String> = recordings.iter().map(|r| r.name.clone()).collect();
    let request = AccelerometerRequest {
        recordings: means.to_vec(),
        names,
        model: accelerometer::model(),
        gravity,
    };
    same_accelerometer(&request, &celsius).map(|_| ())
}

/// The same of static means, at the temperatures that are known, °C; what these may make is said.
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
                    .detail("parameter", difference.parameter.clone());
                between.add_to(found)
            };
            let is_another = difference.size > SAME.get() && difference.p_value < LEVEL.get();
            if is_another && difference.size > between.allowed() {
                let found = of(Kind::DEVICES_DIFFER)
                    .detail("one", format!("{:.5}", difference.values[0]))
                    .detail("two", format!("{:.5}", difference.values[1]))
                    .detail("distance", format!("{:.0}", difference.distance));
                return Err(Error::input(match gravity_apart(a, b) {
                    Some(share) => found.number("gravity", share, "share"),
                    None => found,
                }));
            }
            let pairs = alone.len() * (alone.len() - 1) / 2;
            if difference.p_value * pairs as f64 <= SAID.get() {
                warmer.get_or_insert_with(|| {
                    let change = difference.values[1] - difference.values[0];
                    of(Kind::RECORDINGS_DIFFER)
                        .number("change", change / difference.scale, "share")
                        .number("error", difference.size / difference.distance, "share")
                });
            }
        }
    }
    Ok(warmer)
}

/// Parts of the data in which a sensor is another.
#[derive(Clone, Debug, Default)]
pub struct Differences(Vec<Difference>);

#[derive(Clone, Debug)]
struct Difference {
    apart: Apart,
    /// Calibrations in which chance makes one so large.
    chance: f64,
    finding: Finding,
}

/// The differences between parts of the data by a fit to all: `recordings` are those of the fit.
///
/// # Errors
/// The recording whose gyroscope is another device's.
pub fn differences(
    fit: &JointFit,
    recordings: &[&Recording],
    force_device: bool,
) -> Result<Differences, Error> {
    let all = fit.apart();
    let mut found = Vec::new();
    for sensor in [Sensor::Accelerometer, Sensor::Gyroscope] {
        let own = all.iter().filter(|apart| apart.sensor == sensor);
        let least = own.min_by(|a, b| a.p_value.total_cmp(&b.p_value));
        let Some(apart) = least.filter(|apart| is_said(apart, all.len())) else {
            continue;
        };
        if let Portion::Recording(place) = apart.part
            && !force_device
            && let Some(other) = gyroscope_of_another(apart, recordings, place)
        {
            return Err(Error::input(other));
        }
        found.push(Difference {
            apart: apart.clone(),
            chance: apart.p_value * all.len() as f64,
            finding: said(apart, fit.gravity, recordings),
        });
    }
    Ok(Differences(found))
}

/// Returns true if one of so many differences is beyond chance and large enough to matter: between the halves of a recording, in which no
/// temperature or clock was another, as large as between devices.
fn is_said(apart: &Apart, tried: usize) -> bool {
    let least = match apart.part {
        Portion::Recording(_) => NOTICED.get(),
        Portion::SecondHalf(_) => SAME.get(),
    };
    let size = apart.changes[apart.most].size.abs();
    apart.p_value * tried as f64 <= SAID.get() && size > least
}

fn gyroscope_of_another(apart: &Apart, recordings: &[&Recording], place: usize) -> Option<Finding> {
    let most = &apart.changes[apart.most];
    let own = recordings[place];
    let others = recordings.iter().enumerate().filter(|(k, _)| *k != place);
    let between = others.map(|(_, other)| Temperatures::of(celsius(own), celsius(other)));
    let between: Vec<Temperatures> = between.collect();
    let allowed = between.iter().map(Temperatures::allowed);
    let is_another = most.size.abs() > ANOTHER_GYROSCOPE.get().max(allowed.fold(0.0, f64::max))
        && apart.p_value < LEVEL.get()
        && apart.sensor == Sensor::Gyroscope;
    is_another.then(|| {
        let found = Finding::of(Kind::GYROSCOPE_OF_OTHER)
            .in_recording(&own.name)
            .of_sensor(Sensor::Gyroscope)
            .detail("parameter", most.parameter.trim_start_matches("gyro."))
            .number("change", most.size, "share")
            .number("error", most.std, "share");
        match between.first() {
            Some(between) => between.add_to(found),
            None => found,
        }
    })
}

fn said(apart: &Apart, gravity: f64, recordings: &[&Recording]) -> Finding {
    let most = &apart.changes[apart.most];
    let half = 0.5 * most.size.abs();
    let (Portion::Recording(place) | Portion::SecondHalf(place)) = apart.part;
    let own = recordings[place];
    let others = recordings.iter().enumerate().filter(|(k, _)| *k != place);
    let mut others = others.map(|(_, other)| other);
    // A long recording is several to the fit.
    let is_whole = others.clone().all(|other| other.name != own.name);
    let found = match apart.part {
        Portion::Recording(_) if is_whole => {
            let names = match (others.next(), others.next()) {
                (Some(other), None) => other.name.as_str(),
                _ => "the others",
            };
            let temperatures = match recordings {
                [a, b] => Temperatures::of(celsius(a), celsius(b)),
                _ => Temperatures(None),
            };
            let found = Finding::of(Kind::RECORDINGS_DIFFER)
                .detail("first", names)
                .detail("second", own.name.clone())
                .detail("included", "half");
            temperatures.add_to(found)
        }
        _ => Finding::of(Kind::PARTS_DIFFER),
    };
    let found = found
        .in_recording(&own.name)
        .of_sensor(apart.sensor)
        .detail("parameter", most.parameter.clone())
        .number("change", most.size, "share")
        .number("error", most.std, "share");
    match apart.sensor {
        Sensor::Accelerometer => found.affects("corrected_reading", half * gravity, "m/s^2"),
        _ => found.affects("turn", half * std::f64::consts::FRAC_PI_2, "rad"),
    }
}

impl Differences {
    /// The differences as findings.
    pub fn findings(&self) -> Findings {
        let mut all = Findings::new();
        all.extend(self.0.iter().map(|own| own.finding.clone()));
        all
    }

    /// Those that no misfit of their sensor may explain, by the warnings of the fit.
    #[must_use]
    pub fn beside(mut self, warnings: &Findings) -> Self {
        let misfits = |sensor| {
            let mut all = warnings.iter();
            all.any(|found| found.kind == Kind::MISFIT && found.place.sensor == Some(sensor))
        };
        self.0
            .retain(|own| own.chance <= SAID_BESIDE_MISFIT.get() || !misfits(own.apart.sensor));
        self
    }

    /// Takes back that an effect is missing, where what differs from part to part looks like one to the fit of all.
    pub fn withdraw_effects(&self, warnings: &mut Findings) {
        let sensors: Vec<_> = self.0.iter().map(|own| own.apart.sensor).collect();
        warnings.retain(|found| {
            let is_other = |sensor: Sensor| !sensors.contains(&sensor);
            found.kind != Kind::EFFECT_MISSING
                || sensors.is_empty()
                || found.place.sensor.is_some_and(is_other)
        });
    }

    /// Adds `δδᵀ/4` to the covariance, `δ` the changes of the scale factors and misalignments: those of either part lie about half of
    /// them from what a fit to both finds.
    pub fn enlarge(&self, calibration: &mut Calibration, fit: &JointFit) {
        let values = calibration.parameter_values();
        let mut covariance = calibration.covariance_matrix();
        for Difference { apart, .. } in &self.0 {
            let scale = match apart.sensor {
                Sensor::Accelerometer => fit.force_unit.scale,
                _ => fit.rate_unit.scale,
            };
            let half = |name: &String| {
                let changes = apart.changes.iter();
                let own = changes.filter(|change| change.parameter == *name);
                own.map(|change| 0.5 * scale * change.size).sum::<f64>()
            };
            let halves = calibration.parameters.iter().map(half);
            let halves = DVector::from_iterator(calibration.parameters.len(), halves);
            covariance += &halves * halves.transpose();
        }
        if !self.0.is_empty() {
            calibration.write_parameters(&values, &covariance);
        }
    }
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
            .map_or(0.0, |[one, other]| PER_KELVIN.get() * (one - other).abs())
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
        (change - mean).abs() < CHANCE.get() * std && mean.abs() > 2.0 * CHANCE.get() * std
    };
    (all.len() == 3 && all.iter().all(is_common)).then_some(-mean)
}

/// A parameter in which two fits differ.
struct BetweenFits {
    /// Difference as a share of the scale.
    size: f64,
    scale: f64,
    parameter: String,
    /// In both.
    values: [f64; 2],
    /// In standard errors.
    distance: f64,
    /// Chance of so much in all parameters.
    p_value: f64,
}

/// The parameter in which two fits differ by most standard errors, where that is large enough to matter, and the chance of
/// `dᵀ C⁻¹ d` of all.
fn difference(a: &AccelerometerFit, b: &AccelerometerFit) -> Option<BetweenFits> {
    let scale = a.unit.scale.max(b.unit.scale);
    let place = |fit: &AccelerometerFit, name: &String| {
        let mut names = fit.fitted.free.iter();
        names.position(|own| own == name)
    };
    let is_own = |name: &&String| base_part(name).is_some_and(|(_, part)| part != BasePart::Bias);
    let both = a.fitted.free.iter().filter(is_own);
    let both = both.filter_map(|name| Some((name, place(a, name)?, place(b, name)?)));
    let both: Vec<(&String, usize, usize)> = both.collect();
    let n = both.len();
    let covariance = DMatrix::from_fn(n, n, |i, k| {
        let (one, other) = (&a.fitted.covariance, &b.fitted.covariance);
        one[both[i].1][both[k].1] + other[both[i].2][both[k].2]
    });
    let value = |fit: &AccelerometerFit, k: usize| fit.fitted.parameters.get(both[k].0);
    let values: Option<Vec<[f64; 2]>> =
        (0..n).map(|k| Some([value(a, k)?, value(b, k)?])).collect();
    let values = values?;
    let change = DVector::from_fn(n, |k, _| values[k][1] - values[k][0]);
    let times = |k: usize| change[k].abs() / covariance[(k, k)].sqrt();
    // The largest of those that clearly differ.
    let weight = |k: usize| times(k).min(2.0 * CHANCE.get()) * (1.0 + change[k].abs() / scale);
    let most = (0..n).max_by(|i, k| weight(*i).total_cmp(&weight(*k)))?;
    let dof = [n as f64, spare(a).min(spare(b))];
    let square = change.dot(&covariance.clone().cholesky()?.solve(&change));
    let size = change[most].abs() / scale;
    (size > NOTICED.get() && times(most).is_finite()).then(|| BetweenFits {
        size,
        scale,
        parameter: both[most].0.clone(),
        values: values[most],
        distance: times(most),
        p_value: chance::of_f(square / n as f64, dof),
    })
}
