//! Logs that hold a sensor more than once: what is in them, and the option that chooses.

use std::path::Path;

use calib::Recording;
use calib::recording::formats::LogContents;
use findings::Front;
use serde_json::{Value, json};

use crate::commands::shared::first_screen::to_calibrate;
use crate::exit::Failure;
use crate::read_args::ReadArgs;
use crate::show;

/// A log among whose streams a person has to choose.
pub struct Log {
    name: String,
    contents: LogContents,
    /// The command that reads it.
    next: String,
}

impl Log {
    /// The log at `path`, which was refused.
    ///
    /// # Errors
    /// Why it was refused, where that is not for a choice.
    pub fn of(path: &Path, args: &ReadArgs, refused: Failure) -> Result<Self, Failure> {
        let contents = Recording::streams_in(path, &args.clone().into());
        let Some(contents) = contents.ok().flatten().filter(LogContents::has_choice) else {
            return Err(refused);
        };
        let next = format!(
            "stillpoint calibrate {} {} -o cal.json",
            crate::show::command_line(path),
            contents
                .first_option(Front::CommandLine)
                .unwrap_or_default()
        );
        Ok(Self {
            name: show::path(path),
            contents,
            next,
        })
    }

    /// For programs.
    pub fn document(&self) -> Value {
        let streams = self.contents.streams.iter().map(|stream| {
            json!({
                "sensor": stream.sensor,
                "source": stream.source,
                "instance": stream.instance,
                "samples": stream.samples,
                "rate": stream.rate,
                "corrected_by_the_device": stream.processed,
                "option": stream.option(Front::CommandLine),
            })
        });
        json!({
            "file": self.name,
            "format": self.contents.format,
            "streams": streams.collect::<Vec<_>>(),
            "command": self.next,
        })
    }

    /// For people.
    pub fn page(&self) -> String {
        let mut table = show::table(&["sensor", "source", "rows", "rate Hz", "chosen by"]);
        for stream in &self.contents.streams {
            let corrected = match stream.processed {
                true => " (corrected already)",
                false => "",
            };
            table.add_row([
                stream.sensor.to_owned(),
                format!(
                    "{} {}{corrected}",
                    show::name(&stream.source),
                    stream.instance
                ),
                stream.samples.to_string(),
                format!("{:.2}", stream.rate),
                stream.option(Front::CommandLine).unwrap_or_default(),
            ]);
        }
        format!(
            "{}: {}, with several sensors of a kind: choose one\n\n{table}\n\n{}\n",
            self.name,
            self.contents.format,
            to_calibrate(&self.next)
        )
    }
}
