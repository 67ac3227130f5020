//! Sessions summed up by sensor and kind of parameter.

use sensor::Sensor;

use super::session::{Found, Record};

/// Half-width of a 95 % interval in standard errors.
const WIDTH: f64 = 1.959_963_985;

/// A kind of parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// The diagonal of `T`.
    Scale,
    /// What is beside it.
    Misalignment,
    /// `b`; of a magnetometer the hard iron.
    Bias,
}

impl Class {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Scale, Self::Misalignment, Self::Bias];

    fn of(name: &str) -> Self {
        match name.split_once('.').map(|(_, own)| own) {
            Some(own) if own.starts_with("s_") => Self::Scale,
            Some(own) if own.starts_with("b_") => Self::Bias,
            _ => Self::Misalignment,
        }
    }
}

/// The parameters of one class in all sessions.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// How many.
    pub count: usize,
    /// Share of the 95 % intervals that hold the truth.
    pub coverage: f64,
    /// Root mean square of error over bound, and of stated error over bound.
    pub over_bound: [f64; 2],
    /// Root mean square of error over the bound for whole static intervals.
    pub over_bound_of_whole: f64,
    /// Root mean squares of error and of bound, in the parameter's unit.
    pub size: [f64; 2],
}

/// Of one class, with the magnetometer or without; `None` of no parameters.
pub fn summarise(
    records: &[Record],
    sensor: Sensor,
    class: Class,
    magnetometer: bool,
) -> Option<Summary> {
    let is_of = |found: &&Found| {
        found.name.starts_with(&format!("{}.", sensor.prefix())) && Class::of(&found.name) == class
    };
    let found = records.iter().flat_map(|record| match magnetometer {
        true => &record.with,
        false => &record.without,
    });
    let all: Vec<&Found> = found.filter(is_of).collect();
    if all.is_empty() {
        return None;
    }
    let rms = |of: fn(&Found) -> f64| {
        let squares: f64 = all.iter().map(|f| of(f).powi(2)).sum();
        (squares / all.len() as f64).sqrt()
    };
    let held = all.iter().filter(|f| f.error.abs() <= WIDTH * f.sigma);
    Some(Summary {
        count: all.len(),
        coverage: held.count() as f64 / all.len() as f64,
        over_bound: [rms(|f| f.error / f.bound), rms(|f| f.sigma / f.bound)],
        over_bound_of_whole: rms(|f| f.error / f.bound_of_whole),
        size: [rms(|f| f.error), rms(|f| f.bound)],
    })
}
