//! The readings of an accelerometer in static intervals.

use nalgebra::Vector3;

findings::tuning! {
    /// The first readings after a turn are the tail of a filter, s.
    FILTERED: f64 = 0.4;
}

/// The readings in one static interval.
pub struct Rested<'a> {
    /// Place of its recording.
    pub recording: usize,
    pub t: &'a [f64],
    pub values: &'a [Vector3<f64>],
    /// Their unit, m/s².
    pub unit: f64,
    /// When the turn before ended, s.
    pub turned: f64,
    /// The mean, m/s².
    pub force: Vector3<f64>,
    /// Slope by what is known otherwise, m/s³.
    pub drift: Vector3<f64>,
    /// Its standard error, m/s³.
    pub drift_std: Vector3<f64>,
    /// False of the first of a recording: before it is no turn.
    pub follows_turn: bool,
    /// False of one that was disturbed.
    pub is_sound: bool,
}

/// The error right after a turn, by the readings of one interval.
#[derive(Clone, Copy, Debug, Default)]
pub struct AtFirst {
    pub error: Vector3<f64>,
    /// The error has the variance of a reading over this.
    pub weight: f64,
    /// What a slope of the readings adds to the error, s.
    pub by_drift: f64,
}

impl Rested<'_> {
    /// Returns true if its readings show what fades after a turn.
    pub fn shows_decay(&self) -> bool {
        self.is_sound && self.follows_turn
    }

    /// The error right after the turn by the readings of this interval alone, where it fades with `tau`. The mean of the interval has no part in
    /// it, and so has no parameter of a calibration.
    pub fn at_first(&self, tau: f64) -> AtFirst {
        let settled = self.turned + FILTERED.get();
        let from = self.t.partition_point(|t| *t < settled);
        let own = self.t[from..].iter().zip(&self.values[from..]);
        let count = (self.t.len() - from).max(1) as f64;
        let left = |t: f64| (-(t - self.turned) / tau).exp();
        let mean = self.t[from..].iter().map(|t| left(*t)).sum::<f64>() / count;
        let (mut moment, mut weight, mut lever) = (Vector3::zeros(), 0.0, 0.0);
        for (t, value) in own {
            let by = left(*t) - mean;
            moment += value * by;
            weight += by * by;
            lever += (t - settled) * by;
        }
        match weight > 0.0 {
            true => AtFirst {
                error: (moment * self.unit - self.drift * lever) / weight,
                weight,
                by_drift: lever / weight,
            },
            false => AtFirst::default(),
        }
    }
}

/// What the force has changed by when each static interval begins, m/s², for a part of the reading that follows it with the time constant
/// `tau`; before the first interval of a recording it did not change.
pub fn changes(rests: &[Rested<'_>], tau: f64) -> Vec<Vector3<f64>> {
    let mut before: Option<(&Rested<'_>, Vector3<f64>)> = None;
    let mut changes = Vec::with_capacity(rests.len());
    for own in rests {
        let last = before.filter(|(last, _)| last.recording == own.recording);
        let change = last.map_or_else(Vector3::zeros, |(last, change)| {
            let left = (-(own.turned - last.turned).max(0.0) / tau).exp();
            own.force - last.force + change * left
        });
        changes.push(change);
        before = Some((own, change));
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_slowly_has_not_forgotten_the_turn_before() {
        let of = |turned: f64, x: f64| Rested {
            recording: 0,
            t: &[],
            values: &[],
            unit: 1.0,
            turned,
            force: Vector3::new(x, 0.0, 0.0),
            drift: Vector3::zeros(),
            drift_std: Vector3::zeros(),
            follows_turn: true,
            is_sound: true,
        };
        let rests = [of(0.0, 1.0), of(5.0, 3.0), of(10.0, 3.0)];
        let slow: Vec<f64> = changes(&rests, 1e9).iter().map(|c| c.x).collect();
        assert!((slow[2] - 2.0).abs() < 1e-6 && slow[0] == 0.0, "{slow:?}");
        assert!(changes(&rests, 0.1)[2].norm() < 1e-6);
    }
}
