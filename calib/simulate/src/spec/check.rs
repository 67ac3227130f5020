//! Numbers that a spec must not have.

use findings::{Finding, Kind};
use recording::Error;

use super::complaint::{Complaint, number};
use super::{Motion, SensorSpec, Spec};
use crate::surroundings::{Fault, MagneticField, Temperature, Unsteady, Vibration};

/// Longest recording, s: 30 days.
const LONGEST: f64 = 30.0 * 86400.0;
/// Most placements.
const PLACEMENTS: usize = 10_000;
/// Shortest turn, s: a table contact takes the last 0.4 s of it.
const SHORTEST_TURN: f64 = 0.5;
/// Largest of anything in SI units.
const LARGE: f64 = 1e6;

impl Spec {
    /// Looks through all keys.
    ///
    /// # Errors
    /// [`Error::Usage`] with the key, what was found and what is expected.
    pub fn check(&self) -> Result<(), Error> {
        Ok(self.complaint().map_or(Ok(()), Err)?)
    }

    /// Returns the first complaint about the spec, if there is one.
    pub(crate) fn complaint(&self) -> Option<Complaint> {
        self.check_numbers().and_then(|()| self.check_names()).err()
    }

    fn check_numbers(&self) -> Result<(), Complaint> {
        number("rate", self.rate, 0.01..=100_000.0)?;
        number("gravity", self.gravity, 1.0..=100.0)?;
        number("latitude", self.latitude.unwrap_or(0.0), -90.0..=90.0)?;
        for length in self.lever_arm {
            number("lever_arm", length, -10.0..=10.0)?;
        }
        self.check_motion()?;
        self.accelerometer.check("accelerometer", self.rate)?;
        self.gyroscope.check("gyroscope", self.rate)?;
        self.magnetometer.check("magnetometer", self.rate)?;
        if let Some(field) = &self.magnetic_field {
            field.check()?;
        }
        if let Some(temperature) = &self.temperature {
            temperature.check()?;
        }
        if let Some(vibration) = &self.vibration {
            vibration.check()?;
        }
        if let Some(unsteady) = &self.unsteady {
            unsteady.check()?;
        }
        self.faults
            .iter()
            .enumerate()
            .try_for_each(|(k, fault)| fault.check(k))?;
        let mut hidden = self.hidden.iter().enumerate();
        hidden.try_for_each(|(k, hidden)| hidden.check(k))
    }

    fn check_motion(&self) -> Result<(), Complaint> {
        match &self.motion {
            Motion::HandHeld(m) => {
                let key = |name: &str| format!("motion.hand_held.{name}");
                let count = m.placements.unwrap_or(30) as f64;
                number(&key("placements"), count, 2.0..=PLACEMENTS as f64)?;
                number(
                    &key("initial_rest"),
                    m.initial_rest.unwrap_or(60.0),
                    0.1..=LONGEST,
                )?;
                range(&key("rest"), m.rest, 0.1)?;
                range(&key("turn"), m.turn, SHORTEST_TURN)?;
                number(&key("scatter"), m.scatter, 0.0..=1.0)?;
                number(&key("lift"), m.lift, 0.0..=10.0)?;
                number(&key("tremor"), m.tremor, 0.0..=100.0)?;
                number(&key("shock"), m.shock, 0.0..=LARGE)?;
                number(&key("knocks"), m.knocks as f64, 0.0..=1000.0)?;
                number(&key("knock_rate"), m.knock_rate, 0.0..=1000.0)
            }
            Motion::Planned(m) => {
                let key = |name: &str| format!("motion.planned.{name}");
                direction(&key("up"), m.up)?;
                number(&key("first_rest"), m.first_rest, 0.1..=LONGEST)?;
                number(&key("steps"), m.steps.len() as f64, 0.0..=PLACEMENTS as f64)?;
                number(&key("scatter"), m.scatter, 0.0..=1.0)?;
                number(&key("lift"), m.lift, 0.0..=10.0)?;
                number(&key("tremor"), m.tremor, 0.0..=100.0)?;
                for (k, step) in m.steps.iter().enumerate() {
                    let key = |name: &str| format!("motion.planned.steps.{k}.{name}");
                    number(&key("rest"), step.rest, 0.1..=LONGEST)?;
                    number(&key("legs"), step.legs.len() as f64, 1.0..=100.0)?;
                    for leg in &step.legs {
                        direction(&key("axis"), leg.axis)?;
                        number(&key("angle"), leg.angle, -100.0..=100.0)?;
                        number(&key("duration"), leg.duration, SHORTEST_TURN..=3600.0)?;
                    }
                }
                Ok(())
            }
            Motion::SixPosition(m) => {
                number("motion.six_position.rest", m.rest, 0.1..=LONGEST / 6.0)?;
                number("motion.six_position.turn", m.turn, SHORTEST_TURN..=3600.0)?;
                number("motion.six_position.scatter", m.scatter, 0.0..=1.0)
            }
            Motion::Still(m) => {
                number("motion.still.duration", m.duration, 0.1..=LONGEST)?;
                direction("motion.still.up", m.up)
            }
            Motion::Cart(m) => {
                number("motion.cart.distance", m.distance, -1e4..=1e4)?;
                number("motion.cart.duration", m.duration, 0.1..=LONGEST)?;
                number("motion.cart.rest", m.rest, 0.1..=LONGEST)?;
                number("motion.cart.rattle", m.rattle, 0.0..=LARGE)?;
                direction("motion.cart.along", m.along)
            }
            Motion::Walking(m) => {
                number("motion.walking.distance", m.distance, -1e4..=1e4)?;
                number("motion.walking.duration", m.duration, 0.1..=LONGEST)?;
                number("motion.walking.rest", m.rest, 0.1..=LONGEST)?;
                number("motion.walking.pitch", m.pitch, -3.2..=3.2)?;
                number("motion.walking.cadence", m.cadence, 0.0..=20.0)?;
                number("motion.walking.bob", m.bob, 0.0..=1.0)
            }
        }
    }

    /// Faults that name a placement or a turn, once the number of both is known.
    pub(crate) fn check_faults(&self, placements: usize, turns: usize) -> Result<(), Error> {
        for (k, fault) in self.faults.iter().enumerate() {
            let (key, place, count) = match *fault {
                Fault::Slip { interval, .. }
                | Fault::Touch { interval, .. }
                | Fault::Disturbed { interval, .. } => ("interval", interval, placements),
                Fault::Lost { turn, .. } => ("turn", turn, turns),
                Fault::Gap { .. } | Fault::ClockChange { .. } => continue,
            };
            if place >= count {
                let things = if key == "turn" { "turns" } else { "placements" };
                let found = Finding::of(Kind::PLACE_MISSING)
                    .count("place", place)
                    .count("count", count)
                    .detail("things", things);
                return Err(Complaint::new(format!("faults.{k}.{key}"), found).into());
            }
        }
        Ok(())
    }
}

impl MagneticField {
    fn check(&self) -> Result<(), Complaint> {
        let key = |name: &str| format!("magnetic_field.{name}");
        number(&key("strength"), self.strength, 1e-3..=LARGE)?;
        number(&key("inclination"), self.inclination, -90.0..=90.0)?;
        number(&key("unevenness"), self.unevenness, 0.0..=LARGE)
    }
}

impl SensorSpec {
    fn check(&self, sensor: &str, rate: f64) -> Result<(), Complaint> {
        let key = |name: &str| format!("{sensor}.{name}");
        number(&key("white"), self.white.unwrap_or(0.0), 0.0..=LARGE)?;
        number(&key("random_walk"), self.random_walk, 0.0..=LARGE)?;
        number(&key("instability"), self.instability, 0.0..=LARGE)?;
        number(&key("step"), self.step, 0.0..=LARGE)?;
        number(
            &key("low_pass"),
            self.low_pass.unwrap_or(1e-3),
            1e-3..=LARGE,
        )?;
        number(&key("correlation"), self.correlation, -0.999..=0.999)?;
        if let Some(spikes) = self.spikes {
            number(&key("spikes.share"), spikes.share, 0.0..=1.0)?;
            number(&key("spikes.size"), spikes.size, -LARGE..=LARGE)?;
        }
        number(&key("thermal_drift"), self.thermal_drift, 0.0..=LARGE)?;
        number(&key("dead_zone"), self.dead_zone, 0.0..=LARGE)?;
        number(&key("range"), self.range.unwrap_or(1.0), 1e-9..=1e12)?;
        if self.counts && self.step == 0.0 {
            let found = Finding::of(Kind::STEP_MISSING);
            return Err(Complaint::new(key("counts"), found));
        }
        let clock = &self.clock;
        let own_rate = clock.rate.unwrap_or(rate);
        number(&key("clock.rate"), own_rate, 0.01..=100_000.0)?;
        number(&key("clock.phase"), clock.phase, 0.0..=LARGE)?;
        number(&key("clock.offset"), clock.offset, -LARGE..=LARGE)?;
        number(&key("clock.rate_error"), clock.rate_error, -0.5..=0.5)?;
        number(&key("clock.jitter"), clock.jitter, 0.0..=LARGE)?;
        number(
            &key("clock.sampling_jitter"),
            clock.sampling_jitter,
            0.0..=LARGE,
        )?;
        number(&key("clock.lost"), clock.lost, 0.0..=0.9)?;
        if let Some(resampled) = self.resampled {
            number(&key("resampled.rate"), resampled.rate, 0.01..=100_000.0)?;
        }
        let effective = self.resampled.map_or(own_rate, |r| r.rate);
        if self
            .low_pass
            .is_some_and(|corner| corner >= 0.5 * effective)
        {
            let found = Finding::of(Kind::FILTER_TOO_HIGH);
            return Err(Complaint::new(key("low_pass"), found));
        }
        // Jitter brings two stamps to a tenth of a step; a coarser clock would make them equal.
        let jitters = clock.jitter > 0.0 || clock.sampling_jitter > 0.0;
        let finest = own_rate.recip() * if jitters { 0.1 } else { 0.5 };
        number(&key("clock.resolution"), clock.resolution, 0.0..=finest)
    }
}

impl Temperature {
    fn check(&self) -> Result<(), Complaint> {
        let key = |name: &str| format!("temperature.{name}");
        number(&key("ambient"), self.ambient, -273.15..=1000.0)?;
        number(&key("drift"), self.drift, -100.0..=100.0)?;
        number(&key("swing"), self.swing, -1000.0..=1000.0)?;
        number(&key("self_heating"), self.self_heating, -1000.0..=1000.0)?;
        number(&key("period"), self.period, 1e-3..=1e9)?;
        number(&key("tau"), self.tau, 1e-3..=1e9)?;
        number(&key("rate"), self.rate, 1e-6..=10.0)?;
        number(&key("noise"), self.noise, 0.0..=1000.0)
    }
}

impl Vibration {
    fn check(&self) -> Result<(), Complaint> {
        number("vibration.rms", self.rms, 0.0..=LARGE)?;
        number("vibration.share", self.share, 0.0..=1.0)?;
        let frequency = self.frequency.unwrap_or(1.0);
        number("vibration.frequency", frequency, 1e-3..=LARGE)?;
        number("vibration.rocking", self.rocking, 0.0..=LARGE)
    }
}

impl Unsteady {
    fn check(&self) -> Result<(), Complaint> {
        number("unsteady.tremor", self.tremor, 0.0..=100.0)?;
        number("unsteady.sway", self.sway, 0.0..=1.0)?;
        number("unsteady.yaw", self.yaw, -100.0..=100.0)?;
        number("unsteady.settling", self.settling, 0.0..=1.0)?;
        number("unsteady.share", self.share, 0.0..=1.0)
    }
}

impl Fault {
    fn check(&self, place: usize) -> Result<(), Complaint> {
        let key = |name: &str| format!("faults.{place}.{name}");
        match *self {
            Self::Slip { angle, .. } => number(&key("slip.angle"), angle, -3.2..=3.2),
            Self::Touch { size, .. } => number(&key("touch.size"), size, -LARGE..=LARGE),
            Self::Disturbed { size, .. } => number(&key("disturbed.size"), size, -LARGE..=LARGE),
            Self::Lost { length, .. } => number(&key("lost.length"), length, 0.0..=SHORTEST_TURN),
            Self::Gap { start, length } => {
                number(&key("gap.start"), start, 0.0..=LONGEST)?;
                number(&key("gap.length"), length, 0.0..=LONGEST)
            }
            Self::ClockChange { start, rate_error } => {
                number(&key("clock_change.start"), start, 0.0..=LONGEST)?;
                number(&key("clock_change.rate_error"), rate_error, -0.5..=0.5)
            }
        }
    }
}

/// Shortest and longest of something, s.
fn range(key: &str, [from, to]: [f64; 2], shortest: f64) -> Result<(), Complaint> {
    number(key, from, shortest..=LONGEST)?;
    number(key, to, from..=LONGEST)
}

fn direction(key: &str, v: [f64; 3]) -> Result<(), Complaint> {
    v.iter().try_for_each(|&c| number(key, c, -LARGE..=LARGE))?;
    match v.iter().any(|c| c.abs() > 1e-6) {
        true => Ok(()),
        false => Err(Complaint::new(key, Finding::of(Kind::DIRECTION_ZERO))),
    }
}

#[cfg(test)]
mod tests {
    use sensor::{DefinedParam, Definition, Sensor};

    use super::*;

    #[test]
    fn the_default_is_fine() {
        assert_eq!(Spec::default().complaint(), None);
    }

    #[test]
    fn effects_that_cannot_show_are_refused() {
        for name in ["accel_temperature", "accel_vibration_rectification"] {
            let mut spec = Spec::default().with_effect(name, 1.0);
            assert_eq!(spec.complaint(), None);
            (spec.temperature, spec.vibration) = (None, None);
            assert_eq!(spec.complaint().unwrap().key, format!("effects.{name}"));
        }
    }

    #[test]
    fn an_effect_written_as_text_is_refused_without_what_shows_it() {
        for x in ["k * dT", "k * vibrationy"] {
            let name = "accel_of_ones_own";
            let definition = Definition {
                name: name.into(),
                x: x.into(),
                parameters: vec![DefinedParam::new("k", "", 1e-4)],
                ..Definition::silent(Sensor::Accelerometer)
            };
            let spec = Spec {
                definitions: vec![definition],
                ..Spec::default()
            };
            let mut spec = spec.with_effect(name, 1.0);
            assert_eq!(spec.complaint(), None);
            (spec.temperature, spec.vibration) = (None, None);
            assert_eq!(spec.complaint().unwrap().key, format!("effects.{name}"));
        }
    }

    #[test]
    fn a_slip_of_a_placement_that_is_not_there_is_refused() {
        let faults = vec![Fault::Slip {
            interval: 500,
            angle: 1e-3,
        }];
        let error = Spec {
            faults,
            ..Spec::default()
        }
        .run()
        .unwrap_err()
        .to_string();
        assert!(
            error.starts_with("faults.0.interval: is 500, but there are"),
            "{error}"
        );
    }
}
