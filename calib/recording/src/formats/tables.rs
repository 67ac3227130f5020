//! Files of tables, read by `stillpoint-formats` as the texts that they would be.

use file_formats::Tabular;

use super::{Format, Source, recognise};
use crate::Error;
use crate::recording::{ReadOptions, Recording};
use crate::source::place::in_file;

/// The format of tables that is called so.
#[derive(Debug)]
pub(crate) struct Tables(pub &'static str);

/// Formats of texts and folders that say nothing that the format of the file does not.
const PLAIN: [&str; 4] = ["csv", "imu_tk", "folder", "bundle"];

impl Format for Tables {
    fn name(&self) -> &'static str {
        self.0
    }

    fn about(&self) -> &'static str {
        Tabular::by_name(self.0).map_or("", |format| format.about)
    }

    fn recognises(&self, source: &Source) -> bool {
        matches!(source, Source::Tables(format, _) if format.name == self.0)
    }

    fn read(&self, source: Source, options: &ReadOptions) -> Result<Recording, Error> {
        let source = match source {
            Source::Tables(format, inner) if format.name == self.0 => *inner,
            other => {
                let expected = "a file of that format";
                return Err(super::mismatch(other.name(), self, expected));
            }
        };
        let format = recognise(&source);
        let format = format.ok_or_else(|| in_file(source.name(), "of no known format"))?;
        let mut recording = format.read(source, options)?;
        let described = &mut recording.description.format;
        if described.is_empty() {
            *described = format.name();
        }
        if PLAIN.contains(described) {
            *described = self.0;
        }
        Ok(recording)
    }
}
