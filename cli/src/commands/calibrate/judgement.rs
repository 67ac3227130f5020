//! The verdict that the first screen says, out of the findings of a calibration.

use ::findings::{Finding, Front, Grade, gravest_first};
use calib::Calibration;

use crate::report::Level;

/// How good a calibration is, why, and what was said with that.
pub struct Judgement {
    /// How good.
    pub level: Level,
    /// The verdict in a sentence.
    pub sentence: String,
    /// Findings that ask for something, the gravest first.
    pub findings: Vec<Finding>,
    /// Warnings that the sentence says.
    pub said: Vec<String>,
}

/// Judges a calibration.
pub fn of(calibration: &Calibration) -> Judgement {
    let verdict = calibration.verdict();
    let all = calibration.findings();
    let asks = |finding: &&Finding| finding.level > ::findings::Level::Remark;
    let findings: Vec<Finding> = gravest_first(&all)
        .into_iter()
        .filter(asks)
        .cloned()
        .collect();
    let said = findings
        .first()
        .map(|finding| finding.text(Front::CommandLine));
    Judgement {
        level: match verdict.level {
            Grade::Good => Level::Good,
            Grade::Care => Level::Care,
            Grade::Bad => Level::Bad,
        },
        sentence: verdict.sentence(),
        findings,
        said: said.into_iter().collect(),
    }
}
