//! Result of a session, as its page shows it.

use calib::Recording;
use calib::calibrate::Outcome;
use serde_json::{Value, json};

use crate::commands::calibrate;
use crate::exit::Failure;
use crate::pages::calibration::covered;
use crate::pages::verdict;
use crate::show;

/// Verdict, figures, and the files to take away.
#[derive(Debug)]
pub(super) struct Finish {
    /// For the page's script.
    pub shown: Value,
    /// The calibration's document.
    pub calibration: String,
    /// The report.
    pub report: String,
}

impl Finish {
    /// Builds the result from a finished calibration.
    pub(super) fn of(recordings: &[Recording], outcome: &Outcome) -> Result<Self, Failure> {
        let calibration = &outcome.calibration;
        let session = calibrate::session(recordings, outcome)?;
        let coverage = covered(&session);
        let judged = verdict::judged(calibration, coverage.as_ref());
        let figures = verdict::figures(calibration, &session, coverage.as_ref());
        let figures: Vec<[&str; 3]> = figures.iter().map(|figure| figure.words()).collect();
        Ok(Self {
            shown: json!({
                "level": judged.level.class(),
                "verdict": judged.level.words(),
                "sentence": judged.sentence,
                "figures": figures,
                "next": judged.next,
                "files": true,
            }),
            calibration: show::json(calibration)?,
            report: calibrate::report(recordings, outcome)?,
        })
    }
}
