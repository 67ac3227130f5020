//! What happens, for programs: a JSON document a line.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use live::{Event, Instruction, View};
use serde_json::{Value, json};

use crate::exit::{Failure, OUTPUT};
use crate::show;

/// A file of lines; nothing where none is asked for.
#[derive(Debug)]
pub(super) struct Events(Option<(PathBuf, File)>);

impl Events {
    pub(super) fn open(path: Option<&Path>) -> Result<Self, Failure> {
        let Some(path) = path else {
            return Ok(Self(None));
        };
        let file = OpenOptions::new().create(true).append(true).open(path);
        let file = file.map_err(|error| refused(path, &error))?;
        Ok(Self(Some((path.to_owned(), file))))
    }

    pub(super) fn instruction(
        &mut self,
        view: &View,
        instruction: &Instruction,
    ) -> Result<(), Failure> {
        self.line(&json!({"seconds": view.seconds, "placements": view.placements.len(), "instruction": instruction}))
    }

    pub(super) fn event(&mut self, view: &View, event: &Event) -> Result<(), Failure> {
        self.line(
            &json!({"seconds": view.seconds, "placements": view.placements.len(), "source": event}),
        )
    }

    fn line(&mut self, document: &Value) -> Result<(), Failure> {
        let Some((path, file)) = &mut self.0 else {
            return Ok(());
        };
        let written = file.write_all(format!("{document}\n").as_bytes());
        written.map_err(|error| refused(path, &error))
    }
}

fn refused(path: &Path, error: &std::io::Error) -> Failure {
    Failure::new(
        OUTPUT,
        format!(
            "{}: cannot be written: {error}; choose another file",
            show::path(path)
        ),
    )
}
