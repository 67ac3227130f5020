//! `/time`: experiment time stands still in a pause.

use serde::Deserialize;

use super::reply::is_time;

/// A pause whose length the phone does not tell counts as this long, s: a gap, so that no turn is carried over it.
const UNKNOWN: f64 = 1.0;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Mapping {
    event: String,
    experiment_time: f64,
    system_time: f64,
}

/// More than that happens in no session.
const MOST: usize = 10_000;

/// Pauses in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pauses(Vec<Pause>);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Pause {
    /// Experiment time, s.
    at: f64,
    /// Length, s.
    length: f64,
    /// Total length of this pause and all before, s.
    in_all: f64,
}

impl Pauses {
    /// Reads the answer to `/time`; `None` where it is another document, or one that no phone writes.
    pub(super) fn parse(text: &[u8]) -> Option<Self> {
        let mappings: Vec<Mapping> = serde_json::from_slice(text).ok()?;
        if mappings.len() > MOST {
            return None;
        }
        let mut paused: Option<(f64, f64)> = None;
        let mut pauses = Self::default();
        for mapping in mappings {
            let now = (mapping.experiment_time, mapping.system_time);
            match (mapping.event.as_str(), paused.take()) {
                ("PAUSE", _) => paused = Some(now),
                ("START", Some((at, since))) if now.1 > since => {
                    pauses = pauses.and(at, now.1 - since)?;
                }
                _ => {}
            }
        }
        Some(pauses)
    }

    /// One more; `None` where it is before the last, or a time that is none.
    fn and(mut self, at: f64, length: f64) -> Option<Self> {
        let before = self.0.last().copied();
        let in_all = before.map_or(0.0, |pause| pause.in_all) + length;
        let follows = before.is_none_or(|pause| pause.at <= at);
        let is_time = is_time(at) && is_time(in_all);
        self.0.push(Pause { at, length, in_all });
        (follows && is_time && self.0.len() <= MOST).then_some(self)
    }

    /// One more, at experiment time `at`, of a length that is not known.
    pub(super) fn and_unknown(self, at: f64) -> Self {
        self.clone().and(at, UNKNOWN).unwrap_or(self)
    }

    /// The stamp with the pauses before it counted.
    pub(super) fn counted(&self, t: f64) -> f64 {
        let before = self.0.partition_point(|pause| pause.at < t);
        let last = before.checked_sub(1).and_then(|last| self.0.get(last));
        t + last.map_or(0.0, |pause| pause.in_all)
    }

    /// The length of the last, s.
    pub(super) fn last(&self) -> Option<f64> {
        self.0.last().map(|pause| pause.length)
    }

    pub(super) fn count(&self) -> usize {
        self.0.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_after_a_pause_are_moved_on_by_its_length() {
        let text = br#"[{"event":"START","experimentTime":0,"systemTime":1000},
            {"event":"PAUSE","experimentTime":20.5,"systemTime":1020.5},
            {"event":"START","experimentTime":20.5,"systemTime":1024.0}]"#;
        let pauses = Pauses::parse(text).unwrap();
        assert_eq!([20.5, 21.0].map(|t| pauses.counted(t)), [20.5, 24.5]);
        assert_eq!(pauses.and_unknown(30.0).counted(30.5), 35.0);
        assert!(Pauses::parse(b"{}").is_none());
    }

    #[test]
    fn pauses_that_no_phone_has_are_not_believed() {
        let pauses = |pairs: &[[f64; 3]]| {
            let pair = |[at, from, to]: &[f64; 3]| {
                format!(
                    r#"{{"event":"PAUSE","experimentTime":{at:e},"systemTime":{from:e}}},
                    {{"event":"START","experimentTime":{at:e},"systemTime":{to:e}}}"#
                )
            };
            let pairs: Vec<String> = pairs.iter().map(pair).collect();
            Pauses::parse(format!("[{}]", pairs.join(",")).as_bytes())
        };
        assert!(pauses(&[[1.0, 2.0, 3.0], [4.0, 6.0, 8.0]]).is_some());
        assert!(pauses(&[[1.0, 2.0, 1e300]]).is_none());
        assert!(pauses(&[[1e300, 2.0, 3.0]]).is_none());
        assert!(pauses(&[[4.0, 2.0, 3.0], [1.0, 6.0, 8.0]]).is_none());
        assert!(pauses(&vec![[1.0, 2.0, 3.0]; 300_000]).is_none());
    }
}
