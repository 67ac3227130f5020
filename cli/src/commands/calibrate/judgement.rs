//! The verdict that the first screen says, out of the findings of a calibration.
//!
//! Findings with a kind decide by what they do to a corrected reading. Those that are texts of their own are judged as pages do it.

use ::findings::{Finding, Front, Grade, Kind, Verdict, gravest_first};
use calib::Calibration;

use crate::pages::coverage::Coverage;
use crate::pages::session::Session;
use crate::pages::verdict;
use crate::report::Level;
use crate::show;

/// How good a calibration is, why, and what was said with that.
pub struct Judgement {
    /// How good.
    pub level: Level,
    /// The verdict in a sentence.
    pub sentence: String,
    /// What to do by the verdict's own words; empty where findings say it.
    pub advice: Vec<String>,
    /// Findings with a kind that ask for something, the gravest first.
    pub findings: Vec<Finding>,
    /// Warnings that the sentence says.
    pub said: Vec<String>,
}

/// Judges a calibration.
pub fn of(
    calibration: &Calibration,
    session: Option<&Session<'_>>,
    coverage: Option<&Coverage>,
) -> Judgement {
    let all = calibration.findings();
    let typed: Vec<Finding> = all
        .iter()
        .filter(|f| f.kind != Kind::Remark)
        .cloned()
        .collect();
    let verdict = Verdict::of(&typed);
    let sorted = gravest_first(&typed).into_iter();
    let asks = |finding: &&Finding| finding.level > ::findings::Level::Remark;
    let findings: Vec<Finding> = sorted.filter(asks).cloned().collect();
    let judged = verdict::judged(calibration, session, coverage);
    let is_typed = match judged.level {
        Level::Bad => verdict.level == Grade::Bad,
        _ => verdict.level != Grade::Good,
    };
    if is_typed {
        let said = findings
            .first()
            .map(|finding| finding.text(Front::CommandLine));
        let level = match verdict.level {
            Grade::Good => Level::Good,
            Grade::Care => Level::Care,
            Grade::Bad => Level::Bad,
        };
        return Judgement {
            level,
            sentence: verdict.sentence(),
            advice: Vec::new(),
            findings,
            said: said.into_iter().collect(),
        };
    }
    let why = judged
        .sentence
        .split_once(": ")
        .map_or(judged.sentence.as_str(), |(_, why)| why);
    let (grade, why) = match judged.level {
        Level::Good => {
            return Judgement {
                level: Level::Good,
                sentence: Verdict::default().sentence(),
                advice: judged.next,
                findings,
                said: Vec::new(),
            };
        }
        Level::Care => (Grade::Care, why.to_owned()),
        Level::Bad | Level::Refused => (Grade::Bad, show::gist(why) + "."),
    };
    let body = |text: &str| {
        let gist = show::gist(text);
        session
            .map_or(gist.as_str(), |s| s.body(&gist))
            .to_lowercase()
    };
    let texts = calibration.warnings.texts(Front::CommandLine).into_iter();
    let said = texts.filter(|text| why.to_lowercase().contains(&body(text)));
    Judgement {
        level: judged.level,
        sentence: format!("{}: {why}", grade.title()),
        advice: judged.next,
        findings,
        said: said.collect(),
    }
}
