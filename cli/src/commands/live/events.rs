//! Events of a session for programs: one JSON document per line.

use std::path::Path;

use live::{Event, Instruction, View};
use serde_json::{Value, json};

use crate::exit::Failure;
use crate::output::Growing;

/// A file of lines; nothing where none is asked for.
#[derive(Debug)]
pub(super) struct Events(Option<Growing>);

impl Events {
    /// Begins the file, or goes on with it; it is none of `inputs`.
    pub(super) fn open(path: Option<&Path>, inputs: &[&Path]) -> Result<Self, Failure> {
        let file = path.map(|path| Growing::append_to(path, inputs));
        Ok(Self(file.transpose()?))
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
        match &mut self.0 {
            Some(file) => Ok(file.append(format!("{document}\n").as_bytes())?),
            None => Ok(()),
        }
    }
}
