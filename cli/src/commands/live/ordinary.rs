//! The ordinary calibration of what a session left.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Parser;

use super::args::Args;
use super::finish::Finish;
use super::web::Web;
use crate::call;
use crate::commands::calibrate;
use crate::commands::shared::inputs::as_paths;
use crate::exit::Failure;
use crate::read_args::quoted;
use crate::show::command_line;

/// The command `calibrate` by itself.
#[derive(Debug, Parser)]
#[command(no_binary_name = true)]
struct Ordinary {
    #[command(flatten)]
    args: calibrate::Args,
}

/// The command that calibrates `recording` once more.
pub(super) fn again(args: &Args, recording: &Path) -> String {
    let (recording, place, read) = (
        command_line(recording),
        args.place.command_line(),
        args.read.command_line(),
    );
    let more: String = args
        .calibrate
        .iter()
        .map(|word| format!(" {}", quoted(word)))
        .collect();
    format!("stillpoint calibrate {recording}{place}{read}{more}")
}

/// The call of `calibrate` for `recording`.
pub(super) fn parse(args: &Args, recording: &Path) -> Result<calibrate::Args, Failure> {
    let mut words: Vec<OsString> = vec![recording.into()];
    let place = [
        ("--gravity", args.place.gravity),
        ("--latitude", args.place.latitude),
        ("--altitude", args.place.altitude),
    ];
    for (option, value) in place {
        if let Some(value) = value {
            words.push(format!("{option}={value}").into());
        }
    }
    if let Some(output) = &args.output {
        words.extend(["-o".into(), output.into()]);
    }
    let flags = [
        ("--json", args.json),
        ("--force", args.replace.force()),
        ("--skip-existing", args.replace.skip_existing()),
    ];
    words.extend(
        flags
            .iter()
            .filter(|(_, given)| *given)
            .map(|(flag, _)| (*flag).into()),
    );
    words.extend(args.calibrate.iter().map(OsString::from));
    let call = call::shown(std::iter::once(&"calibrate".into()).chain(&words));
    let parsed = Ordinary::try_parse_from(words);
    let as_it_came = |mut ordinary: Ordinary| {
        ordinary.args.call = Some(call);
        ordinary.args.read_as(&args.read);
        ordinary.args
    };
    parsed.map(as_it_came).map_err(|error| {
        let words = error.render().to_string();
        Failure::usage(format!(
            "after `--`: {}",
            words.trim().trim_start_matches("error: ")
        ))
    })
}

/// Refuses, before a session is held for it, an output that cannot be written or would be written over what is read:
/// the source, or what comes into `folder`.
pub(super) fn refuse_outputs(args: &Args, folder: &Path) -> Result<(), Failure> {
    let mut inputs = vec![PathBuf::from(&args.source)];
    inputs.extend(live::FILES.map(|name| folder.join(name)));
    if let Some(events) = &args.events {
        ::output::refuse_input(events, &as_paths(&inputs))?;
        inputs.push(events.clone());
    }
    calibrate::claim(&parse(args, folder)?, &as_paths(&inputs))?;
    Ok(())
}

/// Calibrates `recording`; the page shows what came of it.
pub(super) fn calibrate(args: &Args, recording: &Path, web: Option<&Web>) -> Result<(), Failure> {
    let done = calibrate::run_and_show(&parse(args, recording)?, &mut |recordings, outcome| {
        if let Some(web) = web {
            web.finish(&Finish::of(recordings, outcome)?);
        }
        Ok(())
    });
    if let (Err(failure), Some(web)) = (&done, web) {
        web.refuse(&failure.message);
    }
    done
}
