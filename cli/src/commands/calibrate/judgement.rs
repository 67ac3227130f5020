//! The verdict that the first screen says, out of the findings of a calibration.

use ::findings::{Finding, Front, Grade, Level as Weight, gravest_first};
use calib::Calibration;

/// Judgement of a calibration: grade, verdict and findings.
pub struct Judgement {
    /// Grade of the calibration.
    pub grade: Grade,
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
    let sorted = gravest_first(&all).into_iter();
    let asks = |finding: &&Finding| finding.level > Weight::Remark;
    let findings: Vec<Finding> = sorted.filter(asks).cloned().collect();
    // What forbids the use of the result is the error that the command ends with.
    let first = findings.first().filter(|_| verdict.level == Grade::Care);
    Judgement {
        grade: verdict.level,
        sentence: verdict.sentence(),
        said: first
            .iter()
            .map(|finding| finding.text(Front::CommandLine))
            .collect(),
        findings,
    }
}
