//! Texts whose columns, units, signs or clocks their names do not say: a table and a line in the registry each.

use crate::Error;
use crate::formats::format::{Format, text};
use crate::header::look::Look;
use crate::recording::assemble::assemble;
use crate::recording::content::Recording;
use crate::recording::options::ReadOptions;
use crate::rows::parts::{self, Part};
use crate::source::Source;

/// A text that is known by its first lines.
#[derive(Debug)]
pub(crate) struct TextFormat {
    /// The name for `--format`.
    pub name: &'static str,
    /// Description of the format in one line.
    pub about: &'static str,
    /// Function that returns the parts to read; `None` for any other text.
    pub parts: fn(&Look) -> Option<Vec<Part>>,
}

impl Format for TextFormat {
    fn name(&self) -> &'static str {
        self.name
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Text(input) if (self.parts)(input.look()).is_some())
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let input = text(source, self)?;
        let name = input.name.clone();
        let mut parts = (self.parts)(input.look()).unwrap_or_default();
        if options.columns.names_a_sensor() || parts.is_empty() {
            // What the user says of the columns goes over what is known of the format.
            parts.truncate(1);
            parts.resize_with(1, Part::default);
            parts[0].only = None;
        }
        assemble(name, parts::read(input, &parts, options)?, options)
    }
}
