//! Simulate → calibrate → apply to another recording: what is left is the noise.
//!
//! One trial is one effect and one method. The first recording has little noise, so that the calibration's own errors
//! are small beside the noise of the second one, in which the remainder is judged.

use calib::calibrate::{Method, Outcome, Request, calibrate};
use calib::calibration::{Calibration, apply};
use calib::intervals::{Segmentation, Span, StaticInterval};
use calib::residuals::{Integrator, attitude_of};
use calib::simulate::{
    HandHeld, MagneticField, Motion, SIZE, SensorSpec, Session, Spec, Temperature, Vibration,
};
use calib::{Error, Recording};
use nalgebra::{Matrix3, Vector3};
use sensor::{DefinedParam, Definition, EffectRef, Quantity, Sensor};

/// White noise densities of the second recording, m/s²/√Hz and rad/s/√Hz: so large that what an integrator misses
/// between samples is small beside them.
const WHITE: [f64; 2] = [4e-3, 4e-4];

/// Share of it in the first recording.
const QUIETER: f64 = 0.05;

/// Placements of the recording that is calibrated.
const FIRST: usize = 40;

/// What is cut off either end of a true placement, s.
const EDGE: f64 = 0.3;

/// One effect in one trial.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The effect.
    pub effect: EffectRef,
    /// Its text, where it is not compiled.
    pub definition: Option<Definition>,
    /// Times its typical size.
    pub size: f64,
}

/// What came of a trial.
#[derive(Debug)]
pub enum End {
    /// Reduced χ² with their degrees of freedom: of force at static intervals, of direction through turns.
    Left {
        /// By the calibration with the effect.
        with: [Chi2; 2],
        /// By one without it.
        without: [Chi2; 2],
    },
    /// A refusal of `calibrate` or `apply` because of what cannot be known.
    Refused(String),
    /// Another error.
    Failed(Error),
}

/// A sum of squares over its expectation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Chi2 {
    /// `Σ (r/σ)²`.
    pub sum: f64,
    /// Degrees of freedom.
    pub dof: f64,
}

impl Chi2 {
    /// Per degree of freedom.
    pub fn reduced(&self) -> f64 {
        self.sum / self.dof
    }
}

/// The whole catalogue and three effects written as text: with `alpha`, `change` and `vibration`.
pub fn trials() -> Vec<Trial> {
    let compiled = calib::calibration::catalogue().map(|effect| Trial {
        size: size_of(&effect),
        effect,
        definition: None,
    });
    let defined = definitions().into_iter().filter_map(|definition| {
        let effect = definition.effect().ok()?;
        Some(Trial {
            size: size_of(&effect),
            effect,
            definition: Some(definition),
        })
    });
    // Those of the magnetometer last: the seed of a trial is its place.
    let mut all: Vec<Trial> = compiled.chain(defined).collect();
    all.sort_by_key(|trial| trial.effect.sensor() == Sensor::Magnetometer);
    all
}

/// Times the typical size: vibration is small here, so that what it adds as noise is small too.
fn size_of(effect: &EffectRef) -> f64 {
    let shaken = effect.needs().contains(&Quantity::Vibration);
    match (shaken, effect.sensor()) {
        (true, Sensor::Accelerometer) => 15.0,
        // A table vibrates until the device leaves it, an interval ends a little before: over that time a gyroscope's error
        // goes uncorrected, and should stay below the noise of a turn.
        (true, Sensor::Gyroscope) => 6.0,
        // It shows where the axis of a turn turns, which is little of a turn.
        (false, Sensor::Gyroscope) if effect.is_positive() => 20.0,
        (_, Sensor::Magnetometer) | (false, _) => 3.0,
    }
}

/// The three texts.
pub fn definitions() -> [Definition; 3] {
    let k = |unit: &str, typical: f64| vec![DefinedParam::new("k", unit, typical)];
    [
        Definition {
            name: "gyro_lag_across".into(),
            x: "k * alphay".into(),
            y: "-k * alphax".into(),
            parameters: k("s", 1e-3),
            ..Definition::silent(Sensor::Gyroscope)
        },
        Definition {
            name: "accel_memory".into(),
            x: "k * changex * abs(fx)".into(),
            z: "k * changez".into(),
            parameters: k("1", 1e-3),
            ..Definition::silent(Sensor::Accelerometer)
        },
        Definition {
            name: "gyro_shaken".into(),
            x: "k * vibrationx".into(),
            y: "k * vibrationz".into(),
            parameters: k("rad*s^3/m^2", 1e-2),
            ..Definition::silent(Sensor::Gyroscope)
        },
    ]
}

impl Trial {
    fn spec(&self, seed: u64, placements: usize, noise: f64) -> Spec {
        let sensor = |white: f64| SensorSpec {
            white: Some(white * noise),
            ..SensorSpec::default()
        };
        let hand = HandHeld {
            placements: Some(placements),
            initial_rest: Some(20.0),
            shock: 0.0,
            ..HandHeld::default()
        };
        let needs = self.effect.needs();
        let mut spec = Spec {
            motion: Motion::HandHeld(hand),
            accelerometer: sensor(WHITE[0]),
            gyroscope: sensor(WHITE[1]),
            definitions: self.definition.clone().into_iter().collect(),
            ..Spec::hand_held(seed)
        };
        if needs.iter().any(|need| need.is_thermal()) {
            let mut temperature = Temperature::default();
            if needs.contains(&Quantity::Warming) || needs.contains(&Quantity::TemperatureRate) {
                // It has to cool down as well.
                (temperature.swing, temperature.period) = (6.0, 200.0);
            }
            spec.temperature = Some(temperature);
        }
        if self.effect.sensor() == Sensor::Magnetometer {
            spec.magnetic_field = Some(MagneticField::default());
        }
        if needs.contains(&Quantity::Vibration) {
            // A machine's: what its sine leaves in the mean of an interval is small beside the noise.
            spec.vibration = Some(Vibration {
                rms: 0.15,
                frequency: Some(37.0),
                ..Vibration::default()
            });
        }
        spec
    }

    fn switched_on(&self, mut spec: Spec) -> Spec {
        match self.effect.name() {
            "earth_rate" => spec.latitude = Some(50.0),
            name => {
                let size = [(SIZE.to_owned(), self.size)];
                spec.effects.insert(name.into(), size.into());
            }
        }
        spec
    }

    /// Two recordings of one device: the same parameters, other placements and noise.
    pub fn sessions(&self, seed: u64, placements: usize) -> Result<[Session; 2], Error> {
        let first = self.switched_on(self.spec(seed, FIRST, QUIETER)).run()?;
        let mut second = self.spec(seed + 1000, placements, 1.0);
        let earth = self.effect.name() == "earth_rate";
        second.latitude = earth.then_some(50.0);
        for parameters in Sensor::ALL.map(|sensor| first.truth.parameters(sensor)) {
            for (name, value) in parameters.names().iter().zip(parameters.values()) {
                let own = name.strip_prefix(&format!("{}.", self.effect.name()));
                match own {
                    Some(_) if earth => {}
                    Some(own) => {
                        let effect = self.effect.name().to_owned();
                        let values = second.effects.entry(effect).or_default();
                        values.insert(own.into(), *value);
                    }
                    None => {
                        second.parameters.insert(name.clone(), *value);
                    }
                }
            }
        }
        Ok([first, second.run()?])
    }

    /// Runs it.
    pub fn run(&self, method: Method, seed: u64, placements: usize) -> End {
        match self.left(method, seed, placements) {
            Ok((with, without)) => End::Left { with, without },
            Err(Error::NotEnough(why)) => End::Refused(why.text(findings::Front::Plain)),
            Err(other) => End::Failed(other),
        }
    }

    fn left(
        &self,
        method: Method,
        seed: u64,
        placements: usize,
    ) -> Result<([Chi2; 2], [Chi2; 2]), Error> {
        let [first, second] = self.sessions(seed, placements)?;
        let with = calibrated(&first, method, std::slice::from_ref(&self.effect))?.calibration;
        let with = remainder(&with, &second)?;
        let without = calibrated(&first, method, &[])?.calibration;
        Ok((with, remainder(&without, &second)?))
    }
}

/// Calibrates a session with its true placements.
pub fn calibrated(
    session: &Session,
    method: Method,
    effects: &[EffectRef],
) -> Result<Outcome, Error> {
    let request = Request {
        method,
        gravity: session.truth.spec.gravity,
        effects: effects.to_vec(),
        sections: vec![placements(session)],
        ..Request::default()
    };
    calibrate(std::slice::from_ref(&session.recording), &[], &request)
}

fn placements(session: &Session) -> Vec<Span> {
    let rests = session.truth.static_intervals.iter();
    let inside = |rest: &calib::simulate::StaticInterval| Span {
        from: rest.start + EDGE,
        to: rest.end - EDGE,
    };
    rests.map(inside).collect()
}

/// What a calibration leaves of another session, against its noise.
pub fn remainder(calibration: &Calibration, session: &Session) -> Result<[Chi2; 2], Error> {
    let corrected = apply(calibration, &session.recording)?;
    let cut = Segmentation::from_spans(&corrected, &placements(session), 10.0);
    let gravity = session.truth.spec.gravity;
    let mut force = Chi2::default();
    let t = calibration
        .triad(Sensor::Accelerometer)
        .map_or_else(Matrix3::identity, |triad| triad.base().t);
    let step = 1.0 / session.truth.spec.rate;
    let white = session.truth.accelerometer_noise.white.powi(2) / step;
    for rest in cut.statics.iter().filter_map(|rest| rest.accelerometer) {
        let u = rest.mean.normalize();
        let variance = white * t.tr_mul(&u).norm_squared() / rest.count as f64;
        force.sum += (rest.mean.norm() - gravity).powi(2) / variance;
        force.dof += 1.0;
    }
    Ok([force, directions(&corrected, &cut, session)])
}

/// Gravity carried through the turns by the corrected rate, nothing taken off.
fn directions(corrected: &Recording, cut: &Segmentation, session: &Session) -> Chi2 {
    let mut chi2 = Chi2::default();
    let Some(rate) = &corrected.gyroscope else {
        return chi2;
    };
    let gravity = session.truth.spec.gravity;
    let white = session.truth.gyroscope_noise.white;
    for turn in &cut.turns {
        let ends = [&cut.statics[turn.from], &cut.statics[turn.from + 1]];
        let up = |rest: &StaticInterval| rest.accelerometer.map_or_else(Vector3::zeros, |m| m.mean);
        let samples = turn.samples.clone();
        let (t, values) = (&rate.t[samples.clone()], &rate.values[samples]);
        let predicted =
            attitude_of(Integrator::Exponential, t, |k| values[k]).into_body(&up(ends[0]));
        let tilt = |rest: &StaticInterval| {
            rest.accelerometer.map_or(0.0, |m| {
                let density = session.truth.accelerometer_noise.white.powi(2);
                density * session.truth.spec.rate / m.count as f64 / gravity.powi(2)
            })
        };
        let length = t.last().zip(t.first()).map_or(0.0, |(b, a)| b - a);
        let variance = white.powi(2) * length + tilt(ends[0]) + tilt(ends[1]);
        chi2.sum += predicted.angle(&up(ends[1])).powi(2) / variance;
        chi2.dof += 2.0;
    }
    chi2
}
