//! `live`: a guided session.

mod args;
mod events;
mod finish;
mod ordinary;
mod screen;
mod visitors;
mod web;
mod words;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use ::findings::{Finding, Kind};
pub use args::Args;
use calib::calibrate::Request;
use events::Events;
use live::{Aim, Batch, Event, Opening, Session, Source, View, Waits, open};
use screen::Screen;
use web::Web;

use crate::exit::Failure;
use crate::output::Folder;
use crate::show;

/// A phone that has not answered for so long is given up.
const PATIENCE: Duration = Duration::from_secs(180);

/// Runs the command.
pub fn run(args: &Args) -> Result<(), Failure> {
    check(args)?;
    ordinary::parse(args, Path::new("recording"))?;
    let gravity = args.place.gravity()?;
    // It goes in the end where nothing came.
    let (path, _folder) = folder(args)?;
    ordinary::refuse_outputs(args, &path)?;
    let how = Opening {
        folder: path.clone(),
        read: args.read.clone().into(),
        baud: args.baud,
        patience: PATIENCE,
        waits: Waits::default(),
    };
    let events = Events::open(args.events.as_deref(), &[Path::new(&args.source)])?;
    let mut source = open(&args.source, &how)?;
    let aim = Aim {
        placements: args.placements.into(),
        hold: args.hold,
        request: Request {
            gravity: gravity.value,
            gravity_source: gravity.source,
            latitude: args.place.latitude,
            ..Request::default()
        },
    };
    show::say(&format!("recording in {}", show::path(&path)));
    show::say(&format!(
        "it ends when this is reached: {}",
        words::promise()
    ));
    let web = args.web.then(Web::start).transpose()?;
    guide(
        args,
        source.as_mut(),
        events,
        Session::new(aim),
        web.as_ref(),
    )?;
    let finished = source.finish()?;
    if let Some(reason) = &finished.fallback {
        show::warn(&format!(
            "the phone's own file is not used ({reason}): what came live, to eight digits, is calibrated"
        ));
    }
    let recording = &finished.recording;
    if args.source == "-" && !recording.exists() {
        let empty = calib::Error::usage(Finding::of(Kind::EMPTY_INPUT));
        return Err(empty.into());
    }
    show::say(&format!(
        "calibrating {}; again with: {}",
        show::path(recording),
        ordinary::again(args, recording)
    ));
    let done = ordinary::calibrate(args, recording, web.as_ref());
    if let Some(web) = &web {
        keep_open(web);
    }
    done
}

/// Waits while somebody looks at the page, to read the result and keep its files.
fn keep_open(web: &Web) {
    if web.is_open() {
        show::say(
            "the page shows the result and offers its files; this ends a minute after it is closed",
        );
    }
    while web.is_open() {
        std::thread::sleep(Duration::from_millis(200));
    }
}

fn check(args: &Args) -> Result<(), Failure> {
    let limits = [
        ("--hold", args.hold, 4.0..=60.0),
        ("--poll", args.poll, 0.0..=5.0),
    ];
    for (name, value, range) in limits {
        if !range.contains(&value) {
            let words = format!(
                "{name} {value}: {} to {} s expected",
                range.start(),
                range.end()
            );
            return Err(Failure::usage(words));
        }
    }
    Ok(())
}

/// The folder for what comes. It is removed again where nothing came.
fn folder(args: &Args) -> Result<(PathBuf, Folder), Failure> {
    let numbered = || {
        (1..)
            .map(|k| PathBuf::from(format!("live-{k}")))
            .find(|path| !path.exists())
    };
    let path = args.out.clone().or_else(numbered).unwrap_or_default();
    let is_empty = std::fs::read_dir(&path).map_or(true, |mut entries| entries.next().is_none());
    if path.exists() && !is_empty {
        return Err(Failure::exists("exists already")
            .in_file(show::path(&path))
            .advise("name a new or an empty folder with --out"));
    }
    let folder = Folder::make(&path)?;
    Ok((path, folder))
}

/// The session, until enough is known or nothing comes any more.
fn guide(
    args: &Args,
    source: &mut dyn Source,
    mut events: Events,
    mut session: Session,
    web: Option<&Web>,
) -> Result<(), Failure> {
    let screen = Screen::new();
    if let Some(web) = web {
        screen.line(&format!(
            "open {} in a browser on this machine",
            web.address()
        ));
    }
    let begin = Instant::now();
    loop {
        let batch = match source.poll(begin.elapsed()) {
            Ok(batch) => batch,
            Err(error) if error.ends_a_session() && !session.placements().is_empty() => {
                screen.line(&format!("warning: {error}: the session ends here"));
                break;
            }
            Err(error) => return Err(error.into()),
        };
        let said = session.take(&batch);
        let view = View::of(&session);
        for event in &batch.events {
            screen.event(event);
            events.event(&view, event)?;
        }
        for instruction in &said {
            screen.instruction(instruction, &view);
            events.instruction(&view, instruction)?;
        }
        screen.show(&view);
        if let Some(web) = web {
            web.publish(&view);
        }
        if session.instruction().ends() || has_ended(&batch) {
            break;
        }
        std::thread::sleep(
            batch
                .pause
                .unwrap_or_default()
                .max(Duration::from_secs_f64(args.poll)),
        );
    }
    screen.end(&View::of(&session));
    Ok(())
}

fn has_ended(batch: &Batch) -> bool {
    batch.events.contains(&Event::Ended)
}
