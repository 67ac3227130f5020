//! `discover`: where simulation and data disagree, and the name of what is missing.

mod advice;
mod alternatives;
mod args;
mod emit;
pub mod first_screen;
mod held_out;
mod page;
mod plots;
mod size;
mod tables;
mod text;
mod units;
mod verdict;
mod words;

use ::findings::Front;

pub use args::Args;
use calib::Recording;
use calib::discover::{Discovery, Request, discover, noise_in, validate};
use calib::recording::figure;
use emit::Emit;
pub use page::{page, page_after};
pub use plots::{PLOTS, plots};
pub use text::text;
pub use verdict::verdict;
pub use words::gaps;

use crate::commands::calibrate::limits::{self, gate};
use crate::commands::shared::first_screen::say;
use crate::commands::shared::inputs::{as_paths, own_effects, read, spinner};
use crate::commands::shared::names::Names;
use crate::exit::Failure;
use crate::output::Output;
use crate::{show, steps};

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    let mut inputs = args.recordings.paths();
    if inputs.is_empty() {
        return Err(Failure::usage(
            "no recording given: name a file or a folder",
        ));
    }
    let files = args.validation.iter().chain(&args.noise);
    inputs.extend(files.chain(&args.effect_file).cloned());
    held_out::refuse_same_path(args.validation.as_deref(), &args.recordings.paths())?;
    let mut request = request(args)?;
    let output = Output::claim_given(args.output.as_deref(), args.replace, &as_paths(&inputs))?;
    let emit = match &args.emit_effect {
        Some(path) => {
            let taken = &request.catalogue;
            Some(Emit::claim(path, args.replace, &as_paths(&inputs), taken)?)
        }
        None => None,
    };
    let pictures = args
        .pictures
        .claim(&PLOTS, args.replace, &as_paths(&inputs))?;
    args.replace.end_if_all_exist()?;
    if let Some(path) = &args.noise {
        let given = noise_in(path)?;
        show::warn_each(&given.notes);
        request.noise = Some(given.noise);
    }
    let recordings = args.recordings.read(&args.read)?;
    request.left_out = args.leave_out.instants(recordings.len())?;
    let validation = args.validation.as_ref();
    let validation = validation.map(|path| read(path, &args.read)).transpose()?;
    let read = recordings.iter().chain(&validation);
    let remarks = read.flat_map(|r| r.warnings.texts(Front::CommandLine));
    let remarks: Vec<String> = remarks.collect();
    held_out::refuse_same_data(validation.as_ref(), &recordings)?;
    if args.units {
        return of_units(args, &recordings, &request, output);
    }
    let found = look(&recordings, validation.as_ref(), &request);
    // Where there is no discovery they may explain why.
    let mut discovery = found.inspect_err(|_| match args.json {
        true => show::warn_all(&remarks),
        false => say(&remarks),
    })?;
    limits::state(&mut discovery.findings.calibration, None, None);
    first_screen::state_next(args, &mut discovery.findings);
    let findings = &discovery.findings;
    let json = show::json(findings)?;
    Output::write_given(output, &json)?;
    if let Some(emit) = emit {
        emit.write(findings)?;
    }
    if pictures.wanted() {
        let plots = plots(&discovery);
        pictures.write(&plots, &page(&discovery, &recordings, &request, &plots)?)?;
    }
    if args.json {
        let mut warnings = findings.calibration.warnings.texts(Front::CommandLine);
        warnings.retain(|warning| !remarks.contains(warning));
        show::warn_all(&[remarks, warnings].concat());
        show::print(&json)?;
    } else {
        let of_all = recordings.iter().chain(&validation);
        let screen = first_screen::screen(args, findings, &recordings, &remarks);
        screen.show(|| text(&discovery, &Names::of(of_all)))?;
    }
    gate(&findings.calibration)
}

/// Runs the search over several units of one type for the effects that they share.
fn of_units(
    args: &Args,
    recordings: &[Recording],
    request: &Request,
    output: Option<Output>,
) -> Result<(), Failure> {
    let findings = units::look(recordings, request)?;
    let remarks = units::warnings(&findings);
    let json = show::json(&findings)?;
    Output::write_given(output, &json)?;
    if args.json {
        show::warn_all(&remarks);
        show::print(&json)?;
    } else {
        units::screen(args.output.as_deref(), &findings, remarks)
            .show(|| units::text(&findings))?;
    }
    units::gate(&findings)
}

fn request(args: &Args) -> Result<Request, Failure> {
    let gravity = args.place.gravity()?;
    if !(args.alpha > 0.0 && args.alpha <= 0.5) {
        return Err(Failure::usage(format!(
            "--alpha {}: a chance above 0 and at most 0.5 expected; 0.01 is one false claim in a hundred \
                 recordings",
            figure(args.alpha)
        )));
    }
    let (detector, choose_multiplier) = args.detector.detector()?;
    let mut request = Request {
        alpha: args.alpha,
        force_device: args.force_device,
        latitude: args.place.latitude,
        clock: args.clock.mode(),
        flicker: args.flicker,
        detector,
        choose_multiplier,
        gravity_source: gravity.source,
        watch: steps::watch(),
        ..Request::new(gravity.value)
    };
    request.catalogue.extend(own_effects(&args.effect_file)?);
    Ok(request)
}

/// The discovery, with the gap on the validation recording.
pub fn look(
    recordings: &[Recording],
    validation: Option<&Recording>,
    request: &Request,
) -> Result<Discovery, Failure> {
    let spinner = spinner("looking for what is missing");
    let mut discovery = discover(recordings, request)?;
    if let Some(recording) = validation {
        spinner.set_message("comparing with the validation recording");
        let validated = validate(recording, request, &discovery)?;
        discovery.findings.validation = validated.gaps;
        discovery.findings.confirmations = validated.confirmations;
        let warnings = &mut discovery.findings.calibration.warnings;
        warnings.extend(validated.doubts);
    }
    spinner.finish_and_clear();
    Ok(discovery)
}
