//! `apply(raw)`: the whole definition of the corrected signal.

use findings::{Finding, Kind};
use recording::intervals::{Detector, Segmentation, StaticInterval, segment};
use recording::watch::{Stage, Watch};
use recording::{Error, Recording, ScalarStream, Stream, figure};
use sensor::{Base, Quantity, Role, ScalarSensorRef, Sensor};

use super::scalar::ScalarValues;
use super::{Calibration, EffectValues};
use crate::methods::MULTIPLIERS;
use crate::truth::{Models, Truth, require_of_instants};

findings::tuning! {
    /// Readings between two looks at whether the work is to end.
    BETWEEN_STEPS: usize = 1 << 12;

    /// A static interval shows gravity to within this share: more than effects and moved biases make of it.
    AT_GRAVITY: f64 = 0.03;
}

/// The corrected recording, each sensor on its own clock. A sensor that the calibration does not
/// speak of stays raw, which a warning says. Of several recordings that the calibration is made from
/// each has its own biases taken off, any other those that the calibration states for the device.
///
/// Where effects look at static intervals these are detected.
///
/// # Errors
/// [`Error::NotEnough`] where an effect needs what cannot be known of this recording; it names both.
pub fn apply(calibration: &Calibration, recording: &Recording) -> Result<Recording, Error> {
    apply_under(&Watch::default(), calibration, recording)
}

/// [`apply`] under a watch.
///
/// # Errors
/// As [`apply`]; that the watch ended it.
pub fn apply_under(
    watch: &Watch,
    calibration: &Calibration,
    recording: &Recording,
) -> Result<Recording, Error> {
    corrected(calibration, recording, None, watch)
}

/// [`apply`] with static intervals that are known already.
///
/// # Errors
/// As [`apply`].
pub fn apply_with(
    calibration: &Calibration,
    recording: &Recording,
    intervals: Option<&Segmentation>,
) -> Result<Recording, Error> {
    corrected(calibration, recording, intervals, &Watch::default())
}

fn corrected(
    calibration: &Calibration,
    recording: &Recording,
    intervals: Option<&Segmentation>,
    watch: &Watch,
) -> Result<Recording, Error> {
    calibration.knows_its_effects()?;
    let doubt = belongs_to(calibration, recording)?;
    let of_another = calibration.doubts_biases_of(recording);
    let calibration = calibration.of_recording(recording);
    let calibration = calibration.as_ref();
    let models = Models::of(calibration);
    let found = match intervals {
        None if looks_at_intervals(&models) => intervals_of(calibration, recording)?,
        _ => None,
    };
    let truth = Truth::of(recording, intervals.or(found.as_ref()), models.clone())?;
    let mut corrected = recording.clone();
    corrected.warnings.extend(calibration.bias_alone());
    corrected
        .warnings
        .extend(doubt.into_iter().chain(of_another));
    if let (Some(field), true) = (
        &mut corrected.magnetometer,
        calibration.magnetometer.is_some(),
    ) {
        field.convert_to_microtesla();
        let own = calibration.magnetic_field.as_ref();
        if own.is_some_and(|own| (own.unit_of_readings() == "uT") != field.unit.is_some()) {
            corrected
                .warnings
                .push(Finding::of(Kind::MAGNETOMETER_UNIT_UNCLEAR));
        }
    }
    for sensor in Sensor::ALL {
        let Some(stream) = corrected.stream_mut(sensor) else {
            continue;
        };
        match models.get(sensor) {
            Some(sensing) if sensing.model.effects().is_empty() => {
                let base = Base::from_parameters(&sensing.parameters);
                stream.values.iter_mut().for_each(|v| *v = base.correct(v));
            }
            Some(_) => correct(stream, sensor, &truth, &models, watch)?,
            None => {
                let found = Finding::of(Kind::LEFT_AS_READ).of_sensor(sensor);
                let why = calibration.why_not(sensor);
                corrected.warnings.push(match why {
                    Some(own) => found.detail("why", own.reason.in_words()),
                    None => found,
                });
            }
        }
    }
    for stream in &mut corrected.scalars {
        let own = calibration.scalar(&stream.name);
        match own.and_then(|own| Some((own, own.sensor.as_ref()?))) {
            Some((own, sensor)) => correct_scalar(own, sensor, stream, recording, &truth)?,
            None => corrected
                .warnings
                .push(Finding::of(Kind::SCALAR_LEFT_AS_READ).detail("name", &*stream.name)),
        }
    }
    Ok(corrected)
}

fn correct(
    stream: &mut Stream,
    sensor: Sensor,
    truth: &Truth<'_>,
    models: &Models,
    watch: &Watch,
) -> Result<(), Error> {
    let Some(sensing) = models.get(sensor) else {
        return Ok(());
    };
    for (k, (t, value)) in stream.t.iter().zip(&mut stream.values).enumerate() {
        if k % BETWEEN_STEPS.get() == 0 {
            watch.step(Stage::Correcting)?;
        }
        *value = sensing.correct(value, &truth.at(*t));
    }
    Ok(())
}

/// Corrects the readings of a sensor of one dimension in place.
fn correct_scalar(
    own: &ScalarValues,
    sensor: &ScalarSensorRef,
    stream: &mut ScalarStream,
    recording: &Recording,
    truth: &Truth<'_>,
) -> Result<(), Error> {
    require_of_instants(sensor, recording, None, truth.models())?;
    let p: Vec<f64> = own.parameters.iter().map(|p| p.value).collect();
    for (t, value) in stream.t.iter().zip(&mut stream.values) {
        let signal = sensor.signal(*value, &truth.at(*t), &p);
        *value = signal.ok_or_else(|| {
            Error::not_enough(
                Finding::of(Kind::SCALAR_UNSOLVED)
                    .detail("name", &*own.name)
                    .detail("reading", figure(*value))
                    .number("time", *t, "s"),
            )
        })?;
    }
    Ok(())
}

impl Calibration {
    /// The calibration of a sensor of one dimension.
    pub fn scalar(&self, name: &str) -> Option<&ScalarValues> {
        self.scalars.iter().find(|own| own.name == name)
    }

    /// The same, as read from a file, with the sensors of one dimension that this program knows.
    ///
    /// # Errors
    /// [`Error::Input`] where a sensor has other parameters than the file.
    pub fn with_sensors(mut self, sensors: &[ScalarSensorRef]) -> Result<Self, Error> {
        for values in &mut self.scalars {
            let Some(sensor) = sensors.iter().find(|own| own.name() == values.name) else {
                continue;
            };
            let own: Vec<&str> = sensor.params().iter().map(|p| &*p.name).collect();
            let found: Vec<&str> = values.parameters.iter().map(|p| p.name.as_str()).collect();
            if own != found {
                return Err(Error::input(
                    Finding::of(Kind::ENTRY_OTHER)
                        .detail("key", format!("scalars.{}.parameters", values.name))
                        .detail("found", found.join(", "))
                        .detail("expected", own.join(", ")),
                ));
            }
            values.sensor = Some(sensor.clone());
        }
        Ok(self)
    }
}

/// Refuses effects with an instant or a heading of another recording. What to say where the calibration does not tell
/// from which recordings it is.
fn belongs_to(calibration: &Calibration, recording: &Recording) -> Result<Option<Finding>, Error> {
    let mut first = None;
    for values in &calibration.effects {
        let effect = values.effect().map_err(Error::input)?;
        for (param, value) in effect.params().iter().zip(&values.parameters) {
            let bound = match param.role {
                Role::Instant => true,
                Role::Reference => value.value != 0.0,
                Role::Coefficient | Role::Shape | Role::TimeConstant => false,
            };
            if bound && first.is_none() {
                first = Some((effect.clone(), param.clone(), value.value));
            }
        }
    }
    let made_from = calibration.was_made_from(recording);
    let Some((effect, param, value)) = first else {
        let drifts = drifting(calibration).filter(|_| made_from == Some(false));
        return Ok(drifts.map(|name| {
            Finding::of(Kind::EFFECT_FROM_START)
                .in_recording(&recording.name)
                .detail("effect", name)
        }));
    };
    let inputs = calibration.provenance.inputs.iter();
    let inputs: Vec<&str> = inputs.map(|input| input.recording.as_str()).collect();
    let of = |kind| {
        Finding::of(kind)
            .detail("effect", effect.name())
            .detail("parameter", &*param.name)
            .detail("inputs", inputs.join(", "))
    };
    match (made_from, param.role) {
        (Some(true), _) => Ok(None),
        (None, _) => Ok(Some(
            of(Kind::EFFECT_OF_RECORDINGS).detail("value", figure(value)),
        )),
        (Some(false), Role::Instant) => Err(Error::not_enough(
            of(Kind::EFFECT_NEEDS_START)
                .in_recording(&recording.name)
                .number("value", value, "s"),
        )),
        (Some(false), _) => Err(Error::not_enough(
            of(Kind::EFFECT_NEEDS_HEADING).in_recording(&recording.name),
        )),
    }
}

/// The first effect that goes by the time since the start of a recording.
fn drifting(calibration: &Calibration) -> Option<&str> {
    let mut effects = calibration.effects.iter();
    let goes_by_time = |values: &&EffectValues| {
        let effect = values.effect();
        effect.is_ok_and(|effect| effect.needs().contains(&Quantity::Time))
    };
    Some(effects.find(goes_by_time)?.name.as_str())
}

/// Returns true if an effect depends on a quantity that only static intervals determine.
fn looks_at_intervals(models: &Models) -> bool {
    let mut needs = models.effects().flat_map(|effect| effect.needs());
    needs.any(Quantity::is_told_by_intervals)
}

/// The static intervals of a recording; none where it shows none.
///
/// Those of the multiplier with the most intervals in which the corrected norm is gravity: a table that vibrates is still
/// a place of rest, and a multiplier chosen by the smallest residual would leave it out.
fn intervals_of(
    calibration: &Calibration,
    recording: &Recording,
) -> Result<Option<Segmentation>, Error> {
    let Some(triad) = calibration.triad(Sensor::Accelerometer) else {
        return Ok(None);
    };
    let (base, gravity) = (triad.base(), calibration.gravity);
    let at_gravity = |rest: &&StaticInterval| {
        let norm = rest.accelerometer.map(|m| base.correct(&m.mean).norm());
        norm.is_some_and(|norm| (norm / gravity - 1.0).abs() < AT_GRAVITY.get())
    };
    let mut best: Option<(usize, Segmentation)> = None;
    for multiplier in MULTIPLIERS {
        let detector = Detector {
            multiplier,
            ..Detector::default()
        };
        let found = match segment(recording, &detector) {
            Ok(found) => found,
            Err(Error::NotEnough(_)) => continue,
            Err(other) => return Err(other),
        };
        let count = found.statics.iter().filter(at_gravity).count();
        if best.as_ref().is_none_or(|(most, _)| count > *most) {
            best = Some((count, found));
        }
    }
    Ok(best.map(|(_, found)| found))
}
