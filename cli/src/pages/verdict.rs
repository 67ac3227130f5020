//! Is the calibration good, and what next: in sentences.

use ::findings::{Grade, Step};
use calib::Calibration;

use super::coverage::Coverage;
use super::parameters;
use super::residual::Residual;
use super::session::Session;
use crate::exit::Failure;
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
        match steps.iter().position(adds_placements) {
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

fn adds_placements(step: &Step) -> bool {
    let text = step.text.to_lowercase();
    text.starts_with("add ") && text.contains(" placement")
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

/// Returns the advice on a failure, from its finding, else from its message.
pub fn advice_of(failure: &Failure) -> Option<String> {
    failure
        .advice()
        .map(|advice| sentence(&advice))
        .or_else(|| advice_in(&failure.message))
}

/// The advice after the semicolon of a message.
fn advice_in(message: &str) -> Option<String> {
    let (_, advice) = message.rsplit_once("; ")?;
    Some(sentence(advice))
}

fn sentence(words: &str) -> String {
    format!("{}.", capital(words.trim().trim_end_matches('.')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_is_what_follows_the_semicolon() {
        assert_eq!(
            advice_in("too few; add placements").unwrap(),
            "Add placements."
        );
        assert_eq!(advice_in("too few"), None);
    }
}
