//! Is the calibration good, and what next: in sentences.

use ::findings::{Finding, Grade, Remedy, Step};
use calib::Calibration;

use super::coverage::Coverage;
use super::parameters;
use super::residual::Residual;
use super::session::Session;
use crate::report::{Figure, Level};
use crate::show::{self, capital};

/// The call for two recordings of one device.
pub const TOGETHER: &str = "stillpoint calibrate FIRST SECOND -o cal.json";

/// The level, the sentence under it, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Level of the verdict.
    pub level: Level,
    /// Why, in one sentence.
    pub sentence: String,
    /// Next steps.
    pub next: Vec<String>,
}

/// The verdict of a calibration as a page shows it.
pub fn judged(calibration: &Calibration, coverage: Option<&Coverage>) -> Judged {
    let verdict = calibration.verdict();
    let why = verdict.reason.clone().unwrap_or_default();
    let sentence = match verdict.level {
        Grade::Good => {
            "The model explains the recording to within its measured noise; the calibration can be used.".to_owned()
        }
        Grade::Care => format!("Usable with care: {why}."),
        Grade::Bad => format!("Do not use this calibration: {why}."),
    };
    let steps = calibration.next_steps();
    let mut next: Vec<String> = steps.iter().map(show::step).collect();
    if let Some(record) = coverage.and_then(Coverage::second_recording) {
        let record = format!("{record}: {TOGETHER}");
        match steps
            .iter()
            .position(|step| adds_placements(calibration, step))
        {
            Some(place) => next[place] = record,
            None => next.push(record),
        }
    }
    Judged {
        level: verdict.level.into(),
        sentence,
        next,
    }
}

/// Returns true for the step of a finding that more placements would mend.
fn adds_placements(calibration: &Calibration, step: &Step) -> bool {
    let findings = calibration.findings();
    let mut steps = findings.iter().filter_map(Finding::step);
    steps.any(|(remedy, text)| matches!(remedy, Remedy::AddPlacements { .. }) && text == step.text)
}

/// Raw to calibrated residual, weakest parameter, coverage.
pub fn figures(
    calibration: &Calibration,
    session: &Session<'_>,
    coverage: Option<&Coverage>,
) -> Vec<Figure> {
    let mut all = vec![Residual::measured(session).figure()];
    all.extend(parameters::weakest(calibration));
    all.extend(coverage.map(Coverage::figure));
    all
}

/// Advice as a sentence of its own.
pub fn sentence(advice: &str) -> String {
    format!("{}.", capital(advice.trim_end_matches('.')))
}
