//! `plan`: which placements and turns to record, and what each buys.

mod args;
mod known;
mod rivals;
mod sheet;
mod tables;
mod units;

use std::path::{Path, PathBuf};

pub use args::Args;
use args::By;
use calib::calibrate::STANDARD_GRAVITY;
use calib::discover::{Aim, Design};
use known::Input;
use nalgebra::Vector3;
use plan::{Criterion, Efficiency, ForceMatrix, Plan, REQUIREMENT, finest};
use serde_json::{Value, json};

use crate::commands::shared::inputs::check_gravity;
use crate::exit::Failure;
use crate::output::Output;
use crate::show;

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    args.gravity.map_or(Ok(()), check_gravity)?;
    args.check()?;
    let inputs: Vec<&Path> = args.input.iter().map(PathBuf::as_path).collect();
    let output = Output::claim_given(args.output.as_deref(), args.replace, &inputs)?;
    let report = Output::claim_given(args.report.as_deref(), args.replace, &inputs)?;
    args.replace.end_if_all_exist()?;
    let ours = match args.input.as_deref() {
        Some(path) => known::document(path)?,
        None => None,
    };
    refuse_unread(args, ours.is_none())?;
    let own = ours.as_ref().and_then(known::gravity);
    let gravity = args.gravity.or(own).unwrap_or(STANDARD_GRAVITY);
    let misfit = ours.as_ref().and_then(known::misfit);
    let (noise, timing, words) = (args.noise(gravity, misfit), args.timing(), args.words());
    let input = match &args.input {
        Some(path) => Some(known::read(path, ours.as_ref(), args, &noise, &timing)?),
        None => None,
    };
    let start = input.as_ref().map(|input| input.known).unwrap_or_default();
    let rivals = input.as_ref().map(|input| &input.rivals);
    let aim = match rivals.filter(|rivals| !rivals.is_empty()) {
        Some(rivals) => Some(rivals.separate(args, gravity, &timing)?),
        None => None,
    };
    let found = match &aim {
        Some(aim) => {
            let Design {
                ups, turns, timing, ..
            } = &aim.design;
            plan::follow(ups, turns, &start, &noise, timing, words)
        }
        None if input.is_none() && args.is_for_a_hand() => {
            let count = args.placements.unwrap_or(REQUIREMENT.advised);
            plan::plan_session(count, &noise, &timing, words)
        }
        None => plan::plan(
            &placements(args, input.as_ref()),
            &start,
            &noise,
            &timing,
            words,
        ),
    };
    let ups: Vec<Vector3<f64>> = found.steps.iter().map(|s| s.up.into()).collect();
    let efficiency = input.is_none().then(|| plan::efficiency(&ups)).flatten();
    let ties = aim.as_ref().map_or(Vec::new(), rivals::rows);
    let mut notes = tables::legend(&found, args.accelerometer_only, words);
    notes.extend(self::notes(args, input.as_ref(), aim.as_ref()));
    notes.extend(efficiency.as_ref().map(efficiency_words));
    notes.extend(rivals::words(&ties));
    let extra = json!({"ties": ties, "efficiency": efficiency, "noise": noise});
    let document = show::json(&document(args, input.as_ref(), &found, extra, &notes))?;
    Output::write_given(output, &document)?;
    if let Some(report) = report {
        report.write(sheet::page(&found, &notes, args.accelerometer_only).as_bytes())?;
    }
    show::print(&if args.json {
        document
    } else {
        tables::text(
            &found,
            input.as_ref(),
            &ties,
            &notes,
            args.accelerometer_only,
        )
    })
}

/// Refuses options about a recording where there is none: no input, or one that is a document of ours.
fn refuse_unread(args: &Args, is_foreign: bool) -> Result<(), Failure> {
    if args.input.is_some() && is_foreign {
        return Ok(());
    }
    match args.detector.given().or(args.read.given()) {
        Some(option) => Err(Failure::usage(format!(
            "{option} is about a recording: name one, or leave it out"
        ))),
        None => Ok(()),
    }
}

/// The placements of the session, or those to add.
fn placements(args: &Args, input: Option<&Input>) -> Vec<Vector3<f64>> {
    match input {
        Some(input) => input.next(args.next),
        None => {
            let count = args.placements.unwrap_or(REQUIREMENT.advised);
            match args.criterion {
                None | Some(By::Reading) => args.protocol.protocol().placements(count),
                Some(By::Volume) => finest(count, &ForceMatrix::zeros(), Criterion::Volume),
            }
        }
    }
}

/// Returns further notes for the user.
fn notes(args: &Args, input: Option<&Input>, aim: Option<&Aim>) -> Vec<String> {
    let mut notes = vec![format!("The requirement: {REQUIREMENT}.")];
    if let Some(aim) = aim {
        if aim.ties.iter().any(|tie| tie.settles) {
            notes.push(
                "Leave the device switched off for an hour before, and record from the moment it is switched on."
                    .into(),
            );
        }
        notes.push(
            "Record it as one recording of its own and give both to `discover`, the first and this one.".into(),
        );
        if args.temperature {
            notes.push(
                "Temperature: begin cold, warm the device by 15 K in the first half (a hair dryer, the sun) and let it \
                 cool in the second."
                    .into(),
            );
        }
        return notes;
    }
    if args.temperature {
        notes.push(
            "Temperature: go through the placements twice, once after an hour in the cold (a refrigerator, in a bag) and \
             once warm (in the sun or beside a heater), letting it warm up slowly in between while it records; at least \
             15 K apart, each placement at both ends."
                .into(),
        );
    }
    notes.extend(
        input
            .into_iter()
            .flat_map(|input| input.notes.iter().cloned()),
    );
    notes
}

fn document(
    args: &Args,
    input: Option<&Input>,
    found: &Plan,
    extra: Value,
    notes: &[String],
) -> Value {
    let mut document = json!({
        "schema": "stillpoint.plan/1",
        "created_by": concat!("stillpoint ", env!("CARGO_PKG_VERSION")),
        "requirement": REQUIREMENT,
        "parameters": plan::parameter_names(),
        "timing": args.timing(),
        "input": input.map(|input| &input.name),
        "coverage": input.and_then(|input| input.coverage.as_ref()),
        "accelerometer_only": args.accelerometer_only,
        "plan": found,
        "notes": notes,
    });
    if let (Value::Object(all), Value::Object(extra)) = (&mut document, extra) {
        all.extend(extra);
    }
    document
}

/// Returns the efficiency of the placements relative to the optimal design, in words.
fn efficiency_words(efficiency: &Efficiency) -> String {
    format!(
        "Placements: {:.1} % of the best that any so many could come to by the error of a reading, {:.1} % by the volume of the \
         confidence ellipsoid (D-efficiency).",
        100.0 * efficiency.reading,
        100.0 * efficiency.volume
    )
}
