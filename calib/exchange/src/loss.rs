//! Losses of an export: the parts of a calibration that a target does not hold, and their size for this device.

use std::fmt;

use crate::targets::code::is_code;
use calib::effects::force_sensitivity;
use findings::{Finding, Kind, human};
use nalgebra::{Matrix3, Vector3};
use sensor::{Base, Kinematics, Model, Quantity, Sensor};
use serde::Serialize;

use crate::kept::Kept;
use crate::source::{Source, diagonal};

/// A size below this is rounding.
const ROUNDING: f64 = 1e-12;

/// Rate of warming at which effects are evaluated, K/s.
const WARMING: f64 = 0.05;

/// Root mean square of its vibration there, m/s².
const SHAKEN: f64 = 0.1;

/// Times at which effects are evaluated, s, in words.
const TIMES: [(f64, &str); 2] = [(0.0, "at the start"), (60.0, "after a minute")];

/// Temperature difference from the reference at which they are, K.
const WARMER: f64 = 10.0;

/// Angular acceleration over the rate of 1 rad/s, 1/s: of a turn that a hand begins.
const FASTER: f64 = 10.0;

/// Something that a target does not hold.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Loss {
    /// Name of the part of the calibration that is lost.
    pub what: String,
    /// The largest error of the corrected signal without it, over faces, edges and corners, SI units; null where it is no
    /// error of the signal.
    pub size: Option<f64>,
    /// Unit of the size.
    pub unit: &'static str,
    /// At which signal.
    pub at: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.finding().what())
    }
}

impl Loss {
    /// The loss as a remark.
    pub fn finding(&self) -> Finding {
        self.as_kind(Kind::LOST_IN_EXPORT)
    }

    /// The loss as a remark of a kind.
    pub(crate) fn as_kind(&self, kind: Kind) -> Finding {
        let lost = Finding::of(kind).detail("what", &self.what);
        // The document has the units of `cal.json`.
        let unit = match self.unit {
            "uT" => "µT",
            unit => unit,
        };
        match self.size {
            Some(size) => lost
                .detail("size", human(size, unit))
                .detail("signal", &self.at),
            None => lost,
        }
    }
}

/// Returns the parts of a calibration that `kept` does not hold.
pub(crate) fn losses(source: &Source<'_>, kept: &Kept) -> Vec<Loss> {
    let mut lost = Vec::new();
    for (sensor, own, left) in [
        (
            Sensor::Accelerometer,
            &source.accelerometer,
            &kept.accelerometer,
        ),
        (Sensor::Gyroscope, &source.gyroscope, &kept.gyroscope),
        (
            Sensor::Magnetometer,
            &source.magnetometer,
            &kept.magnetometer,
        ),
    ] {
        if let Some(own) = own {
            lost.extend(of_base(
                sensor,
                own,
                left.as_ref(),
                source.calibration.gravity,
            ));
        }
    }
    lost.extend(of_effects(source, kept));
    let has_errors = !source.calibration.covariance.is_empty();
    if has_errors && !kept.errors {
        lost.push(Loss {
            what: "standard errors and covariance".into(),
            size: None,
            unit: "",
            at: String::new(),
        });
    }
    lost
}

fn of_base(sensor: Sensor, own: &Base<f64>, left: Option<&Base<f64>>, gravity: f64) -> Vec<Loss> {
    let name = sensor.name();
    let size = |other: &Base<f64>| {
        let errors = probes(sensor, gravity).filter_map(|signal| {
            let raw = own.distort(&signal)?;
            Some((other.correct(&raw) - signal).norm())
        });
        errors.fold(0.0, f64::max)
    };
    let Some(left) = left else {
        let raw = Base::identity();
        return vec![loss(
            sensor,
            format!("the whole calibration of the {name}"),
            size(&raw),
        )];
    };
    let off = |m: &Matrix3<f64>| m - diagonal(m);
    let mut lost = Vec::new();
    let mut say = |what: &str, without: Base<f64>| {
        let size = size(&without);
        if size > ROUNDING {
            lost.push(loss(sensor, format!("{what} of the {name}"), size));
        }
    };
    if off(&left.t) != off(&own.t) {
        say(
            "misalignments",
            Base {
                t: diagonal(&own.t) + off(&left.t),
                ..*own
            },
        );
    }
    if diagonal(&left.t) != diagonal(&own.t) {
        let scales = diagonal(&own.t) - diagonal(&left.t);
        say(
            "scale factors",
            Base {
                t: own.t - scales,
                ..*own
            },
        );
    }
    if left.bias != own.bias {
        say(
            "bias",
            Base {
                bias: left.bias,
                ..*own
            },
        );
    }
    lost
}

fn of_effects(source: &Source<'_>, kept: &Kept) -> Vec<Loss> {
    let mut lost = Vec::new();
    if kept.effects {
        return lost;
    }
    let gravity = source.calibration.gravity;
    for values in &source.calibration.effects {
        if values.name == force_sensitivity().name() && kept.g_sensitivity {
            continue;
        }
        let Ok(effect) = values.effect() else {
            continue;
        };
        if kept.formulas && is_code(&effect) {
            continue;
        }
        let sensor = effect.sensor();
        let needs = effect.needs();
        let model = Model::base(sensor).with(effect);
        let mut p = Base::identity().parameters().to_vec();
        p.extend(values.parameters.iter().map(|v| v.value));
        let errors = TIMES.iter().flat_map(|(time, when)| {
            let size = size_at(&model, &p, gravity, *time);
            (size > ROUNDING).then_some((size, *when))
        });
        let largest = errors.max_by(|a, b| a.0.total_cmp(&b.0));
        let mut own = loss(sensor, format!("the effect {}", values.name), 0.0);
        // Which there is none of at any of these states says nothing of its size.
        own.size = largest.map(|(size, _)| size);
        if let Some((_, when)) = largest
            && !needs.is_empty()
        {
            own.at = state(&needs, when);
        }
        lost.push(own);
    }
    lost
}

/// The largest error of a model's effect over directions of force and rate at a time, SI units.
fn size_at(model: &Model, p: &[f64], gravity: f64, time: f64) -> f64 {
    let errors = probes(Sensor::Accelerometer, gravity).flat_map(|force| {
        probes(Sensor::Gyroscope, gravity).map(move |rate| {
            let mut truth = Kinematics::new(force, rate);
            truth.time = time;
            truth.temperature += WARMER;
            truth.last_change = force.map(f64::signum);
            truth.temperature_rate = WARMING;
            truth.warming = 1.0;
            truth.vibration = Vector3::repeat(SHAKEN * SHAKEN);
            truth.last_turn = Vector3::repeat(1.0);
            truth.angular_acceleration = rate * FASTER;
            truth.specific_force_rate = force.cross(&rate);
            let error: Vector3<f64> = model.error(&truth, p);
            error.norm()
        })
    });
    errors.fold(0.0, f64::max)
}

/// The state at which the size of an effect is stated, of what it depends on.
fn state(needs: &[Quantity], when: &str) -> String {
    let of = |quantity: &Quantity| match quantity {
        Quantity::SpecificForce | Quantity::SpecificForceRate => "1 g",
        Quantity::AngularRate => "1 rad/s",
        Quantity::MagneticField => "50 µT",
        Quantity::Time => when,
        Quantity::Temperature => "10 K from its reference",
        Quantity::AngularAcceleration => "10 rad/s²",
        Quantity::TemperatureRate | Quantity::Warming => "warming by .05 K/s",
        Quantity::Vibration => "shaken by .1 m/s²",
        Quantity::LastChange | Quantity::LastTurn | Quantity::SinceTurn => "right after a turn",
        Quantity::Attitude => "an attitude of the room",
    };
    let mut parts: Vec<&str> = needs.iter().map(of).collect();
    parts.dedup();
    parts.join(", ")
}

fn loss(sensor: Sensor, what: String, size: f64) -> Loss {
    let (unit, at) = match sensor {
        Sensor::Accelerometer => ("m/s^2", "1 g"),
        Sensor::Gyroscope => ("rad/s", "1 rad/s"),
        Sensor::Magnetometer => ("uT", "50 µT"),
    };
    Loss {
        what,
        size: Some(size),
        unit,
        at: at.into(),
    }
}

/// One g or one radian per second along faces, edges and corners.
fn probes(sensor: Sensor, gravity: f64) -> impl Iterator<Item = Vector3<f64>> {
    let size = match sensor {
        Sensor::Accelerometer => gravity,
        Sensor::Gyroscope => 1.0,
        Sensor::Magnetometer => 50.0,
    };
    let all = (0..27).map(|k| Vector3::new(k % 3, k / 3 % 3, k / 9).map(|v| f64::from(v) - 1.0));
    all.filter(|v| v.norm() > 0.5)
        .map(move |v| v.normalize() * size)
}
