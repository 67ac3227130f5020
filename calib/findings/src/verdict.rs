//! The verdict on a result: a function of its findings alone.

use serde::{Deserialize, Serialize};

use crate::finding::Finding;
use crate::inputs::Inputs;
use crate::level::Level;
use crate::remedy::Remedy;
use crate::words::{Front, command, remedies};

/// Most steps that a verdict asks for.
const MOST_STEPS: usize = 4;

/// Grade of a result.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Grade {
    /// It can be used.
    #[default]
    Good,
    /// It can be used with care.
    Care,
    /// It is not to be used.
    Bad,
}

impl Grade {
    /// `good`, `care` or `bad`, as documents have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Care => "care",
            Self::Bad => "bad",
        }
    }

    /// The grade at the head of a report.
    pub fn title(self) -> &'static str {
        match self {
            Self::Good => "Good",
            Self::Care => "With care",
            Self::Bad => "Not to be used",
        }
    }
}

/// A thing to do next.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Step {
    /// Description of the step and of its benefit.
    pub text: String,
    /// The command that does it, where one does.
    pub command: Option<String>,
}

impl Step {
    /// A step with its command.
    pub fn new(text: impl Into<String>, command: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            command: Some(command.into()),
        }
    }

    /// A step in words alone.
    pub fn words(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            command: None,
        }
    }
}

/// The verdict on a calibration or a recording.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdict {
    /// Grade.
    pub level: Grade,
    /// Kinds of the findings behind it, the gravest first; of a good result the remarks.
    pub reasons: Vec<String>,
    /// The gravest reason in a few words; none of a good result.
    #[serde(default)]
    pub reason: Option<String>,
    /// Things to do next, the most useful first.
    pub next: Vec<Step>,
}

impl Verdict {
    /// Builds the verdict from findings, with `RECORDING` as the file name in the commands.
    pub fn of(findings: &[Finding]) -> Self {
        Self::of_inputs(findings, &Inputs::default())
    }

    /// Builds the verdict from findings in these inputs, which stand in the commands.
    ///
    /// Findings are ordered by level. Within a level, the one with the larger error of a corrected reading comes first
    /// ([`Finding::severity`]). A kind counts once.
    pub fn of_inputs(findings: &[Finding], inputs: &Inputs<'_>) -> Self {
        let sorted = gravest_first(findings);
        let level = match sorted.first().map(|gravest| gravest.level) {
            Some(Level::Bad | Level::Error) => Grade::Bad,
            Some(Level::Care) => Grade::Care,
            Some(Level::Remark) | None => Grade::Good,
        };
        let reason = sorted.first().filter(|_| level != Grade::Good);
        let mut reasons: Vec<String> = Vec::new();
        for finding in &sorted {
            let name = finding.kind.name();
            if !reasons.iter().any(|own| own == name) {
                reasons.push(name.to_owned());
            }
        }
        Self {
            level,
            reason: reason.map(|finding| finding.reason()),
            reasons,
            next: next(level, &sorted, inputs),
        }
    }

    /// The verdict in one sentence.
    pub fn sentence(&self) -> String {
        match (&self.reason, self.level) {
            (Some(reason), grade) => format!("{}: {reason}.", grade.title()),
            (None, _) => "Good: the model explains the recording to within its noise.".to_owned(),
        }
    }
}

/// Findings by their weight: level, then the error that they make; equals stay in their order.
pub fn gravest_first(findings: &[Finding]) -> Vec<&Finding> {
    let mut sorted: Vec<&Finding> = findings.iter().collect();
    sorted.sort_by(|a, b| {
        let by_level = b.level.cmp(&a.level);
        by_level.then(b.severity().total_cmp(&a.severity()))
    });
    sorted
}

/// Steps out of the gravest findings; of a result that can be used, its use.
fn next(level: Grade, sorted: &[&Finding], inputs: &Inputs<'_>) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut add = |text: String, command: Option<String>| {
        if steps.len() < MOST_STEPS && !steps.iter().any(|own| own.text == text) {
            steps.push(Step { text, command });
        }
    };
    for finding in sorted {
        if level == Grade::Bad && finding.level == Level::Remark {
            break;
        }
        if let Some((remedy, text)) = finding.step() {
            add(text, command::of(remedy, finding, inputs));
        }
    }
    if level != Grade::Bad {
        let apply = "stillpoint apply cal.json OTHER -o corrected.csv".to_owned();
        add(
            "correct recordings with this calibration".into(),
            Some(apply),
        );
        let check = "stillpoint evaluate SECOND --calibration cal=cal.json".to_owned();
        add("check it by a second recording".into(), Some(check));
    }
    steps
}

impl Finding {
    /// The best remedy, which is the first, as a step: what to do, and for what; `None` where nothing has to be done.
    pub fn step(&self) -> Option<(&Remedy, String)> {
        let first = self.remedies.first();
        let remedy = first.filter(|remedy| !remedy.is_if_wrong())?;
        let place = match (&self.place.interval, &self.place.turn) {
            (Some(k), _) => format!(" (static interval {k})"),
            (None, Some(k)) => format!(" (turn {k})"),
            _ => String::new(),
        };
        let text = format!("{}{place}", remedies::words(remedy, Front::Plain));
        Some((remedy, text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::Kind;

    #[test]
    fn nothing_found_is_good_and_says_what_to_do_with_it() {
        let verdict = Verdict::of(&[]);
        assert_eq!(verdict.level, Grade::Good);
        assert!(verdict.next[0].command.as_ref().unwrap().contains("apply"));
    }

    #[test]
    fn what_makes_the_larger_error_is_the_first_reason() {
        let small = Finding::of(Kind::MISFIT).affects("corrected_reading", 1e-3, "m/s^2");
        let large = Finding::of(Kind::WEAK_PARAMETER).affects("corrected_reading", 2e-2, "m/s^2");
        let verdict = Verdict::of(&[small, large]);
        assert_eq!(verdict.reasons, ["weak_parameter", "misfit"]);
        assert_eq!(verdict.level, Grade::Care);
    }

    #[test]
    fn what_was_decided_without_harm_asks_for_nothing() {
        let told = Finding::of(Kind::UNIT_BY_GRAVITY).detail("unit", "g");
        let verdict = Verdict::of(&[told]);
        assert_eq!(verdict.level, Grade::Good);
        assert_eq!(verdict.next, Verdict::of(&[]).next);
    }

    #[test]
    fn one_bad_finding_makes_the_result_bad() {
        let assumed = Finding::of(Kind::GRAVITY_ASSUMED);
        assert_eq!(
            Verdict::of(std::slice::from_ref(&assumed)).level,
            Grade::Good
        );
        let gate = Finding::from("a gate").at_level(Level::Bad);
        let verdict = Verdict::of(&[assumed, gate]);
        assert_eq!(verdict.level, Grade::Bad);
        assert_eq!(verdict.sentence(), "Not to be used: a gate.");
    }
}
