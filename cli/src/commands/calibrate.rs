//! `calibrate`: recordings to a calibration.

mod arguments;
pub mod clocks;
pub mod field;
mod first_screen;
pub mod joint;
mod judgement;
pub mod left_out;
pub mod limits;
pub mod methods;
pub mod prior;
pub mod reading_error;
mod request;
mod six_position;
pub mod tables;

use ::findings::Front;
use std::path::Path;

use calib::Recording;
use calib::calibrate::{Outcome, Request, calibrate};
use calib::prior::Prior;
use first_screen::Shown;
use limits::gate;

use crate::commands::shared::first_screen::say;
use crate::commands::shared::inputs::{as_paths, read, spinner};
use crate::commands::shared::names::Names;
use crate::commands::shared::pictures::Pictures;
use crate::exit::{Failure, INPUT, NOT_CONVERGED, NOT_ENOUGH};
use crate::output::Output;
use crate::pages::residual::Residual;
use crate::pages::session::{Session, all_cut};
use crate::pages::{calibration, refusal};
use crate::read_args::ReadArgs;
use crate::report::{Picture, Report};
use crate::show;

pub use arguments::Args;

use arguments::Method;
use request::{request, sections};

/// Claims every output of the call.
pub(super) fn claim(args: &Args, inputs: &[&Path]) -> Result<(Option<Output>, Pictures), Failure> {
    let output = Output::claim_given(args.output.as_deref(), args.replace, inputs)?;
    let names = plot_names(args);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let pictures = args.pictures.claim(&names, args.replace, inputs)?;
    args.replace.end_if_all_exist()?;
    Ok((output, pictures))
}

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    run_and_show(args, &mut |_, _| Ok(()))
}

/// Sees the recordings and the outcome before anything is written.
type Watcher<'a> = &'a mut dyn FnMut(&[Recording], &Outcome) -> Result<(), Failure>;

/// Runs the command, and shows what came of it before anything is written.
pub(super) fn run_and_show(args: &Args, shown: Watcher<'_>) -> Result<(), Failure> {
    let mut inputs = args.recordings.paths();
    inputs.extend(args.gyro_recording.iter().chain(&args.sections).cloned());
    inputs.extend(args.static_means.iter().chain(&args.effect_file).cloned());
    if inputs.is_empty() {
        return Err(Failure::usage(
            "no recording given: name a file or a folder",
        ));
    }
    inputs.extend(args.limits.limits.iter().chain(&args.prior).cloned());
    let mut request = request(args)?;
    let limits = args.limits.read()?;
    let prior = args.prior.as_deref().map(Prior::read).transpose()?;
    if let Some(prior) = &prior {
        prior::with_effects(prior, &mut request)?;
    }
    let (output, pictures) = claim(args, &as_paths(&inputs))?;
    let how = ReadArgs {
        accelerometer_alone: args.sensor.is_some(),
        ..args.read.clone()
    };
    let recordings = match args.recordings.read(&how) {
        Ok(recordings) => recordings,
        Err(failure) => return Err(refused(failure, pictures, &[], &request)),
    };
    if let Method::SixPosition = args.method {
        return six_position::run(args, &recordings, &request, limits, output, pictures);
    }
    let gyro_recordings = args
        .gyro_recording
        .iter()
        .map(|p| read(p, &args.read).map(calib::Recording::decimated))
        .collect::<Result<Vec<_>, _>>()?;
    request.sections = sections(args, &recordings)?;
    request.left_out = args.leave_out.instants(recordings.len())?;
    let spinner = spinner("calibrating");
    let mut outcome = match calibrate(&recordings, &gyro_recordings, &request) {
        Ok(outcome) => outcome,
        Err(error) => {
            // A calibration carries the readers' warnings; where there is none they may explain why.
            let warnings = recordings
                .iter()
                .flat_map(|r| r.warnings.texts(Front::CommandLine));
            let warnings: Vec<String> =
                Names::of(&recordings).all_short(&warnings.collect::<Vec<_>>());
            match args.json {
                true => show::warn_all(&warnings),
                false => say(&warnings),
            }
            return Err(refused(error.into(), pictures, &recordings, &request));
        }
    };
    spinner.finish_and_clear();
    if let Some(prior) = &prior {
        prior.inform(&mut outcome.calibration)?;
    }
    // The document alone needs neither.
    let measured = match limits.is_some() || pictures.wanted() || !args.json {
        true => {
            let session = session(&recordings, &outcome)?;
            Some((Residual::measured(&session), calibration::covered(&session)))
        }
        false => None,
    };
    let residual = measured.as_ref().map(|(residual, _)| *residual);
    let own = residual.map(|residual| residual.for_limits());
    limits::state(&mut outcome.calibration, limits.as_ref(), own);
    if let Some((_, coverage)) = &measured {
        first_screen::state_next(args, &mut outcome.calibration, coverage.as_ref());
    }
    if pictures.wanted() {
        draw(pictures, &recordings, &outcome)?;
    }
    shown(&recordings, &outcome)?;
    finish(args, output, &recordings, &outcome, residual)
}

/// Names of the plots that this call draws.
fn plot_names(args: &Args) -> Vec<String> {
    if let Method::SixPosition = args.method {
        return six_position::PLOTS.map(str::to_owned).to_vec();
    }
    calibration::plot_names(args.recordings.recordings.len().max(1))
}

/// Builds the session that pages show. A recording with the same data as another counts once.
pub(super) fn session<'a>(
    recordings: impl IntoIterator<Item = &'a Recording>,
    outcome: &'a Outcome,
) -> Result<Session<'a>, Failure> {
    let mut counted: Vec<&Recording> = Vec::new();
    for recording in recordings {
        let same = |other: &&Recording| {
            other.accelerometer == recording.accelerometer && other.gyroscope == recording.gyroscope
        };
        if !counted.iter().any(same) {
            counted.push(recording);
        }
    }
    let segmentations = outcome.choices.iter().map(|choice| &choice.segmentation);
    let cut = counted.into_iter().zip(segmentations);
    let calibration = &outcome.calibration;
    let mut session = Session::of(cut, Some(calibration), calibration.gravity)?;
    if let Some(fit) = &outcome.joint {
        session.mark(fit);
    }
    Ok(session)
}

/// Writes plots and report. Every recording has a plot of its own.
fn draw(pictures: Pictures, recordings: &[Recording], outcome: &Outcome) -> Result<(), Failure> {
    let (plots, page) = drawn(recordings, outcome)?;
    pictures.write(&plots, &page)
}

/// Plots and report.
fn drawn(
    recordings: &[Recording],
    outcome: &Outcome,
) -> Result<(Vec<(String, Picture)>, Report), Failure> {
    let calibration = &outcome.calibration;
    let session = session(recordings, outcome)?;
    let units = tables::units(outcome);
    let plots = calibration::pictures(calibration, &session, units);
    let page = calibration::page(calibration, &session, &plots, units)?;
    Ok((plots, page))
}

/// The report alone, as HTML.
pub(super) fn report(recordings: &[Recording], outcome: &Outcome) -> Result<String, Failure> {
    drawn(recordings, outcome)?.1.html()
}

/// The failure itself; where a report was asked for, it says why and shows what there is.
fn refused(
    failure: Failure,
    pictures: Pictures,
    recordings: &[Recording],
    request: &Request,
) -> Failure {
    if !pictures.wanted() || ![INPUT, NOT_ENOUGH, NOT_CONVERGED].contains(&failure.code) {
        return failure;
    }
    let (detector, choose) = (&request.detector, request.choose_multiplier);
    let cut = all_cut(recordings, detector, choose, request.gravity);
    let (page, plots) = refusal::page(&failure, recordings, &cut, request.gravity);
    match pictures.write(&plots, &page) {
        Ok(()) => failure,
        Err(other) => other,
    }
}

fn finish(
    args: &Args,
    output: Option<Output>,
    recordings: &[Recording],
    outcome: &Outcome,
    residual: Option<Residual>,
) -> Result<(), Failure> {
    let calibration = &outcome.calibration;
    let json = show::json(&calibration)?;
    Output::write_given(output, &json)?;
    if args.json {
        show::warn_all(&calibration.warnings.texts(Front::CommandLine));
        show::print(&json)?;
        return gate(calibration);
    }
    let shown = Shown {
        args,
        recordings,
        calibration,
        residual: residual.map_or_else(String::new, |residual| residual.in_words()),
    };
    first_screen::screen(&shown).show(|| {
        let shares = calibration
            .prior
            .as_ref()
            .map_or_else(String::new, prior::text);
        let text = limits::text(&calibration.limits) + &tables::text(outcome);
        Names::of(recordings).short(&text) + &shares
    })?;
    gate(calibration)
}
