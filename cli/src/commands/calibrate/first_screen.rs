//! The first screen of a calibration.

mod compact;
mod steps;

use ::findings::{Front, Grade, Kind, gravest_first};
use calib::calibrate::STANDARD_GRAVITY;
use calib::{Calibration, Recording};

use super::arguments::Args;
use super::judgement;
use super::{left_out, limits, reading_error};
use crate::commands::shared::first_screen::{Screen, lines_of_failure, wrote};
use crate::commands::shared::names::Names;
use crate::pages::coverage::Coverage;
use crate::pages::parameters;
use crate::show;

/// States the next steps of a calibration in commands that repeat this call's options; every output says the same.
pub fn state_next(args: &Args, calibration: &mut Calibration, coverage: Option<&Coverage>) {
    let judgement = judgement::of(calibration);
    calibration.next = Some(steps::next(args, calibration, &judgement, coverage));
}

/// A calibration that is to be shown, and how it was asked for.
pub struct Shown<'a> {
    /// The arguments.
    pub args: &'a Args,
    /// The recordings.
    pub recordings: &'a [Recording],
    /// The calibration.
    pub calibration: &'a Calibration,
    /// Residuals in words: at rest and after a turn.
    pub residual: String,
}

/// Builds the first screen.
pub fn screen(shown: &Shown<'_>) -> Screen {
    let Shown {
        args,
        recordings,
        calibration,
        ..
    } = shown;
    let names = Names::of(*recordings);
    let judgement = judgement::of(calibration);
    let reasons = limits::reasons(calibration);
    let (mut remarks, mut said) = (Vec::new(), judgement.said.clone());
    for finding in gravest_first(&calibration.warnings) {
        let text = finding.text(Front::CommandLine);
        // What would be gained by the place is among the next steps.
        let of_gravity = judgement.grade != Grade::Bad && finding.kind == Kind::GRAVITY_ASSUMED;
        match of_gravity {
            true => said.push(text),
            false if !said.contains(&text) => remarks.push(text),
            false => {}
        }
    }
    let mut figures = Vec::new();
    figures.extend(limits::kept(&calibration.limits).map(|kept| ["limits".into(), kept]));
    if !shown.residual.is_empty() {
        figures.push(["residual".into(), shown.residual.clone()]);
    }
    figures.extend(of_readings(calibration));
    figures.extend(parameters::weakest(calibration).map(|weakest| {
        let [_, value, note] = weakest.words();
        let name = note.split(',').next().unwrap_or(note);
        ["weakest parameter".into(), format!("{name} {value}")]
    }));
    figures.extend(not_excluded(calibration));
    Screen {
        verdict: vec![names.short(&judgement.sentence)],
        figures,
        tables: Some(compact::text(calibration))
            .filter(|table| !table.is_empty())
            .into_iter()
            .collect(),
        next: calibration.next_steps(),
        written: wrote(
            args.output
                .as_deref()
                .into_iter()
                .chain(args.pictures.paths()),
            "Nothing was written.",
        ),
        said: names.all_short(&said),
        remarks: names.all_short(&remarks),
        reserved: lines_of_failure(&reasons),
    }
}

/// The effect that would enlarge a standard error most, in words; `None` where none would double.
fn not_excluded(calibration: &Calibration) -> Option<[String; 2]> {
    let worst = calibration.enlarged_by_more_than(left_out::WORTH_SHOWING);
    let own = worst.first()?;
    let (name, added) =
        parameters::error_in_words(calibration, &own.by.parameter, own.by.std_added)?;
    let effect = &own.by.effect;
    Some([
        "not excluded".into(),
        format!("{effect}: adds {added} to {name}"),
    ])
}

/// Returns the standard errors of corrected readings, in words.
fn of_readings(calibration: &Calibration) -> Option<[String; 2]> {
    let error = reading_error::of(calibration);
    let mut parts = Vec::new();
    if let Some(force) = error.force {
        let mg = 1e3 * force / STANDARD_GRAVITY;
        let (force, mg) = (show::rounded(1e3 * force, 2), show::rounded(mg, 2));
        parts.push(format!("± {force} mm/s² ({mg} mg) at one g"));
    }
    if let Some(heading) = error.heading {
        let heading = show::rounded(heading.to_degrees(), 2);
        parts.push(format!("± {heading}° per 90° turn"));
    }
    (!parts.is_empty()).then(|| ["corrected reading".into(), parts.join(", ")])
}
