//! The table from its sessions.

use super::session::{Figures, SessionResult};

/// Half-width of a 95 % interval in standard errors.
const WIDTH: f64 = 1.959_963_985;

/// One method over all sessions.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Tally {
    /// Sessions.
    pub sessions: usize,
    /// Share of the 95 % intervals that hold the truth, over all parameters.
    pub coverage: f64,
    /// The same of the parameter that is held least often, and of the one held most often.
    pub coverage_each: [f64; 2],
    /// Mean normalised estimation error squared over its degrees of freedom.
    pub nees: f64,
    /// Root mean square of errors over their Cramér–Rao bounds.
    pub efficiency: f64,
    /// Largest error of the accelerometer's and of the gyroscope's parameters.
    pub largest: [f64; 2],
}

/// One row of the table.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Summary {
    /// Sessions run.
    pub sessions: usize,
    /// The joint method.
    pub joint: Option<Tally>,
    /// The stepwise method.
    pub stepwise: Option<Tally>,
    /// Share of the disturbances that were named, by kind: slip, touch, gap.
    pub named: [f64; 3],
    /// Sessions in which something was named that was not disturbed.
    pub false_alarms: usize,
    /// Sessions refused or warned of.
    pub warned: usize,
    /// Median seconds of a joint fit.
    #[serde(skip)]
    pub seconds: f64,
}

/// Sums up.
pub fn summarise(results: &[SessionResult]) -> Summary {
    let of =
        |f: fn(&SessionResult) -> Option<&Figures>| tally(results.iter().filter_map(f).collect());
    let named = ["slip", "touch", "gap"].map(|kind| share_named(results, kind));
    let false_alarm = |r: &&SessionResult| {
        let place = |name: &str| name.split_once(' ').map(|(_, p)| p.to_owned());
        let true_places: Vec<_> = r.disturbed.iter().map(|d| place(d)).collect();
        r.named.iter().any(|n| !true_places.contains(&place(n)))
    };
    let mut seconds: Vec<f64> = results.iter().map(|r| r.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    Summary {
        sessions: results.len(),
        joint: of(|r| r.joint.as_ref()),
        stepwise: of(|r| r.stepwise.as_ref()),
        named,
        false_alarms: results.iter().filter(false_alarm).count(),
        warned: results.iter().filter(|r| !r.words.is_empty()).count(),
        seconds: seconds.get(seconds.len() / 2).copied().unwrap_or(0.0),
    }
}

/// How many of the disturbances of a kind were named, at the right place.
fn share_named(results: &[SessionResult], kind: &str) -> f64 {
    let all = results
        .iter()
        .flat_map(|r| r.disturbed.iter().map(move |d| (r, d)));
    let own: Vec<_> = all.filter(|(_, d)| d.starts_with(kind)).collect();
    let found = own.iter().filter(|(r, d)| r.named.contains(d)).count();
    found as f64 / own.len().max(1) as f64
}

fn tally(all: Vec<&Figures>) -> Option<Tally> {
    let first = all.first()?;
    let n = first.names.len();
    let sessions = all.len() as f64;
    let held = |k: usize| {
        let inside = all
            .iter()
            .filter(|f| f.errors[k].abs() <= WIDTH * f.sigmas[k])
            .count();
        inside as f64 / sessions
    };
    let each: Vec<f64> = (0..n).map(held).collect();
    let pairs = all.iter().flat_map(|f| f.errors.iter().zip(&f.bounds));
    let square: f64 = pairs.map(|(e, b)| (e / b).powi(2)).sum();
    let largest = ["accel.", "gyro."].map(|prefix| {
        all.iter()
            .flat_map(|f| f.names.iter().zip(&f.errors))
            .filter(|(name, _)| name.starts_with(prefix))
            .fold(0.0f64, |m, (_, e)| m.max(e.abs()))
    });
    Some(Tally {
        sessions: all.len(),
        coverage: each.iter().sum::<f64>() / n as f64,
        coverage_each: [
            each.iter().copied().fold(1.0, f64::min),
            each.iter().copied().fold(0.0, f64::max),
        ],
        nees: all.iter().map(|f| f.nees).sum::<f64>() / sessions / n as f64,
        efficiency: (square / sessions / n as f64).sqrt(),
        largest,
    })
}
