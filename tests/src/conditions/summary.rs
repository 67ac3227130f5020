//! Figures of a row from its sessions.

use std::collections::BTreeMap;

use calib::calibrate::Method;

use super::catalogue::Condition;
use super::kind::Kind;
use super::session::{Estimate, Outcome, Record};

/// A class of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// Name in tables.
    pub name: &'static str,
    sensor: &'static str,
    what: What,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum What {
    Scale,
    Misalignment,
    Bias,
}

const fn class(name: &'static str, sensor: &'static str, what: What) -> Class {
    Class { name, sensor, what }
}

/// The classes: scale factors, misalignments and biases of both sensors.
pub const CLASSES: [Class; 6] = [
    class("accel scale", "accel.", What::Scale),
    class("accel misalignment", "accel.", What::Misalignment),
    class("accel bias", "accel.", What::Bias),
    class("gyro scale", "gyro.", What::Scale),
    class("gyro misalignment", "gyro.", What::Misalignment),
    class("gyro bias", "gyro.", What::Bias),
];

impl Class {
    /// Whether a parameter belongs to it.
    pub fn has(&self, name: &str) -> bool {
        let Some(own) = name.strip_prefix(self.sensor) else {
            return false;
        };
        let what = match own.split('_').next() {
            Some("s") => What::Scale,
            Some("b") => What::Bias,
            _ => What::Misalignment,
        };
        what == self.what
    }
}

/// One method over the sessions of a row.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// Sessions run.
    pub sessions: usize,
    /// Share of the 95 % intervals that hold the truth, by class.
    pub coverage: [f64; 6],
    /// Mean normalised estimation error squared per degree of freedom.
    pub nees: f64,
    /// Root mean square of error over bound, where the bound is known.
    pub efficiency: Option<f64>,
    /// Sessions in which a parameter is off by more than three stated errors.
    pub wrong: usize,
    /// Of those, sessions without words that name the condition or its visible consequence.
    pub silent: usize,
    /// Sessions off by more than five stated errors without such words: no chance.
    pub gross: usize,
    /// Sessions with words that name a cause that is not there.
    pub false_alarms: usize,
    /// Sessions refused (exit 4 or 5, or any other).
    pub refused: usize,
    /// Sessions with words of each kind, whether those are right here.
    pub kinds: BTreeMap<Kind, (usize, bool)>,
}

/// Three stated errors, beyond which an interval is wrong; five, which is no chance.
const WRONG: [f64; 2] = [3.0, 5.0];

/// Sums up the sessions of `condition` by one method.
pub fn summarise(condition: &Condition, records: &[Record], by: Method) -> Summary {
    let own: Vec<&Record> = records.iter().filter(|r| r.row == condition.name).collect();
    let outcomes: Vec<&Outcome> = own.iter().map(|r| r.by(by)).collect();
    let estimates: Vec<&Estimate> = outcomes
        .iter()
        .filter_map(|o| o.estimate.as_ref())
        .collect();
    let mut summary = Summary {
        sessions: own.len(),
        coverage: CLASSES.map(|class| coverage(&estimates, class)),
        nees: mean(
            estimates
                .iter()
                .filter_map(|e| Some(e.nees? / e.names.len() as f64)),
        ),
        efficiency: efficiency(&own, by),
        refused: outcomes.iter().filter(|o| o.estimate.is_none()).count(),
        ..Summary::default()
    };
    for outcome in outcomes {
        let mut kinds: Vec<Kind> = outcome.words.iter().map(|w| Kind::of(w)).collect();
        kinds.sort();
        kinds.dedup();
        let right = |kind: &Kind| condition.is_right(*kind, by);
        let said = kinds.iter().any(|kind| condition.tells(*kind, by));
        let far = outcome.estimate.as_ref().map_or(0.0, farthest);
        summary.wrong += usize::from(far > WRONG[0]);
        summary.silent += usize::from(far > WRONG[0] && !said);
        summary.gross += usize::from(far > WRONG[1] && !said);
        summary.false_alarms += usize::from(!kinds.iter().all(right));
        for kind in kinds {
            summary.kinds.entry(kind).or_insert((0, right(&kind))).0 += 1;
        }
    }
    summary
}

fn coverage(estimates: &[&Estimate], class: Class) -> f64 {
    let held = |e: &Estimate, k: usize| f64::from(u8::from(e.errors[k].abs() <= e.widths[k]));
    mean(estimates.iter().flat_map(|e| {
        let own = (0..e.names.len()).filter(|k| class.has(&e.names[*k]));
        own.map(|k| held(e, k)).collect::<Vec<_>>()
    }))
}

fn efficiency(records: &[&Record], by: Method) -> Option<f64> {
    let squares: Vec<f64> = records
        .iter()
        .filter_map(|r| r.by(by).estimate.as_ref().zip(r.bounds.as_ref()))
        .filter(|(e, bounds)| e.errors.len() == bounds.len())
        .flat_map(|(e, bounds)| e.errors.iter().zip(bounds).map(|(e, b)| (e / b).powi(2)))
        .collect();
    (!squares.is_empty()).then(|| mean(squares.into_iter()).sqrt())
}

/// Largest error in stated errors.
fn farthest(estimate: &Estimate) -> f64 {
    let pairs = estimate.errors.iter().zip(&estimate.sigmas);
    pairs.map(|(e, s)| (e / s).abs()).fold(0.0, f64::max)
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(s, n), v| (s + v, n + 1.0));
    if count > 0.0 { sum / count } else { f64::NAN }
}

/// Root mean square error of the first method over that of the second, over the parameters and sessions that
/// both have, each in the second's mean square.
pub fn ratio(condition: &Condition, records: &[Record]) -> Option<f64> {
    let both: Vec<(&Estimate, &Estimate)> = records
        .iter()
        .filter(|r| r.row == condition.name)
        .filter_map(|r| r.joint.estimate.as_ref().zip(r.stepwise.estimate.as_ref()))
        .filter(|(a, b)| a.names == b.names)
        .collect();
    let names = both.first()?.0.names.len();
    let square = |e: &Estimate, k: usize| e.errors[k] * e.errors[k];
    let shares = (0..names).map(|k| {
        let joint: f64 = both.iter().map(|(j, _)| square(j, k)).sum();
        joint / both.iter().map(|(_, s)| square(s, k)).sum::<f64>()
    });
    Some(mean(shares).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_belongs_to_one_class() {
        for sensor in [sensor::Sensor::Accelerometer, sensor::Sensor::Gyroscope] {
            for name in sensor::base_names(sensor) {
                let own = CLASSES.iter().filter(|class| class.has(&name)).count();
                assert_eq!(own, 1, "{name}");
            }
        }
    }
}
