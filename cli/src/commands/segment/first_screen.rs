//! The first screen of the static intervals.

use calib::Recording;
use calib::methods::Choice;

use super::args::Args;
use crate::commands::shared::first_screen::{Screen, Step, wrote};
use crate::commands::shared::names::Names;
use crate::exit::Failure;
use crate::pages::coverage::Coverage;
use crate::pages::direction;
use crate::pages::session::Session;
use crate::show;
use crate::show::command_line;

/// Intervals that the first screen lists.
const LISTED: usize = 12;

/// The first screen: how many there are, then each with the axis that pointed up and the turn after it.
pub fn screen(
    args: &Args,
    recording: &Recording,
    choice: &Choice,
    gravity: f64,
    warnings: &[String],
) -> Result<Screen, Failure> {
    let segmentation = &choice.segmentation;
    let session = Session::of(std::iter::once((recording, segmentation)), None, gravity)?;
    let names = Names::of([recording]);
    let length: f64 = segmentation
        .statics
        .iter()
        .map(|rest| rest.span.length())
        .sum();
    let not_used = segmentation
        .turns
        .iter()
        .filter(|t| t.fault.is_some())
        .count();
    let not_used = match not_used {
        0 => String::new(),
        count => format!(" ({count} not used)"),
    };
    let coverage = Coverage::of(&session.directions());
    let verdict = format!(
        "{} ({:.0} s in all) and {}{not_used}: {} covered.",
        show::counted(segmentation.statics.len(), "static interval"),
        0.0 + length,
        show::counted(segmentation.turns.len(), "turn"),
        coverage.value()
    );
    let mut lines = vec![format!(
        "  {:<10}  {:>17}  {:<24}  turn after it",
        "static", "from, to, s", "up"
    )];
    for (k, rest) in session.rests.iter().enumerate().take(LISTED) {
        let turn = session.turns.iter().find(|turn| turn.key[1..] == rest.key);
        let turn = turn.map_or_else(String::new, |turn| match &turn.fault {
            Some(_) => "not used".into(),
            None => format!("{:.1} s", turn.span.1 - turn.span.0),
        });
        let span = format!("{:.2} {:.2}", rest.span.0, rest.span.1);
        let up = rest.up.as_ref().map_or(String::new(), direction::words);
        lines.push(format!("  {:<10}  {span:>17}  {up:<24}  {turn}", k + 1));
    }
    match segmentation.statics.len().saturating_sub(LISTED) {
        0 => {}
        more => lines.push(format!("  … and {more} more with -v")),
    }
    let file = command_line(&args.recording);
    let read = args.read.command_line();
    let mut next = Vec::new();
    if segmentation.statics.len() >= plan::REQUIREMENT.placements {
        let command = format!("stillpoint calibrate {file}{read} -o cal.json");
        next.push(Step::new("calibrate", command));
    }
    if coverage.advice().is_some() {
        next.push(Step::new(
            "plan the placements to add",
            format!("stillpoint plan {file}{read}"),
        ));
    }
    Ok(Screen {
        verdict: vec![verdict],
        tables: vec![lines.join("\n")],
        next,
        written: wrote(args.output.as_deref(), ""),
        remarks: names.all_short(warnings),
        ..Screen::default()
    })
}
