//! `/time`: experiment time stands still in a pause.

use serde::Deserialize;

/// A pause whose length the phone does not tell counts as this long, s: a gap, so that no turn is carried over it.
const UNKNOWN: f64 = 1.0;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Mapping {
    event: String,
    experiment_time: f64,
    system_time: f64,
}

/// Pauses as experiment time and length, s.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pauses(Vec<[f64; 2]>);

impl Pauses {
    /// Reads the answer to `/time`; `None` where it is another document.
    pub(super) fn parse(text: &[u8]) -> Option<Self> {
        let mappings: Vec<Mapping> = serde_json::from_slice(text).ok()?;
        let mut paused: Option<(f64, f64)> = None;
        let mut pauses = Vec::new();
        for mapping in mappings {
            let now = (mapping.experiment_time, mapping.system_time);
            match (mapping.event.as_str(), paused.take()) {
                ("PAUSE", _) => paused = Some(now),
                ("START", Some((at, since))) if now.1 > since => pauses.push([at, now.1 - since]),
                _ => {}
            }
        }
        Some(Self(pauses))
    }

    /// One more, at experiment time `at`, of a length that is not known.
    pub(super) fn and_unknown(mut self, at: f64) -> Self {
        self.0.push([at, UNKNOWN]);
        self
    }

    /// The stamp with the pauses before it counted.
    pub(super) fn counted(&self, t: f64) -> f64 {
        t + self
            .0
            .iter()
            .filter(|[at, _]| t > *at)
            .map(|[_, length]| length)
            .sum::<f64>()
    }

    /// The length of the last, s.
    pub(super) fn last(&self) -> Option<f64> {
        self.0.last().map(|[_, length]| *length)
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
}
